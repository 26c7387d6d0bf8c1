// A dialog that finds a file to open or names one to save.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace curveskel::viewer {

class FileBrowser {
 public:
  enum class Purpose { open, save };

  /// Shows up at the next `draw`, in the folder last seen. `title`: of the dialogue.
  void ask(Purpose purpose, const std::string& title, const std::string& suggested_name);
  /// Within an ImGui frame; the chosen file, once.
  [[nodiscard]] std::optional<std::filesystem::path> draw();
  [[nodiscard]] Purpose purpose() const { return purpose_; }
  [[nodiscard]] bool shown() const { return shown_; }
  /// Asked for, and not yet ready to be typed into.
  [[nodiscard]] bool opening() const { return shown_ && frames_to_open_ > 0; }
  void close() { shown_ = false; }
  void go_to(const std::filesystem::path& folder);

 private:
  struct Entry {
    std::string name;
    bool folder = false;
  };
  void list();

  Purpose purpose_ = Purpose::open;
  std::string title_;
  bool shown_ = false;
  bool opens_now_ = false;
  int frames_to_open_ = 0;  // at most
  std::filesystem::path folder_;
  std::vector<Entry> entries_;
  std::string name_;
  std::string error_;
};

}  // namespace curveskel::viewer
