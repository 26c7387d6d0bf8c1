// The picture in the window: drawn anew only if its content has changed, no finer than the
// machine can draw in time while things move, and whole once they rest.
#pragma once

#include <chrono>
#include <cstddef>
#include <memory>

#include "viewer/render/renderer.hpp"
#include "viewer/render/scene.hpp"
#include "viewer/software/pace.hpp"
#include "viewer/software/warm_up.hpp"

namespace curveskel::viewer {

class WindowPicture {
 public:
  /// Compiles everything that the driver would compile at the first picture.
  WindowPicture() { warm_up(renderer_, pace_); }

  /// Brings it up to date; false if there was nothing to do. Waits until it is drawn.
  bool draw(Scene& scene, int width, int height);
  /// Into the window, its lower left corner there.
  void show(int left, int bottom) const;
  /// The rest of the frame took so long.
  void add_rest(double milliseconds) { pace_.measured_rest(milliseconds); }

  /// True if a finer picture is due now, or will be once things rest.
  [[nodiscard]] bool unrefined() const { return unrefined_; }
  [[nodiscard]] bool moving() const;
  /// True if the picture is simpler than it will be at rest.
  [[nodiscard]] bool coarse() const { return coarse_; }

  [[nodiscard]] Renderer& renderer() { return renderer_; }
  [[nodiscard]] int width() const { return drawn_.width; }
  [[nodiscard]] int height() const { return drawn_.height; }
  /// Someone else has drawn with its renderer.
  void forget() { drawn_ = {}; }

  bool may_be_coarse = true;

 private:
  /// The content of the last picture; if equal, the picture need not be drawn again.
  struct Shown {
    Camera camera;
    Look look;
    Highlights highlights;
    std::shared_ptr<const CurveSkeleton> skeleton;
    std::shared_ptr<const Rig> rig;
    std::shared_ptr<const JointTurns> turns;
    std::shared_ptr<const DrawnMaterials> materials;
    const Scene* scene = nullptr;
    std::size_t moment = 0;
    std::size_t moments = 0;
    int width = 0;
    int height = 0;
    Fineness fineness;
    [[nodiscard]] bool shows_same(const Shown& other) const;
  };
  Fineness fineness_now(const Pace::Load& load, bool same);

  Renderer renderer_;
  Pace pace_;
  Shown drawn_;
  bool unrefined_ = false;
  bool coarse_ = false;
  std::chrono::steady_clock::time_point moved_ = std::chrono::steady_clock::now();
};

}  // namespace curveskel::viewer
