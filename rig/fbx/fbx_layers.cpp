#include "rig/fbx/fbx_layers.hpp"

#include <cmath>

#include "rig/gltf/dressed_mesh.hpp"

namespace curveskel {
namespace {

std::string_view text_in(const FbxRecord& layer, std::string_view name) {
  const FbxRecord* child = layer.child(name);
  return child == nullptr ? std::string_view() : child->text(0);
}

std::vector<double> numbers_in(const FileBytes& file, const FbxRecord& layer,
                               std::string_view name) {
  const FbxRecord* child = layer.child(name);
  return child == nullptr ? std::vector<double>() : fbx_numbers(file, *child);
}

}  // namespace

std::vector<const FbxRecord*> fbx_sets(const FbxRecord& geometry, std::string_view name) {
  std::vector<const FbxRecord*> sets;
  for (const FbxRecord& child : geometry.children) {
    if (child.name == name && sets.size() < most_sets) sets.push_back(&child);
  }
  return sets;
}

FbxLayer::FbxLayer(const FileBytes& file, const FbxRecord* record, std::string_view values,
                   std::string_view indices, std::size_t width)
    : width_(width) {
  if (record == nullptr) return;
  const std::string_view mapping = text_in(*record, "MappingInformationType");
  if (mapping == "ByPolygonVertex") given_ = Given::by_corner;
  if (mapping == "ByVertice" || mapping == "ByVertex") given_ = Given::by_vertex;
  if (mapping == "ByPolygon") given_ = Given::by_polygon;
  if (mapping == "AllSame") given_ = Given::for_all;
  if (given_ == Given::nowhere) return;
  values_ = numbers_in(file, *record, values);
  const std::string_view reference = text_in(*record, "ReferenceInformationType");
  is_indexed_ = !indices.empty() && (reference == "IndexToDirect" || reference == "Index");
  if (is_indexed_) indices_ = numbers_in(file, *record, indices);
}

std::int64_t FbxLayer::row_of(const FbxCorner& corner) const {
  if (given_ == Given::nowhere) return -1;
  std::size_t place = 0;
  if (given_ == Given::by_corner) place = corner.corner;
  if (given_ == Given::by_vertex) place = corner.vertex;
  if (given_ == Given::by_polygon) place = corner.polygon;
  auto row = static_cast<double>(place);
  if (is_indexed_) row = place < indices_.size() ? indices_[place] : -1;
  const bool is_there = row >= 0 && row < static_cast<double>(rows()) && std::floor(row) == row;
  return is_there ? static_cast<std::int64_t>(row) : -1;
}

}  // namespace curveskel
