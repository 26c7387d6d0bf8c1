#include "viewer/render/scene.hpp"

#include <algorithm>
#include <numbers>

#include <curveskel/error.hpp>
#include <curveskel/view.hpp>

namespace curveskel::viewer {
namespace {

constexpr std::array simpler_layers{Layer::simpler, Layer::simpler_still, Layer::simplest};

/// As wide as the ball from wherever it is seen, but for 6 in 100.
void add_ball(std::vector<glm::vec3>& points, const glm::vec3& middle, float radius) {
  constexpr float wider = 1.06F;  // than the ball, for the space between the points
  for (const float x : {-1.0F, 0.0F, 1.0F}) {
    for (const float y : {-1.0F, 0.0F, 1.0F}) {
      for (const float z : {-1.0F, 0.0F, 1.0F}) {
        const glm::vec3 way(x, y, z);
        if (way == glm::vec3(0)) continue;
        points.push_back(middle + glm::normalize(way) * (wider * radius));
      }
    }
  }
}

std::vector<glm::vec3> some_of(const std::vector<glm::vec3>& positions) {
  constexpr std::size_t enough = 50000;
  std::vector<glm::vec3> points;
  const std::size_t every = positions.size() / enough + 1;
  points.reserve(positions.size() / every + 1);
  for (std::size_t v = 0; v < positions.size(); v += every) points.push_back(positions[v]);
  return points;
}

/// Enough of them to fit the picture to.
std::vector<glm::vec3> some_points(const Document& document, const ShownSurface& given) {
  std::vector<glm::vec3> points = some_of(given.positions);
  if (document.rig) {
    for (const auto& joint : document.rig->joints.rowwise()) {
      points.push_back(shown_point(joint, document.space));
    }
  }
  if (!document.skeleton) return points;
  const CurveSkeleton& skeleton = *document.skeleton;
  // Beside a surface, to which balls belong, only the curve itself may lie anywhere.
  const bool has_balls = points.empty() && skeleton.radii.size() > 0;
  for (Eigen::Index node = 0; node < skeleton.nodes.rows(); ++node) {
    const glm::vec3 at = shown_point(skeleton.nodes.row(node), document.space);
    if (has_balls) {
      add_ball(points, at, shown_length(skeleton.radii[node], document.space));
    } else {
      points.push_back(at);
    }
  }
  return points;
}

Surface as_surface(const ShownSurface& shown) {
  Surface surface;
  surface.positions.resize(static_cast<Eigen::Index>(shown.positions.size()), 3);
  for (Eigen::Index v = 0; v < surface.positions.rows(); ++v) {
    surface.positions.row(v) =
        model_vector(shown.positions[static_cast<std::size_t>(v)]).transpose();
  }
  surface.triangles.resize(static_cast<Eigen::Index>(shown.triangles.size()), 3);
  Eigen::Index f = 0;
  for (const glm::uvec3& corners : shown.triangles) {
    surface.triangles.row(f++) << static_cast<int>(corners.x), static_cast<int>(corners.y),
        static_cast<int>(corners.z);
  }
  return surface;
}

/// The best side of a large surface is that of a simpler one, which takes no time to find.
glm::mat3 first_axes(const Document& document, const ShownSurface& simpler) {
  const bool has_triangles = document.surface.triangles.rows() > 0;
  if (!has_triangles && !document.skeleton) return glm::mat3(1);
  constexpr int wide = 1600;
  constexpr int high = 1000;
  const Eigen::Vector3d up = customary_up(document.format, document.to_gltf);
  const auto views = simpler.triangles.size() > 0 ? best_views(as_surface(simpler), wide, high, up)
                     : has_triangles              ? best_views(document.surface, wide, high, up)
                                                  : best_views(*document.skeleton, wide, high);
  const Eigen::Matrix3f axes = views[0].axes.cast<float>();
  glm::mat3 rows(1);
  for (int row = 0; row < 3; ++row) rows[row] = {axes(row, 0), axes(row, 1), axes(row, 2)};
  return rows;
}

}  // namespace

Scene::Scene(Document opened, const Monitor& monitor) : document(std::move(opened)) {
  const auto report = [&](double fraction) { monitor.report("prepare", fraction); };
  report(0);
  given_ = shown_surface(document.surface, document.space);
  report(0.15);
  face_blocks_ = FaceBlocks(document.surface);
  report(0.2);
  points_ = some_points(document, given_);
  bounds_ = bounds_of(points_);
  report(0.25);
  if (document.skeleton) own_skeleton = std::make_shared<const CurveSkeleton>(*document.skeleton);
  constexpr std::array<std::size_t, Pace::levels - 1> vertices{50000, 12000, 3000};
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    // Not worth its cost for a form that is nearly as simple.
    if (given_.positions.size() < 2 * vertices[i]) continue;
    simpler_[i] = simpler_surface(given_, vertices[i], monitor.stop);
    report(0.25 * static_cast<double>(i + 2));
  }
  best_axes_ = first_axes(document, simpler_[0].surface);
  look_from(camera, Side::best, best_axes_);
  given_.triangles = {};
}

Pace::Sizes Scene::sizes() const {
  const auto whole = static_cast<std::size_t>(document.surface.triangles.rows());
  Pace::Sizes sizes{whole};
  for (std::size_t i = 0; i < simpler_.size(); ++i) {
    const std::size_t size = simpler_[i].surface.triangles.size();
    sizes[i + 1] = size > 0 ? size : sizes[i];
  }
  return sizes;
}

std::shared_ptr<const CurveSkeleton> Scene::skeleton() const {
  return own_skeleton ? own_skeleton : recording.skeleton_at(moment);
}

std::shared_ptr<const Rig> Scene::rig() const {
  const auto& made = recording.moments()[moment].rig;
  return made ? made : document.rig;
}

std::shared_ptr<const CharacterRig> Scene::character() const {
  return recording.moments()[moment].character;
}

std::shared_ptr<const JointTurns> Scene::turns() const {
  if (!turns_ || turns_->rig != rig()) return nullptr;
  return {turns_, &turns_->turns};
}

void Scene::turn(JointTurns turns) {
  turns_ = std::make_shared<const TurnedRig>(TurnedRig{rig(), std::move(turns)});
}

Positions Scene::joints_now() const {
  const auto shown = rig();
  const auto turned = turns();
  return turned ? moved_joints(*shown, joint_motions(*shown, *turned)) : shown->joints;
}

bool Scene::shows_curve() const {
  return look.skeleton != SkeletonStyle::hidden && !recording.moments()[moment].rig;
}

Look Scene::look_now() const {
  Look now = look;
  const Moment& shown = recording.moments()[moment];
  const bool within = shown.stage == "contract" || shown.stage == "surgery";
  if (within && now.surface == SurfaceStyle::opaque) {
    now.surface = SurfaceStyle::transparent;
  }
  // The file's own look is what a rigger wants to see move, unless a joint is asked about.
  const bool is_asked = materials == nullptr || highlights.joint >= 0;
  if (now.surface_colour == ColourBy::file && rig() && look.bones && is_asked) {
    now.surface_colour = ColourBy::weight;
  }
  return now;
}

/// The surface that stands for the given one now, and its simpler forms.
void Scene::upload_given(Renderer& renderer, const Uploaded& now) const {
  if (now.faired) {
    renderer.set_surface(Layer::given, recording.faired_at(moment));
    for (const Layer layer : simpler_layers) renderer.set_surface(layer, ShownSurface{});
    return;
  }
  const ShownSurface turned = now.turns ? turned_surface(now) : ShownSurface{};
  const ShownSurface& given = now.turns ? turned : given_;
  if (now.materials) {
    ShownSurface drawn = chosen_vertices(given, now.materials->vertices);
    drawn.triangles = now.materials->triangles;
    drawn.colours = now.materials->colours;
    renderer.set_surface(Layer::given, drawn);
  } else {
    renderer.set_surface(Layer::given, given, document.surface.triangles);
  }
  for (std::size_t i = 0; i < simpler_layers.size(); ++i) {
    const SimplerSurface& simpler = simpler_[i];
    if (!now.turns) {
      renderer.set_surface(simpler_layers[i], simpler.surface);
      continue;
    }
    ShownSurface moved = chosen_vertices(given, simpler.vertex_of_given);
    moved.triangles = simpler.surface.triangles;
    renderer.set_surface(simpler_layers[i], moved);
  }
}

bool Scene::moves_with(const Rig& rig) const {
  return rig.weights.rows() == document.surface.positions.rows();
}

std::vector<glm::vec3> Scene::points() const {
  const auto shown = rig();
  const auto turned = turns();
  if (!turned || !moves_with(*shown)) return points_;
  ShownSurface moved;
  move_surface(moved,
               moved_surface(document.surface.positions, *shown, joint_motions(*shown, *turned)),
               document.space);
  std::vector<glm::vec3> points = some_of(moved.positions);
  const Positions joints = joints_now();
  for (const auto& joint : joints.rowwise()) {
    points.push_back(shown_point(joint, document.space));
  }
  return points;
}

/// Without triangles, as `given_`.
ShownSurface Scene::turned_surface(const Uploaded& now) const {
  const Positions moved =
      moved_surface(document.surface.positions, *now.rig, joint_motions(*now.rig, *now.turns));
  ShownSurface turned;
  move_surface(turned, moved, document.space);
  set_normals(turned, document.surface.triangles);
  return turned;
}

void Scene::colour_given(Renderer& renderer, const Uploaded& now) const {
  const auto shown = character();
  const RigParts* parts = shown ? &shown->parts : nullptr;
  const std::vector<Rgba> colours =
      surface_colours(document.surface, {now.skeleton.get(), now.rig.get(), parts, materials.get()},
                      now.look, highlights);
  if (!now.materials) renderer.set_colours(Layer::given, colours);
  for (std::size_t i = 0; i < simpler_layers.size(); ++i) {
    std::vector<Rgba> fewer;
    if (!colours.empty()) {
      fewer.reserve(simpler_[i].vertex_of_given.size());
      for (const std::uint32_t vertex : simpler_[i].vertex_of_given) {
        fewer.push_back(colours[vertex]);
      }
    }
    renderer.set_colours(simpler_layers[i], fewer);
  }
}

bool Scene::upload_surfaces(Renderer& renderer, Uploaded& now, bool all) {
  const Moment& shown = recording.moments()[moment];
  const bool faired = shown.stage == "fair" && shown.surface;
  now.faired = faired ? shown.surface : nullptr;
  now.contracted = faired                     ? nullptr
                   : shown.stage == "surgery" ? recording.newest_surface(moment)
                                              : shown.surface;
  const bool had_faired = uploaded_ && uploaded_->faired != nullptr;
  const bool anew = all || now.faired != uploaded_->faired || now.turns != uploaded_->turns ||
                    now.materials != uploaded_->materials;
  const auto pictures = [](const Uploaded& one) { return one.faired ? nullptr : one.materials; };
  if (all || pictures(now) != pictures(*uploaded_)) renderer.set_pictures(pictures(now).get());
  if (anew) upload_given(renderer, now);
  const bool recoloured = anew || now.skeleton != uploaded_->skeleton ||
                          now.rig != uploaded_->rig || now.highlights != uploaded_->highlights ||
                          now.look.surface_colour != uploaded_->look.surface_colour ||
                          look.map != uploaded_->look.map || look.theme != uploaded_->look.theme ||
                          had_faired != faired;
  if (recoloured && !faired) colour_given(renderer, now);
  const bool moved = all || now.contracted != uploaded_->contracted;
  if (moved) {
    renderer.set_surface(Layer::contracted,
                         now.contracted ? recording.surface_at(moment) : ShownSurface{});
  }
  return anew || recoloured || moved;
}

bool Scene::upload_skeleton(Renderer& renderer, const Uploaded& now, bool all) {
  const bool same_look =
      !all && now.curve == uploaded_->curve && look.skeleton == uploaded_->look.skeleton &&
      look.skeleton_colour == uploaded_->look.skeleton_colour && look.map == uploaded_->look.map &&
      look.theme == uploaded_->look.theme && look.joints == uploaded_->look.joints &&
      look.bones == uploaded_->look.bones && look.thickness == uploaded_->look.thickness;
  const bool same_bones = !all && now.rig == uploaded_->rig && now.turns == uploaded_->turns &&
                          now.look.surface_colour == uploaded_->look.surface_colour;
  if (same_look && same_bones && now.skeleton == uploaded_->skeleton &&
      now.highlights == uploaded_->highlights) {
    return false;
  }
  ShownSkeleton shown;
  if (now.skeleton && now.curve) {
    shown = shown_skeleton(*now.skeleton, document.space, bounds_.diagonal(), look, highlights);
  }
  if (now.rig && look.bones) {
    const ShownSkeleton rig =
        shown_rig(*now.rig, joints_now(), document.space, bounds_.diagonal(), look, highlights);
    shown.edges.insert(shown.edges.end(), rig.edges.begin(), rig.edges.end());
    shown.nodes.insert(shown.nodes.end(), rig.nodes.begin(), rig.nodes.end());
  }
  renderer.set_skeleton(shown);
  return true;
}

bool Scene::upload(Renderer& renderer) {
  const bool all = !uploaded_;
  Uploaded now;
  now.skeleton = skeleton();
  now.rig = rig();
  now.curve = shows_curve();
  now.look = look_now();
  now.highlights = highlights;
  if (now.rig && moves_with(*now.rig)) now.turns = turns();
  // Lit up vertices need colours of their own.
  const bool own_look = now.look.surface_colour == ColourBy::file && highlights.nodes.empty() &&
                        highlights.failed_faces.empty();
  if (own_look) now.materials = materials;
  const bool surfaces = upload_surfaces(renderer, now, all);
  const bool skeletons = upload_skeleton(renderer, now, all);
  uploaded_ = std::move(now);
  return surfaces || skeletons;
}

int joint_called(const Scene& scene, const std::string& name) {
  const auto rig = scene.rig();
  if (!rig) throw Error(Fault::input, "no rig is shown, so no joint is called " + name);
  const std::vector<std::string>& names = rig->names;
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return static_cast<int>(found - names.begin());
  constexpr std::size_t most = 100;
  std::string some;
  for (std::size_t i = 0; i < std::min(names.size(), most); ++i) {
    some += (some.empty() ? "" : ", ") + names[i];
  }
  if (names.size() > most) some += " and " + std::to_string(names.size() - most) + " more";
  throw Error(Fault::input, "no joint is called " + name + "; there are " + some);
}

Eigen::Quaterniond turn_by(const std::array<double, 3>& degrees) {
  Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
  for (int axis = 0; axis < 3; ++axis) {
    const double angle = degrees[static_cast<std::size_t>(axis)] * std::numbers::pi / 180;
    turn = Eigen::AngleAxisd(angle, Eigen::Vector3d::Unit(axis)) * turn;
  }
  return turn;
}

void look_at_rig(Scene& scene, const std::string& joint) {
  if (!scene.rig() || !scene.look.bones) return;
  scene.highlights.joint = -1;
  if (!joint.empty()) scene.highlights.joint = joint_called(scene, joint);
}

}  // namespace curveskel::viewer
