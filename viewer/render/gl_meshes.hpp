// Triangles, tubes and balls in OpenGL's buffers.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "viewer/model/drawn_materials.hpp"
#include "viewer/render/colours.hpp"
#include "viewer/render/gl_objects.hpp"
#include "viewer/render/shapes_shown.hpp"
#include "viewer/render/unit_shapes.hpp"

namespace curveskel::viewer {

/// A surface; drawn as its triangles or those of its simpler form.
class GlMesh {
 public:
  GlMesh() : array_(make_array()) {}

  /// Three 32-bit indices each.
  void set_triangles(std::span<const std::byte> corners, const std::vector<glm::uvec3>& fewer);
  /// Positions and normals.
  void set_places(const ShownSurface& surface);
  /// None: the plain colour.
  void set_colours(const std::vector<Rgba>& colours);
  /// Pictures on the triangles, which are run by run; none: without pictures.
  void set_pictures(const DrawnMaterials* materials);

  [[nodiscard]] bool empty() const { return corners_ == 0; }
  /// Counts changes.
  [[nodiscard]] unsigned version() const { return version_; }
  /// With the program in use; `few` triangles where there is a simpler form.
  void draw(const GlProgram& program, const glm::vec3& plain, bool few) const;

 private:
  struct Run {
    DrawnMaterials::Run drawn;
    GLuint picture = 0;  // one of the textures; 0 = none
  };

  GlArray array_;
  GlBuffer positions_;
  GlBuffer normals_;
  GlBuffer colours_;
  GlBuffer places_in_picture_;
  GlBuffer triangles_;
  GlBuffer fewer_;
  std::vector<GlTexture> textures_;
  std::vector<Run> runs_;
  GLsizei corners_ = 0;
  GLsizei fewer_corners_ = 0;
  bool coloured_ = false;
  unsigned version_ = 0;
};

/// One shape many times, as tubes or balls.
class GlInstances {
 public:
  explicit GlInstances(const UnitShape& shape);

  void set(const std::vector<TubeInstance>& shown);
  /// With the program in use.
  void draw() const;

 private:
  GlArray array_;
  GlBuffer shape_;
  GlBuffer corners_;
  GlBuffer instances_;
  GLsizei corner_count_ = 0;
  GLsizei count_ = 0;
};

}  // namespace curveskel::viewer
