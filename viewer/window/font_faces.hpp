// Faces of the fonts that this machine has.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <vector>

namespace curveskel::viewer {

/// A face in a font's file, which is mapped: only what is read of it takes memory.
class FontFace {
 public:
  /// Null where there is no such file, or no face in it whose outlines ImGui draws.
  [[nodiscard]] static std::shared_ptr<const FontFace> open(const std::filesystem::path& file,
                                                            int number = 0);
  FontFace(const FontFace&) = delete;
  FontFace& operator=(const FontFace&) = delete;
  ~FontFace();

  [[nodiscard]] bool has(char32_t character) const;
  /// From the lowest to the highest place of letters, in the side of a letter's square: fonts of
  /// one height by this number have letters of one size.
  [[nodiscard]] float lines_per_letter() const { return lines_per_letter_; }
  [[nodiscard]] const void* bytes() const { return bytes_; }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] int number() const { return number_; }

 private:
  FontFace() = default;
  [[nodiscard]] bool find_outlines();

  void* bytes_ = nullptr;
  std::size_t size_ = 0;
  int number_ = 0;
  float lines_per_letter_ = 1;
  std::shared_ptr<const void> outlines_;  // of the font library
};

/// For the window's own letters; null where none of the usual fonts is there.
[[nodiscard]] std::shared_ptr<const FontFace> usual_face();

/// Faces that have the characters, in the order of the person's preferences as fontconfig knows
/// them, each with one at least that those before lack; some characters may be in none. Without
/// fontconfig, `faces_in_usual_places`. O(installed fonts), 10 ms to seconds: not for the
/// drawing thread.
[[nodiscard]] std::vector<std::shared_ptr<const FontFace>> faces_with(
    const std::vector<char32_t>& characters);

/// The same of fonts that distributions have, in the places where they have them.
[[nodiscard]] std::vector<std::shared_ptr<const FontFace>> faces_in_usual_places(
    const std::vector<char32_t>& characters);

}  // namespace curveskel::viewer
