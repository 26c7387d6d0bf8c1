// The viewer's only verb.
#pragma once

#include "app/verbs/verbs.hpp"

namespace curveskel::viewer {

[[nodiscard]] Verb add_view(CLI::App& program);

}  // namespace curveskel::viewer
