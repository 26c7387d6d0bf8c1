#include "base/least_pairs.hpp"

#include <limits>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/monitor.hpp>

namespace curveskel {
namespace {

/// Rows are added one by one; each takes the shortest way of changed pairs to a free column.
class LeastPairing {
 public:
  explicit LeastPairing(const Eigen::MatrixXd& costs)
      : costs_(costs),
        row_price_(Eigen::VectorXd::Zero(costs.rows())),
        column_price_(Eigen::VectorXd::Zero(costs.cols())),
        row_of_(idx(costs.cols()), -1) {}

  void add(int row) {
    const auto columns = static_cast<int>(costs_.cols());
    Eigen::VectorXd slack = Eigen::VectorXd::Constant(columns, infinite);
    std::vector<int> before(idx(columns), -1);  // column on the way, -1 = the new row
    std::vector<bool> done(idx(columns), false);
    int column = -1;
    for (int from = row; from >= 0; from = row_of_[idx(column)]) {
      int next = -1;
      for (int c = 0; c < columns; ++c) {
        if (done[idx(c)]) continue;
        const double reduced = costs_(from, c) - row_price_[from] - column_price_[c];
        if (reduced < slack[c]) {
          slack[c] = reduced;
          before[idx(c)] = column;
        }
        if (next < 0 || slack[c] < slack[next]) next = c;
      }
      raise_prices(row, done, slack, slack[next]);
      done[idx(next)] = true;
      column = next;
    }
    while (column >= 0) {
      const int previous = before[idx(column)];
      row_of_[idx(column)] = previous < 0 ? row : row_of_[idx(previous)];
      column = previous;
    }
  }

  [[nodiscard]] std::vector<int> column_of_rows() const {
    std::vector<int> columns(idx(costs_.rows()), -1);
    for (std::size_t column = 0; column < row_of_.size(); ++column) {
      if (row_of_[column] >= 0) columns[idx(row_of_[column])] = static_cast<int>(column);
    }
    return columns;
  }

 private:
  static constexpr double infinite = std::numeric_limits<double>::infinity();

  void raise_prices(int row, const std::vector<bool>& done, Eigen::VectorXd& slack, double by) {
    row_price_[row] += by;
    for (std::size_t column = 0; column < done.size(); ++column) {
      const auto c = static_cast<Eigen::Index>(column);
      if (done[column]) {
        row_price_[row_of_[column]] += by;
        column_price_[c] -= by;
      } else {
        slack[c] -= by;
      }
    }
  }

  // The columns of a row are asked for one after the other.
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> costs_;
  Eigen::VectorXd row_price_;
  Eigen::VectorXd column_price_;
  std::vector<int> row_of_;  // of each column, -1 = free
};

}  // namespace

std::vector<int> least_pairs(const Eigen::MatrixXd& costs, const std::stop_token& stop) {
  if (costs.rows() > costs.cols()) {
    std::vector<int> columns(idx(costs.rows()), -1);
    const std::vector<int> rows = least_pairs(costs.transpose(), stop);
    for (std::size_t column = 0; column < rows.size(); ++column) {
      columns[idx(rows[column])] = static_cast<int>(column);
    }
    return columns;
  }
  LeastPairing pairing(costs);
  for (Eigen::Index row = 0; row < costs.rows(); ++row) {
    throw_if_stopped(stop);
    pairing.add(static_cast<int>(row));
  }
  return pairing.column_of_rows();
}

}  // namespace curveskel
