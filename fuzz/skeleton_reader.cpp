// Any bytes as a skeleton file: either an error about the input or a graph that holds together.
// CURVESKEL_READER is the reader, CURVESKEL_JOINING how read_skeleton joins its points.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include <curveskel/error.hpp>
#include "skeleton/io/raw_graph.hpp"

namespace {

using namespace curveskel;

void require(bool holds) {
  if (!holds) std::abort();
}

void check(const CurveSkeleton& skeleton) {
  require(skeleton.nodes.allFinite());
  require(skeleton.radii.size() == 0 || skeleton.radii.size() == skeleton.nodes.rows());
  for (const auto& edge : skeleton.edges.rowwise()) {
    require(0 <= edge(0) && edge(0) < edge(1) && edge(1) < skeleton.nodes.rows());
  }
  for (const int node : skeleton.node_of_vertex) {
    require(-1 <= node && node < skeleton.nodes.rows());
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const FileBytes file{"fuzzed", std::string(reinterpret_cast<const char*>(data), size)};
  try {
    check(skeleton_from(CURVESKEL_READER(file), Joining::CURVESKEL_JOINING));
  } catch (const Error& error) {
    require(error.fault() == Fault::input);
  }
  return 0;
}
