// Everything that a run showed on its way, to go back and forth in.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include <curveskel/curve_skeleton.hpp>
#include <curveskel/monitor.hpp>
#include <curveskel/rig.hpp>
#include <curveskel/rig_character.hpp>
#include <curveskel/tries.hpp>
#include "viewer/render/shapes_shown.hpp"

namespace curveskel::viewer {

/// One entry of the timeline.
struct Moment {
  std::string stage;  ///< "input", "fair", "contract", "surgery", "skeleton", "rig"
  int component = 0;
  int iteration = 0;
  int try_number = -1;                          ///< in the history of the run; -1 = of none
  int of_surface = -1;                          ///< see ShownTry
  std::string try_name;                         ///< the same
  double area_ratio = 1;                        ///< of the component's area when the stage began
  double volume_ratio = 1;                      ///< the same of its volume
  double residual = 0;                          ///< of the solve; 0 where nothing was solved
  double seconds = 0;                           ///< since the run began
  std::shared_ptr<const ShownSurface> surface;  ///< the component then; null where all is as given
  std::shared_ptr<const CurveSkeleton> skeleton;  ///< of all, but the component's own for
                                                  ///< "surgery"; null before it is there
  std::shared_ptr<const Rig> rig;                 ///< by the file's vertices; null but for "rig"
  std::shared_ptr<const CharacterRig> character;  ///< the same with its plan and parts
};

/// "contraction 3 (faired)", "input": what a person calls it.
[[nodiscard]] std::string title_of(const Moment& moment);

/// A value; copies share the surfaces.
class Recording {
 public:
  /// Only the input.
  Recording();
  /// It is among the moments, whatever try it is of, until `settle`.
  void add(Moment moment);
  /// The run has come to its end with this history: the moments are those of the tries that were
  /// kept. The others are set aside.
  void settle(const std::vector<Try>& history);
  /// Brings those that were set aside back among the moments, or takes them away again.
  void show_all_tries(bool all);
  [[nodiscard]] bool shows_all_tries() const { return shows_all_tries_; }
  [[nodiscard]] bool has_other_tries() const { return has_other_tries_; }
  /// Forgets the moments of `stage` and of those that come after it, of all components.
  void cut_from(std::string_view stage);
  [[nodiscard]] const std::vector<Moment>& moments() const { return moments_; }

  /// The components' surfaces as they were at moment `index` in the try that it is of, put
  /// together; empty where none has changed yet or the skeleton is there. O(vertices shown +
  /// moments).
  [[nodiscard]] ShownSurface surface_at(std::size_t index) const;
  /// The components' surfaces as fairing had left them at moment `index` in the try that it is of;
  /// those that it came to later as it found them. O(vertices shown + moments).
  [[nodiscard]] ShownSurface faired_at(std::size_t index) const;
  /// That of the last moment up to `index` in its try that has one, or null.
  [[nodiscard]] std::shared_ptr<const ShownSurface> newest_surface(std::size_t index) const;
  /// The latest skeleton up to moment `index`, of no other try than that, or null; after surgery
  /// the curves of all components that have one. The same pointer while the moments are.
  /// O(moments), and O(nodes) where it is another one than at the last call.
  [[nodiscard]] std::shared_ptr<const CurveSkeleton> skeleton_at(std::size_t index) const;

 private:
  /// One moment, and if it is of a try that was not kept.
  struct Recorded {
    Moment moment;
    bool aside = false;
  };
  void choose();
  [[nodiscard]] std::shared_ptr<const CurveSkeleton> curves_at(std::size_t index) const;

  std::vector<Recorded> all_;
  std::vector<Moment> moments_;  // those of `all_` that are shown
  bool shows_all_tries_ = false;
  bool has_other_tries_ = false;
  // The curves that were last put together, and what they became.
  mutable std::vector<std::shared_ptr<const CurveSkeleton>> curves_;
  mutable std::shared_ptr<const CurveSkeleton> all_curves_;
};

/// A moment from a stage's frame. `before` is null or an earlier moment's surface, whose simpler
/// form it takes over where the triangles are the same, which both share then.
[[nodiscard]] Moment moment_of(const Frame& frame, const DrawnSpace& space, double seconds,
                               const ShownSurface* before = nullptr);
/// The component's curve alone.
[[nodiscard]] Moment moment_of(const CurveFrame& curve, double seconds);

}  // namespace curveskel::viewer
