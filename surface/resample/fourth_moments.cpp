#include "surface/resample/fourth_moments.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "surface/mesh/triangle_area.hpp"

namespace curveskel {
namespace {

struct Product {
  std::array<int, 3> powers;  // of x, y, z
  double times;               // so often in the fourth power of a sum
};

constexpr std::array<Product, fourth_moments> coordinate_products = [] {
  constexpr std::array<int, 5> factorials{1, 1, 2, 6, 24};
  std::array<Product, fourth_moments> all{};
  std::size_t next = 0;
  for (int x = 4; x >= 0; --x) {
    for (int y = 4 - x; y >= 0; --y) {
      const int z = 4 - x - y;
      const auto factorial = [&](int n) { return factorials[static_cast<std::size_t>(n)]; };
      all[next++] = {{x, y, z}, 24.0 / (factorial(x) * factorial(y) * factorial(z))};
    }
  }
  return all;
}();

using Powers = std::array<std::array<double, 5>, 3>;

Powers powers_of(const Eigen::Vector3d& p) {
  Powers powers{};
  for (std::size_t k = 0; k < 3; ++k) {
    powers[k][0] = 1;
    for (std::size_t n = 1; n < 5; ++n) {
      powers[k][n] = powers[k][n - 1] * p(static_cast<Eigen::Index>(k));
    }
  }
  return powers;
}

double power(const Powers& powers, std::size_t k, int n) {
  return powers[k][static_cast<std::size_t>(n)];
}

/// A polynomial of degree 4 in the coordinates of a unit vector.
class Quartic {
 public:
  explicit Quartic(const FourthMoments& coefficients) : coefficients_(coefficients) {}

  [[nodiscard]] double value(const Eigen::Vector3d& d) const { return gradient(d).dot(d) / 4; }

  [[nodiscard]] Eigen::Vector3d gradient(const Eigen::Vector3d& d) const {
    const Powers powers = powers_of(d);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < fourth_moments; ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        const auto exponents = coordinate_products[i].powers;
        const int n = exponents[k];
        if (n == 0) continue;
        sum(static_cast<Eigen::Index>(k)) += coefficients_[i] * n * power(powers, k, n - 1) *
                                             power(powers, (k + 1) % 3, exponents[(k + 1) % 3]) *
                                             power(powers, (k + 2) % 3, exponents[(k + 2) % 3]);
      }
    }
    return sum;
  }

  /// The mean over the sphere: that of x^4 is 3 / 15, of x^2 y^2 1 / 15, of odd powers 0.
  [[nodiscard]] double mean() const {
    double sum = 0;
    for (std::size_t i = 0; i < fourth_moments; ++i) {
      const auto& powers = coordinate_products[i].powers;
      if (std::any_of(powers.begin(), powers.end(), [](int n) { return n % 2 != 0; })) continue;
      const bool single = std::find(powers.begin(), powers.end(), 4) != powers.end();
      sum += coefficients_[i] * (single ? 3.0 : 1.0) / 15;
    }
    return sum;
  }

 private:
  FourthMoments coefficients_;
};

std::size_t index_of(const std::array<int, 3>& powers) {
  const auto* const found =
      std::find_if(coordinate_products.begin(), coordinate_products.end(),
                   [&](const Product& product) { return product.powers == powers; });
  return static_cast<std::size_t>(found - coordinate_products.begin());
}

/// Adds a multiple of |d|^2 x_i x_j.
void add_times_square(FourthMoments& coefficients, std::size_t i, std::size_t j, double value) {
  for (std::size_t k = 0; k < 3; ++k) {
    std::array<int, 3> powers{};
    ++powers[i];
    ++powers[j];
    powers[k] += 2;
    coefficients[index_of(powers)] += value;
  }
}

/// The mean of (p . d)^4 without its mean over the sphere.
Quartic deviation(const FourthMoments& moments) {
  FourthMoments coefficients = moments;
  for (std::size_t i = 0; i < fourth_moments; ++i) coefficients[i] *= coordinate_products[i].times;
  const double mean = Quartic(coefficients).mean();
  FourthMoments square{};  // |d|^4
  for (std::size_t k = 0; k < 3; ++k) add_times_square(square, k, k, 1);
  for (std::size_t i = 0; i < fourth_moments; ++i) coefficients[i] -= mean * square[i];
  return Quartic(coefficients);
}

/// The mean of the fourth power of the distance from the line along d, with a minus:
/// - (|p|^2 - (p . d)^2)^2.
Quartic nearness(const FourthMoments& moments) {
  FourthMoments coefficients{};
  for (std::size_t i = 0; i < fourth_moments; ++i) {
    coefficients[i] = -moments[i] * coordinate_products[i].times;
  }
  double square = 0;  // the mean of |p|^4
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      double product = 0;  // the mean of |p|^2 p_i p_j
      for (std::size_t k = 0; k < 3; ++k) {
        std::array<int, 3> powers{};
        ++powers[i];
        ++powers[j];
        powers[k] += 2;
        product += moments[index_of(powers)];
      }
      if (i == j) square += product;
      add_times_square(coefficients, i, j, 2 * product);
    }
  }
  for (std::size_t k = 0; k < 3; ++k) add_times_square(coefficients, k, k, -square);
  return Quartic(coefficients);
}

std::vector<Eigen::Vector3d> spread_over_half_a_sphere(int count) {
  std::vector<Eigen::Vector3d> directions;
  for (int i = 0; i < count; ++i) {
    const double height = (i + 0.5) / count;
    const double across = std::sqrt(1 - height * height);
    const double angle = 2 * std::numbers::pi * i / std::numbers::phi;
    directions.emplace_back(across * std::cos(angle), across * std::sin(angle), height);
  }
  return directions;
}

const std::vector<Eigen::Vector3d>& starts() {
  static const std::vector<Eigen::Vector3d> all = spread_over_half_a_sphere(32);
  return all;
}

double largest_size(const Quartic& quartic) {
  double largest = 0;
  for (const Eigen::Vector3d& d : starts()) largest = std::max(largest, std::abs(quartic.value(d)));
  return largest;
}

/// Towards the peak that is uphill: each step goes along the gradient with a hold that makes it
/// monotonous (Kolda and Mayo, Shifted power method, 2011).
Eigen::Vector3d climbed(const Quartic& quartic, Eigen::Vector3d d, double sign, double largest,
                        int most_steps) {
  constexpr double at_rest = 1e-14;
  const double hold = 4 * largest;  // 3 would do if the largest of all were known
  for (int step = 0; step < most_steps; ++step) {
    const Eigen::Vector3d next = (sign / 4 * quartic.gradient(d) + hold * d).normalized();
    const double moved = (next - d).norm();
    d = next;
    if (moved < at_rest) break;
  }
  return d;
}

constexpr int enough_steps = 3000;

/// Each once, d for -d, too: first near enough to tell them apart, then all the way.
std::vector<Eigen::Vector3d> peaks_of(const Quartic& quartic, double sign, double largest) {
  constexpr int first_steps = 12;
  constexpr double near = 0.1;
  std::vector<Eigen::Vector3d> peaks;
  for (const Eigen::Vector3d& start : starts()) {
    const Eigen::Vector3d d = climbed(quartic, start, sign, largest, first_steps);
    const auto is_near = [&](const Eigen::Vector3d& peak) { return d.cross(peak).norm() < near; };
    if (std::none_of(peaks.begin(), peaks.end(), is_near)) peaks.push_back(d);
  }
  for (Eigen::Vector3d& d : peaks) d = climbed(quartic, d, sign, largest, enough_steps);
  return peaks;
}

}  // namespace

FourthMoments fourth_moments_of_triangle(const Eigen::Vector3d& p, const Eigen::Vector3d& q,
                                         const Eigen::Vector3d& r) {
  // Exact for polynomials of degree 4 (Dunavant 1985): three points and their weight, twice.
  constexpr std::array<std::array<double, 2>, 2> rule{
      {{0.44594849091596488632, 0.22338158967801146570},
       {0.09157621350977074346, 0.10995174365532186764}}};
  FourthMoments moments{};
  for (const auto& [share, weight] : rule) {
    const Eigen::Vector3d sum = share * (p + q + r);
    for (const Eigen::Vector3d* corner : {&p, &q, &r}) {
      const Powers powers = powers_of(sum + (1 - 3 * share) * *corner);
      for (std::size_t i = 0; i < fourth_moments; ++i) {
        const auto& [x, y, z] = coordinate_products[i].powers;
        moments[i] += weight * power(powers, 0, x) * power(powers, 1, y) * power(powers, 2, z);
      }
    }
  }
  return moments;
}

std::vector<Eigen::Vector3d> extreme_directions(const FourthMoments& moments, double least) {
  constexpr double equal = 1e-6;  // of two peaks' heights, and of one direction found twice
  const Quartic heights = deviation(moments);
  const double largest = largest_size(heights);
  if (largest <= least * (moments[0] + moments[index_of({0, 4, 0})] + moments.back())) return {};
  std::vector<Eigen::Vector3d> peaks = peaks_of(heights, 1, largest);
  const std::vector<Eigen::Vector3d> valleys = peaks_of(heights, -1, largest);
  peaks.insert(peaks.end(), valleys.begin(), valleys.end());
  double highest = 0;
  const auto height = [&](const Eigen::Vector3d& d) { return std::abs(heights.value(d)); };
  for (const Eigen::Vector3d& d : peaks) highest = std::max(highest, height(d));
  std::vector<Eigen::Vector3d> directions;
  for (const Eigen::Vector3d& d : peaks) {
    if (height(d) < (1 - equal) * highest) continue;
    const auto is_same = [&](const Eigen::Vector3d& other) {
      return d.cross(other).norm() < equal;
    };
    if (std::any_of(directions.begin(), directions.end(), is_same)) continue;
    directions.push_back(d);
    directions.emplace_back(-d);
  }
  return directions;
}

FourthMoments fourth_moments_of(const Surface& surface) {
  FourthMoments sum{};
  double whole = 0;
  for (const auto& face : surface.triangles.rowwise()) {
    const Eigen::Vector3d p = surface.positions.row(face(0));
    const Eigen::Vector3d q = surface.positions.row(face(1));
    const Eigen::Vector3d r = surface.positions.row(face(2));
    const double area = twice_area(p, q, r);
    const FourthMoments moments = fourth_moments_of_triangle(p, q, r);
    for (std::size_t i = 0; i < fourth_moments; ++i) sum[i] += area * moments[i];
    whole += area;
  }
  for (double& moment : sum) moment /= whole;
  return sum;
}

Eigen::Vector3d nearest_line(const FourthMoments& moments) {
  constexpr double clearly = 0.01;
  const Quartic near = nearness(moments);
  std::vector<Eigen::Vector3d> lines{Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(),
                                     Eigen::Vector3d::UnitZ()};
  lines.insert(lines.end(), starts().begin(), starts().end());
  Eigen::Vector3d best = lines.front();
  std::size_t chosen = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (near.value(lines[i]) <= (1 - clearly) * near.value(best)) continue;  // both are negative
    best = lines[i];
    chosen = i;
  }
  return chosen < 3 ? best : climbed(near, best, 1, largest_size(near), enough_steps);
}

}  // namespace curveskel
