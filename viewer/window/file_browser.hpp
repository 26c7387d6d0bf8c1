// A dialog that finds a file to open or names one to save.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "viewer/window/field_text.hpp"

namespace curveskel::viewer {

/// Controls beneath the list of files, for names with this extension.
struct FieldsForName {
  std::string extension;  ///< in lower case, without its dot; none: never
  int lines = 0;
  /// Of true: the keys are for the first that lacks a text. Returns true where Enter ended one.
  std::function<bool(bool)> draw;
  std::function<std::string()> missing;  ///< why such a file cannot be saved yet; empty: it can
};

class FileBrowser {
 public:
  enum class Purpose { open, save };

  /// Shows up at the next `draw`, in the folder last seen. `title`: of the dialogue.
  /// `hint`: what may be opened, or how names are understood.
  void ask(Purpose purpose, const std::string& title, const std::string& suggested_name,
           const std::string& hint = {});
  /// Within an ImGui frame; the chosen file, once. One that is to be saved and lacks something
  /// is not chosen: the dialogue says why, and stays.
  [[nodiscard]] std::optional<std::filesystem::path> draw(const FieldsForName& fields = {});
  /// Of the file that the field names.
  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] Purpose purpose() const { return purpose_; }
  [[nodiscard]] bool shown() const { return shown_; }
  /// True while it says what such a file lacks.
  [[nodiscard]] bool lacks_fields() const { return lacks_fields_; }
  /// Asked for, and not yet ready to be typed into.
  [[nodiscard]] bool opening() const { return shown_ && frames_to_open_ > 0; }
  void close() { shown_ = false; }
  void go_to(const std::filesystem::path& folder);
  /// The texts that it shows, if it is shown.
  void for_each_name(const std::function<void(const std::string&)>& visit) const;

 private:
  struct Entry {
    std::string name;
    bool folder = false;
  };
  void list();
  void draw_entries(std::filesystem::path& next, std::optional<std::filesystem::path>& chosen);
  void draw_error(const FieldsForName& fields);
  [[nodiscard]] float height_of_hint() const;
  void draw_hint() const;
  /// The field for the name and the buttons; true if a file was chosen by them.
  [[nodiscard]] bool draw_choice();
  /// A folder is entered, a file that lacks something stays unchosen.
  void refuse_unready(std::optional<std::filesystem::path>& chosen, const FieldsForName& fields);
  [[nodiscard]] bool asks_for(const FieldsForName& fields) const;
  /// True if a name was typed and ended by Enter.
  [[nodiscard]] bool draw_name();
  /// The name of the entry so many lines from the one that is named.
  [[nodiscard]] std::string name_beside(const std::string& name, int lines) const;
  [[nodiscard]] std::filesystem::path named() const;

  Purpose purpose_ = Purpose::open;
  std::string title_;
  std::string hint_;
  bool shown_ = false;
  bool opens_now_ = false;
  bool focuses_ = false;  // on the name
  bool focuses_field_ = false;
  bool scrolls_ = false;    // to the entry that is named
  int frames_to_open_ = 0;  // at most
  std::filesystem::path folder_;
  std::vector<Entry> entries_;
  std::string name_;
  FieldText field_text_;
  std::string error_;
  bool lacks_fields_ = false;  // so that the reader is told what they lack
};

}  // namespace curveskel::viewer
