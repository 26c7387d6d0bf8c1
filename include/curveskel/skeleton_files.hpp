// Skeleton files, in and out.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <curveskel/advanced/names.hpp>
#include <curveskel/branch_measures.hpp>
#include <curveskel/branch_profiles.hpp>
#include <curveskel/branch_territories.hpp>
#include <curveskel/curve_skeleton.hpp>

namespace curveskel {

enum class SkeletonFormat { obj, ply, cgal, swc, vtp, csv, graphml, json, svg, png };

inline constexpr NameTable<SkeletonFormat, 10> skeleton_formats{{
    {SkeletonFormat::obj, "obj", "Wavefront OBJ: v, two-vertex l"},
    {SkeletonFormat::ply, "ply", "PLY: vertex (radius, life) and edge elements"},
    {SkeletonFormat::cgal, "cgal", "CGAL polylines, one branch a line"},
    {SkeletonFormat::swc, "swc", "SWC neuron tree; loops are cut, the cuts are comments"},
    {SkeletonFormat::vtp, "vtp", "VTK XML PolyData, radius and life as point data"},
    {SkeletonFormat::csv, "csv",
     "table of branches: ends, kind, length, bends, radii, area, volume"},
    {SkeletonFormat::graphml, "graphml",
     "GraphML: x, y, z, radius, life per node, length per edge"},
    {SkeletonFormat::json, "json", "nodes, edges, radii, vertex map, parameters, certificate"},
    {SkeletonFormat::svg, "svg", "picture: the skeleton inside its surface"},
    {SkeletonFormat::png, "png", "picture: the skeleton inside its surface"},
}};

/// Content of a skeleton file beside the graph. JSON takes the whole, SVG and PNG need the
/// surface, the others use the provenance line as a comment where the format has comments.
struct SkeletonContext {
  const Surface* surface = nullptr;  ///< for pictures
  std::string provenance;            ///< "curveskel 0.1.0, model.obj"; line ends become blanks
  /// A JSON object (parameters, certificate, ...) or empty. Its members become members of the JSON
  /// file, beside "format", "version", "provenance", "nodes", "edges", "radii",
  /// "node_of_vertex" and "root", which it must not have.
  std::string report_json;
  /// A node from which a tree grows, -1 = none was chosen: SWC takes it as the root of its
  /// component, which comes first; JSON has it as "root".
  int root = -1;
  const BranchTerritories* territories = nullptr;  ///< for areas and volumes in CSV
  Eigen::Vector3d up = Eigen::Vector3d::Zero();    ///< for pictures: as of `best_views`
};

/// The text or bytes of the file; give them to `write_file`. Numbers are written so that reading
/// them gives the same doubles, in one way only: the same skeleton gives the same bytes. Nodes keep
/// their numbers (from 0; OBJ from 1; SWC in an order of its own). docs/formats.md has the details.
/// Precondition: finite coordinates and radii, edges as described at Edges.
/// Throws Error(Fault::output) when the format needs what the context lacks, or the root is no
/// node; Error(Fault::input) for territories of another number of branches, and for places in
/// pictures that are not finite. O(#N log #N + #E), for pictures also O(#F + pixels).
[[nodiscard]] std::string format_skeleton(const CurveSkeleton& skeleton, SkeletonFormat format,
                                          const SkeletonContext& context);

/// CSV: a row for each section, an empty field where there is no number. docs/numbers.md has the
/// columns.
[[nodiscard]] std::string format_profiles(const std::vector<BranchSection>& sections);

/// CSV: a row for each junction, several branches or angles in one field with spaces between.
[[nodiscard]] std::string format_junctions(const CurveSkeleton& skeleton);

/// Reads OBJ, PLY (all encodings), CGAL polylines, SWC, VTP (all of VTK's encodings), GraphML and
/// JSON (this program's, or a node-link graph), gzipped or not, whoever wrote them. Coincident
/// points (equal coordinates) become one node, save in GraphML and JSON, whose nodes have names; a
/// chain of several points becomes as many edges less one. `radii` is empty where the file has
/// none, and so are `lives`; `node_of_vertex` comes from JSON only.
/// Throws Error(Fault::input) that names the file, the line or element, and what is wrong there.
/// Time and memory linear in the file's size, times a logarithm for the joining.
[[nodiscard]] CurveSkeleton read_skeleton(const std::filesystem::path& path);

/// The same with the node that a JSON file names as its "root"; -1 where it names none of its own.
struct RootedSkeleton {
  CurveSkeleton skeleton;
  int root = -1;
};
[[nodiscard]] RootedSkeleton read_rooted_skeleton(const std::filesystem::path& path);

}  // namespace curveskel
