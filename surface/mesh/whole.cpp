#include "surface/mesh/whole.hpp"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include "base/parallel.hpp"
#include "surface/mesh/half_edges.hpp"

namespace curveskel {
namespace {

/// Half-edges of a surface as far as they pair; half-edge h = 3 f + k runs from corner k of face f.
class Pairing {
 public:
  explicit Pairing(const Surface& surface)
      : corner_(surface.triangles.data()),
        faces_(static_cast<std::int32_t>(surface.triangles.rows())),
        twin_(idx(surface.triangles.size())),
        leaving_(idx(surface.positions.rows()), -1),
        degree_(idx(surface.positions.rows()), 0) {}

  /// Pairs the edges whose lower vertex lies in [first, last); false if one is not run through
  /// exactly once either way.
  bool pair(std::int32_t first, std::int32_t last) {
    struct Ascending {
      std::int32_t end;
      std::int32_t half_edge;  // -1 once it has its twin
    };
    std::vector<std::int32_t> begin(idx(last - first) + 2, 0);  // shifted by one while filled
    const auto within = [=](std::int32_t v) { return v >= first && v < last; };
    bool proper = true;
    each_half_edge([&](std::int32_t h, std::int32_t from, std::int32_t to) {
      if (!within(from)) return;
      ++degree_[idx(from)];
      leaving_[idx(from)] = h;
      if (from < to) ++begin[idx(from - first) + 2];
      proper = proper && from != to;
    });
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    std::vector<Ascending> ascending(idx(begin.back()));
    each_half_edge([&](std::int32_t h, std::int32_t from, std::int32_t to) {
      if (from < to && within(from)) ascending[idx(begin[idx(from - first) + 1]++)] = {to, h};
    });
    std::size_t paired = 0;
    each_half_edge([&](std::int32_t h, std::int32_t from, std::int32_t to) {
      if (from < to || !within(to) || !proper) return;
      auto i = idx(begin[idx(to - first)]);
      const auto end = idx(begin[idx(to - first) + 1]);
      while (i < end && ascending[i].end != from) ++i;
      proper = i < end && ascending[i].half_edge >= 0;
      if (!proper) return;
      twin_[idx(h)] = ascending[i].half_edge;
      twin_[idx(ascending[i].half_edge)] = h;
      ascending[i].half_edge = -1;
      ++paired;
    });
    return proper && paired == ascending.size();
  }

  /// Precondition: everything is paired.
  [[nodiscard]] bool one_umbrella(std::int32_t vertex) const {
    std::int32_t half_edge = leaving_[idx(vertex)];
    if (half_edge < 0) return false;
    std::int32_t steps = 0;
    do {
      half_edge = next_half_edge(twin_[idx(half_edge)]);
      ++steps;
    } while (half_edge != leaving_[idx(vertex)] && steps <= degree_[idx(vertex)]);
    return steps == degree_[idx(vertex)];
  }

  /// True if the face's neighbours are one and the same.
  [[nodiscard]] bool repeats(std::int32_t face) const {
    const auto neighbour = [&](std::int32_t k) { return twin_[idx(3 * face + k)] / 3; };
    return neighbour(0) == neighbour(1) && neighbour(1) == neighbour(2);
  }

 private:
  template <typename Body>
  void each_half_edge(const Body& body) const {
    for (std::int32_t f = 0; f < faces_; ++f) {
      const std::int32_t* const corner = corner_ + 3 * std::ptrdiff_t{f};
      const std::int32_t a = corner[0];
      const std::int32_t b = corner[1];
      const std::int32_t c = corner[2];
      body(3 * f, a, b);
      body(3 * f + 1, b, c);
      body(3 * f + 2, c, a);
    }
  }

  const std::int32_t* corner_;
  std::int32_t faces_;
  std::vector<std::int32_t> twin_;
  std::vector<std::int32_t> leaving_;  // some half-edge from each vertex
  std::vector<std::int32_t> degree_;
};

/// True if body(begin, end) is true on ranges that cover [0, count).
template <typename Body>
bool all_of_ranges(std::int32_t count, std::int32_t grain, int threads, const Body& body) {
  std::atomic<bool> all{true};
  parallel_for(idx(count), idx(grain), threads, [&](std::size_t begin, std::size_t end) {
    if (all && !body(static_cast<std::int32_t>(begin), static_cast<std::int32_t>(end))) all = false;
  });
  return all;
}

/// True if each edge is run through exactly once either way.
bool pairs(Pairing& pairing, std::int32_t vertices, int threads) {
  // Each range reads all faces, so there are no more of them than cores.
  const auto ranges = static_cast<std::int32_t>(thread_count(threads));
  const std::int32_t range = (vertices + ranges - 1) / ranges;
  return all_of_ranges(vertices, range, threads, [&](std::int32_t first, std::int32_t last) {
    return pairing.pair(first, last);
  });
}

/// Precondition: it pairs.
bool is_manifold(const Pairing& pairing, std::int32_t vertices, std::int32_t faces, int threads) {
  constexpr std::int32_t grain = 1 << 14;
  const bool umbrellas =
      all_of_ranges(vertices, grain, threads, [&](std::int32_t first, std::int32_t last) {
        for (std::int32_t v = first; v < last; ++v) {
          if (!pairing.one_umbrella(v)) return false;
        }
        return true;
      });
  for (std::int32_t f = 0; f < faces; ++f) {
    if (umbrellas && pairing.repeats(f)) return false;
  }
  return umbrellas;
}

}  // namespace

std::optional<Topology> topology_if_whole(const Surface& surface, int threads) {
  const auto vertices = static_cast<std::int32_t>(surface.positions.rows());
  const auto faces = static_cast<std::int32_t>(surface.triangles.rows());
  if (faces == 0) return std::nullopt;
  Pairing pairing(surface);
  if (!pairs(pairing, vertices, threads)) return std::nullopt;
  auto counted = in_background(threads, [&] { return topology(surface); });
  if (!is_manifold(pairing, vertices, faces, threads)) return std::nullopt;
  return counted.get();
}

bool is_whole(const Surface& surface, int threads) {
  const auto vertices = static_cast<std::int32_t>(surface.positions.rows());
  const auto faces = static_cast<std::int32_t>(surface.triangles.rows());
  if (faces == 0) return false;
  Pairing pairing(surface);
  return pairs(pairing, vertices, threads) && is_manifold(pairing, vertices, faces, threads);
}

}  // namespace curveskel
