// The surfaces that laws run over: the project's own families and real ones.
#pragma once

#include <string>
#include <vector>

#include <curveskel/clean.hpp>
#include <curveskel/read.hpp>
#include "meshes/shapes.hpp"
#include "tests/real_surfaces.hpp"

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

/// The closed manifolds among the real surfaces, cleaned.
inline std::vector<NamedSurface> read_real_surfaces() {
  std::vector<NamedSurface> all;
  for (const auto& file : closed_real_surfaces()) {
    all.push_back({file, clean(read_polygons(*real_surface(file), {}), {}).surface});
  }
  return all;
}

inline const std::vector<NamedSurface>& families() {
  static const std::vector<NamedSurface> all = make_families();
  return all;
}

inline const std::vector<NamedSurface>& real_surfaces() {
  static const std::vector<NamedSurface> all = read_real_surfaces();
  return all;
}

}  // namespace curveskel
