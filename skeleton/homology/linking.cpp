#include "skeleton/homology/linking.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include <curveskel/advanced/indices.hpp>

namespace curveskel::linking {
namespace {

__extension__ using Wide = __int128;

/// Twice the area of the triangle: positive if c lies to the left of the line from a to b.
Wide side(const Segment& line, const Seen& c) {
  const auto& [a, b] = line;
  return Wide{b.x - a.x} * (c.y - a.y) - Wide{b.y - a.y} * (c.x - a.x);
}

double height_at(const Segment& segment, Wide from, Wide to) {
  const double share = static_cast<double>(from) / static_cast<double>(from - to);
  return segment[0].height + share * (segment[1].height - segment[0].height);
}

std::vector<Segment> segments_of(const HandleLoops& handles, const std::vector<Seen>& vertices) {
  std::vector<Segment> segments;
  segments.reserve(handles.edges.size());
  for (const auto& [a, b] : handles.edges) segments.push_back({vertices[idx(a)], vertices[idx(b)]});
  return segments;
}

}  // namespace

Projection::Projection(const Positions& about) {
  constexpr double cells = 1LL << 44;
  const Eigen::RowVector3d low = about.colwise().minCoeff();
  const Eigen::RowVector3d high = about.colwise().maxCoeff();
  middle_ = 0.5 * (low + high).transpose();
  const double extent = (high - low).norm();
  frame_ = (extent > 0 ? cells / extent : 1.0) *
           Eigen::Quaterniond(0.6180, 0.3713, -0.2917, 0.6285).normalized().toRotationMatrix();
}

Seen Projection::operator()(const Eigen::Vector3d& position) const {
  // A point far away may as well lie at the end of the grid.
  const auto rounded = [](double value) {
    constexpr double far = 1LL << 48;
    return std::llround(std::clamp(value, -far, far));
  };
  const Eigen::Vector3d p = frame_ * (position - middle_);
  return {rounded(p.x()), rounded(p.y()), p.z()};
}
std::vector<Seen> Projection::operator()(const Positions& positions) const {
  std::vector<Seen> seen;
  seen.reserve(idx(positions.rows()));
  for (Eigen::Index i = 0; i < positions.rows(); ++i) {
    seen.push_back((*this)(Eigen::Vector3d(positions.row(i))));
  }
  return seen;
}

bool crosses_over(const Segment& a, const Segment& b) {
  const Wide a_from = side(b, a[0]);
  const Wide a_to = side(b, a[1]);
  if ((a_from < 0) == (a_to < 0)) return false;
  const Wide b_from = side(a, b[0]);
  const Wide b_to = side(a, b[1]);
  if ((b_from < 0) == (b_to < 0)) return false;
  return height_at(a, a_from, a_to) > height_at(b, b_from, b_to);
}

Grid::Grid(std::vector<Segment> given) : segments_(std::move(given)) {
  const std::vector<Segment>& segments = segments_;
  if (segments.empty()) return;
  low_ = {segments[0][0].x, segments[0][0].y};
  std::array<std::int64_t, 2> high = low_;
  for (const Segment& segment : segments) {
    for (const Seen& end : segment) {
      low_ = {std::min(low_[0], end.x), std::min(low_[1], end.y)};
      high = {std::max(high[0], end.x), std::max(high[1], end.y)};
    }
  }
  constexpr double most = 1024;
  side_ = static_cast<std::int64_t>(
      std::clamp(std::sqrt(static_cast<double>(segments.size())), 1.0, most));
  cell_ = 1 + std::max(high[0] - low_[0], high[1] - low_[1]) / side_;
  cells_.resize(idx(side_ * side_));
  for (std::size_t s = 0; s < segments.size(); ++s) {
    for_cells(segments[s], [&](std::vector<int>& cell) { cell.push_back(static_cast<int>(s)); });
  }
  last_asked_by_.assign(segments.size(), -1);
}

SeenLoops::SeenLoops(const Surface& surface)
    : handles(handle_loops(surface)),
      projection(surface.positions),
      edges(segments_of(handles, projection(surface.positions))) {}

}  // namespace curveskel::linking
