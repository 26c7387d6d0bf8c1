// Pictures without a window.
#pragma once

#include <string>

#include "app/verbs/verbs.hpp"
#include "viewer/render/scene.hpp"
#include "viewer/view_options.hpp"

namespace curveskel::viewer {

/// The bytes of a PNG of the scene; drawn four times as large and averaged, so edges are smooth.
/// Needs a current context. `camera` is fitted already.
[[nodiscard]] std::string screenshot(Scene& scene, Renderer& renderer, int width, int height);

/// The same from two sides at one scale, without perspective: the views of `best_views`, side by
/// side or one above the other. Precondition: the document has triangles.
[[nodiscard]] std::string screenshot_of_two_sides(Scene& scene, Renderer& renderer, int width,
                                                  int height);

/// The scene's camera as the options wish, fitted to the picture.
void place_camera(Scene& scene, const ViewOptions& options);

/// Opens the files, runs the pipeline up to the stage wished for, and writes the pictures; says
/// which, a line each. Throws UsageError for options that need a rig where there will be none;
/// Error for files, stages that never come, and, before it runs anything, where there is no OpenGL
/// or none for pictures as large; Cancelled on a stop, pictures that were written before stay.
[[nodiscard]] std::string write_pictures(const ViewOptions& options, Session& session);

}  // namespace curveskel::viewer
