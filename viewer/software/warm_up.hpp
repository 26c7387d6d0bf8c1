// The driver's work for the first picture, done before there is one.
#pragma once

#include "viewer/render/renderer.hpp"
#include "viewer/software/pace.hpp"

namespace curveskel::viewer {

/// Draws a ball with a skeleton as pictures usually are drawn, so that shaders are compiled, and
/// tells the pace how long it takes then. Leaves the renderer empty.
void warm_up(Renderer& renderer, Pace& pace);

}  // namespace curveskel::viewer
