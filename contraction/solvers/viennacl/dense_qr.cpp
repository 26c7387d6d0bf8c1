#include "contraction/solvers/viennacl/dense_qr.hpp"

#include "contraction/solvers/study/householder_panel.hpp"

#define VIENNACL_WITH_OPENCL
#include <algorithm>
#include <utility>
#include <viennacl/backend/memory.hpp>
#include <viennacl/linalg/prod.hpp>
#include <viennacl/matrix.hpp>
#include <viennacl/ocl/backend.hpp>

namespace curveskel::vcl {
namespace {

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

/// The product of the reflections of one panel, I - v w, for the rows from `first` on.
struct Reflections {
  std::size_t first = 0;
  std::vector<double> v;  ///< height x tile
  std::vector<double> w;  ///< tile x height
};

/// The other way round: the transpose.
Reflections transposed(const Reflections& of) {
  const std::size_t height = of.v.size() / tile;
  Reflections result{of.first, std::vector<double>(of.v.size()), std::vector<double>(of.v.size())};
  for (std::size_t i = 0; i < height; ++i) {
    for (std::size_t k = 0; k < tile; ++k) {
      result.v[i + k * height] = of.w[k + i * tile];
      result.w[k + i * tile] = of.v[i + k * height];
    }
  }
  return result;
}

/// Applies reflections to columns on the device.
class DeviceReflections {
 public:
  /// Of at most this many rows, to at most this many columns. A product adds 0 times what was
  /// there, which must be a number.
  DeviceReflections(std::size_t rows, std::size_t columns)
      : v_(std::vector<double>(rows * tile)),
        w_(std::vector<double>(rows * tile)),
        products_(std::vector<double>(columns * tile)) {}

  /// I - v w, times the columns from `column` on of `matrix` (#rows x #columns), takes their place.
  void apply(const Reflections& to_apply, DeviceMemory& matrix, std::size_t rows,
             std::size_t column, std::size_t columns) {
    const std::size_t height = to_apply.v.size() / tile;
    v_.write(to_apply.v);
    w_.write(to_apply.w);
    const auto v = v_.block(height, 0, height, 0, tile);
    const auto w = w_.block(tile, 0, tile, 0, height);
    auto changed = matrix.block(rows, to_apply.first, height, column, columns - column);
    auto products = products_.block(tile, 0, tile, 0, columns - column);
    products = viennacl::linalg::prod(w, changed);
    changed -= viennacl::linalg::prod(v, products);
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

/// `reduced`, with each panel's reflections handed to `keep`.
Matrix reduce(const Matrix& a, std::size_t eliminated, const std::function<void()>& before_panel,
              const std::function<void(const Reflections&)>& keep) {
  const std::size_t rows = whole_tiles(a.rows);
  const std::size_t columns = whole_tiles(a.columns);
  const std::vector<std::size_t> depth = depths(a);
  DeviceMemory matrix(padded(a, rows, columns));
  DeviceReflections on_device(rows, columns);
  Matrix result{eliminated, a.columns, std::vector<double>(eliminated * a.columns)};
  std::vector<double> panel(rows * tile);
  Reflections reflections;
  for (std::size_t first = 0; first < a.columns; first += tile) {
    before_panel();
    matrix.read(first * rows, panel);
    const std::size_t end = std::min(first + tile, eliminated);
    if (first < end) {
      const std::size_t height = whole_tiles(std::max(depth[end - 1], end)) - first;
      reflections.first = first;
      reflections.v.resize(height * tile);
      reflections.w.resize(height * tile);
      eliminate({panel.data() + first, height, tile, rows}, end - first,
                {reflections.v.data(), height, tile, height},
                {reflections.w.data(), tile, height, tile});
      if (first + tile < columns) {
        on_device.apply(reflections, matrix, rows, first + tile, columns);
      }
      keep(reflections);
    }
    for (std::size_t j = first; j < std::min(first + tile, a.columns); ++j) {
      const double* column = panel.data() + (j - first) * rows;
      std::copy_n(column, std::min(j + 1, eliminated), &result(0, j));
    }
  }
  return result;
}

/// The reflections, last panel first, of the first columns of the identity. Columns before a panel
/// have nothing in its rows yet.
Matrix first_columns_of_q(const std::vector<Reflections>& panels, std::size_t q_rows,
                          std::size_t q_columns, const std::function<void()>& before_panel) {
  const std::size_t rows = whole_tiles(q_rows);
  const std::size_t columns = whole_tiles(q_columns);
  std::vector<double> entries(rows * columns, 0);
  for (std::size_t j = 0; j < q_columns; ++j) entries[j + j * rows] = 1;
  DeviceMemory matrix(entries);
  DeviceReflections on_device(rows, columns);
  for (auto panel = panels.rbegin(); panel != panels.rend(); ++panel) {
    before_panel();
    on_device.apply(transposed(*panel), matrix, rows, panel->first, columns);
  }
  matrix.read(0, entries);
  Matrix q{q_rows, q_columns, std::vector<double>(q_rows * q_columns)};
  for (std::size_t j = 0; j < q_columns; ++j) {
    std::copy_n(&entries[j * rows], q_rows, &q.entries[j * q_rows]);
  }
  return q;
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
  return reduce(a, eliminated, before_panel, [](const Reflections& /*panel*/) {});
}

Factors factorised(const Matrix& a, const std::function<void()>& before_panel) {
  std::vector<Reflections> panels;
  const auto keep = [&](const Reflections& panel) { panels.push_back(panel); };
  Matrix r = reduce(a, a.columns, before_panel, keep);
  return {first_columns_of_q(panels, a.rows, a.columns, before_panel), std::move(r)};
}

}  // namespace curveskel::vcl
