#include "surface/resample/canonical.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

#include <curveskel/advanced/measures.hpp>
#include "base/parallel.hpp"
#include "surface/resample/principal_frame.hpp"
#include "surface/spatial/morton.hpp"

namespace curveskel {
namespace {

// So many vertices at most are posed to choose among the poses of a symmetric surface.
constexpr std::size_t vertices_to_compare = 2'000'000;

using Steps = Eigen::Matrix<std::int32_t, Eigen::Dynamic, 3, Eigen::RowMajor>;

// Vertices along a Morton curve; where the curve's 21 bits do not tell two apart, by coordinates,
// and where these coincide, by the sum of the neighbours' coordinates.
class Order {
 public:
  Order(const Steps& steps, const Triangles& triangles) : steps_(steps), triangles_(triangles) {}

  std::vector<std::int32_t> vertices() {
    const auto count = static_cast<std::size_t>(steps_.rows());
    std::vector<std::uint64_t> keys(count);
    for (std::size_t v = 0; v < count; ++v) {
      // |coordinate| <= 1, so 23 bits hold the steps and 21 their leading part.
      const auto lead = [&](Eigen::Index k) {
        return static_cast<std::uint64_t>(steps_(static_cast<Eigen::Index>(v), k) + (1 << 22)) >>
               2U;
      };
      keys[v] = morton_key(lead(0), lead(1), lead(2));
    }
    std::vector<std::int32_t> order = order_by_key(keys, 63);
    const auto key_at = [&](std::size_t i) { return keys[static_cast<std::size_t>(order[i])]; };
    for (std::size_t i = 0; i < count;) {
      std::size_t end = i + 1;
      while (end < count && key_at(end) == key_at(i)) ++end;
      if (end > i + 1) {
        std::stable_sort(order.begin() + static_cast<std::ptrdiff_t>(i),
                         order.begin() + static_cast<std::ptrdiff_t>(end),
                         [&](int a, int b) { return before(a, b); });
      }
      i = end;
    }
    return order;
  }

 private:
  bool before(int a, int b) {
    const auto here = [&](int v) { return std::tie(steps_(v, 0), steps_(v, 1), steps_(v, 2)); };
    if (here(a) != here(b)) return here(a) < here(b);
    if (round_.rows() == 0) sum_neighbours();
    const auto round = [&](int v) { return std::tie(round_(v, 0), round_(v, 1), round_(v, 2)); };
    return round(a) < round(b);
  }

  void sum_neighbours() {
    round_.setZero(steps_.rows(), 3);
    for (Eigen::Index face = 0; face < triangles_.rows(); ++face) {
      for (Eigen::Index k = 0; k < 3; ++k) {
        round_.row(triangles_(face, k)) +=
            steps_.row(triangles_(face, (k + 1) % 3)).cast<std::int64_t>();
      }
    }
  }

  const Steps& steps_;
  const Triangles& triangles_;
  Eigen::Matrix<std::int64_t, Eigen::Dynamic, 3, Eigen::RowMajor> round_;  // of coincident vertices
};

using Face = std::array<std::int32_t, 3>;

// A left-handed pose mirrors the surface, whose faces then turn the other way.
struct Faces {
  const Triangles& triangles;
  bool are_mirrored;

  [[nodiscard]] std::int32_t corner(std::size_t face, Eigen::Index k) const {
    return triangles(static_cast<Eigen::Index>(face), are_mirrored ? (3 - k) % 3 : k);
  }
};

// Renumbered, smallest vertex first.
std::vector<Face> renumbered(const Faces& given, const Eigen::VectorXi& place, int threads) {
  std::vector<Face> faces(static_cast<std::size_t>(given.triangles.rows()));
  parallel_for(faces.size(), 1 << 14, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      faces[f] = {place(given.corner(f, 0)), place(given.corner(f, 1)), place(given.corner(f, 2))};
      std::rotate(faces[f].begin(), std::min_element(faces[f].begin(), faces[f].end()),
                  faces[f].end());
    }
  });
  return faces;
}

// Renumbered, smallest vertex first, rows in lexicographic order.
Triangles canonical_triangles(const Faces& given, const Eigen::VectorXi& place, int threads) {
  const std::vector<Face> faces = renumbered(given, place, threads);
  const auto vertices = static_cast<std::size_t>(place.size());
  std::vector<std::uint32_t> begin(vertices + 2, 0);  // shifted by one while filled
  for (const Face& face : faces) ++begin[static_cast<std::size_t>(face[0]) + 2];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<Face> sorted(faces.size());
  Triangles result(given.triangles.rows(), 3);
  // Each range reads all faces, so there are no more of them than cores.
  const std::size_t ranges = thread_count(threads);
  const std::size_t grain = (vertices + ranges - 1) / ranges;
  parallel_for(vertices, grain, threads, [&](std::size_t first, std::size_t last) {
    std::size_t row = begin[first + 1];
    for (const Face& face : faces) {
      const auto v = static_cast<std::size_t>(face[0]);
      if (v >= first && v < last) sorted[begin[v + 1]++] = face;
    }
    for (std::size_t v = first; v < last; ++v) {
      const auto end = sorted.begin() + static_cast<std::ptrdiff_t>(begin[v + 1]);
      std::sort(sorted.begin() + static_cast<std::ptrdiff_t>(row), end);
      for (; row < begin[v + 1]; ++row) {
        result.row(static_cast<Eigen::Index>(row)) << sorted[row][0], sorted[row][1],
            sorted[row][2];
      }
    }
  });
  return result;
}

struct Posed {
  Steps steps;
  double scale;
};

Posed posed(const Surface& surface, const PrincipalFrame& frame, std::size_t candidate) {
  const Positions turned =
      (surface.positions.rowwise() - frame.origin.transpose()) * frame.axes[candidate];
  const double diagonal = bounding_box_diagonal(turned);
  const double scale = diagonal > 0 ? diagonal : 1;
  return {(turned / (scale * canonical_step)).array().round().cast<std::int32_t>(), scale};
}

// A number that tells poses of one surface apart, for any numbering: a sum over the sides of
// the triangles.
std::uint64_t fingerprint(const Steps& steps, const Faces& faces) {
  const auto mix = [](std::uint64_t x) {
    x *= 0x9e3779b97f4a7c15U;
    x ^= x >> 29U;
    x *= 0xbf58476d1ce4e5b9U;
    return x ^ x >> 32U;
  };
  std::vector<std::uint64_t> places(static_cast<std::size_t>(steps.rows()));
  for (Eigen::Index v = 0; v < steps.rows(); ++v) {
    std::uint64_t place = 0;
    for (Eigen::Index k = 0; k < 3; ++k) {
      place = mix(place + static_cast<std::uint64_t>(steps(v, k) + (1 << 22)) + 1);
    }
    places[static_cast<std::size_t>(v)] = place;
  }
  std::uint64_t print = 0;
  for (std::size_t f = 0; f < static_cast<std::size_t>(faces.triangles.rows()); ++f) {
    for (Eigen::Index k = 0; k < 3; ++k) {
      print += mix(places[static_cast<std::size_t>(faces.corner(f, k))] +
                   3 * places[static_cast<std::size_t>(faces.corner(f, (k + 1) % 3))]);
    }
  }
  return print;
}

bool is_mirror_image(const Eigen::Matrix3d& axes) { return axes.determinant() < 0; }

}  // namespace

Triangles Canonical::to_model(Triangles triangles) const {
  if (is_mirror_image(rotation)) triangles.col(1).swap(triangles.col(2));
  return triangles;
}

Positions Canonical::to_model(const Positions& positions) const {
  return (scale * (positions * rotation.transpose())).rowwise() + origin.transpose();
}

Canonical canonical_form(const Surface& surface, int threads) {
  const auto vertices = static_cast<std::size_t>(surface.positions.rows());
  const std::size_t most_candidates =
      std::clamp<std::size_t>(vertices_to_compare / std::max<std::size_t>(vertices, 1), 1, 64);
  const PrincipalFrame frame = principal_frame(surface, most_candidates, threads);
  Canonical result;
  result.origin = frame.origin;
  Posed best = posed(surface, frame, 0);
  result.rotation = frame.axes[0];
  if (frame.axes.size() > 1) {
    const auto faces = [&](const Eigen::Matrix3d& axes) {
      return Faces{surface.triangles, is_mirror_image(axes)};
    };
    std::uint64_t least = fingerprint(best.steps, faces(frame.axes[0]));
    for (std::size_t i = 1; i < frame.axes.size(); ++i) {
      Posed other = posed(surface, frame, i);
      const std::uint64_t print = fingerprint(other.steps, faces(frame.axes[i]));
      if (print < least) {
        least = print;
        best = std::move(other);
        result.rotation = frame.axes[i];
      }
    }
  }
  result.scale = best.scale;

  const std::vector<std::int32_t> order = Order(best.steps, surface.triangles).vertices();
  result.input_of_vertex = Eigen::Map<const Eigen::VectorXi>(order.data(), best.steps.rows());
  result.vertex_of_input.resize(best.steps.rows());
  result.surface.positions.resize(best.steps.rows(), 3);
  for (Eigen::Index v = 0; v < best.steps.rows(); ++v) {
    const int input = result.input_of_vertex(v);
    result.vertex_of_input(input) = static_cast<int>(v);
    result.surface.positions.row(v) = canonical_step * best.steps.row(input).cast<double>();
  }
  result.surface.triangles = canonical_triangles(
      {surface.triangles, is_mirror_image(result.rotation)}, result.vertex_of_input, threads);
  return result;
}

}  // namespace curveskel
