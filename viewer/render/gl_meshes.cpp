#include "viewer/render/gl_meshes.hpp"

#include <cstdint>
#include <map>
#include <utility>

namespace curveskel::viewer {
namespace {

enum Attribute : GLuint {
  position,
  normal,
  colour,
  from,
  to,
  from_colour,
  to_colour,
  from_mitre,
  to_mitre,
  place_in_picture
};

constexpr int picture_unit = 2;  // the others are the glass's

GlTexture texture_of(const Picture& picture, const std::array<bool, 2>& repeats) {
  GLuint name = 0;
  glGenTextures(1, &name);
  GlTexture texture(name);
  bind_texture(picture_unit, name);
  const auto wrap = [&](std::size_t way) { return repeats[way] ? GL_REPEAT : GL_CLAMP_TO_EDGE; };
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, wrap(0));
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, wrap(1));
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, picture.width, picture.height, 0, GL_RGBA,
               GL_UNSIGNED_BYTE, picture.bytes.data());
  glGenerateMipmap(GL_TEXTURE_2D);
  return texture;
}

/// Things without colours of their own have the attribute's constant value.
void bind_attribute(GLuint attribute, const GlBuffer& buffer, GLint parts, GLenum type,
                    bool normalised, GLsizei stride, std::size_t offset) {
  glBindBuffer(GL_ARRAY_BUFFER, buffer.get());
  glEnableVertexAttribArray(attribute);
  glVertexAttribPointer(
      attribute, parts, type, normalised ? GL_TRUE : GL_FALSE, stride,
      // OpenGL's way to say an offset.
      reinterpret_cast<const void*>(offset));  // NOLINT(performance-no-int-to-ptr)
}

}  // namespace

void GlMesh::set_triangles(std::span<const std::byte> corners,
                           const std::vector<glm::uvec3>& fewer) {
  ++version_;
  glBindVertexArray(array_.get());
  fill(triangles_, GL_ELEMENT_ARRAY_BUFFER, corners);
  corners_ = static_cast<GLsizei>(corners.size() / sizeof(std::uint32_t));
  fewer_corners_ = static_cast<GLsizei>(3 * fewer.size());
  if (!fewer.empty()) fill(fewer_, GL_ELEMENT_ARRAY_BUFFER, std::span(fewer));
  glBindVertexArray(0);
}

void GlMesh::set_places(const ShownSurface& surface) {
  ++version_;
  glBindVertexArray(array_.get());
  fill(positions_, GL_ARRAY_BUFFER, std::span(surface.positions));
  bind_attribute(position, positions_, 3, GL_FLOAT, false, 0, 0);
  fill(normals_, GL_ARRAY_BUFFER, std::span(surface.normals));
  bind_attribute(normal, normals_, 4, GL_INT_2_10_10_10_REV, true, 0, 0);
  glBindVertexArray(0);
}

void GlMesh::set_colours(const std::vector<Rgba>& colours) {
  if (colours.empty() && !coloured_) return;
  ++version_;
  coloured_ = !colours.empty();
  glBindVertexArray(array_.get());
  if (coloured_) {
    fill(colours_, GL_ARRAY_BUFFER, std::span(colours));
    bind_attribute(colour, colours_, 4, GL_UNSIGNED_BYTE, true, 0, 0);
  } else {
    glDisableVertexAttribArray(colour);
  }
  glBindVertexArray(0);
}

void GlMesh::set_pictures(const DrawnMaterials* materials) {
  if (materials == nullptr && runs_.empty()) return;
  ++version_;
  runs_.clear();
  textures_.clear();
  glBindVertexArray(array_.get());
  if (materials == nullptr) {
    glDisableVertexAttribArray(place_in_picture);
  } else {
    fill(places_in_picture_, GL_ARRAY_BUFFER, std::span(materials->places));
    bind_attribute(place_in_picture, places_in_picture_, 2, GL_FLOAT, false, 0, 0);
    std::map<std::pair<int, std::array<bool, 2>>, GLuint> made;  // runs share them
    for (const DrawnMaterials::Run& run : materials->runs) {
      runs_.push_back({run});
      if (run.picture < 0) continue;
      GLuint& texture = made[{run.picture, run.repeats}];
      if (texture == 0) {
        textures_.push_back(
            texture_of(materials->pictures[static_cast<std::size_t>(run.picture)], run.repeats));
        texture = textures_.back().get();
      }
      runs_.back().picture = texture;
    }
  }
  glBindVertexArray(0);
}

void GlMesh::draw(const GlProgram& program, const glm::vec3& plain, bool few) const {
  if (empty()) return;
  glBindVertexArray(array_.get());
  if (!coloured_) glVertexAttrib4f(colour, plain.r, plain.g, plain.b, 1);
  const bool fewer = few && fewer_corners_ > 0;
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, fewer ? fewer_.get() : triangles_.get());
  program.set("picture", picture_unit);
  program.set("has_picture", 0);
  program.set("cut_out", 0);
  if (runs_.empty() || fewer) {
    glDrawElements(GL_TRIANGLES, fewer ? fewer_corners_ : corners_, GL_UNSIGNED_INT, nullptr);
    return;
  }
  for (const Run& run : runs_) {
    program.set("has_picture", run.picture != 0 ? 1 : 0);
    program.set("cut_out", run.drawn.is_cut_out ? 1 : 0);
    if (run.picture != 0) bind_texture(picture_unit, run.picture);
    const std::size_t offset = 3 * sizeof(std::uint32_t) * run.drawn.first;
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * run.drawn.count), GL_UNSIGNED_INT,
                   // OpenGL's way to say an offset.
                   reinterpret_cast<const void*>(offset));  // NOLINT(performance-no-int-to-ptr)
  }
}

GlInstances::GlInstances(const UnitShape& shape)
    : array_(make_array()), corner_count_(static_cast<GLsizei>(shape.corners.size())) {
  glBindVertexArray(array_.get());
  fill(shape_, GL_ARRAY_BUFFER, std::span(shape.points));
  bind_attribute(position, shape_, 4, GL_FLOAT, false, 0, 0);
  fill(corners_, GL_ELEMENT_ARRAY_BUFFER, std::span(shape.corners));
  const TubeInstance none{};
  fill(instances_, GL_ARRAY_BUFFER, std::span(&none, 1));
  const auto bind = [&](GLuint attribute, GLint parts, GLenum type, std::size_t offset) {
    constexpr GLsizei stride = sizeof(TubeInstance);
    bind_attribute(attribute, instances_, parts, type, type == GL_UNSIGNED_BYTE, stride, offset);
    glVertexAttribDivisor(attribute, 1);
  };
  bind(from, 4, GL_FLOAT, offsetof(TubeInstance, from));
  bind(to, 4, GL_FLOAT, offsetof(TubeInstance, to));
  bind(from_colour, 4, GL_UNSIGNED_BYTE, offsetof(TubeInstance, from_colour));
  bind(to_colour, 4, GL_UNSIGNED_BYTE, offsetof(TubeInstance, to_colour));
  bind(from_mitre, 3, GL_FLOAT, offsetof(TubeInstance, from_mitre));
  bind(to_mitre, 3, GL_FLOAT, offsetof(TubeInstance, to_mitre));
  glBindVertexArray(0);
}

void GlInstances::set(const std::vector<TubeInstance>& shown) {
  count_ = static_cast<GLsizei>(shown.size());
  if (!shown.empty()) fill(instances_, GL_ARRAY_BUFFER, std::span(shown));
}

void GlInstances::draw() const {
  if (count_ == 0) return;
  glBindVertexArray(array_.get());
  glDrawElementsInstanced(GL_TRIANGLES, corner_count_, GL_UNSIGNED_INT, nullptr, count_);
}

}  // namespace curveskel::viewer
