// The surface that skeletons are judged against.
#pragma once

#include <memory>

#include <curveskel/advanced/tree.hpp>
#include <curveskel/certificate.hpp>
#include <curveskel/repair.hpp>
#include "viewer/model/document.hpp"

namespace curveskel::viewer {

struct Ground {
  std::shared_ptr<const RepairedSurface> repaired;
  SurfaceTree tree;
  double diagonal = 0;  ///< D
  int components = 0;
  int genus = 0;
};

/// The document's surface, repaired, or `known` unless that is null. Precondition: it has one.
[[nodiscard]] std::shared_ptr<const RepairedSurface> repaired_of(
    const Document& document, std::shared_ptr<const RepairedSurface> known,
    const RepairOptions& options, const Monitor& monitor);

/// `known` itself if it is of this surface. Else O(#F log #F).
[[nodiscard]] std::shared_ptr<const Ground> ground_of(
    std::shared_ptr<const RepairedSurface> repaired, const Monitor& monitor,
    std::shared_ptr<const Ground> known = nullptr);

/// That of the skeleton, with what repair says about the surface.
[[nodiscard]] Certificate certificate_of(const Ground& ground, const CurveSkeleton& skeleton,
                                         const CertificateOptions& options, const Monitor& monitor);

}  // namespace curveskel::viewer
