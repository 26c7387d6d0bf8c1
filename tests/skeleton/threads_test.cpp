// The effects of an extraction on the process that it runs in.
#include <dlfcn.h>
#include <gtest/gtest.h>
#include <pthread.h>

#include <atomic>

#include <curveskel/advanced/least_squares.hpp>
#include <curveskel/extract.hpp>
#include <curveskel/extract_repaired.hpp>
#include "meshes/shapes.hpp"

namespace {
std::atomic<int> threads_started{0};
}

/// Stands before the system's, so that each thread which the library starts is counted.
extern "C" int pthread_create(pthread_t* thread, const pthread_attr_t* attr,
                              void* (*start_routine)(void*), void* arg) noexcept {
  using Create = int (*)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);
  static const auto create = reinterpret_cast<Create>(dlsym(RTLD_NEXT, "pthread_create"));
  ++threads_started;
  return create(thread, attr, start_routine, arg);
}

namespace curveskel::threads_laws {
namespace {

/// Large enough that every stage has work for two; a part that is coarsened in pieces.
const Surface& two_bodies() {
  static const Surface surface =
      shapes::together("", {shapes::torus(3, 1, 150),
                            shapes::translated(shapes::ellipsoid({1, 1, 2}, 4), {9, 0, 0})})
          .surface;
  return surface;
}

ExtractOptions faired(int threads) {
  ExtractOptions options;
  options.resolution = 1500;
  options.least_resolution = 500;
  options.threads = threads;
  options.fairing = true;
  return options;
}

int started_by(const Surface& surface, const ExtractOptions& options) {
  const int before = threads_started;
  (void)extract(surface, options);
  return threads_started - before;
}

TEST(Threads, OfOneAreNoOthersInAnyStage) {
  EXPECT_EQ(started_by(two_bodies(), faired(1)), 0);
  EXPECT_EQ(started_by(shapes::torus(3, 1, 150).surface, faired(1)), 0);
  EXPECT_GT(started_by(two_bodies(), faired(2)), 0) << "nothing was counted";
}

TEST(Threads, OfTheExtractionCountWhateverTheStagesOwnSay) {
  ExtractOptions options = faired(1);
  options.fair.threads = options.contraction.threads = options.certificate.threads = 3;
  EXPECT_EQ(started_by(two_bodies(), options), 0);
}

/// The number of threads of OpenBLAS, for the whole process.
class HostsBlas {
 public:
  HostsBlas() {
    get_ = reinterpret_cast<int (*)()>(dlsym(RTLD_DEFAULT, "openblas_get_num_threads"));
    set_ = reinterpret_cast<void (*)(int)>(dlsym(RTLD_DEFAULT, "openblas_set_num_threads"));
    if (is_there()) found_ = get_();
  }
  ~HostsBlas() {
    if (is_there()) set_(found_);
  }
  HostsBlas(const HostsBlas&) = delete;
  HostsBlas& operator=(const HostsBlas&) = delete;

  [[nodiscard]] bool is_there() const { return get_ != nullptr && set_ != nullptr; }
  [[nodiscard]] int threads() const { return get_(); }
  void set(int threads) const { set_(threads); }

 private:
  int (*get_)() = nullptr;
  void (*set_)(int) = nullptr;
  int found_ = 1;
};

TEST(Threads, OfTheHostsBlasAreAsManyAfterAsBefore) {
  const HostsBlas blas;
  if (!blas.is_there()) GTEST_SKIP() << "the BLAS of this machine is not OpenBLAS";
  blas.set(2);
  ASSERT_EQ(blas.threads(), 2);
  (void)extract(two_bodies(), faired(0));
  EXPECT_EQ(blas.threads(), 2) << "after an extraction";
  for (const Solver solver : {Solver::cholesky, Solver::sparse_qr}) {
    LeastSquares problem(solver);
    EXPECT_EQ(blas.threads(), 2) << "once the solver is made: " << name_of(solvers, solver);
    SparseMatrix identity(50, 50);
    identity.setIdentity();
    (void)problem.solve(identity, Positions::Ones(50, 3));
    EXPECT_EQ(blas.threads(), 2) << "after a solve by " << name_of(solvers, solver);
  }
}

TEST(Threads, OfTheHostsBlasChangeNoByte) {
  const HostsBlas blas;
  if (!blas.is_there()) GTEST_SKIP() << "the BLAS of this machine is not OpenBLAS";
  std::vector<CurveSkeleton> found;
  for (const int threads : {1, 2}) {
    blas.set(threads);
    ExtractOptions options = faired(0);
    options.contraction.solver = Solver::sparse_qr;
    options.contraction.max_iterations = 3;
    found.push_back(extract(two_bodies(), options).skeleton);
  }
  EXPECT_EQ(found[0].nodes, found[1].nodes);
  EXPECT_EQ(found[0].edges, found[1].edges);
  EXPECT_EQ(found[0].radii, found[1].radii);
}

}  // namespace
}  // namespace curveskel::threads_laws
