#include "contraction/viennacl/dense_and_krylov.hpp"

#define VIENNACL_WITH_OPENCL
#include <boost/numeric/ublas/matrix.hpp>
#include <viennacl/compressed_matrix.hpp>
#include <viennacl/linalg/cg.hpp>
#include <viennacl/linalg/jacobi_precond.hpp>
#include <viennacl/linalg/prod.hpp>
#include <viennacl/linalg/qr.hpp>
#include <viennacl/matrix.hpp>
#include <viennacl/matrix_proxy.hpp>
#include <viennacl/ocl/backend.hpp>
#include <viennacl/vector.hpp>

namespace curveskel::vcl {
namespace {

// Row-major ones come out wrong past the first block of columns (ViennaCL 1.7.1).
using DeviceMatrix = viennacl::matrix<double, viennacl::column_major>;
using HostMatrix = boost::numeric::ublas::matrix<double>;
using DeviceRows = viennacl::compressed_matrix<double>;
using DeviceVector = viennacl::vector<double>;

constexpr std::size_t block_columns = 16;

DeviceMatrix uploaded(const Matrix& a) {
  DeviceMatrix result(a.rows, a.columns);
  std::vector<double> padded(result.internal_size(), 0);
  for (std::size_t j = 0; j < a.columns; ++j) {
    for (std::size_t i = 0; i < a.rows; ++i) padded[i + j * result.internal_size1()] = a(i, j);
  }
  viennacl::fast_copy(padded.data(), padded.data() + padded.size(), result);
  return result;
}

Matrix downloaded(const DeviceMatrix& a) {
  std::vector<double> padded(a.internal_size());
  viennacl::fast_copy(a, padded.data());
  Matrix result{a.size1(), a.size2(), std::vector<double>(a.size1() * a.size2())};
  for (std::size_t j = 0; j < result.columns; ++j) {
    for (std::size_t i = 0; i < result.rows; ++i) {
      result(i, j) = padded[i + j * a.internal_size1()];
    }
  }
  return result;
}

Matrix from_host(const HostMatrix& a) {
  Matrix result{a.size1(), a.size2(), std::vector<double>(a.size1() * a.size2())};
  for (std::size_t j = 0; j < result.columns; ++j) {
    for (std::size_t i = 0; i < result.rows; ++i) result(i, j) = a(i, j);
  }
  return result;
}

DeviceRows uploaded(const SparseRows& rows) {
  DeviceRows result(rows.rows, rows.rows, rows.value.size());
  result.set(rows.start.data(), rows.column.data(), rows.value.data(), rows.rows, rows.rows,
             rows.value.size());
  return result;
}

/// x becomes M^-1 M^-1 x, or D^-1 x without M.
class SquaredInverse {
 public:
  SquaredInverse(const DeviceRows& h, const SparseRows& m)
      : squared_(m.rows > 0),
        factor_(squared_ ? uploaded(m) : DeviceRows()),
        diagonal_(squared_ ? factor_ : h, viennacl::linalg::jacobi_tag()) {}

  void apply(DeviceVector& x) const {
    if (!squared_) {
      diagonal_.apply(x);
      return;
    }
    constexpr double tolerance = 1e-11;  // tight, so that it is one and the same linear map
    constexpr unsigned most = 20000;
    for (int twice = 0; twice < 2; ++twice) {
      const viennacl::linalg::cg_tag tag(tolerance, most);
      x = viennacl::linalg::solve(factor_, x, tag, diagonal_);
    }
  }

 private:
  bool squared_;
  DeviceRows factor_;
  viennacl::linalg::jacobi_precond<DeviceRows> diagonal_;
};

}  // namespace

void use(void* context, void* device, void* queue) {
  static const bool once = [&] {
    viennacl::ocl::setup_context(0, static_cast<cl_context>(context),
                                 static_cast<cl_device_id>(device),
                                 static_cast<cl_command_queue>(queue));
    viennacl::ocl::switch_context(0);
    return true;
  }();
  static_cast<void>(once);
}

Matrix reduced(const Matrix& a) {
  DeviceMatrix on_device = uploaded(a);
  viennacl::linalg::inplace_qr(on_device, block_columns);
  return downloaded(on_device);
}

Factors factorised(const Matrix& a) {
  DeviceMatrix on_device = uploaded(a);
  const std::vector<double> betas = viennacl::linalg::inplace_qr(on_device, block_columns);
  HostMatrix reflections(a.rows, a.columns);
  viennacl::copy(on_device, reflections);
  HostMatrix q(a.rows, a.rows);
  HostMatrix r(a.rows, a.columns);
  viennacl::linalg::recoverQ(reflections, betas, q, r);
  return {from_host(q), from_host(r)};
}

KrylovResult conjugate_gradients(const SparseRows& h, const SparseRows& m,
                                 const std::vector<double>& r, double tolerance,
                                 int most_iterations, const std::function<bool()>& stop) {
  const DeviceRows matrix = uploaded(h);
  const SquaredInverse preconditioner(matrix, m);
  DeviceVector right(r.size());
  viennacl::copy(r.begin(), r.end(), right.begin());
  viennacl::linalg::cg_tag tag(tolerance, static_cast<unsigned>(most_iterations));
  viennacl::linalg::cg_solver<DeviceVector> solver(tag);
  solver.set_monitor(
      [](const DeviceVector&, double, void* data) {
        return (*static_cast<const std::function<bool()>*>(data))();
      },
      const_cast<std::function<bool()>*>(&stop));
  const DeviceVector x = solver(matrix, right, preconditioner);
  KrylovResult result{std::vector<double>(r.size()), static_cast<int>(solver.tag().iters())};
  viennacl::copy(x.begin(), x.end(), result.x.begin());
  return result;
}

}  // namespace curveskel::vcl
