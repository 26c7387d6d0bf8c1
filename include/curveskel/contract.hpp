// Global Laplacian contraction: the surface collapses onto its curve skeleton.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <vector>

#include <curveskel/advanced/least_squares.hpp>
#include <curveskel/advanced/names.hpp>
#include <curveskel/monitor.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

enum class Flow { medial, paper };

inline constexpr NameTable<Flow, 2> flows{{
    {Flow::medial, "medial", "first-order flow drawn to the centres of the inscribed balls"},
    {Flow::paper, "paper", "stacked least squares of the paper (eq. 3)"},
}};

enum class Stop { volume, area, stalled, iterations };

inline constexpr NameTable<Stop, 4> stops{{
    {Stop::volume, "volume", "the volume is below the limit"},
    {Stop::area, "area", "the area is below the limit"},
    {Stop::stalled, "stalled", "neither area nor volume shrinks any more"},
    {Stop::iterations, "iterations", "the largest number of iterations was reached"},
}};

struct ContractionOptions {
  Flow flow = Flow::medial;
  Solver solver = Solver::automatic;
  std::filesystem::path program_cache;  ///< see SolverOptions
  int max_iterations = 40;
  double contraction_weight = 3;    ///< medial: w_L of the first iteration; unit-free
  double contraction_growth = 2;    ///< s_L: factor on w_L (medial) or W_L (paper) per iteration
  double medial_weight = 1;         ///< W_M: pull towards the inscribed ball's centre; unit-free
  double paper_weight = 1e3;        ///< paper: W_L of the first iteration / sqrt(mean face area)
  double attraction_weight = 1;     ///< paper: W_H0
  double collapse_length = 0.3;     ///< edges shorter than this x initial mean edge collapse
  double stop_volume_ratio = 1e-7;  ///< of the initial volume; counts once the area is small, too
  double stop_area_ratio = 1e-3;    ///< of the initial area
  double small_area_ratio = 1e-2;   ///< a flat sheet has no volume: above this it contracts on
  int threads = 0;                  ///< see SolverOptions

  [[nodiscard]] bool operator==(const ContractionOptions&) const = default;
};

/// Throws Error(Fault::usage) that names the first option out of its range, the value and the
/// range.
void require_valid(const ContractionOptions& options);

struct Step {
  double area_ratio = 1;    ///< area / initial area after the step
  double volume_ratio = 1;  ///< |volume| / initial volume after the step
  double residual = 0;      ///< see Solution::residual
  double seconds = 0;
  int vertices = 0;  ///< left after the step
  int solver_iterations = 0;
  Solver solver = Solver::automatic;  ///< the back end that was used
};

struct Contraction {
  Surface surface;                  ///< contracted; may have fewer vertices than the input
  Eigen::VectorXi vertex_of_input;  ///< #V of the input: the vertex that it was merged into
  std::vector<Step> steps;          ///< accepted iterations only
  Stop stop = Stop::iterations;
};

/// Contracts a closed oriented surface. `centres` (#V by 3), the inscribed balls' centres, are
/// needed by Flow::medial and ignored by Flow::paper. An iteration after which area or |volume|
/// would have grown is not accepted, so both sequences in `steps` never grow.
/// A frame for the start and for each of `steps`.
/// The connectivity shrinks by edge collapses under the link condition: the topology is kept.
[[nodiscard]] Contraction contract(const Surface& surface, const Positions& centres,
                                   const ContractionOptions& options = {},
                                   const Monitor& monitor = {});

}  // namespace curveskel
