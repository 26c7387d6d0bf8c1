// The effect of noise, decimation and subdivision on a skeleton: it should be small.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/subdivision_method_3.h>
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <exception>
#include <filesystem>
#include <iostream>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <curveskel/advanced/coarsen.hpp>
#include <curveskel/advanced/measures.hpp>
#include <curveskel/certificate.hpp>
#include <curveskel/curve_skeleton.hpp>
#include <curveskel/extract_repaired.hpp>
#include <curveskel/read.hpp>
#include <curveskel/repair.hpp>
#include "bench/cgal_skeleton.hpp"

namespace curveskel::bench {
namespace {

/// Each vertex moved along its normal by a normal deviate; the same numbers everywhere.
Surface with_noise(const Surface& given, double sigma) {
  Surface result = given;
  const Positions normals = vertex_normals(given);
  std::mt19937_64 random(1);
  for (Eigen::Index v = 0; v < given.positions.rows(); ++v) {
    const double u = (double(random() >> 11U) + 0.5) / 9007199254740992.0;
    const double w = double(random() >> 11U) / 9007199254740992.0;
    const double deviate = std::sqrt(-2 * std::log(u)) * std::cos(2 * std::numbers::pi * w);
    result.positions.row(v) += sigma * deviate * normals.row(v);
  }
  return result;
}

Surface decimated(const Surface& given, int share) {
  CoarsenOptions options;
  options.target_vertices = static_cast<int>(given.positions.rows() / share);
  return coarsen(given, options, {}).surface;
}

Surface loop_subdivided(const Surface& given) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  CGAL::Surface_mesh<Kernel::Point_3> mesh;
  using Vertex = CGAL::Surface_mesh<Kernel::Point_3>::Vertex_index;
  for (const auto& p : given.positions.rowwise()) mesh.add_vertex({p.x(), p.y(), p.z()});
  for (const auto& t : given.triangles.rowwise()) {
    mesh.add_face(Vertex(std::uint32_t(t(0))), Vertex(std::uint32_t(t(1))),
                  Vertex(std::uint32_t(t(2))));
  }
  CGAL::Subdivision_method_3::Loop_subdivision(mesh, CGAL::parameters::number_of_iterations(1));
  Surface result;
  result.positions.resize(mesh.number_of_vertices(), 3);
  result.triangles.resize(mesh.number_of_faces(), 3);
  for (const auto v : mesh.vertices()) {
    const auto& p = mesh.point(v);
    result.positions.row(v.idx()) << p.x(), p.y(), p.z();
  }
  Eigen::Index row = 0;
  for (const auto f : mesh.faces()) {
    int k = 0;
    for (const auto v : CGAL::vertices_around_face(mesh.halfedge(f), mesh)) {
      result.triangles(row, k++) = static_cast<std::int32_t>(v.idx());
    }
    ++row;
  }
  return result;
}

struct Tally {
  int same_graph = 0;
  int near = 0;
  int near_in_the_mean = 0;
  int all = 0;
};

enum class Program { curveskel, cgal };

CurveSkeleton skeleton_of(const Surface& surface, Program program) {
  if (program == Program::cgal) return cgal_skeleton(surface);
  RepairedSurface whole{surface, {}, {}, {}, {}};
  whole.vertex_of_input.setLinSpaced(surface.positions.rows(), 0,
                                     static_cast<int>(surface.positions.rows()) - 1);
  return extract_repaired(whole, {}, {}, {}).extraction.skeleton;
}

std::string cell(const CurveSkeleton& base, const Surface& changed, double diagonal,
                 Program program, Tally& tally) {
  ++tally.all;
  CurveSkeleton found;
  try {
    found = skeleton_of(changed, program);
  } catch (const std::exception&) {
    return " none | |";
  }
  const double spacing = diagonal / 400;
  const double distance = hausdorff_distance(base, found, spacing) / diagonal;
  const double mean = mean_distance(base, found, spacing) / diagonal;
  const GraphTopology was = graph_topology(base);
  const GraphTopology is = graph_topology(found);
  tally.same_graph += is.tips == was.tips && is.junctions == was.junctions ? 1 : 0;
  tally.near += distance < 0.01 ? 1 : 0;
  tally.near_in_the_mean += mean < 0.01 ? 1 : 0;
  return fmt::format(" {}, {} | {:.4f}, {:.1f} |", is.tips, is.junctions, distance, 1000 * mean);
}

int run(int argc, char** argv) {
  CLI::App app("How much a skeleton changes when its surface changes a little");
  std::vector<std::filesystem::path> files;
  app.add_option("files", files, "surfaces")->required();
  bool of_cgal = false;
  app.add_flag("--cgal", of_cgal, "CGAL's mean curvature flow skeletons instead");
  CLI11_PARSE(app, argc, argv);
  const Program program = of_cgal ? Program::cgal : Program::curveskel;
  std::cout << "| surface | tips, junctions | noise 0.2 % D | off by / D, mean / 0.001 D | half "
               "the vertices | off "
               "by | a quarter | off by | Loop subdivision | off by |\n"
               "|---|---|---|---|---|---|---|---|---|---|\n";
  Tally tally;
  for (const auto& file : files) {
    const Surface surface = repair(read_polygons(file, {}), {}, {}).surface;
    const double diagonal = bounding_box_diagonal(surface.positions);
    const CurveSkeleton base = skeleton_of(surface, program);
    const GraphTopology graph = graph_topology(base);
    std::string row =
        fmt::format("| {} | {}, {} |", file.stem().string(), graph.tips, graph.junctions);
    row += cell(base, with_noise(surface, 0.002 * diagonal), diagonal, program, tally);
    row += cell(base, decimated(surface, 2), diagonal, program, tally);
    row += cell(base, decimated(surface, 4), diagonal, program, tally);
    row += cell(base, loop_subdivided(surface), diagonal, program, tally);
    std::cout << row << "\n" << std::flush;
  }
  std::cout << fmt::format(
      "\nSame tips and junctions in {} of {}, moved by less than 1 % in {}, in the "
      "mean in {}.\n",
      tally.same_graph, tally.all, tally.near, tally.near_in_the_mean);
  return 0;
}

}  // namespace
}  // namespace curveskel::bench

int main(int argc, char** argv) {
  try {
    return curveskel::bench::run(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
