// The plans for an extraction of a whole surface: the first is what was asked for, each other one
// is for certificates that fail.
#pragma once

#include <string>
#include <vector>

#include <curveskel/extract_repaired.hpp>
#include "skeleton/pipeline/component.hpp"
#include "skeleton/pipeline/stages.hpp"
#include "skeleton/pipeline/try_loop.hpp"

namespace curveskel {

/// One extraction, and the components it was put together from.
struct Assembled {
  Extraction extraction;  ///< without history
  Shared<Parts> parts;
  std::vector<ComponentResult> components;
};

/// The outcome of one try of a whole surface.
struct Extracted {
  RepairedExtraction found;
  std::string note;  ///< for the user, if it is the result
  Shared<Parts> parts;
  std::vector<ComponentResult> components;
};

/// As asked, faired, and from all vertices, see ExtractOptions. All refer to what is given; `kept`
/// may be null.
[[nodiscard]] std::vector<Plan<Extracted>> extraction_plans(const Surface& surface,
                                                            const ExtractOptions& options,
                                                            ExtractionCache::Implementation* kept);

/// The best of what the plans lead to, with the history, and the times of all. Says what was done.
/// Throws what the last plan threw if none led to anything.
[[nodiscard]] RepairedExtraction carry_out_plans(const std::vector<Plan<Extracted>>& plans,
                                                 const Monitor& monitor);

/// One extraction, as the options say, without another try of the whole. Components that stand are
/// not made again. The tries within it are part of try `part_of`.
[[nodiscard]] Assembled extract_once(const Surface& surface, const ExtractOptions& options,
                                     const Monitor& monitor, SurfaceStages* kept, TryLog& log,
                                     int part_of, StandingResults standing = {});

/// Of the stages in `taken` those that never ran, in order, each once.
[[nodiscard]] std::vector<std::string> only_reused(const std::vector<std::string>& taken,
                                                   const std::vector<StageTime>& ran);

/// The options with the extraction's threads in every stage, once they and the surface are checked.
/// Throws Error(Fault::usage) for an option out of its range, Error(Fault::input) unless the
/// surface is closed and a manifold.
[[nodiscard]] ExtractOptions admitted(const Surface& surface, const ExtractOptions& options);

/// Options with which one component alone is extracted as it will be among the others.
[[nodiscard]] ExtractOptions options_for_one(const ExtractOptions& options,
                                             double share_of_vertices);

}  // namespace curveskel
