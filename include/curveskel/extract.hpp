// The whole way from a clean surface to its certified curve skeleton.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <curveskel/advanced/embed.hpp>
#include <curveskel/advanced/extraction_cache.hpp>
#include <curveskel/advanced/step_clock.hpp>
#include <curveskel/advanced/surgery.hpp>
#include <curveskel/certificate.hpp>
#include <curveskel/contract.hpp>
#include <curveskel/curve_skeleton.hpp>
#include <curveskel/fair.hpp>
#include <curveskel/monitor.hpp>
#include <curveskel/surface.hpp>
#include <curveskel/tries.hpp>

namespace curveskel {

struct ExtractOptions {
  /// Working vertices for the whole surface, but 32 for each handle of a component; 0 = all.
  int resolution = 8000;
  /// Working vertices for each component; fewer are refined. Of more than 133 components each is
  /// sure of fewer, 200,000 over their number, but none is coarsened to fewer than 200 or left at
  /// fewer than 100.
  int least_resolution = 1500;
  /// 0 = one per core; the result does not depend on it. Counts for every stage, whatever `threads`
  /// of the stage's own options says.
  int threads = 0;
  bool fairing = false;  ///< clean the input by `fair` first
  /// Vertices round each hole that was closed (RepairedSurface::rims): where a tip faces one,
  /// the curve goes on to it, see `reach_rims`.
  std::vector<std::vector<std::int32_t>> rims;
  FairOptions fair;
  /// If the certificate finds too much outside: make the components that the curve leaves once
  /// more, with thirty iterations of fairing, and keep the better ones.
  bool fair_if_outside = true;
  /// If the topology is still wrong, or too much outside: make the components that are to blame, if
  /// they have 80,000 vertices at most, once more with all of them, just below the surface where
  /// nothing else leads on inside (EmbedOptions::go_below), and keep the better ones. Those that
  /// have all of them and nothing outside only if they do not cross themselves. A component that
  /// was coarsened is made so at once if its cycles cannot be led round all of its handles.
  bool all_vertices_if_failed = true;
  ContractionOptions contraction;
  SurgeryOptions surgery;
  EmbedOptions embed;
  CertificateOptions certificate;
};

/// Throws Error(Fault::usage) that names the first option out of its range, the value and the
/// range.
void require_valid(const ExtractOptions& options);

struct StageTime {
  std::string stage;
  double seconds = 0;
  std::vector<StepTime> steps{};  ///< of a stage that tells them, in the order of first use
};

/// The record of one component.
struct ComponentRecord {
  int vertices = 0;          ///< of the surface passed in
  int working_vertices = 0;  ///< after coarsening or refining
  int genus = 0;
  int inside_component = -1;  ///< the smallest that it lies wholly inside of; -1 = free
  std::vector<int> overlaps;  ///< the components that it crosses or touches, ascending
  std::vector<Step> steps;    ///< of the last contraction
  Stop stop = Stop::iterations;
};

struct Extraction {
  CurveSkeleton skeleton;  ///< node_of_vertex indexes the vertices of the surface passed in
  std::vector<ComponentRecord> components;  ///< in the order of `topology`
  Certificate certificate;
  std::vector<StageTime> times;  ///< in the order of the stages, summed over the components; only
                                 ///< of those that ran
  std::vector<std::string> reused;  ///< stages all of which came from the ExtractionCache, in order
  std::vector<Try> history;         ///< of all tries, in the order in which they were begun
};

/// normalise, fair, coarsen, balls, contract, surgery, embed and certify, each component on its
/// own. A component that the surgery finds no cut for is contracted once more, gently; where that
/// does not help, level sets cut it. If the certificate fails, all this is tried again as the
/// options say. A try that fails by an Error or a lack of memory leaves what there is; an
/// Error(Fault::usage) and Cancelled pass through any. Precondition: a clean surface (see Surface).
/// The certificate of a single component is taken against its canonical form in the model's frame,
/// which may differ from the surface by `canonical_step` / 2 of D per coordinate; that of several
/// against the surface itself. Throws Error(Fault::solver) when a component cannot be contracted,
/// Cancelled on a stop.
[[nodiscard]] Extraction extract(const Surface& surface, const ExtractOptions& options = {},
                                 const Monitor& monitor = {});

/// The same result, byte for byte (but for the seconds that steps took), in less time: stages whose
/// input and options are those of the last run that reached them are taken from `cache`. `threads`
/// and `program_cache` make no difference. A surface of other content empties the cache first; to
/// see that takes one pass over the arrays. Of a run that threw, Cancelled or an error, the cache
/// has the stages that came to their end. A stage that is reused shows no frames and no progress.
[[nodiscard]] Extraction extract(const Surface& surface, const ExtractOptions& options,
                                 const Monitor& monitor, ExtractionCache& cache);

}  // namespace curveskel
