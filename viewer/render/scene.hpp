// The scene at one time: a moment of the recording, in a look, from a camera.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <curveskel/monitor.hpp>
#include <curveskel/pose.hpp>
#include "viewer/model/document.hpp"
#include "viewer/model/drawn_materials.hpp"
#include "viewer/model/recording.hpp"
#include "viewer/render/camera.hpp"
#include "viewer/render/face_blocks.hpp"
#include "viewer/render/look.hpp"
#include "viewer/render/renderer.hpp"
#include "viewer/render/scene_colours.hpp"
#include "viewer/software/simpler_surface.hpp"

namespace curveskel::viewer {

class Scene {
 public:
  /// Reports the stage "prepare". Throws Cancelled where a stop is requested. O(#V log #V + #F).
  explicit Scene(Document opened, const Monitor& monitor = {});

  Document document;
  Recording recording;
  std::size_t moment = 0;  ///< index into the recording
  Look look;
  Highlights highlights;
  Camera camera;
  /// Instead of the recording's skeleton: the one that was opened, or edited.
  std::shared_ptr<const CurveSkeleton> own_skeleton;

  /// Of the document's file; null where it has none, or none are known yet.
  std::shared_ptr<const DrawnMaterials> materials;

  /// The skeleton that is shown now, or null.
  [[nodiscard]] std::shared_ptr<const CurveSkeleton> skeleton() const;
  /// The rig that is shown now: the one of this moment, else the file's; or null.
  [[nodiscard]] std::shared_ptr<const Rig> rig() const;
  /// Plan and parts of that rig; null where it is the file's.
  [[nodiscard]] std::shared_ptr<const CharacterRig> character() const;
  /// By hand, of the joints of the rig that is shown; null = none is turned.
  [[nodiscard]] std::shared_ptr<const JointTurns> turns() const;
  /// Of the rig that is shown, in place of all turns before; they are gone where another rig is.
  /// Precondition: there is a rig; a turn for each joint.
  void turn(JointTurns turns);
  void turn_back() { turns_ = nullptr; }
  /// The rig's joints where they stand now. Precondition: there is a rig.
  [[nodiscard]] Positions joints_now() const;
  /// True if the curve is seen now; bones stand for it if it was made a rig of.
  [[nodiscard]] bool shows_curve() const;
  [[nodiscard]] const Bounds& bounds() const { return bounds_; }
  /// Enough points of all that is shown to fit the camera to, as turned joints move them.
  [[nodiscard]] std::vector<glm::vec3> points() const;
  /// Rows right, up, to the viewer of the first view.
  [[nodiscard]] const glm::mat3& best_axes() const { return best_axes_; }

  /// Of the document's surface.
  [[nodiscard]] const FaceBlocks& face_blocks() const { return face_blocks_; }

  /// Triangles of the given surface at each level of fineness.
  [[nodiscard]] Pace::Sizes sizes() const;

  /// Brings the renderer up to date; only what has changed since the last call is uploaded. False
  /// if nothing had.
  bool upload(Renderer& renderer);
  /// Forgets all uploads: the renderer is a new one.
  void forget_uploads() { uploaded_.reset(); }
  /// The look as it is drawn at this moment: a contracted surface shows through the given one; a
  /// surface with a rig has its weights' colours if no others are chosen, and it has none itself.
  [[nodiscard]] Look look_now() const;

 private:
  struct TurnedRig {
    std::shared_ptr<const Rig> rig;
    JointTurns turns;
  };
  struct Uploaded {
    std::shared_ptr<const ShownSurface> faired;      // kept, so that no other can have its address
    std::shared_ptr<const ShownSurface> contracted;  // the latest of the components shown
    std::shared_ptr<const CurveSkeleton> skeleton;
    std::shared_ptr<const Rig> rig;
    std::shared_ptr<const JointTurns> turns;
    std::shared_ptr<const DrawnMaterials> materials;  // those that are seen
    bool curve = false;                               // shown
    Look look;
    Highlights highlights;
  };
  void upload_given(Renderer& renderer, const Uploaded& now) const;
  [[nodiscard]] ShownSurface turned_surface(const Uploaded& now) const;
  /// True if turned joints move the surface.
  [[nodiscard]] bool moves_with(const Rig& rig) const;
  void colour_given(Renderer& renderer, const Uploaded& now) const;
  bool upload_surfaces(Renderer& renderer, Uploaded& now, bool all);
  bool upload_skeleton(Renderer& renderer, const Uploaded& now, bool all);

  ShownSurface given_;  // without triangles: those are the document's
  FaceBlocks face_blocks_;
  std::array<SimplerSurface, Pace::levels - 1> simpler_;  // empty where the surface is small
  std::vector<glm::vec3> points_;
  Bounds bounds_;
  glm::mat3 best_axes_{1};
  std::optional<Uploaded> uploaded_;
  std::shared_ptr<const TurnedRig> turns_;
};

/// The joint of the rig that is shown with this name. Throws Error(Fault::input) where there is
/// none, or no rig.
[[nodiscard]] int joint_called(const Scene& scene, const std::string& name);

/// A turn by degrees about x, then y, then z.
[[nodiscard]] Eigen::Quaterniond turn_by(const std::array<double, 3>& degrees);

/// Chooses the joint of the rig that has this name; "" = none. Nothing where there is no rig, or
/// its bones are not shown. Throws Error(Fault::input) where no joint has the name; none is chosen
/// then.
void look_at_rig(Scene& scene, const std::string& joint);

}  // namespace curveskel::viewer
