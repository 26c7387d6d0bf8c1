// Laws of what has to be drawn again of the panels: nothing that is the same, all that is not.
#include "viewer/software/panel_changes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>

#include "tests/viewer/imgui_context.hpp"

namespace curveskel::viewer::panel_changes_laws {
namespace {

class PanelChange : public testing::Test {
 protected:
  PanelChange() {
    frame("a", "b", 0.5F);
    frame("a", "b", 0.5F);  // ImGui sizes things in the first
  }

  /// Two windows side by side, a text in each; a bar in the second.
  std::vector<Area> frame(const std::string& first, const std::string& second, float share,
                          bool third = false) {
    ImGui::NewFrame();
    window("first", left, [&] { ImGui::TextUnformatted(first.c_str()); });
    window("second", right, [&] {
      ImGui::TextUnformatted(second.c_str());
      ImGui::ProgressBar(share);
    });
    if (third) window("third", {300, 300, 50, 50}, [] { ImGui::TextUnformatted("c"); });
    ImGui::Render();
    return changes_.since_last(*ImGui::GetDrawData());
  }

  static constexpr Area left{0, 0, 200, 600};
  static constexpr Area right{500, 0, 300, 600};

 private:
  template <typename Fill>
  static void window(const char* name, const Area& area, const Fill& fill) {
    ImGui::SetNextWindowPos({area.x, area.y});
    ImGui::SetNextWindowSize({area.width, area.height});
    ImGui::Begin(name, nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove);
    fill();
    ImGui::End();
  }
  ImGuiContextWithoutWindow context_{800, 600};
  PanelChanges changes_;
};

bool within(const Area& inner, const Area& outer) {
  return inner.x >= outer.x && inner.y >= outer.y &&
         inner.x + inner.width <= outer.x + outer.width &&
         inner.y + inner.height <= outer.y + outer.height;
}

TEST_F(PanelChange, NothingWhereNothingHasChanged) { EXPECT_TRUE(frame("a", "b", 0.5F).empty()); }

TEST_F(PanelChange, OnlyTheTextThatHas) {
  for (const char* const text : {"x", "a longer one", "y"}) {
    const auto areas = frame(text, "b", 0.5F);
    ASSERT_EQ(areas.size(), 1U);
    EXPECT_TRUE(within(areas[0], left));
    EXPECT_LT(areas[0].height, 30) << "a line";
    EXPECT_TRUE(frame(text, "b", 0.5F).empty());
  }
}

TEST_F(PanelChange, OfABarIsWhereItHasMoved) {
  const auto areas = frame("a", "b", 0.9F);
  ASSERT_EQ(areas.size(), 1U);
  EXPECT_TRUE(within(areas[0], right));
  EXPECT_LT(areas[0].height, 40);
  EXPECT_GT(areas[0].width, 0.3F * right.width) << "from the old end to the new one";
}

TEST_F(PanelChange, OfTwoWindowsAreTwo) { EXPECT_EQ(frame("x", "y", 0.5F).size(), 2U); }

TEST_F(PanelChange, EverythingWhereAWindowComesOrGoes) {
  for (const bool third : {true, false}) {
    frame("a", "b", 0.5F, third);
    const auto areas = frame("a", "b", 0.5F, !third);
    ASSERT_EQ(areas.size(), 1U);
    EXPECT_TRUE(within({0, 0, 800, 600}, areas[0]));
  }
}

bool overlap(const Area& a, const Area& b) {
  return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

TEST(Layout, PartsOfAnyWindowAreOfWholePixelsAndMeet) {
  for (const float scale : {1.0F, 1.25F, 2.0F}) {
    for (int width = 320; width < 2000; width += 37) {
      for (int height = 240; height < 1200; height += 41) {
        const auto wide = static_cast<float>(width);
        const auto high = static_cast<float>(height);
        const Layout layout = lay_out(wide, high, scale, true);
        const std::array<Area, 5> parts{layout.picture, layout.left, layout.right, layout.timeline,
                                        layout.status};
        double covered = 0;
        for (std::size_t i = 0; i < parts.size(); ++i) {
          const Area& part = parts[i];
          for (const float number : {part.x, part.y, part.width, part.height}) {
            ASSERT_EQ(number, std::floor(number)) << width << " x " << height;
          }
          ASSERT_GE(std::min({part.x, part.y, part.width, part.height}), 0);
          ASSERT_LE(part.x + part.width, wide);
          ASSERT_LE(part.y + part.height, high);
          covered += static_cast<double>(part.width) * static_cast<double>(part.height);
          for (std::size_t j = 0; j < i; ++j) {
            ASSERT_FALSE(overlap(part, parts[j]))
                << i << ", " << j << ": " << width << " x " << height;
          }
        }
        ASSERT_EQ(covered, static_cast<double>(width) * height) << width << " x " << height;
        ASSERT_GE(layout.picture.width, 0.3F * wide);
      }
    }
  }
}

}  // namespace
}  // namespace curveskel::viewer::panel_changes_laws
