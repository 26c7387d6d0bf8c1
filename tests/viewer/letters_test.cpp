// Laws of the window's letters: what is shown has its glyphs, whatever its script, and nothing else
// takes time or memory.
#include "viewer/window/letters.hpp"

#include <gtest/gtest.h>
#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "tests/own_folder.hpp"

namespace curveskel::viewer::letters_laws {
namespace {

class Written : public testing::Test {
 protected:
  Written() { ImGui::CreateContext(); }
  ~Written() override { ImGui::DestroyContext(); }
  [[nodiscard]] static bool has_glyph(char32_t letter) {
    const ImFont* const font = ImGui::GetIO().Fonts->Fonts[0];
    return font->FindGlyphNoFallback(static_cast<ImWchar>(letter)) != nullptr;
  }
  /// Until all fonts are found; how often ImGui's fonts were built anew.
  static int settle(Letters& letters) {
    int built = 0;
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    do {
      built += letters.update() ? 1 : 0;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    } while (letters.looking() && std::chrono::steady_clock::now() < end);
    return built;
  }
};

TEST_F(Written, OnlyLatinIsThereFromTheStart) {
  Letters letters(14);
  EXPECT_TRUE(has_glyph('a'));
  EXPECT_TRUE(has_glyph(U'é'));
  EXPECT_FALSE(has_glyph(U'Я'));
  letters.want("plain names, größer, 100 %");
  EXPECT_FALSE(letters.update());
  EXPECT_FALSE(letters.looking());
}

TEST_F(Written, LettersOfItsOwnFontAreThereInTheSameFrame) {
  Letters letters(14);
  letters.want("Нога и κεφάλι");
  EXPECT_TRUE(letters.update());
  EXPECT_FALSE(letters.looking());
  for (const char32_t letter : std::u32string_view(U"Ногаиκεφάλι")) {
    EXPECT_TRUE(has_glyph(letter)) << static_cast<unsigned>(letter);
  }
  letters.want("Нога");
  EXPECT_FALSE(letters.update()) << "they are there already";
  EXPECT_TRUE(letters.take_lacking().empty());
}

TEST_F(Written, OthersComeFromTheFontsOfTheSystem) {
  for (const char32_t letter : {U'腕', U'の', U'팔'}) {
    if (faces_with({letter}).empty()) GTEST_SKIP() << "no fonts have them all here";
  }
  Letters letters(14);
  letters.want("左腕の팔");
  EXPECT_EQ(settle(letters), 1);
  for (const char32_t letter : {U'左', U'腕', U'の', U'팔'}) EXPECT_TRUE(has_glyph(letter));
  EXPECT_FALSE(has_glyph(U'右')) << "nobody has asked for it";
  EXPECT_LT(ImGui::GetIO().Fonts->TexHeight, 512);
  const ImFont* const font = ImGui::GetIO().Fonts->Fonts[0];
  EXPECT_GE(font->FindGlyph(U'左')->AdvanceX, font->FindGlyph('M')->AdvanceX)
      << "as large as Latin";
  EXPECT_TRUE(letters.take_lacking().empty());
}

TEST_F(Written, WhatNoFontHasIsLookedForAndSaidOnce) {
  Letters letters(14);
  letters.want("\xef\xb7\x90");  // no character
  EXPECT_EQ(settle(letters), 0);
  EXPECT_FALSE(letters.take_lacking().empty());
  letters.want("\xef\xb7\x90");
  EXPECT_FALSE(letters.update());
  EXPECT_FALSE(letters.looking());
  EXPECT_TRUE(letters.take_lacking().empty());
}

TEST_F(Written, NoFontIsLookedForAnEmoji) {
  Letters letters(14);
  letters.want("\U0001F98A fox");
  EXPECT_FALSE(letters.update());
  EXPECT_FALSE(letters.looking());
}

TEST(LackingLetters, ArePromisedNoFontThatHasThemNot) {
  const auto names = [](char32_t one, const char* package) {
    return words_on_lacking({one}).find(package) != std::string::npos;
  };
  EXPECT_TRUE(names(U'\u5de6', "fonts-noto-cjk"));
  EXPECT_FALSE(names(U'\u5de6', "fonts-noto-core"));
  EXPECT_TRUE(names(U'\u0915', "fonts-noto-core"));  // of India
  for (const char32_t sign : {U'\u2b50', U'\u231a', U'\ufdd0'}) {
    EXPECT_FALSE(names(sign, "fonts-noto"));
  }
}

TEST_F(Written, BytesThatAreNoTextAreNoHarm) {
  Letters letters(14);
  std::string bytes;
  for (int byte = 255; byte >= 0; --byte) bytes.push_back(static_cast<char>(byte));
  letters.want(bytes);
  letters.want("\xf0\x9f\xa6\xb4 cut off: \xe4\xba");
  settle(letters);
  EXPECT_TRUE(has_glyph('a'));
}

// ImGui ends the program at such a file.
TEST(FontFaces, AreNoneInFilesThatAreNoFonts) {
  const OwnFolder folder;
  EXPECT_EQ(FontFace::open(folder.path() / "missing.ttf"), nullptr);
  EXPECT_EQ(FontFace::open(folder.path()), nullptr);
  EXPECT_EQ(FontFace::open(folder.write("empty.ttf", "")), nullptr);
  EXPECT_EQ(FontFace::open(folder.write("text.ttf", "not a font, but long enough to be read")),
            nullptr);
  const auto face = usual_face();
  ASSERT_NE(face, nullptr) << "packages/view has fonts-dejavu-core";
  EXPECT_TRUE(face->has('a'));
  EXPECT_FALSE(face->has(0xE123));
  const std::string whole(static_cast<const char*>(face->bytes()), face->size());
  EXPECT_NE(FontFace::open(folder.write("whole.ttf", whole)), nullptr);
  EXPECT_EQ(FontFace::open(folder.write("whole.ttf", whole), 1), nullptr) << "it has one face";
  for (std::size_t size = 1; size < whole.size(); size *= 3) {
    EXPECT_EQ(FontFace::open(folder.write("cut.ttf", whole.substr(0, size))), nullptr) << size;
  }
}

TEST(FontFaces, AreThoseThatHaveTheCharactersAndNoOthers) {
  const std::vector<char32_t> wanted{U'a', U'Я', U'გ'};
  for (const auto& find : {faces_with, faces_in_usual_places}) {
    const auto faces = find(wanted);
    ASSERT_FALSE(faces.empty());
    for (const char32_t letter : wanted) {
      EXPECT_TRUE(std::any_of(faces.begin(), faces.end(),
                              [&](const auto& face) { return face->has(letter); }));
    }
    EXPECT_LE(faces.size(), wanted.size());
    EXPECT_TRUE(find({0xFDD0}).empty()) << "no character";
    EXPECT_TRUE(find({}).empty());
  }
}

}  // namespace
}  // namespace curveskel::viewer::letters_laws
