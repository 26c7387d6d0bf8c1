// Garland and Heckbert, Surface simplification using quadric error metrics, SIGGRAPH 1997.
// Dey, Edelsbrunner, Guha and Nekhayev, Topology preserving edge contraction, 1999.
#include "surface/resample/collapse.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/parallel.hpp"

namespace curveskel {
namespace {

using Index = std::int32_t;

constexpr float shortness_weight = 0.1F;   // of tr(Q) |e|^2 against the squared distance
constexpr float stiffness = 1e-2F;         // how strongly the merged vertex holds to the midpoint
constexpr double largest_share = 0.4;      // of the vertices that one pass may remove
constexpr double considered_share = 0.6;   // of the edges that one pass looks at
constexpr double least_turn_cosine = 0.2;  // of a face's normal, before against after
constexpr double least_roundness = 0.1;    // of a face afterwards, unless it was worse before
constexpr int largest_valence = 12;
constexpr Index dead = -1;

/// The limits that a collapse keeps to, eased one after another when no edge may go any more.
enum class Limits : std::uint8_t {
  all,        ///< valence, roundness, turning
  not_worse,  ///< faces may be as far from round as they were
  turning,    ///< needles may come: of scans with needles everywhere each collapse makes one
};

constexpr int next(int corner) { return corner == 2 ? 0 : corner + 1; }
constexpr int previous(int corner) { return corner == 0 ? 2 : corner - 1; }

struct Merged {
  Eigen::Vector3f step;  // from the first end's position, in scaled units
  Quadric quadric;       // about the first end's position plus step
  float cost;
};

Merged merge(const CollapsingPatch& patch, Index a, Index b) {
  const CollapsingPatch::Vertex& first = patch.vertices[static_cast<std::size_t>(a)];
  const CollapsingPatch::Vertex& second = patch.vertices[static_cast<std::size_t>(b)];
  const Eigen::Vector3f edge = (patch.scale * (second.position - first.position)).cast<float>();
  const Eigen::Vector3f half = 0.5F * edge;
  Quadric sum = first.quadric.moved(half);
  sum += second.quadric.moved(-half);
  const float length = edge.squaredNorm();
  Quadric::Minimum best = sum.minimum(stiffness);
  if (best.point.squaredNorm() > length) best = {Eigen::Vector3f::Zero(), sum.c};
  const float cost = std::max(best.value, 0.0F) + shortness_weight * sum.trace() * length;
  return {half + best.point, sum.moved(best.point), cost};
}

class Pass {
 public:
  Pass(CollapsingPatch& patch, const CollapseOptions& options)
      : patch_(patch),
        options_(options),
        into_(patch.vertices.size(), dead),
        locked_(patch.fixed),
        stamp_(patch.vertices.size(), 0) {
    link_corners();
  }

  // Returns how many vertices went.
  std::size_t run(Limits limits) {
    limits_ = limits;
    const std::size_t excess =
        patch_.vertices.size() - static_cast<std::size_t>(options_.target_vertices);
    const std::size_t allowed = std::min(
        excess,
        std::max<std::size_t>(1, static_cast<std::size_t>(
                                     largest_share * static_cast<double>(patch_.vertices.size()))));
    std::size_t removed = 0;
    for (const std::uint32_t slot : edges_by_cost()) {
      if (removed == allowed) break;
      if (collapse(slot)) ++removed;
    }
    return removed;
  }

  // Drops dead elements; per vertex of before, the vertex of after.
  std::vector<Index> compact() {
    std::vector<Index> place(patch_.vertices.size());
    Index alive = 0;
    for (std::size_t v = 0; v < place.size(); ++v) {
      if (into_[v] != dead) continue;
      place[v] = alive;
      patch_.vertices[static_cast<std::size_t>(alive)] = patch_.vertices[v];
      patch_.fixed[static_cast<std::size_t>(alive)] = patch_.fixed[v];
      ++alive;
    }
    for (std::size_t v = 0; v < place.size(); ++v) {
      if (into_[v] != dead) place[v] = place[static_cast<std::size_t>(into_[v])];
    }
    patch_.vertices.resize(static_cast<std::size_t>(alive));
    patch_.fixed.resize(static_cast<std::size_t>(alive));
    std::size_t faces = 0;
    for (const auto& face : patch_.faces) {
      if (face[0] == dead) continue;
      auto& kept = patch_.faces[faces++];
      kept = {place[static_cast<std::size_t>(face[0])], place[static_cast<std::size_t>(face[1])],
              place[static_cast<std::size_t>(face[2])]};
    }
    patch_.faces.resize(faces);
    return place;
  }

 private:
  // A corner 3 f + k lists under the vertex at face f's corner k. Valid for a vertex until it is
  // locked: collapses elsewhere only kill faces and rename other corners.
  void link_corners() {
    first_corner_.assign(patch_.vertices.size() + 1, 0);
    for (const auto& face : patch_.faces) {
      for (const Index v : face) ++first_corner_[static_cast<std::size_t>(v) + 1];
    }
    std::partial_sum(first_corner_.begin(), first_corner_.end(), first_corner_.begin());
    corners_.resize(3 * patch_.faces.size());
    std::vector<std::uint32_t> filled(first_corner_.begin(), first_corner_.end() - 1);
    for (std::size_t f = 0; f < patch_.faces.size(); ++f) {
      for (std::size_t k = 0; k < 3; ++k) {
        corners_[filled[static_cast<std::size_t>(patch_.faces[f][k])]++] =
            static_cast<std::uint32_t>(3 * f + k);
      }
    }
  }

  // Costs order by their leading bits, about 3 %, so one counting sort does it; ties by index.
  std::vector<std::uint32_t> edges_by_cost() {
    constexpr unsigned dropped_bits = 18;
    constexpr std::uint16_t none = 0xffff;
    std::vector<std::uint16_t> key(3 * patch_.faces.size(), none);
    parallel_for(patch_.faces.size(), 8192, options_.threads, [&](auto begin, auto end) {
      for (std::size_t f = begin; f < end; ++f) {
        for (int k = 0; k < 3; ++k) {
          const Index a = patch_.faces[f][static_cast<std::size_t>(k)];
          const Index b = patch_.faces[f][static_cast<std::size_t>(next(k))];
          if (a > b || patch_.fixed[static_cast<std::size_t>(a)] != 0 ||
              patch_.fixed[static_cast<std::size_t>(b)] != 0) {
            continue;
          }
          key[3 * f + static_cast<std::size_t>(k)] = static_cast<std::uint16_t>(
              std::bit_cast<std::uint32_t>(merge(patch_, a, b).cost) >> dropped_bits);
        }
      }
    });
    std::vector<std::uint32_t> begin(std::size_t{none} + 1, 0);
    for (const std::uint16_t k : key) {
      if (k != none) ++begin[std::size_t{k} + 1];
    }
    const std::size_t total = std::accumulate(begin.begin(), begin.end(), std::size_t{0});
    const auto wanted =
        limits_ == Limits::all
            ? static_cast<std::size_t>(considered_share * static_cast<double>(total))
            : total;
    std::uint16_t last = 0;  // keys up to this one are considered
    for (std::size_t i = 1; i < begin.size(); ++i) {
      begin[i] += begin[i - 1];
      if (begin[i - 1] <= wanted) last = static_cast<std::uint16_t>(i - 1);
    }
    std::vector<std::uint32_t> sorted(begin[std::size_t{last} + 1]);
    for (std::size_t slot = 0; slot < key.size(); ++slot) {
      if (key[slot] <= last) sorted[begin[key[slot]]++] = static_cast<std::uint32_t>(slot);
    }
    return sorted;
  }

  template <typename Visit>  // bool(face, corner), false = stop
  bool each_corner(Index vertex, const Visit& visit) const {
    const auto v = static_cast<std::size_t>(vertex);
    for (std::uint32_t i = first_corner_[v]; i < first_corner_[v + 1]; ++i) {
      const auto& face = patch_.faces[corners_[i] / 3];
      if (face[0] != dead && !visit(face, static_cast<int>(corners_[i] % 3))) return false;
    }
    return true;
  }

  // Link condition for an edge inside a closed surface: the ends share two neighbours, and what is
  // left is no flat pocket.
  bool keeps_topology(Index a, Index b) {
    ++token_;
    int valence_a = 0;
    each_corner(a, [&](const auto& face, int k) {
      stamp_[static_cast<std::size_t>(face[static_cast<std::size_t>(next(k))])] = token_;
      return ++valence_a > 0;
    });
    int valence_b = 0;
    int common = 0;
    each_corner(b, [&](const auto& face, int k) {
      const auto x = static_cast<std::size_t>(face[static_cast<std::size_t>(next(k))]);
      if (stamp_[x] == token_) ++common;
      return ++valence_b > 0;
    });
    const int valence = valence_a + valence_b - 4;
    return common == 2 && valence >= 3 && (limits_ != Limits::all || valence <= largest_valence);
  }

  // No face round `vertex` but those at `other` turns over or becomes a needle when it moves.
  bool keeps_faces(Index vertex, Index other, const Eigen::Vector3d& target) const {
    const Eigen::Vector3d& from = patch_.vertices[static_cast<std::size_t>(vertex)].position;
    return each_corner(vertex, [&](const auto& face, int k) {
      const Index i = face[static_cast<std::size_t>(next(k))];
      const Index j = face[static_cast<std::size_t>(previous(k))];
      if (i == other || j == other) return true;
      const Eigen::Vector3d& x = patch_.vertices[static_cast<std::size_t>(i)].position;
      const Eigen::Vector3d& y = patch_.vertices[static_cast<std::size_t>(j)].position;
      const Eigen::Vector3d side = y - x;
      const Eigen::Vector3d before = side.cross(from - x);
      const Eigen::Vector3d after = side.cross(target - x);
      const double cosine = before.dot(after);
      const double area_before = before.squaredNorm();
      const double area_after = after.squaredNorm();
      if (cosine < 0 ||
          cosine * cosine < least_turn_cosine * least_turn_cosine * area_before * area_after) {
        return false;
      }
      // Roundness: 2 sqrt(3) |cross| / (sum of squared sides), 1 for an equilateral triangle.
      const double fixed_side = side.squaredNorm();
      const double sides_after =
          fixed_side + (target - x).squaredNorm() + (target - y).squaredNorm();
      const double bound = least_roundness * least_roundness / 12;
      if (area_after >= bound * sides_after * sides_after) return true;
      if (limits_ == Limits::turning) return area_after > 0;
      const double sides_before = fixed_side + (from - x).squaredNorm() + (from - y).squaredNorm();
      return limits_ == Limits::not_worse &&
             area_after * sides_before * sides_before >= area_before * sides_after * sides_after;
    });
  }

  bool collapse(std::uint32_t slot) {
    const auto& face = patch_.faces[slot / 3];
    if (face[0] == dead) return false;
    const Index a = face[slot % 3];
    const Index b = face[static_cast<std::size_t>(next(static_cast<int>(slot % 3)))];
    const auto ia = static_cast<std::size_t>(a);
    const auto ib = static_cast<std::size_t>(b);
    if (locked_[ia] != 0 || locked_[ib] != 0 || !keeps_topology(a, b)) return false;
    const Merged merged = merge(patch_, a, b);
    const Eigen::Vector3d target =
        patch_.vertices[ia].position + merged.step.cast<double>() / patch_.scale;
    if (!keeps_faces(a, b, target) || !keeps_faces(b, a, target)) return false;

    for (std::uint32_t i = first_corner_[ib]; i < first_corner_[ib + 1]; ++i) {
      auto& own = patch_.faces[corners_[i] / 3];
      if (own[0] == dead) continue;
      if (own[0] == a || own[1] == a || own[2] == a) {
        own[0] = dead;
      } else {
        own[corners_[i] % 3] = a;
      }
    }
    patch_.vertices[ia] = {target, merged.quadric};
    into_[ib] = a;
    locked_[ia] = locked_[ib] = 1;
    return true;
  }

  CollapsingPatch& patch_;
  const CollapseOptions& options_;
  std::vector<Index> into_;
  std::vector<std::uint8_t> locked_;
  std::vector<std::uint32_t> stamp_;
  std::uint32_t token_ = 0;
  Limits limits_ = Limits::all;
  std::vector<std::uint32_t> first_corner_;
  std::vector<std::uint32_t> corners_;
};

}  // namespace

std::vector<Index> collapse_edges(CollapsingPatch& patch, const CollapseOptions& options,
                                  const std::function<void(std::size_t)>& between_passes) {
  const auto target = static_cast<std::size_t>(options.target_vertices);
  std::vector<std::vector<Index>> places;
  std::vector<Index> result(patch.vertices.size());
  Limits limits = Limits::all;
  while (patch.vertices.size() > target) {
    Pass pass(patch, options);
    const std::size_t before = patch.vertices.size();
    const std::size_t removed = pass.run(limits);
    places.push_back(pass.compact());
    between_passes(patch.vertices.size());
    if (limits == Limits::all && removed * 100 < std::min(before, 10 * (before - target))) {
      limits = Limits::not_worse;
    } else if (removed == 0) {
      if (limits == Limits::turning) break;
      limits = Limits::turning;
    }
  }
  std::iota(result.begin(), result.end(), 0);
  if (places.empty()) return result;
  // From the last pass back, each map shrinks to the size of the surface before it.
  for (std::size_t i = places.size() - 1; i-- > 0;) {
    for (Index& place : places[i]) place = places[i + 1][static_cast<std::size_t>(place)];
  }
  return places.front();
}

}  // namespace curveskel
