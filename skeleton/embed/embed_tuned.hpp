// The embedding with other constants than the usual ones, for the test that moves each of them.
#pragma once

#include <curveskel/advanced/embed.hpp>
#include "skeleton/embed/tuning.hpp"

namespace curveskel {

/// See `embed`.
[[nodiscard]] CurveSkeleton embed_tuned(const EmbedInput& input, const EmbedOptions& options,
                                        const EmbedTuning& tuning, int threads, StepClock& clock,
                                        const Monitor& monitor);

}  // namespace curveskel
