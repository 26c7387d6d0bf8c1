#include "viewer/workbench/pick.hpp"

#include <algorithm>
#include <limits>
#include <vector>

namespace curveskel::viewer {
namespace {

constexpr float node_pixels = 9;
constexpr float edge_pixels = 6;

class Projection {
 public:
  Projection(const Camera& camera, const Bounds& bounds, int width, int height)
      : size_(width, height),
        matrix_(camera.projection(size_.x / size_.y, bounds) * camera.view()) {}
  [[nodiscard]] glm::vec3 pixel(const glm::vec3& point) const {
    const glm::vec4 seen = matrix_ * glm::vec4(point, 1);
    if (!(seen.w > 0)) return glm::vec3(std::numeric_limits<float>::infinity());
    const glm::vec3 place = glm::vec3(seen) / seen.w;
    return {(place.x + 1) / 2 * size_.x, (1 - place.y) / 2 * size_.y, place.z};
  }

 private:
  glm::vec2 size_;
  glm::mat4 matrix_;
};

/// The nearest of these points within reach; of those that lie over each other, the one in front.
Pick pick_point(const std::vector<glm::vec3>& pixels, const glm::vec2& at, Pick::Kind kind,
                float scale) {
  Pick best;
  float best_cost = node_pixels * scale;
  for (std::size_t node = 0; node < pixels.size(); ++node) {
    const float distance = glm::length(glm::vec2(pixels[node]) - at);
    if (!(distance <= node_pixels * scale)) continue;
    const float cost = distance + pixels[node].z;  // depth is -1..1: it decides between equals
    if (cost >= best_cost) continue;
    best_cost = cost;
    best.kind = kind;
    best.index = static_cast<int>(node);
  }
  return best;
}

std::vector<glm::vec3> pixels_of(const Projection& projection, const Positions& points,
                                 const Scene& scene) {
  std::vector<glm::vec3> pixels;
  pixels.reserve(static_cast<std::size_t>(points.rows()));
  for (const auto& point : points.rowwise()) {
    pixels.push_back(projection.pixel(shown_point(point, scene.document.space)));
  }
  return pixels;
}

Pick pick_edge(const CurveSkeleton& skeleton, const std::vector<glm::vec3>& pixels,
               const glm::vec2& at, float scale, float& share) {
  Pick best;
  float nearest = edge_pixels * scale;
  for (Eigen::Index row = 0; row < skeleton.edges.rows(); ++row) {
    const glm::vec2 a(pixels[static_cast<std::size_t>(skeleton.edges(row, 0))]);
    const glm::vec2 b(pixels[static_cast<std::size_t>(skeleton.edges(row, 1))]);
    const float squared = glm::dot(b - a, b - a);
    const float along =
        squared > 0 ? std::clamp(glm::dot(at - a, b - a) / squared, 0.0F, 1.0F) : 0.0F;
    const float distance = glm::length(at - glm::mix(a, b, along));
    if (!(distance < nearest)) continue;
    nearest = distance;
    share = along;
    best.kind = Pick::Kind::edge;
    best.index = static_cast<int>(row);
  }
  return best;
}

Pick pick_face(const Scene& scene, const PickRay& ray) {
  const auto in_model = [&](const glm::vec3& point) {
    return model_point(point, scene.document.space);
  };
  const Eigen::Vector3d direction = model_vector(ray.direction).normalized();
  const FaceBlocks::Hit hit =
      scene.face_blocks().first(scene.document.surface, in_model(ray.origin), direction);
  if (hit.face < 0) return {};
  const Eigen::Vector3d place = in_model(ray.origin) + direction * hit.distance;
  Pick found;
  found.kind = Pick::Kind::face;
  found.index = hit.face;
  found.place = shown_point(place.transpose(), scene.document.space);
  double nearest = std::numeric_limits<double>::infinity();
  for (const int vertex : scene.document.surface.triangles.row(hit.face)) {
    const double distance =
        (scene.document.surface.positions.row(vertex).transpose() - place).squaredNorm();
    if (distance >= nearest) continue;
    nearest = distance;
    found.vertex = vertex;
  }
  return found;
}

}  // namespace

glm::vec3 pixel_of(const Camera& camera, const Bounds& bounds, const glm::vec3& point, int width,
                   int height) {
  return Projection(camera, bounds, width, height).pixel(point);
}

Pick pick(const Scene& scene, const glm::vec2& at, int width, int height, float scale) {
  const auto skeleton = scene.skeleton();
  const bool covered = scene.look.surface == SurfaceStyle::opaque && !scene.look.through;
  const Projection projection(scene.camera, scene.bounds(), width, height);
  const auto rig = scene.rig();
  if (rig && scene.look.bones && !covered) {
    const Positions joints = scene.joints_now();
    Pick found = pick_point(pixels_of(projection, joints, scene), at, Pick::Kind::joint, scale);
    if (found.kind == Pick::Kind::joint) {
      found.place = shown_point(joints.row(found.index), scene.document.space);
      return found;
    }
  }
  if (skeleton && !covered && scene.shows_curve()) {
    const std::vector<glm::vec3> pixels = pixels_of(projection, skeleton->nodes, scene);
    const auto shown = [&](Eigen::Index node) {
      return shown_point(skeleton->nodes.row(node), scene.document.space);
    };
    Pick found = pick_point(pixels, at, Pick::Kind::node, scale);
    if (found.kind == Pick::Kind::node) {
      found.place = shown(found.index);
      return found;
    }
    float share = 0;
    found = pick_edge(*skeleton, pixels, at, scale, share);
    if (found.kind == Pick::Kind::edge) {
      found.place = glm::mix(shown(skeleton->edges(found.index, 0)),
                             shown(skeleton->edges(found.index, 1)), share);
      return found;
    }
  }
  // Faces are found where the file has them.
  if (scene.look.surface == SurfaceStyle::hidden || scene.turns()) return {};
  return pick_face(scene, ray_through(scene.camera, at.x, at.y, width, height));
}

}  // namespace curveskel::viewer
