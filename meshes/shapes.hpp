// Closed surfaces whose curve skeleton is known: the families that tests and benchmarks run over.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <curveskel/curve_skeleton.hpp>
#include <curveskel/surface.hpp>

namespace curveskel::shapes {

/// A surface and its known skeleton. Lengths in model units; deterministic on one machine.
struct Shape {
  std::string name;
  Surface surface;
  int genus = 0;  ///< summed over the components
  int components = 1;
  CurveSkeleton axis;  ///< the expected curve with the tube's radii; empty = no single right answer
  int tips = -1;       ///< expected, -1 = no single right answer
  int junctions = -1;  ///< expected, -1 = no single right answer
  int cycles = 0;      ///< expected; equals genus
};

// ---- Tubes swept along a curve ------------------------------------------------------------------

using Curve = std::function<Eigen::Vector3d(double t)>;  ///< t in [0, 1]; closed if ends coincide
using Profile = std::function<double(double t)>;         ///< radius at t, > 0

[[nodiscard]] Curve straight(double length);               ///< along x, centred at the origin
[[nodiscard]] Curve arc(double radius, double angle);      ///< circular, in the xy plane; radians
[[nodiscard]] Curve s_curve(double length, double width);  ///< one sine period, amplitude width / 2
[[nodiscard]] Curve helix(double radius, double pitch, double turns);  ///< round z
[[nodiscard]] Curve circle(double radius);                             ///< closed, xy plane
[[nodiscard]] Curve trefoil(double scale);  ///< closed knot, bounding radius 3 scale

[[nodiscard]] Profile constant(double radius);
[[nodiscard]] Profile tapered(double first, double last);  ///< linear
[[nodiscard]] Profile wavy(double radius, double amplitude, double waves);

/// `sides` vertices round each ring, rings as far apart as the vertices on them, hemispherical caps
/// at the ends of an open curve; frames by parallel transport. The caller keeps the radius of
/// curvature and the distance between windings above the tube's radius.
[[nodiscard]] Shape tube(std::string name, const Curve& curve, const Profile& radius, int sides);

/// Major radius R round z, minor radius r; `around` vertices on each small circle.
[[nodiscard]] Shape torus(double major_radius, double minor_radius, int around);

/// Two tori through each other's hole.
[[nodiscard]] Shape linked_rings(double major_radius, double minor_radius, int around);

// ---- Solids -------------------------------------------------------------------------------------

/// `cells` near-square cells along the longest edge, each cut into two triangles. No axis.
[[nodiscard]] Shape box(const Eigen::Vector3d& size, int cells);

/// Icosahedron subdivided `levels` times, pushed onto the ellipsoid with these half axes. No axis.
[[nodiscard]] Shape ellipsoid(const Eigen::Vector3d& half_axes, int levels);

/// Base circle of this radius at z = 0, apex at z = height with `neighbours` neighbours.
[[nodiscard]] Shape cone(double radius, double height, int neighbours);

/// A square plate of unit cubes with square holes, so many along each side and as wide as what is
/// left between two of them: genus holes_along^2. No axis.
[[nodiscard]] Shape sieve(int holes_along);

/// The algebraic surface (x (x - 1)^2 (x - 2) + y^2)^2 + z^2 = 0.01, genus 2. `spacing` = edges.
[[nodiscard]] Shape algebraic_double_torus(double spacing);

// ---- Tubes round a graph ------------------------------------------------------------------------

struct TubeUnionOptions {
  double blend = 0.25;      ///< how far branches melt together, in units of the smallest radius
  double resolution = 2.5;  ///< vertices per smallest radius
};

/// The level set of a smooth union of tubes round the graph's edges; radii (#nodes) vary linearly
/// along each edge. One closed surface per component of the graph, genus = its cycle rank.
/// Throws Error(Fault::input) when tubes touch that share no node, so that the genus is another.
[[nodiscard]] Shape tube_union(std::string name, const CurveSkeleton& graph,
                               const TubeUnionOptions& options = {});

/// `arms` edges of this length from one node; 2 and 4 arms lie in a plane, others spread over the
/// sphere. 3 arms lie in a plane as well: a Y.
[[nodiscard]] CurveSkeleton star(int arms, double length, double radius);
[[nodiscard]] CurveSkeleton letter_h(double height, double width, double radius);
/// Two rails and rungs + 1 rungs: cycle rank `loops`.
[[nodiscard]] CurveSkeleton ladder(int loops, double width, double radius);
/// `loops` circles in a row, neighbours joined by a bar; 0 loops: one straight edge.
[[nodiscard]] CurveSkeleton ring_chain(int loops, double ring_radius, double radius);
/// Binary tree in space, every generation 0.75 as long and 0.8 as thick; 2^generations tips.
[[nodiscard]] CurveSkeleton tree(int generations, double length, double radius);
/// Connected, `nodes` nodes, cycle rank `loops`, straight edges well apart from each other (at
/// least four radii between edges that share no node, 75 degrees between those that do), degree at
/// most 4; radius between `radius` and 1.5 `radius`.
[[nodiscard]] CurveSkeleton random_graph(std::uint64_t seed, int nodes, int loops, double radius);

/// One of the parts that assets are made of, each about as long as `size`, turned as it likes.
enum class PartKind : std::uint8_t { box, ball, rod, sheet, ribbon };  // ribbons: 24 flat cells
struct AssortedPart {
  PartKind kind = PartKind::box;
  double size = 1;       ///< its longest extent
  double thickness = 1;  ///< its shortest
  Shape shape;
};
/// So many parts that touch nowhere, of sizes from 1 / 100 to 1 of the largest and thicknesses from
/// 1 / 300 of the size up, on a jittered grid.
[[nodiscard]] std::vector<AssortedPart> assorted_parts(int count, std::uint64_t seed);

/// The tubes round a random graph of 9 to 13 nodes and 0 to 3 loops; "random-seed-N".
[[nodiscard]] Shape random_tubes(int seed);

// ---- Changes that must not matter, or little ----------------------------------------------------

[[nodiscard]] Shape scaled(Shape shape, double factor);
[[nodiscard]] Shape translated(Shape shape, const Eigen::Vector3d& offset);
/// By `angle` radians round `direction`.
[[nodiscard]] Shape rotated(Shape shape, const Eigen::Vector3d& direction, double angle);
/// Vertices, faces and the first corner of each face permuted.
[[nodiscard]] Shape renumbered(Shape shape, std::uint64_t seed);
/// Each vertex moved along its normal by a normal deviate times `sigma` (model units).
[[nodiscard]] Shape noisy(Shape shape, double sigma, std::uint64_t seed);
/// Each triangle cut into four at its edges' midpoints.
[[nodiscard]] Shape subdivided(Shape shape);
/// Rolled round the y axis: what lies at height z over x goes to the angle x / `radius` on the
/// circle of radius `radius` + z. The caller keeps x within a turn and z above -`radius`. No axis.
[[nodiscard]] Shape rolled(Shape shape, double radius);
/// All shapes in one surface, which the caller has kept apart.
[[nodiscard]] Shape together(std::string name, const std::vector<Shape>& parts);

// ---- By name ------------------------------------------------------------------------------------

struct CatalogueEntry {
  std::string_view name;
  std::string_view meaning;
  std::function<Shape()> make;
};
/// One or more members of every family, a few thousand vertices each.
[[nodiscard]] const std::vector<CatalogueEntry>& catalogue();

/// Writes OBJ, OFF or ASCII PLY by the extension, numbers with `digits` significant digits (0: as
/// many as give the same double back). Throws Error(Fault::output).
void write_surface(const Surface& surface, const std::filesystem::path& file, int digits = 0);

}  // namespace curveskel::shapes
