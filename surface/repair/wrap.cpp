#include "surface/repair/wrap.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/version.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/measures.hpp>
#include <curveskel/error.hpp>
#include "base/memory.hpp"
#include "surface/mesh/cgal_mesh.hpp"
#include "surface/repair/join_soup.hpp"

// The quicker oracle takes the place of one that is no public part of CGAL.
#if CGAL_VERSION_MAJOR == 5 && CGAL_VERSION_MINOR == 5
#include "surface/repair/wrap_oracle.hpp"
#else
#include <CGAL/alpha_wrap_3.h>
#endif

namespace curveskel {
namespace {

using WrapKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using WrapMesh = CGAL::Surface_mesh<WrapKernel::Point_3>;

/// By the area: on sheets there are more, which have two sides.
double expected_vertices(const Surface& triangles, double gap) {
  return area(triangles) / (gap * gap);
}

[[noreturn]] void refuse_more(const Surface& triangles, double gap, std::int64_t budget) {
  std::array<char, 160> found{};
  std::snprintf(found.data(), found.size(),
                "found a wrap that spans gaps up to %.2g D with more than %lld vertices, needed "
                "fewer; ",
                gap / extent_of_faces(triangles), static_cast<long long>(budget));
  throw WrapTooLarge(found.data() +
                     std::string("choose a wider --wrap-gap, or decimate the surface first"));
}

/// Lets a stop out of CGAL's loop, and how far it is into the monitor. CGAL copies it.
struct WatchedWrapping : CGAL::Alpha_wraps_3::internal::Wrapping_default_visitor {
  WatchedWrapping(const Monitor& given, double expected, WrapBudget& within,
                  const std::function<void()>& when_spent)
      : monitor(&given), budget(&within), spent(&when_spent), expected_(expected) {}

  template <typename Wrapper, typename Gate>
  void before_facet_treatment(const Wrapper& /*wrapper*/, const Gate& /*gate*/) {
    constexpr int facets_between_checks = 256;
    if (++facets_ % facets_between_checks == 0) monitor->report("wrap", fraction());
  }

  template <typename Wrapper, typename Vertex>
  void after_Steiner_point_insertion(const Wrapper& /*wrapper*/, Vertex /*vertex*/) {
    ++vertices_;
    if (--budget->vertices <= 0) (*spent)();
  }

  const Monitor* monitor;
  WrapBudget* budget;
  const std::function<void()>* spent;  ///< throws

 private:
  /// Slower towards the end, as it is not known.
  [[nodiscard]] double fraction() const { return 1 - std::exp(-2 * vertices_ / expected_); }

  double expected_;
  double vertices_ = 0;
  int facets_ = 0;
};

/// Rounded up to two digits, to be typed.
std::string share_at_least(double share) {
  std::array<char, 32> text{};
  const double step = std::pow(10, std::floor(std::log10(share)) - 1);
  std::snprintf(text.data(), text.size(), "%.2g", std::ceil(share / step) * step);
  return text.data();
}

void require_room(const Surface& triangles, double gap) {
  const double narrowest = narrowest_gap(triangles);
  if (gap >= narrowest) return;
  const double extent = extent_of_faces(triangles);
  std::array<char, 160> found{};
  std::snprintf(found.data(), found.size(),
                "a wrap that spans gaps up to %.2g D would have about %.1e vertices; ",
                gap / extent, expected_vertices(triangles, gap));
  throw WrapTooLarge(
      found.data() +
      (narrowest < extent
           ? "needed is --wrap-gap " + share_at_least(narrowest / extent) + " or wider"
           : std::string("there is no memory for any; decimate the surface "
                         "first")));
}

}  // namespace

double narrowest_gap(const Surface& triangles) {
  constexpr double most_vertices = 1e6;
  // As measured: the hierarchy over the faces, and a triangulation with the wrap's vertices.
  const double for_faces = 600.0 * double(triangles.triangles.rows());
  const double fitting = (available_memory_bytes() - for_faces) / 3500;
  if (!(fitting > 0)) return std::numeric_limits<double>::infinity();
  return std::sqrt(area(triangles) / std::min(most_vertices, fitting));
}

Surface wrap(const Surface& triangles, const WrapOptions& options, WrapBudget& budget,
             const Monitor& monitor) {
  require_room(triangles, options.gap);
  const std::function<void()> when_spent = [&, all = budget.vertices] {
    refuse_more(triangles, options.gap, all);
  };
  if (budget.for_expected * expected_vertices(triangles, options.gap) > double(budget.vertices)) {
    when_spent();
  }
  monitor.report("wrap", 0);
  std::vector<WrapKernel::Point_3> points;
  points.reserve(idx(triangles.positions.rows()));
  for (const auto& p : triangles.positions.rowwise()) points.emplace_back(p.x(), p.y(), p.z());
  std::vector<std::array<std::size_t, 3>> faces;
  faces.reserve(idx(triangles.triangles.rows()));
  for (const auto& t : triangles.triangles.rowwise())
    faces.push_back({idx(t(0)), idx(t(1)), idx(t(2))});

  WrapMesh mesh;
  WatchedWrapping visitor(monitor, expected_vertices(triangles, options.gap), budget, when_spent);
#if CGAL_VERSION_MAJOR == 5 && CGAL_VERSION_MINOR == 5
  WrapOracle<WrapKernel> oracle(options.gap, WrapKernel());
  oracle.add_triangle_soup(points, faces);
  CGAL::Alpha_wraps_3::internal::Alpha_wrap_3<WrapOracle<WrapKernel>> wrapping(oracle);
  wrapping(options.gap, options.offset, mesh, CGAL::parameters::visitor(visitor));
#else
  CGAL::alpha_wrap_3(points, faces, options.gap, options.offset, mesh,
                     CGAL::parameters::default_values(), CGAL::parameters::visitor(visitor));
#endif

  Surface result = surface_of_cgal(mesh);
  monitor.report("wrap", 1);
  return result;
}

}  // namespace curveskel
