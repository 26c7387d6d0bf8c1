// The local flow on all cores of the host: each patch in closed form, in double precision.
// Derivation in docs/method.md, "Local flow".
#include <Eigen/Geometry>
#include <cmath>

#include "base/parallel.hpp"
#include "contraction/fairing/least_height.hpp"
#include "contraction/fairing/local_flow.hpp"

namespace curveskel {
namespace {

/// std::complex multiplies and divides with checks for infinities that cost more than the rest.
struct Complex {
  double re = 0;
  double im = 0;
};
Complex operator+(Complex a, Complex b) { return {a.re + b.re, a.im + b.im}; }
Complex operator-(Complex a, Complex b) { return {a.re - b.re, a.im - b.im}; }
Complex operator*(Complex a, Complex b) {
  return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}
Complex operator*(double a, Complex b) { return {a * b.re, a * b.im}; }
Complex inverse(Complex a) {
  const double scale = 1 / (a.re * a.re + a.im * a.im);
  return {scale * a.re, -scale * a.im};
}
Complex times_i(Complex a) { return {-a.im, a.re}; }

struct Complex3 {
  Complex x, y, z;
};
Complex3 operator+(const Complex3& a, const Complex3& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
Complex3 operator-(const Complex3& a, const Complex3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
Complex3 operator*(Complex a, const Complex3& b) { return {a * b.x, a * b.y, a * b.z}; }
Complex3 complex(const Eigen::Vector3d& v) { return {{v.x(), 0}, {v.y(), 0}, {v.z(), 0}}; }

/// mu / 2 times the cotangents of the face (centre, first, second); 0 for a face without area.
struct Cotangents {
  double centre, first, second;
};
Cotangents face_cotangents(const Eigen::Vector3d& first, const Eigen::Vector3d& second,
                           double half_smoothing) {
  const Eigen::Vector3d edge = second - first;
  const SideProducts of{first.dot(second), first.dot(edge), second.dot(edge)};
  const double square = first.cross(second).squaredNorm();
  const double scale = has_area(square, of) ? half_smoothing / std::sqrt(square) : 0;
  return {scale * of.first_second, -scale * of.first_edge, scale * of.second_edge};
}

/// The motion of the patch's centre. The ring's system is eliminated from its first vertex to
/// its last; nothing but the running sums is kept, so any valence will do.
Eigen::Vector3d centre_step(std::span<const std::int32_t> ring, const Positions& positions,
                            const Eigen::Vector3d& centre, double half_smoothing) {
  const std::size_t last = ring.size() - 1;
  const auto at = [&](std::size_t i) -> Eigen::Vector3d {
    return positions.row(ring[i]).transpose() - centre;
  };
  Eigen::Vector3d here = at(0);
  const Eigen::Vector3d first = here;
  const Eigen::Vector3d end = at(last);
  const Cotangents closing = face_cotangents(end, first, half_smoothing);
  Cotangents before = closing;

  Complex to_last{0, -closing.centre};  // the entry that couples this row to the last one
  Complex carry;                        // i x the multiplier of the row before
  Complex right;                        // eliminated right-hand side: the couplings to the centre
  Complex3 value;                       // eliminated positions
  Complex last_right_sum, last_pivot_sum, right_right_sum;
  Complex3 last_value_sum, right_value_sum;
  double coupling_sum = 0;
  for (std::size_t i = 0; i < last; ++i) {
    const Eigen::Vector3d following = i + 1 == last ? end : at(i + 1);
    const Cotangents after = face_cotangents(here, following, half_smoothing);
    const double s = after.second + before.first;  // coupling to the centre
    coupling_sum += s;
    // carry = i t / pivot of the row before, t = before.centre, so t^2 / pivot = -i t carry.
    const Complex pivot =
        Complex{1, after.centre + before.centre + s} - before.centre * times_i(carry);
    const Complex reciprocal = inverse(pivot);
    right = Complex{s, 0} + carry * right;
    value = complex(here) + carry * value;
    if (i > 0) to_last = carry * to_last;
    if (i + 1 == last) to_last = to_last + Complex{0, -after.centre};
    const Complex scaled_right = reciprocal * right;
    const Complex scaled_last = reciprocal * to_last;
    right_right_sum = right_right_sum + scaled_right * right;
    right_value_sum = right_value_sum + scaled_right * value;
    last_right_sum = last_right_sum + scaled_last * right;
    last_pivot_sum = last_pivot_sum + scaled_last * to_last;
    last_value_sum = last_value_sum + scaled_last * value;
    carry = times_i(after.centre * reciprocal);
    before = after;
    here = following;
  }
  const double s = closing.second + before.first;
  coupling_sum += s;
  const Complex pivot = Complex{1, closing.centre + before.centre + s} - last_pivot_sum;
  const Complex last_right = Complex{s, 0} - last_right_sum;
  const Complex scaled_right = inverse(pivot) * last_right;
  right_right_sum = right_right_sum + scaled_right * last_right;
  right_value_sum = right_value_sum + scaled_right * (complex(end) - last_value_sum);

  const Complex weight = times_i(inverse(Complex{1, coupling_sum} + right_right_sum));
  const Complex3 result = weight * right_value_sum;
  return {result.x.re, result.y.re, result.z.re};
}

class HostFlow final : public LocalFlow {
 public:
  HostFlow(const Surface& surface, const OneRings& rings, const FairOptions& options)
      : rings_(rings), options_(options), now_(surface.positions), next_(now_) {}

  void advance(int iterations, const Monitor& monitor) override {
    constexpr std::size_t grain = 1024;
    for (int iteration = 0; iteration < iterations; ++iteration) {
      monitor.report("fair", static_cast<double>(iteration) / iterations);
      parallel_for(rings_.vertices(), grain, options_.threads,
                   [&](std::size_t begin, std::size_t end) {
                     for (std::size_t v = begin; v < end; ++v) move(v);
                   });
      now_.swap(next_);
    }
  }

  Positions positions() override { return now_; }

 private:
  void move(std::size_t v) {
    const auto ring = rings_.of(v);
    if (ring.empty()) return;
    const auto row = static_cast<Eigen::Index>(v);
    const Eigen::Vector3d centre = now_.row(row);
    next_.row(row) = (centre + centre_step(ring, now_, centre, options_.smoothing / 2)).transpose();
  }

  const OneRings& rings_;
  const FairOptions& options_;
  Positions now_;
  Positions next_;
};

}  // namespace

std::unique_ptr<LocalFlow> make_host_flow(const Surface& surface, const OneRings& rings,
                                          const FairOptions& options) {
  return std::make_unique<HostFlow>(surface, rings, options);
}

}  // namespace curveskel
