// The surface of a file, coloured by the branches of its skeleton.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include <curveskel/advanced/names.hpp>
#include <curveskel/curve_skeleton.hpp>
#include <curveskel/read.hpp>
#include <curveskel/repair.hpp>

namespace curveskel {

enum class LabelledFormat { ply, vtp, glb };

inline constexpr NameTable<LabelledFormat, 3> labelled_formats{{
    {LabelledFormat::ply, "ply", "PLY: branch and colour of each vertex and each face"},
    {LabelledFormat::vtp, "vtp", "VTK XML PolyData: branch as point data and as cell data"},
    {LabelledFormat::glb, "glb", "glTF 2.0: COLOR_0 and _BRANCH of each vertex"},
}};

/// sRGB, each 0..255, of equal lightness; branches with near numbers differ clearly. Grey for -1.
/// (B. Ottosson, A perceptual color space for image processing, 2020)
[[nodiscard]] std::array<std::uint8_t, 3> branch_colour(int branch);

/// Numbers of branches, -1 = of none, by the vertices and polygons of a file.
struct BranchLabels {
  Eigen::VectorXi of_vertex;
  Eigen::VectorXi of_polygon;
};
/// `skeleton` is of `repaired.surface`, which was made of `soup`; see `branch_territories`.
[[nodiscard]] BranchLabels labels_of_input(const PolygonSoup& soup, const RepairedSurface& repaired,
                                           const CurveSkeleton& skeleton);

/// The bytes of the file: vertices and polygons as given, in order, with the number of the branch
/// (-1 = of none) and its colour; GLB has triangles and single precision. Precondition: one label
/// for each vertex, one for each polygon. Line ends in `provenance` become blanks; it may be
/// empty. O(#V + corners).
[[nodiscard]] std::string format_labelled_surface(const PolygonSoup& soup,
                                                  const BranchLabels& labels, LabelledFormat format,
                                                  std::string_view provenance = {});

}  // namespace curveskel
