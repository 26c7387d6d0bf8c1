#include "contraction/solvers/viennacl/dense_qr.hpp"

#include "contraction/solvers/study/householder_panel.hpp"

#define VIENNACL_WITH_OPENCL
#include <algorithm>
#include <boost/numeric/ublas/matrix.hpp>
#include <viennacl/backend/memory.hpp>
#include <viennacl/linalg/prod.hpp>
#include <viennacl/linalg/qr.hpp>
#include <viennacl/matrix.hpp>
#include <viennacl/ocl/backend.hpp>

namespace curveskel::vcl {
namespace {

// Row-major ones come out wrong past the first block of columns (ViennaCL 1.7.1).
using DeviceMatrix = viennacl::matrix<double, viennacl::column_major>;
using HostMatrix = boost::numeric::ublas::matrix<double>;

constexpr std::size_t block_columns = 16;
/// Columns that the host eliminates at a time, and a multiple of the rows and columns that a
/// product takes at a time; ViennaCL's kernel for what is left over is slow.
constexpr std::size_t tile = 32;

std::size_t whole_tiles(std::size_t size) { return (size + tile - 1) / tile * tile; }

/// On processors, ViennaCL's own choice of tiles takes twice as long: work-items that take 4 x 4
/// entries which lie apart. These take 8 that follow each other, 4 columns of them.
void take_larger_tiles_on_processors() {
  namespace specific = viennacl::device_specific;
  using Tiles = specific::matrix_product_template::parameters_type;
  constexpr auto policy = specific::FETCH_FROM_GLOBAL_CONTIGUOUS;
  auto& of_processors =
      specific::builtin_database::matrix_product_N_N.map.d[viennacl::ocl::unknown_id]
          .d[CL_DEVICE_TYPE_CPU]
          .d[viennacl::ocl::unknown]
          .d[""]
          .d;
  of_processors.erase(viennacl::scheduler::DOUBLE_TYPE);
  of_processors.insert(
      {viennacl::scheduler::DOUBLE_TYPE, Tiles(1, 4, 8, 2, 8, 1, 4, policy, policy, 0, 0)});
}

/// `rows` x `columns`, what is beyond `a` 0.
std::vector<double> padded(const Matrix& a, std::size_t rows, std::size_t columns) {
  std::vector<double> entries(rows * columns, 0);
  for (std::size_t j = 0; j < a.columns; ++j) {
    std::copy_n(&a.entries[j * a.rows], a.rows, &entries[j * rows]);
  }
  return entries;
}

Matrix from_host(const HostMatrix& a) {
  Matrix result{a.size1(), a.size2(), std::vector<double>(a.size1() * a.size2())};
  for (std::size_t j = 0; j < result.columns; ++j) {
    for (std::size_t i = 0; i < result.rows; ++i) result(i, j) = a(i, j);
  }
  return result;
}

/// Column-major memory of the device, seen as matrices of any shape.
class DeviceMemory {
 public:
  explicit DeviceMemory(const std::vector<double>& entries) {
    viennacl::backend::memory_create(handle_, entries.size() * sizeof(double), viennacl::context(),
                                     entries.data());
  }
  void write(const std::vector<double>& from) {
    viennacl::backend::memory_write(handle_, 0, from.size() * sizeof(double), from.data());
  }
  void read(std::size_t first, std::vector<double>& to) const {
    viennacl::backend::memory_read(handle_, first * sizeof(double), to.size() * sizeof(double),
                                   to.data());
  }
  /// Rows from `row`, columns from `column`, of a matrix with `stride` entries a column.
  viennacl::matrix_base<double> block(std::size_t stride, std::size_t row, std::size_t rows,
                                      std::size_t column, std::size_t columns) {
    return viennacl::matrix_base<double>(handle_, rows, row, 1, stride, columns, column, 1,
                                         column + columns, false);
  }

 private:
  viennacl::backend::mem_handle handle_;
};

/// Applies the reflections of a panel to columns beside it.
class DeviceReflections {
 public:
  /// Of at most this many rows, to at most this many columns. A product adds 0 times what was
  /// there, which must be a number.
  DeviceReflections(std::size_t rows, std::size_t columns)
      : v_(std::vector<double>(rows * tile)),
        w_(std::vector<double>(rows * tile)),
        products_(std::vector<double>(columns * tile)) {}

  /// rest -= v (w rest); v is #rows x tile, w tile x #rows.
  void apply(const std::vector<double>& v, const std::vector<double>& w,
             viennacl::matrix_base<double>& rest) {
    const std::size_t height = rest.size1();
    v_.write(v);
    w_.write(w);
    const auto v_block = v_.block(height, 0, height, 0, tile);
    const auto w_block = w_.block(tile, 0, tile, 0, height);
    auto products = products_.block(tile, 0, tile, 0, rest.size2());
    products = viennacl::linalg::prod(w_block, rest);
    rest -= viennacl::linalg::prod(v_block, products);
  }

 private:
  DeviceMemory v_, w_, products_;
};

/// For each column, the rows up to the last entry in it or in a column before it: below there is
/// nothing to eliminate.
std::vector<std::size_t> depths(const Matrix& a) {
  std::vector<std::size_t> depth(a.columns);
  std::size_t deepest = 0;
  for (std::size_t j = 0; j < a.columns; ++j) {
    for (std::size_t i = a.rows; i > deepest; --i) {
      if (a(i - 1, j) != 0) deepest = i;
    }
    depth[j] = deepest;
  }
  return depth;
}

}  // namespace

void use(void* context, void* device, void* queue) {
  static const bool once = [&] {
    take_larger_tiles_on_processors();
    viennacl::ocl::setup_context(0, static_cast<cl_context>(context),
                                 static_cast<cl_device_id>(device),
                                 static_cast<cl_command_queue>(queue));
    viennacl::ocl::switch_context(0);
    return true;
  }();
  static_cast<void>(once);
}

Matrix reduced(const Matrix& a, std::size_t eliminated, const std::function<void()>& before_panel) {
  const std::size_t rows = whole_tiles(a.rows);
  const std::size_t columns = whole_tiles(a.columns);
  const std::vector<std::size_t> depth = depths(a);
  DeviceMemory matrix(padded(a, rows, columns));
  DeviceReflections reflections(rows, columns);
  Matrix result{eliminated, a.columns, std::vector<double>(eliminated * a.columns)};
  std::vector<double> panel(rows * tile), v, w;
  for (std::size_t first = 0; first < a.columns; first += tile) {
    before_panel();
    matrix.read(first * rows, panel);
    const std::size_t end = std::min(first + tile, eliminated);
    if (first < end) {
      const std::size_t height = whole_tiles(std::max(depth[end - 1], end)) - first;
      v.resize(height * tile);
      w.resize(height * tile);
      eliminate({panel.data() + first, height, tile, rows}, end - first,
                {v.data(), height, tile, height}, {w.data(), tile, height, tile});
      const std::size_t next = first + tile;
      if (next < columns) {
        auto rest = matrix.block(rows, first, height, next, columns - next);
        reflections.apply(v, w, rest);
      }
    }
    for (std::size_t j = first; j < std::min(first + tile, a.columns); ++j) {
      const double* column = panel.data() + (j - first) * rows;
      std::copy_n(column, std::min(j + 1, eliminated), &result(0, j));
    }
  }
  return result;
}

Factors factorised(const Matrix& a) {
  DeviceMatrix on_device(a.rows, a.columns);
  std::vector<double> entries = padded(a, on_device.internal_size1(), on_device.internal_size2());
  viennacl::fast_copy(entries.data(), entries.data() + entries.size(), on_device);
  const std::vector<double> betas = viennacl::linalg::inplace_qr(on_device, block_columns);
  HostMatrix reflections(a.rows, a.columns);
  viennacl::copy(on_device, reflections);
  HostMatrix q(a.rows, a.rows);
  HostMatrix r(a.rows, a.columns);
  viennacl::linalg::recoverQ(reflections, betas, q, r);
  return {from_host(q), from_host(r)};
}

}  // namespace curveskel::vcl
