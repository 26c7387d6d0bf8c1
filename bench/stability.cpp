// The effect of noise, decimation and subdivision on a skeleton: it should be small.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/subdivision_method_3.h>
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <exception>
#include <filesystem>
#include <iostream>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <curveskel/advanced/coarsen.hpp>
#include <curveskel/advanced/graph.hpp>
#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/measures.hpp>
#include <curveskel/advanced/tree.hpp>
#include <curveskel/certificate.hpp>
#include <curveskel/curve_skeleton.hpp>
#include <curveskel/extract_repaired.hpp>
#include <curveskel/lives.hpp>
#include <curveskel/read.hpp>
#include <curveskel/repair.hpp>
#include <curveskel/topology.hpp>
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

/// The distance between two junctions at the ends of a branch over the sum of their radii.
double merge_of(const CurveSkeleton& skeleton, int a, int b) {
  return (skeleton.nodes.row(a) - skeleton.nodes.row(b)).norm() /
         (skeleton.radii[a] + skeleton.radii[b]);
}

/// Junctions, with those as one whose balls overlap and that a branch joins. Two skeletons are the
/// same but for such branches if each has no fewer junctions than the other has so.
int junctions_modulo_balls(const CurveSkeleton& skeleton) {
  const std::vector<int> degree = degrees(skeleton.nodes.rows(), skeleton.edges);
  const auto is_junction = [&](int node) { return degree[idx(node)] >= 3; };
  UnionFind one(skeleton.nodes.rows());
  int junctions = graph_topology(skeleton).junctions;
  for (const Branch& branch : branches(skeleton)) {
    const int a = branch.nodes.front();
    const int b = branch.nodes.back();
    if (!is_junction(a) || !is_junction(b) || one.root(a) == one.root(b)) continue;
    if (merge_of(skeleton, a, b) >= 1) continue;
    one.unite(a, b);
    --junctions;
  }
  return junctions;
}

Positions tips_of(const CurveSkeleton& skeleton) {
  const std::vector<int> degree = degrees(skeleton.nodes.rows(), skeleton.edges);
  std::vector<int> tips;
  for (int node = 0; node < skeleton.nodes.rows(); ++node) {
    if (degree[idx(node)] == 1) tips.push_back(node);
  }
  return skeleton.nodes(tips, Eigen::all);
}

/// True if there are as many, and each has one of the others near it.
bool same_tips(const Positions& a, const Positions& b, double near) {
  if (a.rows() != b.rows()) return false;
  const auto has_near = [near](const Positions& all, const Eigen::RowVector3d& tip) {
    return (all.rowwise() - tip).rowwise().norm().minCoeff() < near;
  };
  for (Eigen::Index k = 0; k < a.rows(); ++k) {
    if (!has_near(b, a.row(k)) || !has_near(a, b.row(k))) return false;
  }
  return true;
}

/// Of the tips, descending.
std::vector<double> log_lives(const CurveSkeleton& skeleton) {
  std::vector<double> logs;
  if (skeleton.lives.size() == 0) return logs;
  const std::vector<int> degree = degrees(skeleton.nodes.rows(), skeleton.edges);
  for (int node = 0; node < skeleton.nodes.rows(); ++node) {
    if (degree[idx(node)] != 1 || !(skeleton.lives[node] > 0)) continue;
    logs.push_back(std::log(skeleton.lives[node]));
  }
  std::sort(logs.rbegin(), logs.rend());
  return logs;
}

/// Of the tips that the surface has, drawn or not; each component by itself, of 8,000 vertices.
std::vector<double> log_lives(const Surface& surface) {
  std::vector<double> logs;
  for (const Component& component : split_components(surface, topology(surface))) {
    for (const TipLife& tip : tip_lives(coarsen(component.surface, {}, {}).surface)) {
      if (tip.life > 0) logs.push_back(std::log(tip.life));
    }
  }
  std::sort(logs.rbegin(), logs.rend());
  return logs;
}

/// Bottleneck distance: the least that the largest difference of a pair can be, where a life may
/// also be paired with the limit below which lives are noise. On a line descending order is best.
double bottleneck(std::vector<double> a, std::vector<double> b, double least_life) {
  const double least = std::log(least_life);
  const std::size_t most = std::max(a.size(), b.size());
  a.resize(most, least);
  b.resize(most, least);
  double largest = 0;
  for (std::size_t k = 0; k < most; ++k) {
    largest = std::max(largest, std::abs(std::max(a[k], least) - std::max(b[k], least)));
  }
  return largest;
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  return values[std::min(values.size() - 1,
                         static_cast<std::size_t>(share * static_cast<double>(values.size())))];
}

struct Tally {
  int same_graph = 0;
  int same_but_for_balls = 0;
  int same_tips = 0;
  int near = 0;
  int near_in_the_mean = 0;
  int all = 0;
  /// Bottleneck distances of the lives' logarithms: of the surfaces, where lives of less than .5,
  /// or of .8, count as noise, and of the tips that are drawn.
  std::vector<double> apart_above_half;
  std::vector<double> apart;
  std::vector<double> drawn_apart;
};

enum class Program { curveskel, cgal };

CurveSkeleton skeleton_of(const Surface& surface, Program program) {
  if (program == Program::cgal) {
    CurveSkeleton skeleton = cgal_skeleton(surface);
    const SurfaceTree tree(surface);
    skeleton.radii.resize(skeleton.nodes.rows());
    for (Eigen::Index node = 0; node < skeleton.nodes.rows(); ++node) {
      skeleton.radii[node] = tree.nearest(skeleton.nodes.row(node).transpose()).distance;
    }
    return skeleton;
  }
  RepairedSurface whole;
  whole.surface = surface;
  whole.vertex_of_input.setLinSpaced(surface.positions.rows(), 0,
                                     static_cast<int>(surface.positions.rows()) - 1);
  return extract_repaired(whole, {}, {}, {}).extraction.skeleton;
}

/// A surface before it changes.
struct Base {
  Surface surface;
  double diagonal;
  CurveSkeleton skeleton;
  std::vector<double> log_lives;  ///< of the surface
};

Base base_of(const std::filesystem::path& file, Program program) {
  Base base;
  base.surface = repair(read_polygons(file, {}), {}, {}).surface;
  base.diagonal = bounding_box_diagonal(base.surface.positions);
  base.skeleton = skeleton_of(base.surface, program);
  if (program == Program::curveskel) base.log_lives = log_lives(base.surface);
  return base;
}

std::string cell(const Base& base, const Surface& changed, Program program, Tally& tally) {
  ++tally.all;
  CurveSkeleton found;
  try {
    found = skeleton_of(changed, program);
  } catch (const std::exception&) {
    return " none | |";
  }
  const double spacing = base.diagonal / 400;
  const double distance = hausdorff_distance(base.skeleton, found, spacing) / base.diagonal;
  const double mean = mean_distance(base.skeleton, found, spacing) / base.diagonal;
  const GraphTopology was = graph_topology(base.skeleton);
  const GraphTopology is = graph_topology(found);
  tally.same_graph += is.tips == was.tips && is.junctions == was.junctions ? 1 : 0;
  const bool same_but_for_balls = is.tips == was.tips &&
                                  junctions_modulo_balls(found) <= was.junctions &&
                                  junctions_modulo_balls(base.skeleton) <= is.junctions;
  tally.same_but_for_balls += same_but_for_balls ? 1 : 0;
  tally.same_tips +=
      same_tips(tips_of(base.skeleton), tips_of(found), 0.03 * base.diagonal) ? 1 : 0;
  if (program == Program::curveskel) {
    const std::vector<double> lives = log_lives(changed);
    tally.apart_above_half.push_back(bottleneck(base.log_lives, lives, 0.5));
    tally.apart.push_back(bottleneck(base.log_lives, lives, 0.8));
    tally.drawn_apart.push_back(bottleneck(log_lives(base.skeleton), log_lives(found), 0.8));
  }
  tally.near += distance < 0.01 ? 1 : 0;
  tally.near_in_the_mean += mean < 0.01 ? 1 : 0;
  return fmt::format(" {}, {} | {:.4f}, {:.1f} |", is.tips, is.junctions, distance, 1000 * mean);
}

std::string in_words(const Tally& tally, Program program) {
  std::string text = fmt::format(
      "Same tips and junctions in {} of {}; in {}, if some whose balls overlap count as one; all "
      "tips within 3 % in {}; moved by less than 1 % in {}, in the mean in {}.",
      tally.same_graph, tally.all, tally.same_but_for_balls, tally.same_tips, tally.near,
      tally.near_in_the_mean);
  if (program == Program::cgal) return text;
  const auto in_numbers = [](const std::vector<double>& distances) {
    return fmt::format("{:.3f}, {:.3f}", quantile(distances, 0.5), quantile(distances, 0.9));
  };
  return text + fmt::format(
                    " Bottleneck distance of the logarithms of the surfaces' lives, median and "
                    "nine of ten below: {} over 0.5, {} over 0.8; of those drawn {} over 0.8.",
                    in_numbers(tally.apart_above_half), in_numbers(tally.apart),
                    in_numbers(tally.drawn_apart));
}

/// Counts for each amount of noise, a row each.
void print_noise_curve(const std::vector<std::filesystem::path>& files, Program program) {
  std::cout
      << "| noise, % D | same graph | modulo overlapping balls | tips within 3 % | < 1 % | mean "
         "< 1 % | of |\n|---|---|---|---|---|---|---|\n";
  std::vector<Base> bases;
  for (const auto& file : files) bases.push_back(base_of(file, program));
  for (const double percent : {1e-6, 1e-3, 0.1, 0.2, 0.5, 1.0}) {
    Tally tally;
    for (const Base& base : bases) {
      (void)cell(base, with_noise(base.surface, percent / 100 * base.diagonal), program, tally);
    }
    std::cout << fmt::format("| {:g} | {} | {} | {} | {} | {} | {} |\n", percent, tally.same_graph,
                             tally.same_but_for_balls, tally.same_tips, tally.near,
                             tally.near_in_the_mean, tally.all)
              << std::flush;
  }
}

int run(int argc, char** argv) {
  CLI::App app("How much a skeleton changes when its surface changes a little");
  std::vector<std::filesystem::path> files;
  app.add_option("files", files, "surfaces")->required();
  bool of_cgal = false;
  app.add_flag("--cgal", of_cgal, "CGAL's mean curvature flow skeletons instead");
  bool as_curve = false;
  app.add_flag("--noise", as_curve, "noise of 1e-6 to 1 % D alone, a row for each");
  CLI11_PARSE(app, argc, argv);
  const Program program = of_cgal ? Program::cgal : Program::curveskel;
  if (as_curve) {
    print_noise_curve(files, program);
    return 0;
  }
  std::cout << "| surface | tips, junctions | noise 0.2 % D | off by / D, mean / 0.001 D | half "
               "the vertices | off "
               "by | a quarter | off by | Loop subdivision | off by |\n"
               "|---|---|---|---|---|---|---|---|---|---|\n";
  Tally tally;
  for (const auto& file : files) {
    const Base base = base_of(file, program);
    const GraphTopology graph = graph_topology(base.skeleton);
    std::string row =
        fmt::format("| {} | {}, {} |", file.stem().string(), graph.tips, graph.junctions);
    row += cell(base, with_noise(base.surface, 0.002 * base.diagonal), program, tally);
    row += cell(base, decimated(base.surface, 2), program, tally);
    row += cell(base, decimated(base.surface, 4), program, tally);
    row += cell(base, loop_subdivided(base.surface), program, tally);
    std::cout << row << "\n" << std::flush;
  }
  std::cout << "\n" << in_words(tally, program) << "\n";
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
