#include "viewer/window/letters.hpp"

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <utility>

#include "viewer/software/priority.hpp"

namespace curveskel::viewer {
namespace {

constexpr char32_t first_letter = 0x20;
constexpr char32_t last_latin_letter = 0xFF;
constexpr char32_t first_not_shown = 0xFFFD;

bool is_within(char32_t one, char32_t first, char32_t last) { return one >= first && one <= last; }

/// Joiners, marks of direction, and those that choose how an emoji looks.
bool is_mark_without_shape(char32_t one) {
  return is_within(one, 0x200B, 0x200F) || is_within(one, 0x202A, 0x202E) ||
         is_within(one, 0x2060, 0x206F) || is_within(one, 0xFE00, 0xFE0F) || one == 0xFEFF;
}

bool is_chinese_japanese_or_korean(char32_t one) {
  return is_within(one, 0x1100, 0x11FF) || is_within(one, 0x2E80, 0x9FFF) ||
         is_within(one, 0xA960, 0xA97F) || is_within(one, 0xAC00, 0xD7FF) ||
         is_within(one, 0xF900, 0xFAFF) || is_within(one, 0xFE30, 0xFE4F) ||
         is_within(one, 0xFF00, 0xFFEF);
}

/// Arrows, signs and pictures, and what is private or nothing: no package is sure to have them.
bool is_of_no_script(char32_t one) {
  return is_within(one, 0x2000, 0x2BFF) || is_within(one, 0xD800, 0xF8FF) ||
         is_within(one, 0xFDD0, 0xFDEF);
}

}  // namespace

std::string words_on_lacking(const std::vector<char32_t>& characters) {
  bool of_cjk = false;
  bool of_others = false;
  for (const char32_t one : characters) {
    const bool is_cjk = is_chinese_japanese_or_korean(one);
    of_cjk = of_cjk || is_cjk;
    of_others = of_others || (!is_cjk && !is_of_no_script(one));
  }
  std::string text =
      "a name has characters that no font of this system has, so that they are shown as ?";
  if (of_cjk) text += "; Debian's fonts-noto-cjk has those of Chinese, Japanese and Korean";
  if (of_others) text += "; Debian's fonts-noto-core has those of most scripts";
  return text;
}

Letters::Letters(float line_pixels) : line_pixels_(line_pixels), own_(usual_face()) {
  for (char32_t one = first_letter; one <= last_latin_letter; ++one) wanted_.set(one);
  build();
}

void Letters::want(std::string_view text) {
  const char* at = text.data();
  const char* const end = at + text.size();
  while (at < end) {
    unsigned character = static_cast<unsigned char>(*at);
    if (character < 0x80) {
      ++at;
      continue;
    }
    at += std::max(ImTextCharFromUtf8(&character, at, end), 1);
    // ImGui has U+FFFD for what it cannot show, such as emoji; no font is looked for it.
    if (character < first_letter || character >= first_not_shown || wanted_[character]) continue;
    wanted_.set(character);
    new_.push_back(character);
  }
}

bool Letters::has(char32_t character) const {
  if (own_ && own_->has(character)) return true;
  return std::any_of(others_.begin(), others_.end(),
                     [&](const auto& face) { return face->has(character); });
}

void Letters::look_for(std::vector<char32_t> characters) {
  looked_for_ = characters;
  found_ = std::async(std::launch::async, [wanted = std::move(characters)] {
    give_way();
    return faces_with(wanted);
  });
}

bool Letters::take_found() {
  const bool ready =
      found_.valid() && found_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
  if (!ready) return false;
  auto found = found_.get();
  others_.insert(others_.end(), found.begin(), found.end());
  std::copy_if(looked_for_.begin(), looked_for_.end(), std::back_inserter(lacking_),
               [&](char32_t one) { return !has(one) && !is_mark_without_shape(one); });
  return !found.empty();
}

bool Letters::update() {
  bool anew = take_found();
  if (!new_.empty() && !found_.valid()) {
    const auto known =
        std::partition(new_.begin(), new_.end(), [&](char32_t one) { return has(one); });
    anew = anew || known != new_.begin();
    if (known != new_.end()) look_for({known, new_.end()});
    new_.clear();
  }
  if (anew) build();
  return anew;
}

std::string Letters::take_lacking() {
  if (lacking_.empty() || std::exchange(told_, true)) return {};
  return words_on_lacking(lacking_);
}

void Letters::build() {
  ranges_.clear();
  for (std::size_t first = first_letter; first < count; ++first) {
    if (!wanted_[first]) continue;
    std::size_t last = first;
    while (last + 1 < count && wanted_[last + 1]) ++last;
    ranges_.push_back(static_cast<unsigned short>(first));
    ranges_.push_back(static_cast<unsigned short>(last));
    first = last;
  }
  ranges_.push_back(0);
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  atlas.Clear();
  if (!own_) {
    constexpr float plain_pixels = 13;  // of the font in ImGui
    atlas.AddFontDefault();
    ImGui::GetIO().FontGlobalScale = line_pixels_ / plain_pixels;
  }
  const auto add = [&](const FontFace& face) {
    const float lines_of_own = own_ ? own_->lines_per_letter() : face.lines_per_letter();
    ImFontConfig config;
    config.FontDataOwnedByAtlas = false;
    config.FontNo = face.number();
    config.MergeMode = !atlas.Fonts.empty();
    const float pixels = line_pixels_ * face.lines_per_letter() / lines_of_own;
    atlas.AddFontFromMemoryTTF(const_cast<void*>(face.bytes()), static_cast<int>(face.size()),
                               pixels, &config, ranges_.data());
  };
  if (own_) add(*own_);
  for (const auto& face : others_) add(*face);
  atlas.Build();
}

}  // namespace curveskel::viewer
