// The values of an extraction's stages, with their keys: a later extraction may take them again.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <curveskel/advanced/coarsen.hpp>
#include <curveskel/advanced/inscribed_balls.hpp>
#include <curveskel/advanced/tree.hpp>
#include <curveskel/extract.hpp>
#include <curveskel/lives.hpp>
#include <curveskel/topology.hpp>
#include "skeleton/cut/as_contracted.hpp"
#include "skeleton/cut/level_set_graph.hpp"
#include "skeleton/pipeline/stage_clock.hpp"
#include "surface/mesh/overlaps.hpp"
#include "surface/resample/canonical.hpp"

namespace curveskel {

template <typename Value>
using Shared = std::shared_ptr<const Value>;

/// A stage's value, and as its key all that it was made from: the options that the stage reads and
/// the values of earlier stages, by identity. A key holds on to these, so that no other value can
/// come to stand in their place.
template <typename Key, typename Value>
struct Kept {
  Key key{};
  Shared<Value> value;
};

/// Options without those that leave the result as it is.
[[nodiscard]] inline FairOptions what_counts(FairOptions options) {
  options.threads = 0;
  options.program_cache.clear();
  return options;
}
[[nodiscard]] inline ContractionOptions what_counts(ContractionOptions options) {
  options.threads = 0;
  options.program_cache.clear();
  return options;
}
[[nodiscard]] inline CertificateOptions what_counts(CertificateOptions options) {
  options.threads = 0;
  return options;
}

/// The number of working vertices that a component may have.
struct WorkingSize {
  int least = 0;
  int most = 0;

  [[nodiscard]] bool operator==(const WorkingSize&) const = default;
};

struct WorkingBalls {
  SurfaceTree rough;  ///< over the working surface
  SurfaceTree near;   ///< over the surface of the inscribed balls
  InscribedBalls balls;
  Positions targets;  ///< where the contraction is pulled to: the balls' centres, smoothed
};

/// The level-set Reeb graph, made if the surgery gave up.
struct LevelSets {
  LevelSetGraph cut;
  Eigen::VectorXi vertex_of_input;  ///< canonical vertex -> vertex of the cut surface
  InscribedBalls balls;
};

struct ContractionAttempt {
  Kept<std::tuple<Shared<WorkingBalls>, ContractionOptions>, Contraction> contraction;
  Kept<std::tuple<Shared<Contraction>, SurgeryOptions>, std::optional<PartitionGraph>> graph;
};

/// Without embedding. The balls are null where the flow needs none.
struct StagesAsContracted {
  Kept<std::tuple<Shared<Coarsened>, Shared<WorkingBalls>, ContractionOptions>, Contraction>
      contraction;
  Kept<std::tuple<Shared<Contraction>, SurgeryOptions>, SkeletonAsContracted> operated;
  Kept<std::tuple<Shared<SkeletonAsContracted>>, CurveSkeleton> skeleton;
};

/// All that the surgery and growth make, in the working surface's numbers, with lives.
struct EmbeddedCurve {
  CurveSkeleton skeleton;
  std::vector<TipLife> lives;  ///< of the working surface
};

/// Of one component, in its canonical frame but for the skeleton, which is in the model's.
struct ComponentStages {
  Kept<std::monostate, Canonical> canonical;
  Kept<std::tuple<Shared<Canonical>>, SurfaceTree> tree;  ///< over the canonical surface
  Kept<std::tuple<Shared<Canonical>, FairOptions>, Surface> faired;
  Kept<std::tuple<Shared<Surface>, WorkingSize>, Coarsened> working;
  Kept<std::tuple<Shared<Coarsened>>, WorkingBalls> balls;
  Kept<std::tuple<Shared<Coarsened>>, std::vector<TipLife>> lives;
  std::array<ContractionAttempt, 2> contractions;  ///< as asked, and gentler
  Kept<std::tuple<Shared<WorkingBalls>>, LevelSets> level_sets;
  /// The number is the component's extent over the whole's; nothing if it misses handles that it
  /// must find.
  Kept<std::tuple<Shared<PartitionGraph>, EmbedOptions, double, bool>, std::optional<EmbeddedCurve>>
      curve;
  /// The number is the level of detail.
  Kept<std::tuple<Shared<std::optional<EmbeddedCurve>>, double>, CurveSkeleton> skeleton;
  StagesAsContracted as_contracted;
  std::shared_ptr<ComponentStages> of_all_vertices;  ///< if the coarsened one misses handles
};

struct Parts {
  Topology counted;
  std::vector<Component> components;
  Overlaps overlaps;
};

struct CertifiedSkeleton {
  CurveSkeleton skeleton;
  Certificate certificate;
};

/// Of a whole surface. The certified skeleton has all components' skeletons.
struct SurfaceStages {
  using CertifiedFrom = std::tuple<std::vector<Shared<CurveSkeleton>>,
                                   std::vector<std::vector<std::int32_t>>, CertificateOptions>;
  Kept<std::monostate, Parts> parts;
  Kept<std::monostate, SurfaceTree> tree;  ///< over all components, if there are several
  std::vector<ComponentStages> components;
  Kept<CertifiedFrom, CertifiedSkeleton> certified;
};

struct ExtractionCache::Implementation {
  Surface surface;
  SurfaceStages as_asked;
  SurfaceStages all_vertices;  ///< see ExtractOptions::all_vertices_if_failed
  SurfaceStages faired;        ///< see ExtractOptions::fair_if_outside

  /// Forgets everything if it is of another surface.
  void keep_only(const Surface& wanted);
};

/// Runs stages, or takes their kept values.
class StageRun {
 public:
  /// Times go to `times`, the names of stages whose value was kept to `reused`; unless `keep`,
  /// values live no longer than their users.
  StageRun(std::vector<StageTime>& times, std::vector<std::string>& reused, const Monitor& monitor,
           bool keep)
      : clock(times), reused_(reused), monitor_(monitor), keep_(keep) {}

  /// work makes the value from `key`, see StageClock. The value kept stays until the new one is
  /// there, so that a cancelled run takes nothing away. Throws Cancelled if a stop was requested.
  template <typename Key, typename Value, typename Work>
  Shared<Value> operator()(const char* stage, Kept<Key, Value>& kept, std::type_identity_t<Key> key,
                           const Work& work) {
    throw_if_stopped(monitor_.stop);
    if (kept.value && kept.key == key) {
      reused_.emplace_back(stage);
      return kept.value;
    }
    Shared<Value> made = std::make_shared<const Value>(clock(stage, work));
    if (keep_) kept = {std::move(key), made};
    return made;
  }

  [[nodiscard]] bool keeps() const { return keep_; }

  StageClock clock;

 private:
  std::vector<std::string>& reused_;
  const Monitor& monitor_;
  bool keep_;
};

}  // namespace curveskel
