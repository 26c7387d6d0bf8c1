#include "contraction/solvers/study/householder_panel.hpp"

#include <Eigen/Core>
#include <Eigen/Householder>

namespace curveskel {
namespace {

using PanelMap = Eigen::Map<Eigen::MatrixXd, 0, Eigen::OuterStride<>>;

PanelMap mapped(const Panel& panel) {
  return {panel.entries, static_cast<Eigen::Index>(panel.rows),
          static_cast<Eigen::Index>(panel.columns),
          Eigen::OuterStride<>(static_cast<Eigen::Index>(panel.stride))};
}

/// Upper triangular T with H_0 H_1 ... = I - V T V^T, column by column.
Eigen::MatrixXd joined(const Eigen::VectorXd& scales, const Eigen::MatrixXd& gram) {
  Eigen::MatrixXd t = Eigen::MatrixXd::Zero(scales.size(), scales.size());
  for (Eigen::Index k = 0; k < scales.size(); ++k) {
    const Eigen::VectorXd coupling = -scales[k] * gram.col(k).head(k);
    t.col(k).head(k) = t.topLeftCorner(k, k).triangularView<Eigen::Upper>() * coupling;
    t(k, k) = scales[k];
  }
  return t;
}

}  // namespace

void eliminate(const Panel& panel, std::size_t pivots, const Panel& v, const Panel& w) {
  PanelMap a = mapped(panel);
  PanelMap reflectors = mapped(v);
  PanelMap products = mapped(w);
  const auto count = static_cast<Eigen::Index>(pivots);
  Eigen::VectorXd scales(count);
  Eigen::VectorXd workspace(a.cols());
  reflectors.setZero();
  products.setZero();
  for (Eigen::Index k = 0; k < count; ++k) {
    const Eigen::Index below = a.rows() - k - 1;
    double diagonal = 0;
    a.col(k).tail(below + 1).makeHouseholderInPlace(scales[k], diagonal);
    a(k, k) = diagonal;
    a.bottomRightCorner(below + 1, a.cols() - k - 1)
        .applyHouseholderOnTheLeft(a.col(k).tail(below), scales[k], workspace.data());
    reflectors(k, k) = 1;
    reflectors.col(k).tail(below) = a.col(k).tail(below);
  }
  const auto used = reflectors.leftCols(count);
  const Eigen::MatrixXd t = joined(scales, used.transpose() * used);
  products.topRows(count).noalias() = t.transpose() * used.transpose();
}

}  // namespace curveskel
