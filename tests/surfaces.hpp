// The surfaces that laws run over: the project's own families and, where they are, real ones.
#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <curveskel/clean.hpp>
#include <curveskel/read.hpp>
#include "meshes/shapes.hpp"

namespace curveskel {

struct NamedSurface {
  std::string name;
  Surface surface;
};

inline std::vector<NamedSurface> make_families() {
  std::vector<NamedSurface> all;
  for (const auto& entry : shapes::catalogue()) {
    all.push_back({std::string(entry.name), entry.make().surface});
  }
  return all;
}

/// The closed manifolds among the shared meshes, cleaned; empty where there are none.
inline std::vector<NamedSurface> read_shared_meshes() {
  const std::filesystem::path folder = CURVESKEL_SHARED_MESHES;
  std::vector<NamedSurface> all;
  std::ifstream index(folder / "INDEX.csv");
  for (std::string line; std::getline(index, line);) {
    std::vector<std::string> cells;
    std::istringstream cut(line);
    for (std::string cell; cells.size() < 9 && std::getline(cut, cell, ',');) cells.push_back(cell);
    if (cells.size() < 9 || cells[0].starts_with("defects/")) continue;
    if (cells[6] != "y" || cells[7] != "y" || cells[8] != "y") continue;  // closed, manifold, ...
    all.push_back({cells[0], clean(read_polygons(folder / cells[0], {}), {}).surface});
  }
  return all;
}

inline const std::vector<NamedSurface>& families() {
  static const std::vector<NamedSurface> all = make_families();
  return all;
}

inline const std::vector<NamedSurface>& shared_meshes() {
  static const std::vector<NamedSurface> all = read_shared_meshes();
  return all;
}

}  // namespace curveskel
