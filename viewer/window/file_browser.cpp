#include "viewer/window/file_browser.hpp"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <system_error>
#include <utility>

#include <curveskel/advanced/file_names.hpp>
#include "viewer/window/reading_order.hpp"

namespace curveskel::viewer {
namespace {

namespace fs = std::filesystem;

/// The working directory, if it is still there.
fs::path first_folder() {
  std::error_code error;
  const fs::path here = fs::current_path(error);
  return error ? fs::path("/") : here;
}

/// With all of its label: ImGui leaves out what follows "##", and takes equal labels for one.
bool whole_selectable(const std::string& label, bool selected) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::PushID(label.c_str());
  const bool pressed =
      ImGui::Selectable("##entry", selected, ImGuiSelectableFlags_AllowDoubleClick);
  ImGui::PopID();
  ImGui::GetWindowDrawList()->AddText(at, ImGui::GetColorU32(ImGuiCol_Text), label.c_str());
  return pressed;
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

void FileBrowser::for_each_name(const std::function<void(const std::string&)>& visit) const {
  if (!shown_) return;
  visit(folder_.string());
  visit(error_);
  visit(name_);
  for (const Entry& entry : entries_) visit(entry.name);
}

void FileBrowser::ask(Purpose purpose, const std::string& title, const std::string& suggested_name,
                      const std::string& hint) {
  purpose_ = purpose;
  title_ = title;
  hint_ = hint;
  name_ = suggested_name;
  shown_ = opens_now_ = true;
  lacks_fields_ = false;
  frames_to_open_ = 5;  // ImGui takes two
  go_to(folder_.empty() ? first_folder() : folder_);
}

std::string FileBrowser::name_beside(const std::string& name, int lines) const {
  if (entries_.empty()) return name;
  const auto now = std::find_if(entries_.begin(), entries_.end(),
                                [&](const Entry& entry) { return entry.name == name; });
  const auto last = static_cast<std::ptrdiff_t>(entries_.size()) - 1;
  const std::ptrdiff_t at = now != entries_.end() ? now - entries_.begin() + lines
                            : lines > 0           ? 0
                                                  : last;
  return entries_[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(at, 0, last))].name;
}

/// A name typed as in a shell: from the folder that is shown, or from the home folder.
fs::path FileBrowser::named() const {
  const char* const home = std::getenv("HOME");
  if (home != nullptr && (name_ == "~" || name_.starts_with("~/"))) {
    return fs::path(home) / (name_.size() > 2 ? name_.substr(2) : "");
  }
  return folder_ / name_;  // itself if it is absolute
}

void FileBrowser::draw_entries(fs::path& next, std::optional<fs::path>& chosen) {
  if (ImGui::Selectable("../")) next = folder_.parent_path();
  for (const Entry& entry : entries_) {
    const std::string shown = in_reading_order(entry.name);
    const std::string label = entry.folder ? shown + "/" : shown;
    const bool is_named = entry.name == name_;
    const bool pressed = whole_selectable(label, is_named);
    if (is_named && scrolls_) ImGui::SetScrollHereY();
    if (!pressed) continue;
    if (entry.folder) {
      next = folder_ / entry.name;
      continue;
    }
    name_ = entry.name;
    // To replace it takes a word more. Keys choose by a single stroke.
    const bool by_key = ImGui::GetIO().NavVisible && !ImGui::IsMouseReleased(0);
    const bool opens = by_key || ImGui::IsMouseDoubleClicked(0);
    if (purpose_ == Purpose::open && opens) chosen = folder_ / name_;
  }
  scrolls_ = false;
}

bool FileBrowser::draw_name() {
  const auto heed = [](ImGuiInputTextCallbackData* data) {
    constexpr ImWchar no_character = 0xFFFD;  // typed, and more than a field can hold
    if (data->EventFlag == ImGuiInputTextFlags_CallbackCharFilter) {
      return data->EventChar == no_character ? 1 : 0;
    }
    auto& self = *static_cast<FileBrowser*>(data->UserData);
    const int lines = data->EventKey == ImGuiKey_UpArrow ? -1 : 1;
    const std::string now =
        self.field_text_.from_field({data->Buf, static_cast<std::size_t>(data->BufTextLen)});
    const std::string beside = self.field_text_.in_field(self.name_beside(now, lines));
    data->DeleteChars(0, data->BufTextLen);
    data->InsertChars(0, beside.c_str());
    self.scrolls_ = true;
    return 0;
  };
  constexpr ImGuiInputTextFlags flags = ImGuiInputTextFlags_EnterReturnsTrue |
                                        ImGuiInputTextFlags_CallbackHistory |
                                        ImGuiInputTextFlags_CallbackCharFilter;
  std::string shown = field_text_.in_field(name_);
  const bool entered = ImGui::InputText("##name", &shown, flags, heed, this);
  name_ = field_text_.from_field(shown);
  return entered;
}

bool FileBrowser::asks_for(const FieldsForName& fields) const {
  return purpose_ == Purpose::save && !fields.extension.empty() &&
         lower_extension(name_) == fields.extension;
}

void FileBrowser::draw_error(const FieldsForName& fields) {
  lacks_fields_ = lacks_fields_ && asks_for(fields) && !fields.missing().empty();
  const std::string text = lacks_fields_ ? fields.missing() : error_;
  if (text.empty()) return;
  ImGui::PushStyleColor(ImGuiCol_Text, {0.9F, 0.2F, 0.2F, 1});
  ImGui::TextWrapped("%s", text.c_str());
  ImGui::PopStyleColor();
}

float FileBrowser::height_of_hint() const {
  if (hint_.empty()) return 0;
  const float width = ImGui::GetContentRegionAvail().x;
  return ImGui::GetStyle().ItemSpacing.y +
         ImGui::CalcTextSize(hint_.c_str(), nullptr, false, width).y;
}

void FileBrowser::draw_hint() const {
  if (hint_.empty()) return;
  ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
  ImGui::TextWrapped("%s", hint_.c_str());
  ImGui::PopStyleColor();
}

bool FileBrowser::draw_choice() {
  if (opens_now_ || focuses_) ImGui::SetKeyboardFocusHere();
  opens_now_ = focuses_ = false;
  const float button = 5 * ImGui::GetFontSize();
  ImGui::SetNextItemWidth(-2 * button - 2 * ImGui::GetStyle().ItemSpacing.x - 1);
  const bool entered = draw_name();
  frames_to_open_ = ImGui::IsItemActive() ? 0 : std::max(frames_to_open_ - 1, 0);
  ImGui::SameLine();
  const bool pressed = ImGui::Button(purpose_ == Purpose::open ? "Open" : "Save", {button, 0});
  ImGui::SameLine();
  if (ImGui::Button("Cancel", {button, 0})) shown_ = false;
  return (entered || pressed) && !name_.empty();
}

void FileBrowser::refuse_unready(std::optional<fs::path>& chosen, const FieldsForName& fields) {
  if (!chosen) return;
  std::error_code error;
  if (fs::is_directory(*chosen, error)) {
    go_to(*chosen);
    name_.clear();
    focuses_ = true;
    chosen.reset();
    return;
  }
  if (!asks_for(fields) || fields.missing().empty()) return;
  lacks_fields_ = true;
  chosen.reset();
  focuses_field_ = true;
}

std::optional<fs::path> FileBrowser::draw(const FieldsForName& fields) {
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
  if (!ImGui::BeginPopupModal(title, &shown_)) {
    shown_ = shown_ && ImGui::IsPopupOpen(title);  // a question may have come in its place
    return chosen;
  }
  ImGui::TextWrapped("%s", in_reading_order(folder_.string()).c_str());
  draw_error(fields);
  const int lines = 1 + (asks_for(fields) ? fields.lines : 0);
  const float below =
      static_cast<float>(lines) * ImGui::GetFrameHeightWithSpacing() + height_of_hint();
  fs::path next;
  if (ImGui::BeginChild("files", {0, -below}, true, ImGuiWindowFlags_NavFlattened)) {
    draw_entries(next, chosen);
  }
  ImGui::EndChild();
  if (!next.empty()) go_to(next);
  draw_hint();
  const bool entered = lines > 1 && fields.draw(std::exchange(focuses_field_, false));
  if (draw_choice() || entered) chosen = named();
  refuse_unready(chosen, fields);
  if (chosen) shown_ = false;
  if (!shown_) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
  return chosen;
}

}  // namespace curveskel::viewer
