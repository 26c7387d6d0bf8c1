// The order in which a tree's nodes come behind their parents. Internal to rig/.
#pragma once

#include <vector>

namespace curveskel {

/// Numbers of nodes, parents before children, depth first; of several that may come next the first.
/// `parents`: -1 = none. Nodes that hang from themselves are missing. O(nodes).
[[nodiscard]] std::vector<int> parents_first(const std::vector<int>& parents);

}  // namespace curveskel
