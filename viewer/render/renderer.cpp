#include "viewer/render/renderer.hpp"

#include <algorithm>
#include <cmath>

#include "viewer/render/shaders.hpp"
#include "viewer/render/unit_shapes.hpp"

namespace curveskel::viewer {

/// State that all passes of one picture share.
struct Renderer::Seen {
  const Camera& camera;
  const Look& look;
  const Frame& frame;
  Palette palette;
  glm::mat4 view;
  glm::mat4 projection;
  Part part;

  /// The target holds the part only.
  void bind(const GlTarget& target) const {
    target.bind();
    glViewport(-part.x, -part.y, frame.width, frame.height);
  }
  [[nodiscard]] GlTarget::Form form(int samples) const {
    return {part.width, part.height, samples, GL_RGBA8, true};
  }
  void set(const GlProgram& program) const {
    program.use();
    program.set("view", view);
    program.set("projection", projection);
    program.set("orthographic", static_cast<int>(camera.orthographic));
  }
};

Renderer::Renderer()
    : surface_("surface", surface_vertex_source, with_light(surface_fragment_source)),
      coarse_("coarse", with_light(coarse_vertex_source), coarse_fragment_source),
      thickness_program_("thickness", place_vertex_source, thickness_fragment_source),
      background_("background", screen_vertex_source, background_fragment_source),
      body_("body", screen_vertex_source, body_fragment_source),
      skin_program_("skin", screen_vertex_source, skin_fragment_source),
      wire_("wire", place_vertex_source, wire_fragment_source),
      tube_("tube", tube_vertex_source, with_light(tube_fragment_source)),
      edges_(unit_tube()),
      nodes_(unit_ball()),
      screen_(make_array()) {
  glGetIntegerv(GL_MAX_SAMPLES, &most_samples_);
}

void Renderer::set_surface(Layer layer, const ShownSurface& surface) {
  set_surface(layer, surface, std::as_bytes(std::span(surface.triangles.list())));
}

void Renderer::set_surface(Layer layer, const ShownSurface& surface, const Triangles& triangles) {
  const std::span corners(triangles.data(), static_cast<std::size_t>(triangles.size()));
  set_surface(layer, surface, std::as_bytes(corners));
}

void Renderer::set_surface(Layer layer, const ShownSurface& surface,
                           std::span<const std::byte> corners) {
  mesh(layer).set_triangles(corners, surface.fewer.list());
  move_surface(layer, surface);
  set_colours(layer, surface.colours);
}

void Renderer::move_surface(Layer layer, const ShownSurface& surface) {
  mesh(layer).set_places(surface);
}

void Renderer::set_colours(Layer layer, const std::vector<Rgba>& colours) {
  mesh(layer).set_colours(colours);
}

void Renderer::set_pictures(const DrawnMaterials* materials) {
  mesh(Layer::given).set_pictures(materials);
}

void Renderer::set_skeleton(const ShownSkeleton& skeleton) {
  edges_.set(skeleton.edges);
  nodes_.set(skeleton.nodes);
}

void Renderer::draw_mesh(const GlProgram& program, const GlMesh& shown, const glm::vec3& plain,
                         const Seen& seen) const {
  if (shown.empty()) return;
  seen.set(program);
  const ColourBy by = seen.look.surface_colour;
  program.set("categories", static_cast<int>(by == ColourBy::component || by == ColourBy::node ||
                                             by == ColourBy::branch));
  shown.draw(program, plain, seen.frame.fineness.lit_at_vertices());
}

const GlProgram& Renderer::program_for(const Seen& seen) const {
  return seen.frame.fineness.lit_at_vertices() ? coarse_ : surface_;
}

void Renderer::draw_opaque(const GlMesh& shown, const glm::vec3& plain, const Seen& seen) const {
  glEnable(GL_DEPTH_TEST);
  glEnable(GL_POLYGON_OFFSET_FILL);  // lets the edges lie on the faces
  glPolygonOffset(1, 1);
  const GlProgram& program = program_for(seen);
  program.use();
  program.set("skin", 0);
  program.set("inner", seen.palette.inside);
  draw_mesh(program, shown, plain, seen);
  glDisable(GL_POLYGON_OFFSET_FILL);
}

void Renderer::draw_wires(const GlMesh& shown, const glm::vec4& line, const Seen& seen) const {
  glEnable(GL_DEPTH_TEST);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glDepthMask(GL_FALSE);
  glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
  wire_.use();
  wire_.set("line", line);
  draw_mesh(wire_, shown, seen.palette.wire, seen);
  glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
}

void Renderer::draw_skeleton(const Seen& seen) const {
  const auto height = static_cast<float>(seen.frame.height);
  seen.set(tube_);
  const float unit = 2 * std::tan(seen.camera.field_of_view / 2) / height;
  tube_.set("unit_per_pixel", seen.camera.orthographic ? unit * seen.camera.distance : unit);
  constexpr float thinnest = 1.0F / 1000;  // radius of the picture's height
  const bool lines = seen.look.skeleton == SkeletonStyle::lines;
  tube_.set("least_pixels", thinnest * height * seen.look.thickness * (lines ? 1.3F : 0.8F));
  glEnable(GL_DEPTH_TEST);
  glEnable(GL_CULL_FACE);
  // The casing: the far side of a slightly thicker tube, which shows round what it lies behind.
  constexpr float casing = 1.6F / 1000;
  tube_.set("more_pixels", casing * height);
  tube_.set("flat_colour", 1);
  glCullFace(GL_FRONT);
  const auto both = [&] {
    tube_.set("ball", 0);
    edges_.draw();
    tube_.set("ball", 1);
    nodes_.draw();
  };
  tube_.set("casing", glm::vec4(seen.palette.casing, 1));
  both();
  glCullFace(GL_BACK);
  tube_.set("more_pixels", 0.0F);
  tube_.set("flat_colour", 0);
  both();
  glDisable(GL_CULL_FACE);
}

void Renderer::draw_screen(const GlProgram& program) const {
  program.use();
  glBindVertexArray(screen_.get());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

/// The level wanted, or the next finer one that has been set.
const GlMesh& Renderer::given_at(int level) const {
  auto found = static_cast<std::size_t>(level);
  while (found > 0 && meshes_[found].empty()) --found;
  return meshes_[found];
}

unsigned Renderer::given_version() const {
  unsigned version = 0;
  for (std::size_t level = 0; level < Pace::levels; ++level) version += meshes_[level].version();
  return version;
}

int Renderer::samples_of(const Frame& frame) const {
  return std::clamp(frame.fineness.samples, 1, std::max(most_samples_, 1));
}

/// True if the last glass was the same, or finer.
bool Renderer::has_glass(const GlassKey& wanted) const {
  return glass_.view == wanted.view && glass_.projection == wanted.projection &&
         glass_.opacity == wanted.opacity && glass_.theme == wanted.theme &&
         glass_.version == wanted.version && glass_.fineness.level <= wanted.fineness.level &&
         glass_.fineness.samples >= wanted.fineness.samples && glass_.part == wanted.part;
}

/// The skin (its nearest layer, lit) and the thickness of the body, each in a target of its own;
/// neither depends on the order of the triangles.
bool Renderer::draw_glass(const Seen& seen) {
  const GlMesh& given = given_at(seen.frame.fineness.level);
  const GlassKey key{seen.view,           seen.projection, seen.look.opacity, seen.look.theme,
                     seen.frame.fineness, seen.part,       given_version()};
  if (has_glass(key)) return false;  // only its content has changed
  glass_ = key;
  skin_.shape(seen.form(1));
  const int samples = samples_of(seen.frame);
  if (samples > 1) skin_samples_.shape(seen.form(samples));
  seen.bind(samples > 1 ? skin_samples_ : skin_);
  glClearColor(0, 0, 0, 0);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  glEnable(GL_DEPTH_TEST);
  const GlProgram& program = program_for(seen);
  program.use();
  program.set("skin", 1);
  program.set("strength", 2 * seen.look.opacity);
  program.set("inner", seen.palette.inside);
  draw_mesh(program, given, seen.palette.surface, seen);
  if (samples > 1) skin_samples_.resolve_into(skin_, true);

  GlTarget::Form sums = seen.form(1);
  sums.colour = GL_R32F;
  sums.depth = false;
  thickness_.shape(sums);
  seen.bind(thickness_);
  glClear(GL_COLOR_BUFFER_BIT);
  glDisable(GL_DEPTH_TEST);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE);
  draw_mesh(thickness_program_, given, seen.palette.surface, seen);
  glDisable(GL_BLEND);
  return true;
}

void Renderer::draw_background(const Seen& seen) const {
  glDisable(GL_DEPTH_TEST);
  background_.use();
  background_.set("upper", glm::vec4(seen.palette.upper, 1));
  background_.set("lower", glm::vec4(seen.palette.lower, 1));
  draw_screen(background_);
}

/// The glass's body, behind all that is in it.
void Renderer::draw_body(const Seen& seen) const {
  glDisable(GL_DEPTH_TEST);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  bind_texture(0, thickness_.colour());
  body_.use();
  body_.set("thickness", 0);
  body_.set("tint", seen.palette.body);
  body_.set("half_length", 0.12F * seen.frame.bounds.diagonal());
  body_.set("most", 0.9F * seen.look.opacity);
  draw_screen(body_);
  glDisable(GL_BLEND);
}

/// All but the glass.
void Renderer::draw_surfaces(const Seen& seen) {
  const Look& look = seen.look;
  const GlMesh& given = given_at(seen.frame.fineness.level);
  const GlMesh& contracted = mesh(Layer::contracted);
  if (look.surface == SurfaceStyle::opaque) draw_opaque(given, seen.palette.surface, seen);
  draw_opaque(contracted, seen.palette.contracted, seen);
  // Without its edges, what has contracted to a line would be gone where it is thinner than a
  // pixel. They take as long as all the rest, so they are left out where time is short.
  if (seen.frame.fineness.shrink == 1) {
    draw_wires(contracted, glm::vec4(seen.palette.contracted * 0.75F, 0.45F), seen);
  }
  if (look.surface == SurfaceStyle::wireframe) {
    draw_wires(given, glm::vec4(seen.palette.wire, 0.3F), seen);
  } else if (look.edges && look.surface == SurfaceStyle::opaque) {
    draw_wires(given, glm::vec4(seen.palette.wire, 0.28F), seen);
  }
}

/// The glass's skin, over its content.
void Renderer::draw_skin() const {
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glEnable(GL_DEPTH_TEST);
  // At a silhouette the one depth that is kept may be the background's.
  glDepthFunc(GL_LEQUAL);
  bind_texture(0, skin_.colour());
  bind_texture(1, skin_.depth());
  skin_program_.use();
  skin_program_.set("skin", 0);
  skin_program_.set("skin_depth", 1);
  draw_screen(skin_program_);
  glDepthFunc(GL_LESS);
  glDisable(GL_BLEND);
}

bool Renderer::draw(const Camera& camera, const Look& look, const Frame& frame) {
  const float aspect = static_cast<float>(frame.width) / static_cast<float>(frame.height);
  const Seen seen{camera,
                  look,
                  frame,
                  palette_of(look.theme),
                  camera.view(),
                  camera.projection(aspect, frame.bounds),
                  frame.part.value_or(Part{0, 0, frame.width, frame.height})};
  const int samples = samples_of(frame);
  if (samples > 1) scene_.shape(seen.form(samples));
  picture_.shape(seen.form(1));
  const bool glass = look.surface == SurfaceStyle::transparent && !mesh(Layer::given).empty();
  const bool all_anew = !glass || draw_glass(seen);

  seen.bind(samples > 1 ? scene_ : picture_);
  glClearColor(0, 0, 0, 0);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  if (!look.transparent_background) draw_background(seen);
  if (glass) draw_body(seen);
  draw_surfaces(seen);
  if (look.surface == SurfaceStyle::opaque && look.through) glClear(GL_DEPTH_BUFFER_BIT);
  draw_skeleton(seen);
  if (glass) {
    const GlMesh& given = given_at(frame.fineness.level);
    if (look.edges) draw_wires(given, glm::vec4(seen.palette.wire, 0.2F), seen);
    draw_skin();
  }
  if (samples > 1) scene_.resolve_into(picture_, false);
  glBindVertexArray(0);
  return all_anew;
}

PixelRows Renderer::read() const {
  const GlTarget::Form& form = picture_.form();
  const auto pixels = static_cast<std::size_t>(form.width) * static_cast<std::size_t>(form.height);
  PixelRows rows{form.width, form.height, std::vector<std::uint8_t>(4 * pixels)};
  glBindFramebuffer(GL_READ_FRAMEBUFFER, picture_.framebuffer());
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, rows.width, rows.height, GL_RGBA, GL_UNSIGNED_BYTE, rows.bytes.data());
  return rows;
}

}  // namespace curveskel::viewer
