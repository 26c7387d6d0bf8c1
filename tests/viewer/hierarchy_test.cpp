// Laws of a rig's outline: every joint once, below what it hangs from, however deep; and its panel.
#include "viewer/model/hierarchy.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <random>
#include <set>

#include "tests/viewer/imgui_context.hpp"
#include "viewer/window/panels.hpp"

namespace curveskel::viewer::hierarchy_laws {
namespace {

constexpr int absurd = 100000;

std::shared_ptr<const Rig> rig_of(const std::vector<int>& parents) {
  auto rig = std::make_shared<Rig>();
  const auto count = static_cast<Eigen::Index>(parents.size());
  rig->parents = Eigen::Map<const Eigen::VectorXi>(parents.data(), count);
  rig->joints.setZero(count, 3);
  for (Eigen::Index joint = 0; joint < count; ++joint) {
    rig->joints(joint, 0) = static_cast<double>(joint);
    rig->names.push_back("joint " + std::to_string(joint));
  }
  rig->weights.resize(0, count);
  return rig;
}

std::shared_ptr<const Rig> chain(int count) {
  std::vector<int> parents(static_cast<std::size_t>(count));
  std::iota(parents.begin(), parents.end(), -1);
  return rig_of(parents);
}

std::shared_ptr<const Rig> random_rig(std::mt19937& random) {
  std::vector<int> parents(1 + random() % 60);
  for (std::size_t joint = 0; joint < parents.size(); ++joint) {
    parents[joint] = static_cast<int>(random() % (joint + 1)) - 1;
  }
  return rig_of(parents);
}

/// All joints above this one.
std::set<int> above(const Rig& rig, int joint) {
  std::set<int> found;
  while ((joint = rig.parents[joint]) >= 0) found.insert(joint);
  return found;
}

TEST(Hierarchy, LinesBelowAJointAreThoseThatHangFromIt) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 100; ++trial) {
    const auto rig = random_rig(random);
    const auto lines = hierarchy_of(*rig);
    ASSERT_EQ(lines.size(), rig->names.size());
    for (std::size_t i = 0; i < lines.size(); ++i) {
      EXPECT_EQ(lines[i].depth, static_cast<int>(above(*rig, lines[i].joint).size()));
      for (std::size_t k = 0; k < lines.size(); ++k) {
        const bool below = k > i && k <= i + lines[i].below;
        EXPECT_EQ(above(*rig, lines[k].joint).contains(lines[i].joint), below);
      }
    }
  }
}

TEST(Hierarchy, FoldedHidesWhatIsBelow) {
  std::mt19937 random(4);
  for (int trial = 0; trial < 50; ++trial) {
    const auto rig = random_rig(random);
    Outline outline;
    outline.show(rig);
    EXPECT_EQ(outline.seen().size(), rig->names.size());
    std::set<int> folded;
    for (int joint = 0; joint < rig->parents.size(); ++joint) {
      if (random() % 3 != 0) continue;
      outline.fold(joint);
      folded.insert(joint);
    }
    std::set<int> seen;
    for (const HierarchyLine& line : outline.seen()) seen.insert(line.joint);
    for (int joint = 0; joint < rig->parents.size(); ++joint) {
      bool hidden = false;
      for (const int parent : above(*rig, joint)) hidden |= folded.contains(parent);
      EXPECT_EQ(seen.contains(joint), !hidden);
    }
    for (const int joint : folded) outline.fold(joint);
    EXPECT_EQ(outline.seen().size(), rig->names.size());
  }
}

TEST(Hierarchy, OfAnAbsurdlyLongChainIsDrawn) {
  const auto rig = chain(absurd);
  const auto lines = hierarchy_of(*rig);
  EXPECT_EQ(lines.front().below, static_cast<std::size_t>(absurd - 1));
  EXPECT_EQ(lines.back().depth, absurd - 1);
  const ImGuiContextWithoutWindow context(1000, 700);
  Document document;
  document.rig = rig;
  Workbench bench({});
  bench.scene = std::make_shared<Scene>(std::move(document));
  Panels panels;
  for (int frame = 0; frame < 3; ++frame) {
    ImGui::NewFrame();
    draw_panels(bench, panels, lay_out(1000, 700, 1, true));
    ImGui::Render();
  }
  EXPECT_EQ(panels.outline.seen().size(), static_cast<std::size_t>(absurd));
  // Only what is seen of it is laid out.
  EXPECT_LT(ImGui::GetDrawData()->TotalVtxCount, 50000);
}

}  // namespace
}  // namespace curveskel::viewer::hierarchy_laws
