#include <curveskel/advanced/extraction_cache.hpp>

#include <cstring>

#include "skeleton/pipeline/stages.hpp"

namespace curveskel {
namespace {

template <typename Rows>
bool same_bytes(const Rows& a, const Rows& b) {
  const auto bytes = static_cast<std::size_t>(a.size()) * sizeof(typename Rows::Scalar);
  return a.rows() == b.rows() && (bytes == 0 || std::memcmp(a.data(), b.data(), bytes) == 0);
}

/// Slots are written to, so each cache has its own; values are shared.
void copy_slots_of_all_vertices(SurfaceStages& stages) {
  for (ComponentStages& component : stages.components) {
    if (component.of_all_vertices == nullptr) continue;
    component.of_all_vertices = std::make_shared<ComponentStages>(*component.of_all_vertices);
  }
}

}  // namespace

ExtractionCache::ExtractionCache() = default;
ExtractionCache::~ExtractionCache() = default;
ExtractionCache::ExtractionCache(ExtractionCache&&) noexcept = default;
ExtractionCache& ExtractionCache::operator=(ExtractionCache&&) noexcept = default;

ExtractionCache ExtractionCache::copy() const {
  ExtractionCache other;
  if (!implementation_) return other;
  other.implementation_ = std::make_unique<Implementation>(*implementation_);
  Implementation& copied = *other.implementation_;
  for (SurfaceStages* stages : {&copied.as_asked, &copied.all_vertices, &copied.faired}) {
    copy_slots_of_all_vertices(*stages);
  }
  return other;
}

ExtractionCache::Implementation& ExtractionCache::implementation() {
  if (!implementation_) implementation_ = std::make_unique<Implementation>();
  return *implementation_;
}

void ExtractionCache::Implementation::keep_only(const Surface& wanted) {
  if (same_bytes(surface.positions, wanted.positions) &&
      same_bytes(surface.triangles, wanted.triangles)) {
    return;
  }
  *this = {};
  surface = wanted;
}

}  // namespace curveskel
