#include "rig/joints/parents_first.hpp"

#include <cstddef>

#include <curveskel/advanced/indices.hpp>

namespace curveskel {

std::vector<int> parents_first(const std::vector<int>& parents) {
  std::vector<int> order;
  std::vector<std::vector<int>> children(parents.size());
  std::vector<int> open;
  for (std::size_t k = parents.size(); k-- > 0;) {
    std::vector<int>& siblings = parents[k] < 0 ? open : children[idx(parents[k])];
    siblings.push_back(static_cast<int>(k));
  }
  while (!open.empty()) {
    const int node = open.back();
    open.pop_back();
    order.push_back(node);
    open.insert(open.end(), children[idx(node)].begin(), children[idx(node)].end());
  }
  return order;
}

}  // namespace curveskel
