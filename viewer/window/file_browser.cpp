#include "viewer/window/file_browser.hpp"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <system_error>

namespace curveskel::viewer {
namespace {

namespace fs = std::filesystem;

/// The working directory, if it is still there.
fs::path first_folder() {
  std::error_code error;
  const fs::path here = fs::current_path(error);
  return error ? fs::path("/") : here;
}

}  // namespace

void FileBrowser::go_to(const fs::path& folder) {
  std::error_code error;
  const fs::path whole = fs::absolute(folder, error).lexically_normal();
  if (fs::is_directory(whole, error)) folder_ = whole;
  list();
}

void FileBrowser::list() {
  entries_.clear();
  error_.clear();
  std::error_code error;
  fs::directory_iterator entry(folder_, error);
  while (!error && entry != fs::directory_iterator()) {
    std::error_code unknown;
    const std::string name = entry->path().filename().string();
    if (!name.starts_with('.')) entries_.push_back({name, entry->is_directory(unknown)});
    entry.increment(error);
  }
  if (error) error_ = folder_.string() + ": " + error.message();
  std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
    return a.folder != b.folder ? a.folder : a.name < b.name;
  });
}

void FileBrowser::ask(Purpose purpose, const std::string& title,
                      const std::string& suggested_name) {
  purpose_ = purpose;
  title_ = title;
  name_ = suggested_name;
  shown_ = opens_now_ = true;
  frames_to_open_ = 5;  // ImGui takes two
  go_to(folder_.empty() ? first_folder() : folder_);
}

std::optional<fs::path> FileBrowser::draw() {
  if (!shown_) return std::nullopt;
  const char* const title = title_.c_str();
  if (opens_now_) ImGui::OpenPopup(title);
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  const float letter = ImGui::GetFontSize();
  ImGui::SetNextWindowSize(
      {std::min(46 * letter, screen.x * 0.9F), std::min(34 * letter, screen.y * 0.9F)},
      ImGuiCond_Appearing);
  ImGui::SetNextWindowPos({screen.x / 2, screen.y / 2}, ImGuiCond_Appearing, {0.5F, 0.5F});
  std::optional<fs::path> chosen;
  if (!ImGui::BeginPopupModal(title, &shown_)) return chosen;
  ImGui::TextUnformatted(folder_.string().c_str());
  if (!error_.empty()) ImGui::TextColored({0.9F, 0.2F, 0.2F, 1}, "%s", error_.c_str());
  const float line = ImGui::GetFrameHeightWithSpacing();
  fs::path next;
  if (ImGui::BeginChild("files", {0, -line}, true)) {
    if (ImGui::Selectable("../")) next = folder_.parent_path();
    for (const Entry& entry : entries_) {
      const std::string label = entry.folder ? entry.name + "/" : entry.name;
      if (!ImGui::Selectable(label.c_str(), entry.name == name_,
                             ImGuiSelectableFlags_AllowDoubleClick)) {
        continue;
      }
      if (entry.folder) {
        next = folder_ / entry.name;
      } else {
        name_ = entry.name;
        // To replace it takes a word more.
        const bool opens = purpose_ == Purpose::open && ImGui::IsMouseDoubleClicked(0);
        if (opens) chosen = folder_ / name_;
      }
    }
  }
  ImGui::EndChild();
  if (!next.empty()) go_to(next);
  if (opens_now_) ImGui::SetKeyboardFocusHere();
  opens_now_ = false;
  const float button = 5 * letter;
  ImGui::SetNextItemWidth(-2 * button - 2 * ImGui::GetStyle().ItemSpacing.x - 1);
  const bool entered = ImGui::InputText("##name", &name_, ImGuiInputTextFlags_EnterReturnsTrue);
  frames_to_open_ = ImGui::IsItemActive() ? 0 : std::max(frames_to_open_ - 1, 0);
  ImGui::SameLine();
  const bool pressed = ImGui::Button(purpose_ == Purpose::open ? "Open" : "Save", {button, 0});
  ImGui::SameLine();
  if (ImGui::Button("Cancel", {button, 0})) shown_ = false;
  if ((entered || pressed) && !name_.empty()) {
    const fs::path typed(name_);
    chosen = typed.is_absolute() ? typed : folder_ / typed;
  }
  if (chosen) {
    std::error_code error;
    if (fs::is_directory(*chosen, error)) {
      go_to(*chosen);
      chosen.reset();
    }
  }
  if (chosen) shown_ = false;
  if (!shown_) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
  return chosen;
}

}  // namespace curveskel::viewer
