#include "skeleton/lives/geodesic_distance.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/monitor.hpp>
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

GeodesicDistance::GeodesicDistance(const Surface& surface) {
  std::vector<std::array<Corner, 3>> corners(idx(surface.triangles.rows()));  // by triangle
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
      corners[idx(f)][idx(k)] = {static_cast<float>(length), static_cast<float>(x),
                                 static_cast<float>(y)};
    }
  }
  wedges_around_ = bucket<Wedge>(
      surface.triangles.size(), surface.positions.rows(),
      [&](std::int64_t i) { return surface.triangles(i / 3, i % 3); },
      [&](std::int64_t i) {
        const std::int64_t f = i / 3;
        const std::int64_t k = i % 3;
        return Wedge{surface.triangles(f, (k + 1) % 3), surface.triangles(f, (k + 2) % 3),
                     corners[idx(f)][idx((k + 1) % 3)], corners[idx(f)][idx((k + 2) % 3)]};
      });
  constexpr double steps_per_edge = 4;
  constexpr double most_steps = 4000;
  const double mean = sum / std::max(1.0, static_cast<double>(surface.triangles.size()));
  const double step = std::max({mean / steps_per_edge, longest / most_steps,
                                static_cast<double>(std::numeric_limits<float>::min())});
  step_ = static_cast<float>(step);
  steps_ = std::bit_ceil(static_cast<std::size_t>(longest / step) + 3);
}

/// Vertices by distance, in steps so short that the order within one hardly matters: no heap.
class GeodesicDistance::Front {
 public:
  /// Precondition: `steps` is a power of two.
  Front(float step, std::size_t steps, std::size_t vertices) : step_(step), first_(steps, none) {
    entries_.reserve(2 * vertices);
  }

  void push(float distance, std::int32_t vertex) {
    // Across an edge of an obtuse triangle a wave may come to a step that is over.
    std::int32_t& first = first_[idx(std::max(at_, number(distance))) & (first_.size() - 1)];
    entries_.push_back({vertex, first});
    first = static_cast<std::int32_t>(entries_.size()) - 1;
    ++count_;
  }
  /// The next vertex that is reached by `distance`, maybe one that was there before; -1 at the end.
  [[nodiscard]] std::int32_t pop(const Eigen::VectorXf& distance) {
    while (count_ > 0) {
      std::int32_t& first = first_[idx(at_) & (first_.size() - 1)];
      if (first == none) {
        ++at_;
        continue;
      }
      const Entry entry = entries_[idx(first)];
      first = entry.next;
      --count_;
      if (number(distance[entry.vertex]) <= at_) return entry.vertex;
    }
    return -1;
  }

 private:
  static constexpr std::int32_t none = -1;
  struct Entry {
    std::int32_t vertex;
    std::int32_t next;  // in the same step
  };

  [[nodiscard]] std::int64_t number(float distance) const {
    return static_cast<std::int64_t>(distance / step_);
  }

  float step_;
  std::vector<std::int32_t> first_;  // of the entries of each step
  std::vector<Entry> entries_;
  std::int64_t at_ = 0;
  std::size_t count_ = 0;
};

Eigen::VectorXf GeodesicDistance::from(int vertex, const std::stop_token& stop) const {
  constexpr std::size_t taken_between_looks = 1 << 16;
  const std::size_t count = wedges_around_.offsets.size() - 1;
  Eigen::VectorXf distance = Eigen::VectorXf::Constant(static_cast<Eigen::Index>(count), nowhere);
  std::vector<char> is_done(count, 0);
  float worth_it = 0.05F * step_;  // of reaching a vertex anew
  // Among slivers a wave may be improved without end, by less and less.
  const std::size_t many = 4 * count;
  std::size_t taken = 0;
  Front front(step_, steps_, count);
  distance[vertex] = 0;
  front.push(0, vertex);
  const auto offer = [&](std::int32_t target, float found) {
    if (!(found < distance[target] - worth_it)) return;
    distance[target] = found;
    is_done[idx(target)] = 0;
    front.push(found, target);
  };
  for (std::int32_t v = front.pop(distance); v >= 0; v = front.pop(distance)) {
    if (is_done[idx(v)] != 0) continue;
    is_done[idx(v)] = 1;
    if (++taken % many == 0) worth_it *= 4;
    if (taken % taken_between_looks == 0) throw_if_stopped(stop);
    const float reached = distance[v];
    for (std::int64_t i = wedges_around_.offsets[idx(v)]; i < wedges_around_.offsets[idx(v) + 1];
         ++i) {
      const Wedge& wedge = wedges_around_.values[idx(i)];
      const Corner& at_next = wedge.at_next;
      const Corner& at_last = wedge.at_last;
      // A wave goes on across an edge once both of the edge's ends are reached: the last of the two
      // asks.
      if (distance[wedge.last] > reached) {
        float found = reached + at_next.length;
        if (is_done[idx(wedge.next)] != 0) {
          found = std::min(
              found, across(at_last.length, at_last.x, at_last.y, reached, distance[wedge.next]));
        }
        offer(wedge.last, found);
      }
      if (distance[wedge.next] > reached) {
        float found = reached + at_last.length;
        if (is_done[idx(wedge.last)] != 0) {
          found = std::min(
              found, across(at_next.length, at_next.x, at_next.y, distance[wedge.last], reached));
        }
        offer(wedge.next, found);
      }
    }
  }
  return distance;
}

Eigen::VectorXd mean_geodesic_distance(const Surface& surface, const Eigen::VectorXd& areas,
                                       int samples, int threads, const std::stop_token& stop) {
  const GeodesicDistance distance(surface);
  const std::vector<int> chosen = samples_of(surface, samples);
  std::vector<Eigen::VectorXf> from(chosen.size());
  parallel_for(chosen.size(), 1, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      throw_if_stopped(stop);
      from[k] = distance.from(chosen[k], stop);
    }
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
