#include "bench/paper_flow.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <curveskel/advanced/measures.hpp>

namespace curveskel::bench {

Surface wavy_ring(int around, int across) {
  Surface surface;
  surface.positions.resize(Eigen::Index{around} * across, 3);
  surface.triangles.resize(Eigen::Index{2} * around * across, 3);
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      const double u = 2 * std::numbers::pi * i / around;
      const double v = 2 * std::numbers::pi * j / across;
      const double thickness = 0.5 + 0.15 * std::sin(3 * u) + 0.03 * std::cos(5 * v);
      const double out = 2 + thickness * std::cos(v);
      surface.positions.row(Eigen::Index{i} * across + j) << out * std::cos(u), out * std::sin(u),
          thickness * std::sin(v) + 0.4 * std::cos(2 * u);
      const int a = i * across + j;
      const int b = (i + 1) % around * across + j;
      const int c = (i + 1) % around * across + (j + 1) % across;
      const int d = i * across + (j + 1) % across;
      surface.triangles.row(Eigen::Index{2} * a) << a, b, c;
      surface.triangles.row(Eigen::Index{2} * a + 1) << a, c, d;
    }
  }
  return surface;
}

Surface surface_of_table(int vertices) {
  switch (vertices) {
    case 648:
      return wavy_ring(36, 18);
    case 1416:
      return wavy_ring(59, 24);
    case 5664:
      return wavy_ring(118, 48);
    case 14952:
      return wavy_ring(178, 84);
    default:
      throw std::invalid_argument("the table has no surface of " + std::to_string(vertices) +
                                  " vertices");
  }
}

PaperFlow::PaperFlow(Surface surface, double weight)
    : surface_(std::move(surface)),
      initial_areas_(vertex_areas(surface_)),
      initial_volume_(volume(surface_)),
      weight_(weight * std::sqrt(area(surface_) / static_cast<double>(surface_.triangles.rows()))) {
}

PaperFlow::System PaperFlow::system() const {
  const SparseMatrix laplacian = intrinsic_delaunay_laplacian(surface_);
  const Eigen::VectorXd pull =
      (initial_areas_.array() / vertex_areas(surface_).array().max(1e-14 * initial_areas_.array()))
          .sqrt();
  const Eigen::Index n = laplacian.cols();
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index j = 0; j < n; ++j) {
    const int column = static_cast<int>(j);
    for (SparseMatrix::InnerIterator entry(laplacian, j); entry; ++entry) {
      entries.emplace_back(static_cast<int>(entry.row()), column, weight_ * entry.value());
    }
    entries.emplace_back(static_cast<int>(n + j), column, pull[j]);
  }
  System system{SparseMatrix(2 * n, n), Positions::Zero(2 * n, 3)};
  system.a.setFromTriplets(entries.begin(), entries.end());
  system.b.bottomRows(n) = pull.asDiagonal() * surface_.positions;
  return system;
}

void PaperFlow::accept(const Positions& next) {
  surface_.positions = next;
  weight_ *= 2;
}

double PaperFlow::volume_ratio() const { return std::abs(volume(surface_) / initial_volume_); }

}  // namespace curveskel::bench
