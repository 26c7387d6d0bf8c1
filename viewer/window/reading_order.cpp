#include "viewer/window/reading_order.hpp"

#include <algorithm>
#include <vector>

#include <fribidi.h>

namespace curveskel::viewer {
namespace {

using Letters32 = std::vector<FriBidiChar>;

Letters32 decoded(std::string_view text) {
  Letters32 letters(text.size());
  const auto size = static_cast<FriBidiStrIndex>(text.size());
  letters.resize(static_cast<std::size_t>(
      fribidi_charset_to_unicode(FRIBIDI_CHAR_SET_UTF8, text.data(), size, letters.data())));
  return letters;
}

std::string encoded(const Letters32& letters) {
  std::string text(4 * letters.size() + 1, '\0');  // with the zero that FriBidi adds
  const auto size = static_cast<FriBidiStrIndex>(letters.size());
  text.resize(static_cast<std::size_t>(
      fribidi_unicode_to_charset(FRIBIDI_CHAR_SET_UTF8, letters.data(), size, text.data())));
  return text;
}

bool is_from_right(FriBidiChar letter) {
  return (fribidi_get_bidi_type(letter) & FRIBIDI_MASK_RTL) != 0;
}

Letters32 in_order(const Letters32& read) {
  Letters32 seen(read.size() + 1);
  const auto size = static_cast<FriBidiStrIndex>(read.size());
  FriBidiParType line = FRIBIDI_PAR_LTR;
  if (fribidi_log2vis(read.data(), size, &line, seen.data(), nullptr, nullptr, nullptr) == 0) {
    return read;
  }
  // A letter that was joined to the one before leaves a mark without a shape.
  seen.resize(static_cast<std::size_t>(
      fribidi_remove_bidi_marks(seen.data(), size, nullptr, nullptr, nullptr)));
  return seen;
}

}  // namespace

std::string in_reading_order(std::string_view text) {
  constexpr unsigned char first_of_hebrew = 0xD6;  // in UTF-8; of Arabic and their forms more
  const auto may_be = [](char byte) { return static_cast<unsigned char>(byte) >= first_of_hebrew; };
  if (std::none_of(text.begin(), text.end(), may_be)) return std::string(text);
  const Letters32 letters = decoded(text);
  const bool is_utf8 = encoded(letters) == text;
  if (!is_utf8 || std::none_of(letters.begin(), letters.end(), is_from_right)) {
    return std::string(text);
  }
  return encoded(in_order(letters));
}

}  // namespace curveskel::viewer
