#include "viewer/window/window_picture.hpp"

#include <epoxy/gl.h>

#include <algorithm>

namespace curveskel::viewer {
namespace {

double elapsed_seconds(std::chrono::steady_clock::time_point then) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - then).count();
}

bool same_camera(const Camera& a, const Camera& b) {
  return a.target == b.target && a.orientation == b.orientation && a.distance == b.distance &&
         a.orthographic == b.orthographic && a.field_of_view == b.field_of_view;
}

}  // namespace

bool WindowPicture::Shown::shows_same(const Shown& other) const {
  return same_camera(camera, other.camera) && look == other.look &&
         highlights == other.highlights && skeleton == other.skeleton && rig == other.rig &&
         turns == other.turns && materials == other.materials && scene == other.scene &&
         moment == other.moment && moments == other.moments && width == other.width &&
         height == other.height;
}

bool WindowPicture::moving() const {
  constexpr double rest_seconds = 0.3;
  return elapsed_seconds(moved_) <= rest_seconds;
}

Fineness WindowPicture::fineness_now(const Pace::Load& load, bool same) {
  if (!same) moved_ = std::chrono::steady_clock::now();
  const Fineness resting = may_be_coarse ? pace_.at_rest(load) : Fineness{};
  const bool moves = moving();
  const Fineness now = moves && may_be_coarse ? pace_.while_moving(load) : resting;
  unrefined_ = moves || !(now == resting);
  return now;
}

bool WindowPicture::draw(Scene& scene, int width, int height) {
  if (drawn_.scene != &scene) scene.forget_uploads();
  Shown now{scene.camera,
            scene.look_now(),
            scene.highlights,
            scene.skeleton(),
            scene.rig(),
            scene.turns(),
            scene.materials,
            &scene,
            scene.moment,
            scene.recording.moments().size(),
            width,
            height,
            {}};
  now.look.transparent_background = false;  // that of files; a window has nothing behind it
  if (!moving()) coarse_ = false;
  const bool same = now.shows_same(drawn_);
  const Pace::Load load{scene.sizes(), static_cast<double>(width) * height};
  now.fineness = fineness_now(load, same);
  if (same && (moving() || !finer(now.fineness, drawn_.fineness))) return false;
  const bool uploaded = scene.upload(renderer_);
  const auto began = std::chrono::steady_clock::now();
  const int shrink = now.fineness.shrink;
  const bool anew = renderer_.draw(
      scene.camera, now.look,
      {std::max(width / shrink, 1), std::max(height / shrink, 1), now.fineness, scene.bounds()});
  glFinish();
  if (anew && !uploaded) pace_.measured(now.fineness, load, 1000 * elapsed_seconds(began));
  drawn_ = now;
  coarse_ = moving() && finer(pace_.at_rest(load), now.fineness);
  return true;
}

void WindowPicture::show(int left, int bottom) const {
  if (drawn_.width == 0) return;
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, renderer_.picture().framebuffer());
  const GlTarget::Form& drawn = renderer_.picture().form();
  glBlitFramebuffer(0, 0, drawn.width, drawn.height, left, bottom, left + drawn_.width,
                    bottom + drawn_.height, GL_COLOR_BUFFER_BIT,
                    drawn.width == drawn_.width ? GL_NEAREST : GL_LINEAR);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

}  // namespace curveskel::viewer
