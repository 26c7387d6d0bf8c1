// A workbench that is waited for. Waits are bounded by a minute, which only a hang takes.
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <thread>

#include "viewer/workbench/workbench.hpp"

namespace curveskel::viewer {

/// One of those in meshes/.
inline std::filesystem::path mesh_called(const std::string& name) {
  return std::filesystem::path(CURVESKEL_SOURCE_DIR) / "meshes" / name;
}

template <typename Condition>
bool wait_for(Workbench& bench, const Condition& wanted) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  for (bench.update(); !wanted(); bench.update()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

inline bool wait_for_rest(Workbench& bench) {
  return wait_for(bench, [&] { return !bench.busy(); });
}

inline void select_edge(Workbench& bench, int edge) {
  Pick picked;
  picked.kind = Pick::Kind::edge;
  picked.index = edge;
  bench.select(picked, false);
}

inline void select_node(Workbench& bench, int node) {
  Pick picked;
  picked.kind = Pick::Kind::node;
  picked.index = node;
  bench.select(picked, false);
}

inline std::size_t moment_called(const Workbench& bench, const std::string& stage) {
  const auto& moments = bench.scene->recording.moments();
  for (std::size_t i = 0; i < moments.size(); ++i) {
    if (moments[i].stage == stage) return i;
  }
  ADD_FAILURE() << "no moment of " << stage;
  return 0;
}

}  // namespace curveskel::viewer
