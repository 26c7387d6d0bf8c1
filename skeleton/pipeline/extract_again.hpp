// Another try of a whole surface that makes again only the components that are to blame.
#pragma once

#include <functional>
#include <string_view>

#include <curveskel/certificate.hpp>
#include <curveskel/extract.hpp>
#include "skeleton/pipeline/extraction_plans.hpp"

namespace curveskel {

/// Another way to make a component, and for which ones it may help.
struct AnotherWay {
  std::string_view name;  ///< of the try
  const ExtractOptions& options;
  std::function<bool(const ComponentResult&, const Surface&, const Certificate&)> may_help;
};

/// The best so far with the components for which the way may help by their own certificates, made
/// again; each stays as it was unless its certificate is better then. A single component is always
/// made again, and not judged here. `kept` may be null.
/// Throws GaveUp if none is better, and what the last one threw if all failed.
[[nodiscard]] Extracted extract_again(const Surface& surface, const AnotherWay& way,
                                      SurfaceStages* kept, const Plan<Extracted>::Room& room);

/// True if the topology is right where it was wrong, or else more of the curve is inside.
[[nodiscard]] bool better_than(const Certificate& one, const Certificate& other);

}  // namespace curveskel
