// The viewer, a program of its own, so that this one needs no OpenGL.
#pragma once

#include <filesystem>
#include <string>

#include <curveskel/curve_skeleton.hpp>
#include <curveskel/surface.hpp>
#include "app/interruption.hpp"

namespace curveskel {

/// The path of the installed viewer: beside this program.
[[nodiscard]] std::filesystem::path viewer_program();

/// A picture as the viewer draws it, or why there is none.
struct ViewerPicture {
  std::string png;     ///< empty = it could not be drawn
  std::string reason;  ///< then: the viewer's message
};
/// The surface with the skeleton in it, from two sides, 1600 x 1200 pixels; both go through files
/// in a temporary folder. Throws Cancelled; the viewer is stopped then. Precondition:
/// viewer_program() exists.
[[nodiscard]] ViewerPicture picture_by_viewer(const Surface& surface, const CurveSkeleton& skeleton,
                                              const Interruption& interruption);

}  // namespace curveskel
