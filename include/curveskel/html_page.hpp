// One self-contained page of a skeleton in its surface: to turn, with tables, plots, certificate.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include <curveskel/curve_skeleton.hpp>
#include <curveskel/skeleton_files.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

struct PageContent {
  std::string title;
  std::string certificate;  ///< in words
  std::string failures;     ///< of the certificate; empty if it holds
  std::string provenance;   ///< program, file, what was changed; lines
  /// As in ProfileOptions.
  std::vector<std::vector<std::int32_t>> rims = {};
  Eigen::Vector3d up = Eigen::Vector3d::Zero();  ///< as of `best_views`
};

/// HTML, without anything from elsewhere: browsers with WebGL 2 show the shape, all others the
/// tables. `skeleton` is of `surface`, with its vertex map. A surface of more than 60,000 vertices
/// is shown with as many. O(#V + #F + sections).
[[nodiscard]] std::string html_page(const Surface& surface, const CurveSkeleton& skeleton,
                                    const PageContent& content, int threads);

}  // namespace curveskel
