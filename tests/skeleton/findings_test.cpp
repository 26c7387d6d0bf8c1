// Laws of the places where a certificate fails.
#include <curveskel/findings.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include <curveskel/advanced/measures.hpp>
#include <curveskel/certificate.hpp>
#include <curveskel/edit.hpp>
#include "meshes/random.hpp"
#include "tests/skeleton/graph/edited_skeletons.hpp"

namespace curveskel::findings_laws {
namespace {

using namespace edited_skeletons;

/// Held against the certificate, which knows nothing of edges.
void expect_findings_agree(const Subject& subject, const SurfaceTree& tree,
                           const CurveSkeleton& skeleton) {
  const double diagonal = bounding_box_diagonal(subject.surface.positions);
  const Certificate certificate = evaluate(subject.surface, skeleton, {}, {});
  const Findings found = findings(tree, diagonal, skeleton, {}, {});
  EXPECT_EQ(static_cast<int>(found.spurs.size()), certificate.spurs);
  EXPECT_EQ(found.exits.empty(), certificate.inside_fraction == 1);
  double outside = 0;
  double deepest = 0;
  double lone = 0;
  for (std::size_t k = 0; k < found.exits.size(); ++k) {
    const Exit& exit = found.exits[k];
    EXPECT_GT(exit.length, 0);
    outside += exit.length;
    deepest = std::max(deepest, exit.depth);
    ASSERT_NE(exit.edge >= 0, exit.node >= 0);
    if (exit.edge < 0) {
      EXPECT_TRUE(neighbours_of(skeleton, exit.node).empty());
      continue;
    }
    ASSERT_LT(exit.edge, edges_of(skeleton));
    EXPECT_TRUE(k == 0 || found.exits[k - 1].edge < exit.edge);
  }
  for (int node = 0; node < nodes_of(skeleton); ++node) {
    if (neighbours_of(skeleton, node).empty())
      lone += diagonal * CertificateOptions{}.sample_spacing;
  }
  const double length = certificate.length * diagonal + lone;
  EXPECT_NEAR(outside / length, 1 - certificate.inside_fraction, 1e-9);
  EXPECT_NEAR(deepest / diagonal, certificate.deepest_exit, 1e-12);
}

TEST(Findings, AgreeWithTheCertificateWhateverWasDoneToTheSkeleton) {
  int exits = 0;
  int spurs = 0;
  for (const Subject& subject : subjects()) {
    const SurfaceTree tree(subject.surface);
    const double diagonal = bounding_box_diagonal(subject.surface.positions);
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      SCOPED_TRACE(subject.name + ", seed " + std::to_string(seed));
      shapes::Random random(seed);
      CurveSkeleton skeleton = subject.skeleton;
      expect_findings_agree(subject, tree, skeleton);
      for (int step = 0; step < 15; ++step) {
        skeleton = RandomEdit(skeleton, random, nullptr).make().after;
      }
      const int node = static_cast<int>(random.index(static_cast<std::size_t>(nodes_of(skeleton))));
      const Eigen::Vector3d nearby = skeleton.nodes.row(node).array() + 0.01 * diagonal;
      skeleton = add_node(skeleton, node, nearby, &tree);
      expect_findings_agree(subject, tree, skeleton);
      const Findings found = findings(tree, diagonal, skeleton, {}, {});
      exits += static_cast<int>(found.exits.size());
      spurs += static_cast<int>(found.spurs.size());
    }
  }
  EXPECT_GT(exits, 0);
  EXPECT_GT(spurs, 0);
}

TEST(Findings, NameTheEdgeThatWasDraggedOutside) {
  const Subject& subject = subjects().front();
  const SurfaceTree tree(subject.surface);
  const double diagonal = bounding_box_diagonal(subject.surface.positions);
  ASSERT_TRUE(findings(tree, diagonal, subject.skeleton, {}, {}).exits.empty());
  for (int node = 0; node < nodes_of(subject.skeleton); ++node) {
    const Eigen::Vector3d outside =
        subject.skeleton.nodes.row(node).transpose() + diagonal * Eigen::Vector3d::UnitZ();
    const CurveSkeleton dragged = move_node(subject.skeleton, node, outside, &tree);
    EXPECT_EQ(dragged.radii[node], 0);
    std::vector<int> touching;
    for (int edge = 0; edge < edges_of(dragged); ++edge) {
      if (dragged.edges(edge, 0) == node || dragged.edges(edge, 1) == node)
        touching.push_back(edge);
    }
    const Findings all = findings(tree, diagonal, dragged, {}, {});
    std::vector<int> found;
    found.reserve(all.exits.size());
    for (const Exit& exit : all.exits) found.push_back(exit.edge);
    EXPECT_EQ(found, touching) << "node " << node;
  }
}

}  // namespace
}  // namespace curveskel::findings_laws
