#include "contraction/solvers/cholesky_factor.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <new>
#include <string>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/error.hpp>
#include <curveskel/monitor.hpp>
#include "base/memory.hpp"
#include "base/wide_vectors.hpp"
#include "contraction/solvers/elimination_tree.hpp"

namespace curveskel {
namespace {

/// y[i] -= x_0[0] x_0[i] + x_1[0] x_1[i] + ..., the columns x_k `stride` apart. In this order, so
/// the width of the machine's vectors is no matter.
CURVESKEL_WIDE_VECTORS
void subtract_products(double* __restrict y, const double* __restrict x, std::size_t stride,
                       int columns, int rows) {
  int k = 0;
  for (; k + 4 <= columns; k += 4, x += 4 * stride) {
    const double* x1 = x + stride;
    const double* x2 = x1 + stride;
    const double* x3 = x2 + stride;
    const double f0 = x[0];
    const double f1 = x1[0];
    const double f2 = x2[0];
    const double f3 = x3[0];
    for (int i = 0; i < rows; ++i) y[i] = y[i] - f0 * x[i] - f1 * x1[i] - f2 * x2[i] - f3 * x3[i];
  }
  for (; k < columns; ++k, x += stride) {
    const double f = x[0];
    for (int i = 0; i < rows; ++i) y[i] -= f * x[i];
  }
}

/// In four parts, so that the sums need not wait for one another.
double sum_of_products(const double* x, const double* y, std::size_t count) {
  std::array<double, 4> part{};
  std::size_t i = 0;
  for (; i + 4 <= count; i += 4) {
    for (std::size_t k = 0; k < 4; ++k) part[k] += x[i + k] * y[i + k];
  }
  for (; i < count; ++i) part[0] += x[i] * y[i];
  return part[0] + part[1] + (part[2] + part[3]);
}

std::string scientific(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.1e", value);
  return text.data();
}

/// The start of column j of a lower triangle that is stored column by column without gaps.
std::size_t column_of_triangle(std::size_t order, std::size_t j) {
  return j * (2 * order - j + 1) / 2;
}
std::size_t size_of_triangle(std::size_t order) { return order * (order + 1) / 2; }

struct NotDefinite {
  int unknown;
};

}  // namespace

struct CholeskyFactor::Workspace::Implementation {
  std::vector<double> in_order;  // by place, a column after the other
  std::vector<double> front;
  Eigen::MatrixXd x;
};

struct CholeskyFactor::Implementation {
  /// Memory that is not written before it is used: pages cost more than what is done with them.
  class Scratch {
   public:
    void resize(std::size_t size) {
      if (size <= size_) return;
      values_.reset();
      size_ = 0;
      const std::size_t room = size + size / 4;
      values_ = std::make_unique_for_overwrite<double[]>(room);
      size_ = room;
    }
    [[nodiscard]] double* data() { return values_.get(); }
    [[nodiscard]] const double* data() const { return values_.get(); }

   private:
    std::unique_ptr<double[]> values_;
    std::size_t size_ = 0;
  };

  explicit Implementation(int threads_at_most) : threads(threads_at_most) {}

  [[nodiscard]] bool same_pattern(const SparseMatrix& h) const {
    return outer.size() == idx(h.outerSize()) + 1 && inner.size() == idx(h.nonZeros()) &&
           std::equal(outer.begin(), outer.end(), h.outerIndexPtr()) &&
           std::equal(inner.begin(), inner.end(), h.innerIndexPtr());
  }

  void analyse(const SparseMatrix& h) {
    outer.clear();  // nothing is known until all is
    tree = dissect(h, threads);
    panel.resize(tree.nodes.size());
    std::size_t panels = 0;
    for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
      panel[i] = panels;
      panels += idx(tree.nodes[i].pivot_count()) * front_rows(tree.nodes[i]);
    }
    const std::size_t updates = place_updates();
    require_room(panels + updates);
    panel_values.resize(panels);
    update_values.resize(updates);
    inner.assign(h.innerIndexPtr(), h.innerIndexPtr() + h.nonZeros());
    outer.assign(h.outerIndexPtr(), h.outerIndexPtr() + h.outerSize() + 1);
  }

  [[nodiscard]] static std::size_t front_rows(const EliminationNode& node) {
    return idx(node.pivot_count()) + node.border.size();
  }

  /// In a subtree what a node leaves is made above what its children left, a stack, and moved down
  /// to where theirs began.
  [[nodiscard]] std::size_t place_updates() {
    update.assign(tree.nodes.size(), 0);
    made.assign(tree.nodes.size(), 0);
    std::size_t begin = 0;
    for (const std::vector<int>& subtree : tree.subtrees) {
      std::size_t top = begin;
      std::size_t most = begin;
      for (const int node : subtree) {
        made[idx(node)] = update[idx(node)] = top;
        const std::size_t size = size_of_triangle(tree.nodes[idx(node)].border.size());
        most = std::max(most, top + size);
        for (const int child : tree.children[idx(node)]) {
          update[idx(node)] = std::min(update[idx(node)], update[idx(child)]);
        }
        top = update[idx(node)] + size;
      }
      begin = most;
    }
    for (const std::vector<int>& round : tree.rounds) {
      for (const int node : round) {
        made[idx(node)] = update[idx(node)] = begin;
        begin += size_of_triangle(tree.nodes[idx(node)].border.size());
      }
    }
    return begin;
  }

  /// For so many numbers. The system is not asked about sizes that it always has.
  void require_room(std::size_t numbers) const {
    constexpr std::size_t always_there = std::size_t{1} << 25U;  // 256 MiB
    if (numbers <= always_there) return;
    require_memory(
        sizeof(double) * static_cast<double>(numbers), available_memory_bytes(),
        "the factor of a matrix of " + std::to_string(tree.unknown_at.size()) + " unknowns",
        Fault::solver, "use a coarser surface");
  }

  /// The row of a front that belongs to a place; `from` is a row at or before it.
  [[nodiscard]] static std::size_t row_of(const EliminationNode& node, int place,
                                          std::size_t from) {
    if (place < node.end) return idx(place - node.pivots);
    const auto pivots = idx(node.pivot_count());
    std::size_t k = std::max(from, pivots) - pivots;
    while (node.border[k] != place) ++k;
    return pivots + k;
  }

  void add_entries(const SparseMatrix& h, const EliminationNode& node, double* block) const {
    const std::size_t rows = front_rows(node);
    for (int place = node.pivots; place < node.end; ++place) {
      double* column = block + idx(place - node.pivots) * rows;
      const int v = tree.unknown_at[idx(place)];
      for (int k = h.outerIndexPtr()[v]; k < h.outerIndexPtr()[v + 1]; ++k) {
        const int other = tree.place_of[idx(h.innerIndexPtr()[k])];
        if (other < place) continue;
        if (other < node.end) {
          column[other - node.pivots] += h.valuePtr()[k];
        } else {
          const auto found = std::lower_bound(node.border.begin(), node.border.end(), other);
          column[idx(node.pivot_count()) + idx(found - node.border.begin())] += h.valuePtr()[k];
        }
      }
    }
  }

  void add_update(const EliminationNode& node, int child, double* block, double* rest) const {
    const std::vector<int>& below = tree.nodes[idx(child)].border;
    const double* values = update_values.data() + update[idx(child)];
    const auto pivots = idx(node.pivot_count());
    const std::size_t border = node.border.size();
    std::vector<std::size_t> row(below.size());
    std::size_t at = 0;
    for (std::size_t i = 0; i < below.size(); ++i) row[i] = at = row_of(node, below[i], at);
    for (std::size_t j = 0; j < below.size(); values += below.size() - j++) {
      double* column = row[j] < pivots
                           ? block + row[j] * (pivots + border)
                           : rest + column_of_triangle(border, row[j] - pivots) - row[j];
      for (std::size_t i = j; i < below.size(); ++i) column[row[i]] += values[i - j];
    }
  }

  void eliminate(const SparseMatrix& h, int number, const std::stop_token& stop) {
    const EliminationNode& node = tree.nodes[idx(number)];
    const int pivots = node.pivot_count();
    const int border = node.border_count();
    const int rows = pivots + border;
    double* block = panel_values.data() + panel[idx(number)];
    double* rest = update_values.data() + made[idx(number)];
    std::fill_n(block, idx(pivots) * idx(rows), 0.0);
    std::fill_n(rest, size_of_triangle(idx(border)), 0.0);
    add_entries(h, node, block);
    for (const int child : tree.children[idx(number)]) add_update(node, child, block, rest);
    for (int j = 0; j < pivots; ++j) {
      throw_if_stopped(stop);
      double* column = block + idx(j) * idx(rows) + j;
      subtract_products(column, block + j, idx(rows), j, rows - j);
      if (!(column[0] > 0)) throw NotDefinite{tree.unknown_at[idx(node.pivots + j)]};
      const double root = std::sqrt(column[0]);
      for (int i = 0; i < rows - j; ++i) column[i] /= root;
    }
    for (int j = 0; j < border; ++j) {
      throw_if_stopped(stop);
      subtract_products(rest + column_of_triangle(idx(border), idx(j)), block + pivots + j,
                        idx(rows), pivots, border - j);
    }
    if (made[idx(number)] != update[idx(number)]) {
      std::copy_n(rest, size_of_triangle(idx(border)), update_values.data() + update[idx(number)]);
    }
  }

  /// The columns of x, `count` entries each by place, become those of the solution.
  void substitute(std::vector<double>& x, std::size_t count, std::vector<double>& front) const {
    for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
      for (std::size_t at = 0; at < x.size(); at += count) forward(i, x.data() + at, front);
    }
    for (std::size_t i = tree.nodes.size(); i-- > 0;) {
      for (std::size_t at = 0; at < x.size(); at += count) backward(i, x.data() + at, front);
    }
  }

  void forward(std::size_t number, double* x, std::vector<double>& front) const {
    const EliminationNode& node = tree.nodes[number];
    const auto pivots = idx(node.pivot_count());
    const std::size_t rows = pivots + node.border.size();
    front.assign(rows, 0);
    std::copy_n(x + node.pivots, pivots, front.begin());
    const double* column = panel_values.data() + panel[number];
    for (std::size_t j = 0; j < pivots; ++j, column += rows) {
      const double value = front[j] / column[j];
      x[idx(node.pivots) + j] = value;
      for (std::size_t i = j + 1; i < rows; ++i) front[i] -= value * column[i];
    }
    for (std::size_t k = pivots; k < rows; ++k) x[node.border[k - pivots]] += front[k];
  }

  void backward(std::size_t number, double* x, std::vector<double>& front) const {
    const EliminationNode& node = tree.nodes[number];
    const auto pivots = idx(node.pivot_count());
    const std::size_t rows = pivots + node.border.size();
    front.resize(rows);
    for (std::size_t k = pivots; k < rows; ++k) front[k] = x[node.border[k - pivots]];
    const double* column = panel_values.data() + panel[number] + pivots * rows;
    for (std::size_t j = pivots; j-- > 0;) {
      column -= rows;
      front[j] = (x[idx(node.pivots) + j] -
                  sum_of_products(column + j + 1, front.data() + j + 1, rows - j - 1)) /
                 column[j];
      x[idx(node.pivots) + j] = front[j];
    }
  }

  /// From the diagonal so far, as rough as it is cheap.
  [[nodiscard]] double reciprocal_condition() const {
    double least = 0;
    double most = 0;
    for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
      const auto pivots = idx(tree.nodes[i].pivot_count());
      const std::size_t rows = pivots + tree.nodes[i].border.size();
      for (std::size_t j = 0; j < pivots; ++j) {
        const double pivot = panel_values.data()[panel[i] + j * rows + j];
        if (!(pivot > 0)) return 0;
        least = most == 0 ? pivot : std::min(least, pivot);
        most = std::max(most, pivot);
      }
    }
    return most > 0 ? least / most * (least / most) : 0;
  }

  int threads;
  EliminationTree tree;
  std::vector<std::size_t> panel;   // per node, where its columns of the factor begin
  std::vector<std::size_t> made;    // where what it leaves to its parent is made,
  std::vector<std::size_t> update;  // and where it waits
  Scratch panel_values;
  Scratch update_values;
  std::vector<int> outer;  // pattern of the analysed matrix
  std::vector<int> inner;
};

CholeskyFactor::Workspace::Workspace() : implementation_(std::make_unique<Implementation>()) {}
CholeskyFactor::Workspace::~Workspace() = default;

CholeskyFactor::CholeskyFactor(int threads)
    : implementation_(std::make_unique<Implementation>(threads)) {}
CholeskyFactor::~CholeskyFactor() = default;

void CholeskyFactor::factorize(const SparseMatrix& h, const std::stop_token& stop) {
  Implementation& own = *implementation_;
  const auto matrix = [&] { return "the matrix of " + std::to_string(h.rows()) + " unknowns "; };
  try {
    if (!own.same_pattern(h)) own.analyse(h);
    own.tree.visit(own.threads, [&](int node) { own.eliminate(h, node, stop); });
  } catch (const std::bad_alloc&) {
    throw Error(Fault::solver,
                matrix() + "could not be factorised: out of memory; use a coarser surface");
  } catch (const NotDefinite& at) {
    throw Error(Fault::solver, matrix() + "is not positive definite at row " +
                                   std::to_string(at.unknown) + " (reciprocal condition estimate " +
                                   scientific(own.reciprocal_condition()) +
                                   "); use the solver sparse-qr or a coarser surface");
  }
}

Eigen::Map<const Eigen::MatrixXd> CholeskyFactor::solve(const Eigen::MatrixXd& r,
                                                        Workspace& workspace) const {
  const Implementation& own = *implementation_;
  Workspace::Implementation& space = *workspace.implementation_;
  const auto count = idx(r.rows());
  space.x.resize(r.rows(), r.cols());
  space.in_order.resize(count * idx(r.cols()));
  const std::vector<int>& unknown_at = own.tree.unknown_at;
  for (Eigen::Index column = 0; column < r.cols(); ++column) {
    double* in_order = space.in_order.data() + idx(column) * count;
    for (std::size_t i = 0; i < count; ++i) in_order[i] = r(unknown_at[i], column);
  }
  own.substitute(space.in_order, count, space.front);
  for (Eigen::Index column = 0; column < r.cols(); ++column) {
    const double* in_order = space.in_order.data() + idx(column) * count;
    for (std::size_t i = 0; i < count; ++i) space.x(unknown_at[i], column) = in_order[i];
  }
  return {space.x.data(), r.rows(), r.cols()};
}

}  // namespace curveskel
