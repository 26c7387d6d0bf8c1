// The paper's local CPU method: per vertex, a dense QR of the stacked system of its patch.
#include <Eigen/Dense>
#include <Eigen/SparseLU>
#include <complex>
#include <vector>

#include "contraction/local_flow.hpp"

namespace curveskel {
namespace {

using Matrix = Eigen::MatrixXd;

/// Above this a dense QR of one patch takes a minute or more; the same least-squares solution is
/// then the real part of a sparse complex system (docs/method.md, "Local flow").
constexpr std::size_t largest_dense_ring = 1024;

struct CornerWeights {
  double at_centre;  // each cotangent / 2, 0 for a face without area
  double at_first;
  double at_second;
};

CornerWeights corner_weights(const Eigen::Vector3d& first, const Eigen::Vector3d& second) {
  const double double_area = first.cross(second).norm();
  if (!(double_area > 0)) return {0, 0, 0};
  const Eigen::Vector3d edge = second - first;
  return {0.5 * first.dot(second) / double_area, -0.5 * first.dot(edge) / double_area,
          0.5 * second.dot(edge) / double_area};
}

/// Calls add(i, j, weight) for the edges of all faces of the fan; 0 is the centre, i the ring's
/// vertex i - 1.
template <typename Add>
void for_each_weight(const Positions& ring, Add add) {
  const Eigen::Index k = ring.rows();
  for (Eigen::Index i = 0; i < k; ++i) {
    const Eigen::Index j = (i + 1) % k;
    const CornerWeights w = corner_weights(ring.row(i), ring.row(j));
    add(i + 1, j + 1, w.at_centre);
    add(0, j + 1, w.at_first);
    add(0, i + 1, w.at_second);
  }
}

/// min ||mu L X||^2 + ||X - V||^2, the row of the centre; V relative to the centre.
Eigen::RowVector3d centre_by_qr(const Positions& ring, double smoothing) {
  const Eigen::Index n = ring.rows() + 1;
  Matrix stacked = Matrix::Zero(2 * n, n);
  for_each_weight(ring, [&](Eigen::Index i, Eigen::Index j, double weight) {
    stacked(i, j) += smoothing * weight;
    stacked(j, i) += smoothing * weight;
    stacked(i, i) -= smoothing * weight;
    stacked(j, j) -= smoothing * weight;
  });
  stacked.bottomRows(n).setIdentity();
  Matrix right = Matrix::Zero(2 * n, 3);
  right.bottomRows(n - 1) = ring;
  return stacked.householderQr().solve(right).row(0);
}

Eigen::RowVector3d centre_by_sparse_lu(const Positions& ring, double smoothing) {
  using Complex = std::complex<double>;
  const Eigen::Index n = ring.rows() + 1;
  std::vector<Eigen::Triplet<Complex>> entries;
  for (Eigen::Index i = 0; i < n; ++i) entries.emplace_back(i, i, 1);
  for_each_weight(ring, [&](Eigen::Index i, Eigen::Index j, double weight) {
    const Complex entry(0, smoothing * weight);
    entries.emplace_back(i, j, entry);
    entries.emplace_back(j, i, entry);
    entries.emplace_back(i, i, -entry);
    entries.emplace_back(j, j, -entry);
  });
  Eigen::SparseMatrix<Complex> system(n, n);
  system.setFromTriplets(entries.begin(), entries.end());
  Eigen::Matrix<Complex, Eigen::Dynamic, 3> right(n, 3);
  right.row(0).setZero();
  right.bottomRows(n - 1) = ring.cast<Complex>();
  Eigen::SparseLU<Eigen::SparseMatrix<Complex>> lu(system);
  const Eigen::Matrix<Complex, Eigen::Dynamic, 3> solution = lu.solve(right);
  return solution.row(0).real();
}

class CpuFlow final : public LocalFlow {
 public:
  CpuFlow(const Surface& surface, const OneRings& rings, double smoothing)
      : rings_(rings), smoothing_(smoothing), now_(surface.positions) {}

  void advance(int iterations, const Monitor& monitor) override {
    constexpr std::size_t vertices_per_report = 1024;
    for (int iteration = 0; iteration < iterations; ++iteration) {
      next_ = now_;
      for (std::size_t v = 0; v < rings_.vertices(); ++v) {
        if (v % vertices_per_report == 0) {
          const double part = static_cast<double>(v) / static_cast<double>(rings_.vertices());
          monitor.report("fair", (iteration + part) / iterations);
        }
        if (!rings_.of(v).empty()) move(v);
      }
      now_.swap(next_);
    }
  }

  Positions positions() override { return now_; }

 private:
  void move(std::size_t v) {
    const auto neighbours = rings_.of(v);
    const Eigen::RowVector3d centre = now_.row(static_cast<Eigen::Index>(v));
    ring_.resize(static_cast<Eigen::Index>(neighbours.size()), 3);
    for (std::size_t i = 0; i < neighbours.size(); ++i) {
      ring_.row(static_cast<Eigen::Index>(i)) = now_.row(neighbours[i]) - centre;
    }
    next_.row(static_cast<Eigen::Index>(v)) += neighbours.size() <= largest_dense_ring
                                                   ? centre_by_qr(ring_, smoothing_)
                                                   : centre_by_sparse_lu(ring_, smoothing_);
  }

  const OneRings& rings_;
  double smoothing_;
  Positions now_;
  Positions next_;
  Positions ring_;
};

}  // namespace

std::unique_ptr<LocalFlow> make_cpu_flow(const Surface& surface, const OneRings& rings,
                                         const FairOptions& options) {
  return std::make_unique<CpuFlow>(surface, rings, options.smoothing);
}

}  // namespace curveskel
