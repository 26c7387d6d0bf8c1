// Laws of texts in fields: each comes back as it was, whatever its bytes.
#include "viewer/window/field_text.hpp"

#include <gtest/gtest.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <string>
#include <string_view>
#include <vector>

namespace curveskel::viewer::field_text_laws {
namespace {

/// ImGui's own form of a text that is edited.
std::string through_imgui(const std::string& text) {
  std::vector<ImWchar> wide(text.size() + 1);
  ImTextStrFromUtf8(wide.data(), static_cast<int>(wide.size()), text.c_str(), nullptr);
  std::string found(3 * wide.size() + 1, 0);
  ImTextStrToUtf8(found.data(), static_cast<int>(found.size()), wide.data(), nullptr);
  return found;  // with NULs after it
}

TEST(FieldText, ComesBackAsItWas) {
  FieldText texts;
  for (const char* text :
       {"", "plain.json", "gr\u00f6\u00dfer \u5de6.obj", "\U0001F98A fox \U0001F40E horse.json",
        "\U0001F98A\U0001F98A", "no text: \xff\xe4\xba", "cut \xf0\x9f\xa6", "\ue000 private",
        "no character: \ufffd"}) {
    const std::string shown = texts.in_field(text);
    EXPECT_EQ(texts.from_field(through_imgui(shown)), text);
  }
}

TEST(FieldText, WhatIsBesideACharacterThatNoFieldHoldsMayChange) {
  FieldText texts;
  std::string shown = texts.in_field("\U0001F98A-\U0001F40E.json");
  shown.erase(0, 3);  // the first one
  EXPECT_EQ(texts.from_field("my" + shown), "my-\U0001F40E.json");
  EXPECT_EQ(texts.from_field(std::string("a.json\0rest", 11)), "a.json");
}

TEST(FieldText, IsPlainWhereAFieldHoldsIt) {
  FieldText texts;
  EXPECT_EQ(texts.in_field("gr\u00f6\u00dfer.obj"), "gr\u00f6\u00dfer.obj");
}

}  // namespace
}  // namespace curveskel::viewer::field_text_laws
