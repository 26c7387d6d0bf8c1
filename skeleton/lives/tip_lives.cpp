#include <curveskel/lives.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <queue>
#include <stop_token>
#include <utility>

#include <curveskel/advanced/closed_manifold.hpp>
#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/laplacian.hpp>
#include <curveskel/advanced/measures.hpp>
#include <curveskel/advanced/union_find.hpp>
#include "base/option_ranges.hpp"
#include "skeleton/lives/geodesic_distance.hpp"

namespace curveskel {
namespace {

constexpr int level_curves = 32;
constexpr int first_level = 6;  // nearer to the tip triangles are as wide as the part
constexpr int least_vertices = 8;

/// The neighbours of each vertex, ascending.
std::vector<std::vector<int>> neighbours_of(const Surface& surface) {
  std::vector<std::vector<int>> around(idx(surface.positions.rows()));
  for (const auto& t : surface.triangles.rowwise()) {
    for (int k = 0; k < 3; ++k) {
      around[idx(t[k])].push_back(t[(k + 1) % 3]);
      around[idx(t[k])].push_back(t[(k + 2) % 3]);
    }
  }
  for (std::vector<int>& one : around) {
    std::sort(one.begin(), one.end());
    one.erase(std::unique(one.begin(), one.end()), one.end());
  }
  return around;
}

class Lives {
 public:
  Lives(const Surface& surface, const LifeOptions& options, const std::stop_token& stop)
      : surface_(surface),
        areas_(vertex_areas(surface)),
        whole_(areas_.sum()),
        size_(bounding_box_diagonal(surface.positions)),
        value_(mean_geodesic_distance(surface, areas_, options.samples, options.threads, stop)),
        around_(neighbours_of(surface)),
        triangles_(bucket<std::int32_t>(
            surface.triangles.size(), surface.positions.rows(),
            [&](std::int64_t i) { return surface.triangles(i / 3, i % 3); },
            [](std::int64_t i) { return static_cast<std::int32_t>(i / 3); })),
        is_in_(around_.size(), 0),
        queued_(around_.size(), 0) {}

  std::vector<TipLife> find(double least_height, const Monitor& monitor) {
    merge();
    std::vector<int> numbers;  // of the maxima that stay
    for (int k = 0; k < static_cast<int>(tips_.size()); ++k) {
      const bool stays = tips_[idx(k)].parent < 0 ||
                         tips_[idx(k)].birth - tips_[idx(k)].death >= least_height * size_;
      if (stays) numbers.push_back(k);
    }
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      monitor.report("lives", static_cast<double>(k) / static_cast<double>(numbers.size()));
      measure(tips_[idx(numbers[k])]);
    }
    std::stable_sort(numbers.begin(), numbers.end(),
                     [&](int a, int b) { return tips_[idx(a)].life > tips_[idx(b)].life; });
    return in_order(numbers);
  }

 private:
  /// Higher, or of equals the one with the lower number.
  [[nodiscard]] bool is_above(int a, int b) const {
    return std::pair(-value_[a], a) < std::pair(-value_[b], b);
  }

  /// The merge tree of the superlevel sets.
  void merge() {
    std::vector<int> order(around_.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](int a, int b) { return is_above(a, b); });
    UnionFind parts(static_cast<std::int64_t>(around_.size()));
    std::vector<int> tip_of(around_.size(), -1);  // by root: the highest of the part
    std::vector<char> seen(around_.size(), 0);
    for (const int v : order) {
      seen[idx(v)] = 1;
      std::vector<int> met;  // tips
      for (const int other : around_[idx(v)]) {
        if (seen[idx(other)] == 0) continue;
        const int tip = tip_of[idx(parts.root(other))];
        if (std::find(met.begin(), met.end(), tip) == met.end()) met.push_back(tip);
      }
      int eldest = -1;
      for (const int tip : met) {
        const bool is_elder =
            eldest < 0 || is_above(tips_[idx(tip)].vertex, tips_[idx(eldest)].vertex);
        if (is_elder) eldest = tip;
      }
      if (eldest < 0) {
        eldest = static_cast<int>(tips_.size());
        TipLife born;
        born.vertex = v;
        born.birth = value_[v];
        tips_.push_back(born);
      }
      for (const int tip : met) {
        if (tip == eldest) continue;
        tips_[idx(tip)].parent = eldest;
        tips_[idx(tip)].saddle = v;
        tips_[idx(tip)].death = value_[v];
      }
      for (const int other : around_[idx(v)]) {
        if (seen[idx(other)] != 0) parts.unite(v, other);
      }
      tip_of[idx(parts.root(v))] = eldest;
      last_ = v;
    }
    for (TipLife& tip : tips_) {
      if (tip.parent >= 0) continue;
      tip.saddle = last_;
      tip.death = value_[last_];
    }
  }

  /// The level curve of the vertices that are in, where `f` is `level`.
  struct Curve {
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    double radius = 0;
  };
  [[nodiscard]] Curve level_curve(const std::vector<int>& part, double level) const {
    std::vector<std::pair<Eigen::Vector3d, double>> pieces;  // middle, length
    const auto crossing = [&](int in, int out) {
      const double share = (value_[in] - level) / (value_[in] - value_[out]);
      return Eigen::Vector3d(
          ((1 - share) * surface_.positions.row(in) + share * surface_.positions.row(out))
              .transpose());
    };
    Curve curve;
    double length = 0;
    for (const int v : part) {
      for (std::int64_t i = triangles_.offsets[idx(v)]; i < triangles_.offsets[idx(v) + 1]; ++i) {
        const auto t = surface_.triangles.row(triangles_.values[idx(i)]);
        int ins = 0;
        for (const int corner : t) ins += is_in_[idx(corner)];
        if (ins == 3) continue;
        // Each triangle once: from its first corner that is in.
        const auto first = std::find_if(t.begin(), t.end(), [&](int c) { return is_in_[idx(c)]; });
        if (*first != v) continue;
        Eigen::Vector3d ends[2];
        int count = 0;
        for (int k = 0; k < 3; ++k) {
          const int a = t[k];
          const int b = t[(k + 1) % 3];
          if (is_in_[idx(a)] == is_in_[idx(b)]) continue;
          ends[count++] = is_in_[idx(a)] != 0 ? crossing(a, b) : crossing(b, a);
        }
        const double piece = (ends[1] - ends[0]).norm();
        const Eigen::Vector3d middle = 0.5 * (ends[0] + ends[1]);
        pieces.emplace_back(middle, piece);
        curve.centre += piece * middle;
        length += piece;
      }
    }
    if (!(length > 0)) return curve;
    curve.centre /= length;
    for (const auto& [middle, piece] : pieces) {
      curve.radius += piece * (middle - curve.centre).norm() / length;
    }
    return curve;
  }

  /// Grows the part from the tip downwards.
  void measure(TipLife& tip) {
    const double height = tip.birth - tip.death;
    if (!(height > 0)) return;
    const auto lower = [&](int a, int b) { return is_above(b, a); };
    std::priority_queue<int, std::vector<int>, decltype(lower)> open(lower);
    std::vector<int> part;
    open.push(tip.vertex);
    queued_[idx(tip.vertex)] = 1;
    double area = 0;
    std::int64_t euler = 0;
    int level = first_level;
    const auto level_at = [&](int k) { return tip.birth - height * k / level_curves; };
    while (level <= level_curves) {
      // All that is connected above the level is in before anything below.
      while (!open.empty() && value_[open.top()] >= level_at(level)) {
        const int v = open.top();
        open.pop();
        euler += take(v);
        part.push_back(v);
        area += areas_[v];
        for (const int other : around_[idx(v)]) {
          if (queued_[idx(other)] != 0) continue;
          queued_[idx(other)] = 1;
          open.push(other);
        }
      }
      if (area > 0.5 * whole_) break;
      if (euler == 1 && part.size() >= least_vertices) {
        const Curve curve = level_curve(part, level_at(level));
        const double life = curve.radius > 0 ? (tip.birth - level_at(level)) / curve.radius : 0;
        if (life > tip.life) {
          tip.life = life;
          tip.rim = curve.centre;
          tip.rim_radius = curve.radius;
          tip.area = area / whole_;
        }
      }
      ++level;
    }
    for (const int v : part) is_in_[idx(v)] = queued_[idx(v)] = 0;
    for (; !open.empty(); open.pop()) queued_[idx(open.top())] = 0;
  }

  /// Returns the change of the part's Euler characteristic.
  std::int64_t take(int v) {
    std::int64_t change = 1;
    for (const int other : around_[idx(v)]) change -= is_in_[idx(other)];
    is_in_[idx(v)] = 1;
    for (std::int64_t i = triangles_.offsets[idx(v)]; i < triangles_.offsets[idx(v) + 1]; ++i) {
      const auto t = surface_.triangles.row(triangles_.values[idx(i)]);
      change += is_in_[idx(t[0])] != 0 && is_in_[idx(t[1])] != 0 && is_in_[idx(t[2])] != 0 ? 1 : 0;
    }
    return change;
  }

  /// Those that stay, with parents among them.
  [[nodiscard]] std::vector<TipLife> in_order(const std::vector<int>& numbers) const {
    std::vector<int> place(tips_.size(), -1);
    for (std::size_t k = 0; k < numbers.size(); ++k) place[idx(numbers[k])] = static_cast<int>(k);
    std::vector<TipLife> lives;
    for (const int number : numbers) {
      TipLife life = tips_[idx(number)];
      while (life.parent >= 0 && place[idx(life.parent)] < 0) {
        life.parent = tips_[idx(life.parent)].parent;
      }
      if (life.parent >= 0) life.parent = place[idx(life.parent)];
      life.birth /= size_;
      life.death /= size_;
      lives.push_back(life);
    }
    return lives;
  }

  const Surface& surface_;
  const Eigen::VectorXd areas_;
  const double whole_;
  const double size_;
  const Eigen::VectorXd value_;
  const std::vector<std::vector<int>> around_;
  const Buckets<std::int32_t> triangles_;
  std::vector<char> is_in_;  // of the part that grows
  std::vector<char> queued_;
  std::vector<TipLife> tips_;
  int last_ = -1;
};

}  // namespace

void require_valid(const LifeOptions& options) {
  const OptionCheck check("LifeOptions");
  check.number("samples", options.samples, {8, 1000});
  check.number("least_height", options.least_height, share_range);
  check.number("threads", options.threads, thread_range);
}

std::vector<TipLife> tip_lives(const Surface& surface, const LifeOptions& options,
                               const Monitor& monitor) {
  require_valid(options);
  if (surface.positions.rows() == 0) return {};
  require_closed_manifold(surface, "tip_lives", options.threads);
  monitor.report("lives", 0);
  return Lives(surface, options, monitor.stop).find(options.least_height, monitor);
}

}  // namespace curveskel
