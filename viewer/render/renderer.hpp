// Draws surfaces and a skeleton into a picture of its own, for the window and for screenshots.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "viewer/render/camera.hpp"
#include "viewer/render/gl_meshes.hpp"
#include "viewer/render/gl_objects.hpp"
#include "viewer/render/look.hpp"
#include "viewer/render/shapes_shown.hpp"
#include "viewer/software/pace.hpp"

namespace curveskel::viewer {

/// The surface given and its simpler forms, and its shape on the way to the skeleton.
enum class Layer { given, simpler, simpler_still, simplest, contracted };

/// Premultiplied RGBA rows from the bottom, as OpenGL reads them.
struct PixelRows {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> bytes;
};

/// Lives on the thread whose OpenGL 3.3 context is current, as long as that context.
class Renderer {
 public:
  /// Compiles the shaders. Throws Error(Fault::device) where the driver refuses.
  Renderer();

  /// An empty surface takes the layer away.
  void set_surface(Layer layer, const ShownSurface& surface);
  /// With these triangles instead of its own.
  void set_surface(Layer layer, const ShownSurface& surface, const Triangles& triangles);
  /// The same triangles at other positions.
  void move_surface(Layer layer, const ShownSurface& surface);
  void set_colours(Layer layer, const std::vector<Rgba>& colours);
  /// Of the given surface, whose triangles are the materials'; null for none.
  void set_pictures(const DrawnMaterials* materials);
  void set_skeleton(const ShownSkeleton& skeleton);

  /// A rectangle of pixels, from the lower left corner.
  struct Part {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
    bool operator==(const Part&) const = default;
  };
  struct Frame {
    int width = 0;                  ///< pixels
    int height = 0;                 ///< pixels
    Fineness fineness;              ///< no more samples than the driver has
    Bounds bounds;                  ///< of all that is shown
    std::optional<Part> part = {};  ///< all that is drawn of it, where it is not the whole
  };
  /// The picture is then in `picture()`. O(faces + pixels). False if the given surface was taken
  /// from the last picture, as neither it nor the camera has changed.
  bool draw(const Camera& camera, const Look& look, const Frame& frame);
  [[nodiscard]] const GlTarget& picture() const { return picture_; }
  [[nodiscard]] PixelRows read() const;

 private:
  /// The content of the last glass; if equal, the glass need not be drawn again.
  struct GlassKey {
    glm::mat4 view{0};
    glm::mat4 projection{0};
    float opacity = -1;
    Theme theme = Theme::light;
    Fineness fineness;
    Part part;
    unsigned version = 0;
  };
  struct Seen;

  void set_surface(Layer layer, const ShownSurface& surface, std::span<const std::byte> corners);
  [[nodiscard]] const GlMesh& given_at(int level) const;
  [[nodiscard]] unsigned given_version() const;
  [[nodiscard]] int samples_of(const Frame& frame) const;
  [[nodiscard]] bool has_glass(const GlassKey& wanted) const;
  [[nodiscard]] GlMesh& mesh(Layer layer) { return meshes_[static_cast<std::size_t>(layer)]; }
  void draw_mesh(const GlProgram& program, const GlMesh& shown, const glm::vec3& plain,
                 const Seen& seen) const;
  [[nodiscard]] const GlProgram& program_for(const Seen& seen) const;
  void draw_opaque(const GlMesh& shown, const glm::vec3& plain, const Seen& seen) const;
  void draw_wires(const GlMesh& shown, const glm::vec4& line, const Seen& seen) const;
  void draw_background(const Seen& seen) const;
  void draw_body(const Seen& seen) const;
  void draw_surfaces(const Seen& seen);
  void draw_skeleton(const Seen& seen) const;
  void draw_skin() const;
  bool draw_glass(const Seen& seen);
  void draw_screen(const GlProgram& program) const;

  GlProgram surface_;
  GlProgram coarse_;
  GlProgram thickness_program_;
  GlProgram background_;
  GlProgram body_;
  GlProgram skin_program_;
  GlProgram wire_;
  GlProgram tube_;
  std::array<GlMesh, Pace::levels + 1> meshes_;
  GlInstances edges_;
  GlInstances nodes_;
  GlArray screen_;
  GlTarget scene_;
  GlTarget picture_;
  GlTarget skin_samples_;
  GlTarget skin_;
  GlTarget thickness_;
  GlassKey glass_;
  int most_samples_ = 1;
};

}  // namespace curveskel::viewer
