#include <curveskel/findings.hpp>

#include <algorithm>
#include <cstddef>
#include <map>

#include <curveskel/advanced/indices.hpp>
#include "skeleton/certify/measured_curve.hpp"
#include "skeleton/graph/sound_skeleton.hpp"

namespace curveskel {

Findings findings(const SurfaceTree& tree, double diagonal, const CurveSkeleton& skeleton,
                  const CertificateOptions& options, const Monitor& monitor) {
  const MeasuredCurve curve = measured_curve(tree, diagonal, skeleton, options, monitor);
  std::map<int, Exit> by_edge;
  std::vector<Exit> nodes;
  const std::size_t on_edges = curve.samples.size() - curve.lone_nodes.size();
  for (std::size_t i = 0; i < curve.samples.size(); ++i) {
    if (curve.radius[i] > 0) continue;
    const CurveSample& sample = curve.samples[i];
    if (i >= on_edges) {
      nodes.push_back({-1, curve.lone_nodes[i - on_edges], sample.length, -curve.radius[i]});
      continue;
    }
    const std::vector<int>& along = curve.branches[idx(sample.branch)].nodes;
    const int edge = require_edge(skeleton, along[idx(sample.segment)],
                                  along[idx(sample.segment) + 1], "findings");
    Exit& exit = by_edge[edge];
    exit.edge = edge;
    exit.length += sample.length;
    exit.depth = std::max(exit.depth, -curve.radius[i]);
  }
  Findings found;
  found.exits.reserve(by_edge.size() + nodes.size());
  for (const auto& [edge, exit] : by_edge) found.exits.push_back(exit);
  found.exits.insert(found.exits.end(), nodes.begin(), nodes.end());
  const std::vector<int> spurs = spurs_of(curve);
  found.spurs.reserve(spurs.size());
  for (const int branch : spurs) found.spurs.push_back(curve.branches[idx(branch)]);
  monitor.report("certify", 1);
  return found;
}

}  // namespace curveskel
