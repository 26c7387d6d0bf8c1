// Values that an extraction leaves, so that the next one runs only the stages that changed.
#pragma once

#include <memory>

namespace curveskel {

/// The stages' values of the last extractions of one surface, see the `extract` that takes one.
/// Movable, not copyable; what was moved from is empty. For one extraction at a time. Holds a copy
/// of the surface, its canonical form and the trees over it: about 0.4 KB a vertex, and as much
/// again for what fairing makes.
class ExtractionCache {
 public:
  ExtractionCache();
  ~ExtractionCache();
  ExtractionCache(ExtractionCache&&) noexcept;
  ExtractionCache& operator=(ExtractionCache&&) noexcept;
  ExtractionCache(const ExtractionCache&) = delete;
  ExtractionCache& operator=(const ExtractionCache&) = delete;

  /// Another one that begins with the same values, which the two share; from then on each may serve
  /// an extraction of its own at the same time. O(#V).
  [[nodiscard]] ExtractionCache copy() const;

  struct Implementation;

  /// For `extract`: the kept stages, made if there are none.
  [[nodiscard]] Implementation& implementation();

 private:
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace curveskel
