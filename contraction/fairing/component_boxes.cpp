#include "contraction/fairing/component_boxes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/measures.hpp>

namespace curveskel {
namespace {

double scale_for(double diagonal) {
  constexpr double largest_exponent = 1022;  // of numbers that have all their digits
  if (!(diagonal > 0)) return 1;
  return std::exp2(std::min(-std::ceil(std::log2(diagonal)), largest_exponent));
}

}  // namespace

ComponentBoxes::ComponentBoxes(const Positions& positions, const Topology& parts)
    : parts_(parts), boxes_(idx(parts.components())) {
  constexpr double beyond_all = std::numeric_limits<double>::infinity();
  Positions ends(2 * parts.components(), 3);  // the least and the largest corner of each box
  for (Eigen::Index i = 0; i < parts.components(); ++i) {
    ends.row(2 * i).setConstant(beyond_all);
    ends.row(2 * i + 1).setConstant(-beyond_all);
  }
  for (Eigen::Index v = 0; v < positions.rows(); ++v) {
    const Eigen::Index i = parts.component_of_vertex[v];
    ends.row(2 * i) = ends.row(2 * i).cwiseMin(positions.row(v));
    ends.row(2 * i + 1) = ends.row(2 * i + 1).cwiseMax(positions.row(v));
  }
  for (Eigen::Index i = 0; i < parts.components(); ++i) {
    if (parts.faces[idx(i)] == 0) continue;
    const Positions corners = ends.middleRows(2 * i, 2);
    boxes_[idx(i)] = {corners.row(0) / 2 + corners.row(1) / 2,
                      scale_for(bounding_box_diagonal(corners))};
  }
}

const ComponentBoxes::Box& ComponentBoxes::of(Eigen::Index vertex) const {
  return boxes_[idx(parts_.component_of_vertex[vertex])];
}

Positions ComponentBoxes::enter(const Positions& positions) const {
  Positions result(positions.rows(), 3);
  for (Eigen::Index v = 0; v < positions.rows(); ++v) {
    const Box& box = of(v);
    result.row(v) = (positions.row(v) - box.centre) * box.scale;
  }
  return result;
}

Positions ComponentBoxes::leave(const Positions& positions) const {
  Positions result(positions.rows(), 3);
  for (Eigen::Index v = 0; v < positions.rows(); ++v) {
    const Box& box = of(v);
    result.row(v) = positions.row(v) / box.scale + box.centre;
  }
  return result;
}

}  // namespace curveskel
