// Random graphs of tubes, back from their surfaces: which tips, junctions and places come out
// otherwise than the graph has them. A row for each seed that fails, then the counts.
// usage: random_graphs [--first N] [--last N] [--write FOLDER]
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <string>

#include <curveskel/advanced/measures.hpp>
#include <curveskel/certificate.hpp>
#include <curveskel/extract.hpp>
#include "meshes/shapes.hpp"

namespace {

using namespace curveskel;
using shapes::Shape;

struct Failures {
  int tips = 0;
  int junctions = 0;
  int cycles = 0;
  int far = 0;
  int outside = 0;
  int spurs = 0;
};

double furthest_node(const CurveSkeleton& skeleton, const CurveSkeleton& axis) {
  double furthest = 0;
  for (Eigen::Index i = 0; i < skeleton.nodes.rows(); ++i) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& edge : axis.edges.rowwise()) {
      const Eigen::RowVector3d from = axis.nodes.row(edge(0));
      const Eigen::RowVector3d along = axis.nodes.row(edge(1)) - from;
      const Eigen::RowVector3d p = skeleton.nodes.row(i) - from;
      const double t = std::clamp(p.dot(along) / along.squaredNorm(), 0.0, 1.0);
      nearest = std::min(nearest, (p - t * along).norm());
    }
    furthest = std::max(furthest, nearest);
  }
  return furthest;
}

void measure(int seed, const std::string& folder, Failures& failures) {
  const Shape shape = shapes::random_tubes(seed);
  const Extraction found = extract(shape.surface, {}, {});
  const GraphTopology graph = graph_topology(found.skeleton);
  const double far =
      furthest_node(found.skeleton, shape.axis) / bounding_box_diagonal(shape.surface.positions);
  const Certificate& certificate = found.certificate;
  const bool right = graph.tips == shape.tips && graph.junctions == shape.junctions &&
                     graph.cycle_rank == shape.cycles && far < 0.02 &&
                     certificate.topology_correct() && certificate.inside_fraction == 1 &&
                     certificate.spurs == 0;
  failures.tips += graph.tips != shape.tips ? 1 : 0;
  failures.junctions += graph.junctions != shape.junctions ? 1 : 0;
  failures.cycles += graph.cycle_rank != shape.cycles || !certificate.topology_correct() ? 1 : 0;
  failures.far += far < 0.02 ? 0 : 1;
  failures.outside += certificate.inside_fraction < 1 ? 1 : 0;
  failures.spurs += certificate.spurs > 0 ? 1 : 0;
  if (right) return;
  std::printf("| %d | %d (%d) | %d (%d) | %d (%d) | %.4f | %.4f | %d |\n", seed, graph.tips,
              shape.tips, graph.junctions, shape.junctions, graph.cycle_rank, shape.cycles, far,
              certificate.inside_fraction, certificate.spurs);
  std::fflush(stdout);
  if (folder.empty()) return;
  shapes::write_surface(shape.surface,
                        std::filesystem::path(folder) / (std::to_string(seed) + ".off"));
}

}  // namespace

int main(int count, char** values) {
  int first = 1;
  int last = 200;
  std::string folder;
  CLI::App program("Skeletons of random graphs of tubes against the graphs");
  program.add_option("--first", first, "seed");
  program.add_option("--last", last, "seed");
  program.add_option("--write", folder, "surfaces that fail, as FOLDER/SEED.off");
  CLI11_PARSE(program, count, values);
  std::printf(
      "| seed | tips (of the graph) | junctions | cycles | furthest node / D | inside | "
      "spurs |\n|---|---|---|---|---|---|---|\n");
  Failures failures;
  for (int seed = first; seed <= last; ++seed) measure(seed, folder, failures);
  std::printf(
      "\n%d seeds; wrong tips %d, junctions %d, cycles %d; further than 2 %% of D %d; not "
      "all inside %d; spurs %d\n",
      last - first + 1, failures.tips, failures.junctions, failures.cycles, failures.far,
      failures.outside, failures.spurs);
}
