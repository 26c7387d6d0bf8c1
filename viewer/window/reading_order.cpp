#include "viewer/window/reading_order.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>

namespace curveskel::viewer {
namespace {

using Letters32 = std::u32string;

/// Bytes that are no UTF-8 become characters of their own, above all others.
constexpr char32_t stray_bytes = 0x200000;

std::size_t length_of(unsigned char first) {
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first < 0xE0) return 2;
  if (first >= 0xE0 && first < 0xF0) return 3;
  return first >= 0xF0 && first < 0xF5 ? 4 : 0;
}

Letters32 decoded(std::string_view text) {
  Letters32 letters;
  for (std::size_t at = 0; at < text.size();) {
    const auto first = static_cast<unsigned char>(text[at]);
    const std::size_t length = length_of(first);
    bool whole = length > 0 && at + length <= text.size();
    char32_t letter = length <= 1 ? first : first & (0xFFU >> (length + 1));
    for (std::size_t k = 1; whole && k < length; ++k) {
      const auto next = static_cast<unsigned char>(text[at + k]);
      whole = (next & 0xC0U) == 0x80;
      letter = letter << 6U | (next & 0x3FU);
    }
    letters.push_back(whole ? letter : stray_bytes + first);
    at += whole ? length : 1;
  }
  return letters;
}

std::string encoded(const Letters32& letters) {
  std::string text;
  const auto add = [&](char32_t byte) { text.push_back(static_cast<char>(byte)); };
  for (const char32_t letter : letters) {
    if (letter < 0x80) {
      add(letter);
    } else if (letter >= stray_bytes) {
      add(letter - stray_bytes);
    } else if (letter < 0x800) {
      add(0xC0 | letter >> 6U);
      add(0x80 | (letter & 0x3FU));
    } else if (letter < 0x10000) {
      add(0xE0 | letter >> 12U);
      add(0x80 | (letter >> 6U & 0x3FU));
      add(0x80 | (letter & 0x3FU));
    } else {
      add(0xF0 | letter >> 18U);
      add(0x80 | (letter >> 12U & 0x3FU));
      add(0x80 | (letter >> 6U & 0x3FU));
      add(0x80 | (letter & 0x3FU));
    }
  }
  return text;
}

bool is_within(char32_t letter, char32_t first, char32_t last) {
  return letter >= first && letter <= last;
}

bool is_digit(char32_t letter) {
  return is_within(letter, '0', '9') || is_within(letter, 0x660, 0x669) ||
         is_within(letter, 0x6F0, 0x6F9);
}

bool is_from_right(char32_t letter) {
  return !is_digit(letter) &&
         (is_within(letter, 0x590, 0x8FF) || is_within(letter, 0xFB1D, 0xFDFF) ||
          is_within(letter, 0xFE70, 0xFEFE));
}

/// Vowel signs, which stand over or under the letter before them and join nothing.
bool is_mark(char32_t letter) {
  return is_within(letter, 0x591, 0x5BD) || is_within(letter, 0x610, 0x61A) ||
         is_within(letter, 0x64B, 0x65F) || letter == 0x670;
}

/// Neither from the left nor from the right.
bool is_neutral(char32_t letter) {
  if (letter >= 0x80) return false;
  return !is_digit(letter) && !is_within(letter | 0x20U, 'a', 'z') && letter != '\n';
}

/// The forms of a letter stand one after the other: alone, at the end, at the beginning, within. A
/// letter of two forms does not join the next one.
struct Forms {
  char32_t letter;
  char32_t alone;
  int count;
};

constexpr std::array<Forms, 42> arabic_forms{{
    {0x621, 0xFE80, 1}, {0x622, 0xFE81, 2}, {0x623, 0xFE83, 2}, {0x624, 0xFE85, 2},
    {0x625, 0xFE87, 2}, {0x626, 0xFE89, 4}, {0x627, 0xFE8D, 2}, {0x628, 0xFE8F, 4},
    {0x629, 0xFE93, 2}, {0x62A, 0xFE95, 4}, {0x62B, 0xFE99, 4}, {0x62C, 0xFE9D, 4},
    {0x62D, 0xFEA1, 4}, {0x62E, 0xFEA5, 4}, {0x62F, 0xFEA9, 2}, {0x630, 0xFEAB, 2},
    {0x631, 0xFEAD, 2}, {0x632, 0xFEAF, 2}, {0x633, 0xFEB1, 4}, {0x634, 0xFEB5, 4},
    {0x635, 0xFEB9, 4}, {0x636, 0xFEBD, 4}, {0x637, 0xFEC1, 4}, {0x638, 0xFEC5, 4},
    {0x639, 0xFEC9, 4}, {0x63A, 0xFECD, 4}, {0x641, 0xFED1, 4}, {0x642, 0xFED5, 4},
    {0x643, 0xFED9, 4}, {0x644, 0xFEDD, 4}, {0x645, 0xFEE1, 4}, {0x646, 0xFEE5, 4},
    {0x647, 0xFEE9, 4}, {0x648, 0xFEED, 2}, {0x649, 0xFEEF, 2}, {0x64A, 0xFEF1, 4},
    {0x67E, 0xFB56, 4}, {0x686, 0xFB7A, 4}, {0x698, 0xFB8A, 2}, {0x6A9, 0xFB8E, 4},
    {0x6AF, 0xFB92, 4}, {0x6CC, 0xFBFC, 4},
}};

constexpr char32_t lam = 0x644;
constexpr char32_t stretch = 0x640;  // joins on both sides and has one form

const Forms* forms_of(char32_t letter) {
  const auto found = std::lower_bound(arabic_forms.begin(), arabic_forms.end(), letter,
                                      [](const Forms& a, char32_t b) { return a.letter < b; });
  return found != arabic_forms.end() && found->letter == letter ? &*found : nullptr;
}

bool joins_next(char32_t letter) {
  const Forms* const forms = forms_of(letter);
  return letter == stretch || (forms != nullptr && forms->count == 4);
}

bool joins_last(char32_t letter) {
  const Forms* const forms = forms_of(letter);
  return letter == stretch || (forms != nullptr && forms->count > 1);
}

/// Alone, of lam and the alef after it, which are written as one.
std::optional<char32_t> lam_with(char32_t alef) {
  switch (alef) {
    case 0x622:
      return 0xFEF5;
    case 0x623:
      return 0xFEF7;
    case 0x625:
      return 0xFEF9;
    case 0x627:
      return 0xFEFB;
    default:
      return std::nullopt;
  }
}

/// In the order in which they are read.
Letters32 joined(const Letters32& given) {
  Letters32 written;
  const auto next_letter = [&](std::size_t at) {
    while (++at < given.size() && is_mark(given[at])) {
    }
    return at < given.size() ? given[at] : 0;
  };
  char32_t last = 0;  // the letter before, marks aside
  for (std::size_t at = 0; at < given.size(); ++at) {
    const char32_t letter = given[at];
    if (is_mark(letter)) {
      written.push_back(letter);
      continue;
    }
    const bool from_last = joins_next(last) && joins_last(letter);
    const auto both =
        letter == lam && at + 1 < given.size() ? lam_with(given[at + 1]) : std::nullopt;
    if (both) {
      written.push_back(*both + (from_last ? 1 : 0));
      last = given[++at];
      continue;
    }
    const Forms* const forms = forms_of(letter);
    const bool to_next = joins_next(letter) && joins_last(next_letter(at));
    const char32_t form = (from_last ? 1U : 0U) + (to_next ? 2U : 0U);
    written.push_back(forms == nullptr ? letter : forms->alone + form);
    last = letter;
  }
  return written;
}

char32_t mirrored(char32_t letter) {
  constexpr std::u32string_view pairs = U"()[]{}<>";
  const std::size_t at = pairs.find(letter);
  return at == std::u32string_view::npos ? letter : pairs[at ^ 1U];
}

/// Turns what is read from the right; numbers, with a point or the like within, are not turned.
Letters32 turned(const Letters32& run) {
  Letters32 result;
  for (std::size_t end = run.size(); end > 0;) {
    std::size_t first = end - 1;
    const auto goes_on = [&](std::size_t at) {
      if (at == 0) return false;
      if (is_digit(run[at - 1])) return true;
      const bool within = run[at - 1] == '.' || run[at - 1] == ',' || run[at - 1] == ':';
      return within && at > 1 && is_digit(run[at - 2]);
    };
    const bool keeps = is_digit(run[first]) || is_mark(run[first]);
    if (is_digit(run[first])) {
      while (goes_on(first)) --first;
    } else {
      while (first > 0 && is_mark(run[first])) --first;  // with the letter that they belong to
    }
    if (keeps) {
      result.append(run, first, end - first);
    } else {
      result.push_back(mirrored(run[first]));
    }
    end = first;
  }
  return result;
}

}  // namespace

std::string in_reading_order(std::string_view text) {
  constexpr unsigned char first_of_hebrew = 0xD6;  // in UTF-8; of Arabic and their forms more
  const auto may_be = [](char byte) { return static_cast<unsigned char>(byte) >= first_of_hebrew; };
  if (std::none_of(text.begin(), text.end(), may_be)) return std::string(text);
  const Letters32 letters = decoded(text);
  if (std::none_of(letters.begin(), letters.end(), is_from_right)) return std::string(text);
  Letters32 written;
  for (std::size_t at = 0; at < letters.size();) {
    if (!is_from_right(letters[at])) {
      written.push_back(letters[at++]);
      continue;
    }
    std::size_t end = at + 1;  // after the last letter or digit of the run
    for (std::size_t ahead = end; ahead < letters.size(); ++ahead) {
      const bool is_of_run = is_from_right(letters[ahead]) || is_digit(letters[ahead]);
      if (!is_of_run && !is_neutral(letters[ahead])) break;
      if (is_of_run) end = ahead + 1;
    }
    written += turned(joined(letters.substr(at, end - at)));
    at = end;
  }
  return encoded(written);
}

}  // namespace curveskel::viewer
