// Shapes with their skeletons, for laws of what is shown.
#pragma once

#include <string>
#include <vector>

#include <curveskel/extract.hpp>
#include "meshes/shapes.hpp"
#include "viewer/model/document.hpp"

namespace curveskel::viewer::extracted_shapes {

struct Extracted {
  std::string name;
  Surface surface;
  CurveSkeleton skeleton;
};

/// One, two and many parts, with and without junctions and loops.
inline const std::vector<Extracted>& family() {
  static const std::vector<Extracted> made = [] {
    std::vector<Extracted> all;
    for (const shapes::Shape& shape :
         {shapes::torus(3, 1, 10), shapes::linked_rings(3, 0.7, 8),
          shapes::tube_union("y", shapes::star(3, 6, 1)), shapes::cone(1, 4, 16)}) {
      all.push_back({shape.name, shape.surface, extract(shape.surface, {}, {}).skeleton});
    }
    return all;
  }();
  return made;
}

inline Document document_of(const Surface& surface, const CurveSkeleton* skeleton = nullptr) {
  Document document;
  document.surface = surface;
  if (skeleton != nullptr) document.skeleton = *skeleton;
  document.space = space_round(surface.positions);
  return document;
}

}  // namespace curveskel::viewer::extracted_shapes
