// What a driver does at the first picture, done before there is one.
#pragma once

#include "viewer/pace.hpp"
#include "viewer/renderer.hpp"

namespace curveskel::viewer {

/// Draws a ball with a skeleton as pictures usually are drawn, so that shaders are compiled, and
/// tells the pace how long it takes then. Leaves the renderer empty.
void warm_up(Renderer& renderer, Pace& pace);

}  // namespace curveskel::viewer
