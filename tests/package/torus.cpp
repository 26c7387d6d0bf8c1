// A program of somebody else's: makes a torus and counts the cycles of its skeleton.
#include <curveskel.hpp>

#include <cmath>
#include <cstdio>

int main() {
  constexpr int around = 60;
  constexpr int across = 20;
  curveskel::Surface torus;
  torus.positions.resize(around * across, 3);
  torus.triangles.resize(2 * around * across, 3);
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      const double u = 2 * EIGEN_PI * i / around;
      const double v = 2 * EIGEN_PI * j / across;
      const double w = 3 + std::cos(v);
      const int a = i * across + j;
      const int b = (i + 1) % around * across + j;
      const int c = (i + 1) % around * across + (j + 1) % across;
      const int d = i * across + (j + 1) % across;
      torus.positions.row(a) << w * std::cos(u), w * std::sin(u), std::sin(v);
      torus.triangles.row(2 * a) << a, b, c;
      torus.triangles.row(2 * a + 1) << a, c, d;
    }
  }
  curveskel::Extraction found = curveskel::extract(torus);
  const curveskel::GraphTopology graph = curveskel::graph_topology(found.skeleton);
  // Memory that the library has allocated is given back by this program.
  curveskel::Positions nodes = found.skeleton.nodes;
  nodes.conservativeResize(nodes.rows() + 1000, 3);
  nodes.bottomRows(1000).setOnes();
  found.skeleton.nodes = nodes;
  std::printf("%d component, %d cycle\n", graph.components, graph.cycle_rank);
  return graph.components == 1 && graph.cycle_rank == 1 ? 0 : 1;
}
