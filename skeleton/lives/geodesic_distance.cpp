#include "skeleton/lives/geodesic_distance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include "base/parallel.hpp"

namespace curveskel {
namespace {

constexpr float nowhere = std::numeric_limits<float>::infinity();

/// At (x, y), from an edge of this length along the x axis whose ends, at (0, 0) and (length, 0),
/// are at distances u and v: as from a source below the edge; infinite if it is not seen through
/// the edge.
float across(float length, float x, float y, float u, float v) {
  if (!(std::abs(u - v) < length)) return nowhere;
  const float source_x = (length * length + u * u - v * v) / (2 * length);
  const float depth = std::sqrt(std::max(u * u - source_x * source_x, 0.0F));
  const float rise = y + depth;
  if (!(rise > 0)) return nowhere;
  const float along = x - source_x;
  const float crossing = source_x + along * depth / rise;
  if (crossing < 0 || crossing > length) return nowhere;
  return std::sqrt(along * along + rise * rise);
}

/// Vertices far from each other, by straight distance: the next is the farthest from all before.
std::vector<int> samples_of(const Surface& surface, int count) {
  const Eigen::Index n = surface.positions.rows();
  const Eigen::RowVector3d middle = surface.positions.colwise().mean();
  Eigen::VectorXd far = (surface.positions.rowwise() - middle).rowwise().squaredNorm();
  std::vector<int> chosen;
  for (int k = 0; k < std::min<Eigen::Index>(count, n); ++k) {
    Eigen::Index next = 0;
    far.maxCoeff(&next);
    chosen.push_back(static_cast<int>(next));
    const Eigen::VectorXd from_it =
        (surface.positions.rowwise() - surface.positions.row(next)).rowwise().squaredNorm();
    far = k == 0 ? from_it : far.cwiseMin(from_it).eval();
  }
  return chosen;
}

}  // namespace

GeodesicDistance::GeodesicDistance(const Surface& surface)
    : surface_(surface),
      triangles_around_(bucket<std::int32_t>(
          surface.triangles.size(), surface.positions.rows(),
          [&](std::int64_t i) { return surface.triangles(i / 3, i % 3); },
          [](std::int64_t i) { return static_cast<std::int32_t>(i / 3); })),
      corners_(idx(surface.triangles.rows())) {
  double longest = 0;
  double sum = 0;
  for (Eigen::Index f = 0; f < surface.triangles.rows(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const auto place = [&](int corner) {
        return Eigen::RowVector3d(surface.positions.row(surface.triangles(f, corner % 3)));
      };
      const Eigen::RowVector3d edge = place(k + 2) - place(k + 1);
      const Eigen::RowVector3d side = place(k) - place(k + 1);
      const double length = edge.norm();
      const double x = length > 0 ? side.dot(edge) / length : 0;
      const double y = std::sqrt(std::max(side.squaredNorm() - x * x, 0.0));
      longest = std::max(longest, length);
      sum += length;
      corners_[idx(f)][idx(k)] = {static_cast<float>(length), static_cast<float>(x),
                                  static_cast<float>(y)};
    }
  }
  constexpr double steps_per_edge = 4;
  constexpr double most_steps = 4000;
  const double mean = sum / std::max(1.0, static_cast<double>(surface.triangles.size()));
  const double step = std::max({mean / steps_per_edge, longest / most_steps,
                                static_cast<double>(std::numeric_limits<float>::min())});
  step_ = static_cast<float>(step);
  steps_ = static_cast<std::size_t>(longest / step) + 3;
}

/// Vertices by distance, in steps so short that the order within one hardly matters: no heap.
class GeodesicDistance::Front {
 public:
  Front(float step, std::size_t steps) : step_(step), ring_(steps) {}

  void push(float distance, int vertex) {
    ring_[static_cast<std::size_t>(number(distance)) % ring_.size()].push_back(vertex);
    ++count_;
  }
  /// The next vertex that is reached in this step by `distance`, -1 at the end.
  [[nodiscard]] int pop(const Eigen::VectorXf& distance) {
    while (count_ > 0) {
      std::vector<int>& now = ring_[static_cast<std::size_t>(at_) % ring_.size()];
      if (now.empty()) {
        ++at_;
        continue;
      }
      const int vertex = now.back();
      now.pop_back();
      --count_;
      if (number(distance[vertex]) == at_) return vertex;  // else it was reached sooner
    }
    return -1;
  }

 private:
  [[nodiscard]] std::int64_t number(float distance) const {
    return static_cast<std::int64_t>(distance / step_);
  }

  float step_;
  std::vector<std::vector<int>> ring_;
  std::int64_t at_ = 0;
  std::size_t count_ = 0;
};

Eigen::VectorXf GeodesicDistance::from(int vertex) const {
  Eigen::VectorXf distance = Eigen::VectorXf::Constant(surface_.positions.rows(), nowhere);
  std::vector<char> is_done(idx(surface_.positions.rows()), 0);
  const float worth_it = 0.05F * step_;  // of reaching a vertex anew
  Front front(step_, steps_);
  distance[vertex] = 0;
  front.push(0, vertex);
  for (int v = front.pop(distance); v >= 0; v = front.pop(distance)) {
    if (is_done[idx(v)] != 0) continue;
    is_done[idx(v)] = 1;
    const float reached = distance[v];
    for (std::int64_t i = triangles_around_.offsets[idx(v)];
         i < triangles_around_.offsets[idx(v) + 1]; ++i) {
      const std::int32_t f = triangles_around_.values[idx(i)];
      const auto row = surface_.triangles.row(f);
      const auto& corners = corners_[idx(f)];
      const int own = row[0] == v ? 0 : row[1] == v ? 1 : 2;
      const int next = (own + 1) % 3;
      const int last = (own + 2) % 3;
      const auto offer = [&](int target, float along, float found) {
        const float least = std::min(reached + along, found);
        if (!(least < distance[row[target]] - worth_it)) return;
        distance[row[target]] = least;
        is_done[idx(row[target])] = 0;
        front.push(least, row[target]);
      };
      // A wave that comes from here reaches nothing sooner than this. It goes on across an edge
      // once both of the edge's ends are reached: the last of the two asks.
      const auto pass = [&](int target, int other, float from_start, float from_end) {
        if (!(distance[row[target]] > reached)) return;
        const Corner& at = corners[idx(target)];
        const bool is_reached = is_done[idx(row[other])] != 0;
        offer(target, corners[idx(other)].length,
              is_reached ? across(at.length, at.x, at.y, from_start, from_end) : nowhere);
      };
      pass(last, next, reached, distance[row[next]]);
      pass(next, last, distance[row[last]], reached);
    }
  }
  return distance;
}

Eigen::VectorXd mean_geodesic_distance(const Surface& surface, const Eigen::VectorXd& areas,
                                       int samples, int threads) {
  const GeodesicDistance distance(surface);
  const std::vector<int> chosen = samples_of(surface, samples);
  std::vector<Eigen::VectorXf> from(chosen.size());
  parallel_for(chosen.size(), 1, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) from[k] = distance.from(chosen[k]);
  });
  Eigen::VectorXd share = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(chosen.size()));
  for (Eigen::Index v = 0; v < surface.positions.rows(); ++v) {
    std::size_t nearest = 0;
    for (std::size_t k = 1; k < from.size(); ++k) {
      if (from[k][v] < from[nearest][v]) nearest = k;
    }
    share[static_cast<Eigen::Index>(nearest)] += areas[v];
  }
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(surface.positions.rows());
  for (std::size_t k = 0; k < from.size(); ++k) {
    mean += share[static_cast<Eigen::Index>(k)] * from[k].cast<double>();
  }
  return mean / std::max(areas.sum(), std::numeric_limits<double>::min());
}

}  // namespace curveskel
