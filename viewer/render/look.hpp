// The look of the scene, as a person can choose it.
#pragma once

#include <glm/glm.hpp>

#include <curveskel/advanced/names.hpp>
#include "viewer/render/colours.hpp"

namespace curveskel::viewer {

enum class SurfaceStyle { transparent, opaque, wireframe, hidden };

inline constexpr NameTable<SurfaceStyle, 4> surface_styles{{
    {SurfaceStyle::transparent, "transparent", "like glass, the skeleton in it"},
    {SurfaceStyle::opaque, "opaque", "the skeleton shows through if it is told to"},
    {SurfaceStyle::wireframe, "wireframe", "the edges only"},
    {SurfaceStyle::hidden, "hidden", "the skeleton alone"},
}};

enum class SkeletonStyle { tubes, lines, balls, hidden };

inline constexpr NameTable<SkeletonStyle, 4> skeleton_styles{{
    {SkeletonStyle::tubes, "tubes", "of one thickness, the nearer the wider"},
    {SkeletonStyle::lines, "lines", "of the same width everywhere"},
    {SkeletonStyle::balls, "balls", "as thick as the surface is there: the inscribed balls"},
    {SkeletonStyle::hidden, "hidden", "the surface alone"},
}};

enum class ColourBy { file, plain, component, node, branch, radius, weight, role, part };

inline constexpr NameTable<ColourBy, 9> colourings{{
    {ColourBy::file, "file", "the materials and pictures of the file; without any, one colour"},
    {ColourBy::plain, "plain", "one colour"},
    {ColourBy::component, "component", "connected parts"},
    {ColourBy::node, "node", "which part of the surface collapsed to which node"},
    {ColourBy::branch, "branch", "chains between junctions and tips"},
    {ColourBy::radius, "radius", "inscribed radius at the node, in model units"},
    {ColourBy::weight, "weight", "of a rig: what the chosen joint moves, or all of them mixed"},
    {ColourBy::role, "role", "of a rig: what its joints are, left ones lighter"},
    {ColourBy::part, "part", "of a rig: the body, and the parts that follow it"},
}};

enum class Theme { light, dark };

inline constexpr NameTable<Theme, 2> themes{{
    {Theme::light, "light", "dark on light"},
    {Theme::dark, "dark", "light on dark"},
}};

struct Look {
  SurfaceStyle surface = SurfaceStyle::transparent;
  SkeletonStyle skeleton = SkeletonStyle::tubes;
  ColourBy surface_colour = ColourBy::file;
  ColourBy skeleton_colour = ColourBy::plain;
  ColourMap map = ColourMap::viridis;
  Theme theme = Theme::light;
  bool edges = false;                   ///< the surface's edges over its faces
  bool joints = true;                   ///< tips and junctions as balls
  bool bones = true;                    ///< of a rig
  bool through = true;                  ///< the skeleton shows through an opaque surface
  bool transparent_background = false;  ///< for screenshots
  float opacity = 0.5F;                 ///< of the transparent surface, 0..1
  float thickness = 1;                  ///< of tubes and lines; 1 = as fits the picture

  bool operator==(const Look&) const = default;
};

/// Everything that a theme decides.
struct Palette {
  glm::vec3 upper;    ///< background, top
  glm::vec3 lower;    ///< background, bottom
  glm::vec3 surface;  ///< plain
  glm::vec3 inside;   ///< factor on faces seen from inside
  glm::vec3 body;     ///< what a transparent surface takes on in depth
  glm::vec3 wire;
  glm::vec3 skeleton;  ///< plain
  glm::vec3 joint;     ///< tips and junctions
  glm::vec3 bone;
  glm::vec3 bone_joint;
  glm::vec3 casing;  ///< round the skeleton
  glm::vec3 contracted;
};
[[nodiscard]] Palette palette_of(Theme theme);

}  // namespace curveskel::viewer
