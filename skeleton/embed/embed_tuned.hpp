// The embedding as the pipeline and the test of its constants ask for it.
#pragma once

#include <optional>

#include <curveskel/advanced/embed.hpp>
#include "skeleton/embed/tuning.hpp"

namespace curveskel {

struct EmbedDemand {
  int threads = 0;
  bool all_handles = false;  ///< nothing is made if no cycles can be led round all of them
};

/// See `embed`. Nothing if the demand cannot be met, told before most of the time is spent.
[[nodiscard]] std::optional<CurveSkeleton> embed_tuned(const EmbedInput& input,
                                                       const EmbedOptions& options,
                                                       const EmbedTuning& tuning,
                                                       const EmbedDemand& demand, StepClock& clock,
                                                       const Monitor& monitor);

}  // namespace curveskel
