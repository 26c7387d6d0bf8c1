#include "viewer/window/field_text.hpp"

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>

namespace curveskel::viewer {
namespace {

constexpr unsigned first_private = 0xE000;
constexpr unsigned last_private = 0xF8FF;
constexpr unsigned unheld_character = 0xFFFD;  // ImGui's word for one that it cannot hold
constexpr std::string_view unheld_character_itself = "\xEF\xBF\xBD";

/// Of three bytes.
std::string private_character(std::size_t number) {
  const auto character = static_cast<unsigned>(first_private + number);
  const auto six_bits = [character](int shift) {
    return static_cast<char>(0x80U | ((character >> shift) & 0x3FU));
  };
  return {static_cast<char>(0xE0U | (character >> 12U)), six_bits(6), six_bits(0)};
}

/// The first character of the text and the bytes that are it.
std::string_view next_bytes(std::string_view text, unsigned& character) {
  const char* const end = text.data() + text.size();
  const int bytes = std::max(ImTextCharFromUtf8(&character, text.data(), end), 1);
  return text.substr(0, static_cast<std::size_t>(bytes));
}

bool is_private(unsigned character) {
  return character >= first_private && character <= last_private;
}

}  // namespace

std::string FieldText::place_of(std::string_view bytes) {
  const auto found = std::find(kept_.begin(), kept_.end(), bytes);
  const auto number = static_cast<std::size_t>(found - kept_.begin());
  if (first_private + number > last_private) return {};
  if (found == kept_.end()) kept_.emplace_back(bytes);
  return private_character(number);
}

std::string FieldText::in_field(std::string_view text) {
  std::string shown;
  while (!text.empty()) {
    unsigned character = 0;
    const std::string_view bytes = next_bytes(text, character);
    const bool holds = !is_private(character) &&
                       (character != unheld_character || bytes == unheld_character_itself);
    shown += holds ? std::string(bytes) : place_of(bytes);
    text.remove_prefix(bytes.size());
  }
  return shown;
}

std::string FieldText::from_field(std::string_view shown) const {
  shown = shown.substr(0, shown.find('\0'));
  std::string text;
  while (!shown.empty()) {
    unsigned character = 0;
    const std::string_view bytes = next_bytes(shown, character);
    const std::size_t number = character - first_private;
    text += is_private(character) && number < kept_.size() ? kept_[number] : std::string(bytes);
    shown.remove_prefix(bytes.size());
  }
  return text;
}

}  // namespace curveskel::viewer
