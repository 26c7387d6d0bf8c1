#include "viewer/render/scene_colours.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <curveskel/advanced/graph.hpp>
#include "viewer/render/role_colours.hpp"

namespace curveskel::viewer {
namespace {

float share_of(const ColourScale& scale, double radius) {
  return scale.high > scale.low
             ? (static_cast<float>(radius) - scale.low) / (scale.high - scale.low)
             : 0.5F;
}

constexpr glm::vec3 lit_up{1.0F, 0.84F, 0.10F};
constexpr glm::vec3 failed{0.92F, 0.05F, 0.55F};

/// Colours of nodes; of edges for things that belong to edges.
class SkeletonColours {
 public:
  SkeletonColours(const CurveSkeleton& skeleton, const Look& look)
      : skeleton_(skeleton), look_(look), palette_(palette_of(look.theme)) {
    if (look.skeleton_colour == ColourBy::component) component_ = components_of(skeleton);
    if (look.skeleton_colour == ColourBy::branch) branch_ = branch_of_edges(skeleton);
    scale_ = radius_scale(skeleton).value_or(ColourScale{});
  }
  [[nodiscard]] glm::vec3 node(int index) const {
    switch (look_.skeleton_colour) {
      case ColourBy::file:
      case ColourBy::plain:
      case ColourBy::branch:
      case ColourBy::weight:
      case ColourBy::role:
      case ColourBy::part:
        break;
      case ColourBy::component:
        return category(static_cast<std::size_t>(component_[static_cast<std::size_t>(index)]));
      case ColourBy::node:
        return category(static_cast<std::size_t>(index));
      case ColourBy::radius:
        if (skeleton_.radii.size() == 0) break;
        return mapped(look_.map, share_of(scale_, skeleton_.radii[index]));
    }
    return palette_.skeleton;
  }
  [[nodiscard]] glm::vec3 edge(Eigen::Index row, int end) const {
    if (look_.skeleton_colour != ColourBy::branch) return node(skeleton_.edges(row, end));
    const int branch = branch_[static_cast<std::size_t>(row)];
    return branch < 0 ? palette_.skeleton : category(static_cast<std::size_t>(branch));
  }
  [[nodiscard]] glm::vec3 joint(int index) const {
    const bool by_node = look_.skeleton_colour == ColourBy::component ||
                         look_.skeleton_colour == ColourBy::node ||
                         look_.skeleton_colour == ColourBy::radius;
    return by_node ? node(index) : palette_.joint;
  }

 private:
  const CurveSkeleton& skeleton_;
  const Look& look_;
  Palette palette_;
  ColourScale scale_;
  std::vector<int> component_;
  std::vector<int> branch_;
};

bool holds(const std::vector<int>& sorted, Eigen::Index index) {
  return std::binary_search(sorted.begin(), sorted.end(), static_cast<int>(index));
}

std::vector<int> in_order(std::vector<int> indices) {
  std::sort(indices.begin(), indices.end());
  return indices;
}

/// The tube's thickness at a node, as drawn.
float radius_at(const CurveSkeleton& skeleton, const DrawnSpace& space, Eigen::Index node,
                float thin, const Look& look) {
  if (look.skeleton == SkeletonStyle::balls && skeleton.radii.size() > 0) {
    return std::max(shown_length(skeleton.radii[node], space), 0.0F);
  }
  return look.skeleton == SkeletonStyle::lines ? 0 : thin;
}

/// For each node between two edges that turn by less than 75 degrees: the normal of the plane along
/// which both are cut, pointing from the lower neighbour to the higher one; else zero.
std::vector<glm::vec3> mitres_of(const CurveSkeleton& skeleton, const std::vector<int>& degree) {
  std::vector<glm::vec3> mitres(degree.size(), glm::vec3(0));
  std::vector<int> seen(degree.size(), 0);
  std::vector<glm::vec3> first(degree.size(), glm::vec3(0));
  const auto way = [&](int a, int b) {
    const Eigen::Vector3f along =
        (skeleton.nodes.row(b) - skeleton.nodes.row(a)).stableNormalized().cast<float>();
    return glm::vec3(along.x(), along.y(), along.z());
  };
  for (const auto& edge : skeleton.edges.rowwise()) {
    for (int end = 0; end < 2; ++end) {
      const auto node = static_cast<std::size_t>(edge[end]);
      const glm::vec3 out = way(edge[end], edge[1 - end]);
      if (degree[node] != 2) continue;
      if (seen[node]++ == 0) {
        first[node] = out;
        continue;
      }
      constexpr float least = 1.58F;  // |a - b| of unit vectors out of a node that turns by 75 deg
      const glm::vec3 normal = out - first[node];
      const float length = glm::length(normal);
      if (length > least) mitres[node] = normal / length;
    }
  }
  return mitres;
}

std::vector<Rgba> category_colours(const std::vector<int>& number) {
  std::vector<Rgba> colours;
  colours.reserve(number.size());
  for (const int part : number) {
    colours.push_back(rgba(part < 0 ? glm::vec3(0.5F) : category(static_cast<std::size_t>(part))));
  }
  return colours;
}

/// Shares of one joint by the map; of all, their colours mixed.
std::vector<Rgba> weight_colours(const Rig& rig, int joint, const Look& look,
                                 const Palette& palette) {
  std::vector<Rgba> colours;
  colours.reserve(static_cast<std::size_t>(rig.weights.rows()));
  for (Eigen::Index vertex = 0; vertex < rig.weights.rows(); ++vertex) {
    float share = 0;
    float sum = 0;
    glm::vec3 mixed(0);
    for (SkinWeights::InnerIterator it(rig.weights, vertex); it; ++it) {
      sum += it.value();
      mixed += it.value() * category(static_cast<std::size_t>(it.col()));
      if (it.col() == joint) share = it.value();
    }
    const glm::vec3 own = joint < 0 ? mixed : mapped(look.map, share);
    colours.push_back(rgba(sum > 0 ? own : palette.surface));
  }
  return colours;
}

/// Of each vertex that of the joint with the largest share.
std::vector<Rgba> colours_by_role(const Rig& rig, const Palette& palette) {
  const std::vector<glm::vec3> of_joint = role_colours(rig);
  std::vector<Rgba> colours;
  colours.reserve(static_cast<std::size_t>(rig.weights.rows()));
  for (Eigen::Index vertex = 0; vertex < rig.weights.rows(); ++vertex) {
    float most = 0;
    glm::vec3 colour = palette.surface;
    for (SkinWeights::InnerIterator it(rig.weights, vertex); it; ++it) {
      if (it.value() <= most) continue;
      most = it.value();
      colour = of_joint[static_cast<std::size_t>(it.col())];
    }
    colours.push_back(rgba(colour));
  }
  return colours;
}

/// Followers in their own colours, the body in the plain one.
std::vector<Rgba> colours_by_part(const RigParts& parts, const Palette& palette) {
  std::vector<Rgba> colours;
  colours.reserve(static_cast<std::size_t>(parts.part_of_vertex.size()));
  for (const int part : parts.part_of_vertex) {
    const bool follows = part >= 0 && parts.parts[static_cast<std::size_t>(part)].follows;
    colours.push_back(rgba(follows ? category(static_cast<std::size_t>(part)) : palette.surface));
  }
  return colours;
}

std::vector<Rgba> colours_by_map(const CurveSkeleton& skeleton, const Look& look,
                                 const Palette& palette) {
  Look as_skeleton = look;
  as_skeleton.skeleton_colour = look.surface_colour;
  const SkeletonColours of_nodes(skeleton, as_skeleton);
  std::vector<Rgba> of_node;
  of_node.reserve(static_cast<std::size_t>(skeleton.nodes.rows()));
  for (int node = 0; node < skeleton.nodes.rows(); ++node) {
    of_node.push_back(rgba(of_nodes.node(node)));
  }
  if (look.surface_colour == ColourBy::branch) {
    const std::vector<int> branch = branch_of_edges(skeleton);
    for (Eigen::Index row = 0; row < skeleton.edges.rows(); ++row) {
      for (int end = 0; end < 2; ++end) {
        of_node[static_cast<std::size_t>(skeleton.edges(row, end))] = rgba(
            category(static_cast<std::size_t>(std::max(branch[static_cast<std::size_t>(row)], 0))));
      }
    }
  }
  std::vector<Rgba> colours;
  colours.reserve(static_cast<std::size_t>(skeleton.node_of_vertex.size()));
  for (const int node : skeleton.node_of_vertex) {
    colours.push_back(node < 0 ? rgba(palette.surface) : of_node[static_cast<std::size_t>(node)]);
  }
  return colours;
}

}  // namespace

std::vector<int> components_of(const Surface& surface) {
  UnionFind parts(surface.positions.rows());
  std::vector<bool> used(static_cast<std::size_t>(surface.positions.rows()), false);
  for (const auto& triangle : surface.triangles.rowwise()) {
    parts.unite(triangle[0], triangle[1]);
    parts.unite(triangle[1], triangle[2]);
    for (const int vertex : triangle) used[static_cast<std::size_t>(vertex)] = true;
  }
  std::vector<int> number(used.size(), -1);
  int next = 0;
  for (int vertex = 0; vertex < static_cast<int>(used.size()); ++vertex) {
    if (!used[static_cast<std::size_t>(vertex)]) continue;
    const int first = parts.root(vertex);
    number[static_cast<std::size_t>(vertex)] =
        first == vertex ? next++ : number[static_cast<std::size_t>(first)];
  }
  return number;
}

std::vector<int> components_of(const CurveSkeleton& skeleton) {
  return component_of_node(skeleton);
}

std::optional<ColourScale> radius_scale(const CurveSkeleton& skeleton) {
  if (skeleton.radii.size() == 0) return std::nullopt;
  const auto low = static_cast<float>(skeleton.radii.minCoeff());
  const auto high = static_cast<float>(skeleton.radii.maxCoeff());
  // Values that hardly differ are shown as equal.
  constexpr float least_range = 0.1F;
  return ColourScale{std::min(low, high * (1 - least_range)), high};
}

ShownSkeleton shown_skeleton(const CurveSkeleton& skeleton, const DrawnSpace& space, float size,
                             const Look& look, const Highlights& highlights) {
  const SkeletonColours colours(skeleton, look);
  constexpr float thin_share = 0.0032F;
  const float thin = thin_share * size * look.thickness;
  const auto at = [&](Eigen::Index node) {
    return glm::vec4(shown_point(skeleton.nodes.row(node), space),
                     radius_at(skeleton, space, node, thin, look));
  };
  const std::vector<int> lit_edges = in_order(highlights.edges);
  const std::vector<int> failed_edges = in_order(highlights.failed_edges);
  const std::vector<int> lit_nodes = in_order(highlights.nodes);
  const std::vector<int> degree = degrees(skeleton.nodes.rows(), skeleton.edges);
  const bool thick = look.skeleton == SkeletonStyle::balls;
  const std::vector<glm::vec3> mitres =
      thick ? std::vector<glm::vec3>(degree.size(), glm::vec3(0)) : mitres_of(skeleton, degree);
  /// Towards the edge's second end.
  const auto mitre_at = [&](Eigen::Index row, int end) {
    const glm::vec3 mitre = mitres[static_cast<std::size_t>(skeleton.edges(row, end))];
    const glm::vec3 along =
        glm::vec3(at(skeleton.edges(row, 1))) - glm::vec3(at(skeleton.edges(row, 0)));
    return glm::dot(mitre, along) < 0 ? -mitre : mitre;
  };
  ShownSkeleton shown;
  shown.edges.reserve(static_cast<std::size_t>(skeleton.edges.rows()));
  for (Eigen::Index row = 0; row < skeleton.edges.rows(); ++row) {
    TubeInstance tube{at(skeleton.edges(row, 0)), at(skeleton.edges(row, 1)),
                      rgba(colours.edge(row, 0)), rgba(colours.edge(row, 1)),
                      mitre_at(row, 0),           mitre_at(row, 1)};
    if (holds(failed_edges, row)) tube.from_colour = tube.to_colour = rgba(failed);
    if (holds(lit_edges, row)) tube.from_colour = tube.to_colour = rgba(lit_up);
    shown.edges.push_back(tube);
  }
  shown.nodes.reserve(degree.size());
  for (Eigen::Index node = 0; node < skeleton.nodes.rows(); ++node) {
    const bool lit = holds(lit_nodes, node);
    const bool joint = look.joints && degree[static_cast<std::size_t>(node)] != 2;
    glm::vec4 place = at(node);
    if (joint && !thick) place.w = std::max(place.w, 1.9F * thin);
    if (lit) place.w = std::max(place.w, 2.4F * thin);
    const auto index = static_cast<int>(node);
    const Rgba own = rgba(joint ? colours.joint(index) : colours.node(index));
    // If the edges fit without a gap, a ball would cost more than both of them.
    const bool seamless = mitres[static_cast<std::size_t>(node)] != glm::vec3(0);
    if (seamless && !lit) continue;
    const Rgba colour = lit ? rgba(lit_up) : own;
    shown.nodes.push_back({place, place, colour, colour, {}, {}});
  }
  return shown;
}

ShownSkeleton shown_rig(const Rig& rig, const Positions& joints, const DrawnSpace& space,
                        float size, const Look& look, const Highlights& highlights) {
  // The shape that Blender and others draw: widest near the joint that turns it.
  constexpr float widest_at = 0.12F;
  constexpr float width = 0.07F;
  constexpr float joint_share = 0.0055F;
  const Palette palette = palette_of(look.theme);
  const float ball = joint_share * size * look.thickness;
  const bool by_role = look.surface_colour == ColourBy::role;
  const std::vector<glm::vec3> of_role = by_role ? role_colours(rig) : std::vector<glm::vec3>{};
  const auto colour_of = [&](int joint, const glm::vec3& usual) {
    if (joint == highlights.joint) return rgba(lit_up);
    return rgba(by_role ? of_role[static_cast<std::size_t>(joint)] : usual);
  };
  ShownSkeleton shown;
  for (int joint = 0; joint < rig.joints.rows(); ++joint) {
    const bool lit = joint == highlights.joint;
    const glm::vec3 at = shown_point(joints.row(joint), space);
    const Rgba colour = colour_of(joint, palette.bone_joint);
    const glm::vec4 place(at, lit ? 1.4F * ball : ball);
    shown.nodes.push_back({place, place, colour, colour, {}, {}});
    const int parent = rig.parents[joint];
    if (parent < 0) continue;
    const glm::vec3 from = shown_point(joints.row(parent), space);
    const glm::vec4 middle(glm::mix(from, at, widest_at),
                           std::min(width * glm::length(at - from), 2 * ball));
    const Rgba bone = colour_of(parent, palette.bone);
    shown.edges.push_back({glm::vec4(from, 0), middle, bone, bone, {}, {}});
    shown.edges.push_back({middle, glm::vec4(at, 0), bone, bone, {}, {}});
  }
  return shown;
}

std::vector<Rgba> surface_colours(const Surface& surface, const Meaning& meaning, const Look& look,
                                  const Highlights& highlights) {
  const Palette palette = palette_of(look.theme);
  const CurveSkeleton* const skeleton = meaning.skeleton;
  const bool has_map =
      skeleton != nullptr && skeleton->node_of_vertex.size() == surface.positions.rows();
  const bool has_weights =
      meaning.rig != nullptr && meaning.rig->weights.rows() == surface.positions.rows();
  std::vector<Rgba> colours;
  if (look.surface_colour == ColourBy::component) {
    colours = category_colours(components_of(surface));
  } else if (look.surface_colour == ColourBy::weight) {
    if (has_weights) colours = weight_colours(*meaning.rig, highlights.joint, look, palette);
  } else if (look.surface_colour == ColourBy::role) {
    if (has_weights) colours = colours_by_role(*meaning.rig, palette);
  } else if (look.surface_colour == ColourBy::part) {
    const bool has_parts = meaning.parts != nullptr &&
                           meaning.parts->part_of_vertex.size() == surface.positions.rows();
    if (has_parts) colours = colours_by_part(*meaning.parts, palette);
  } else if (look.surface_colour == ColourBy::file) {
    if (meaning.materials != nullptr) colours = meaning.materials->colour_of_vertex;
  } else if (look.surface_colour != ColourBy::plain && has_map) {
    colours = colours_by_map(*skeleton, look, palette);
  }
  const bool lights_up = has_map && !highlights.nodes.empty();
  if (colours.empty() && (lights_up || !highlights.failed_faces.empty())) {
    colours.assign(static_cast<std::size_t>(surface.positions.rows()), rgba(palette.surface));
  }
  constexpr glm::vec3 defective{0.90F, 0.12F, 0.10F};
  for (const int face : highlights.failed_faces) {
    for (const int vertex : surface.triangles.row(face)) {
      colours[static_cast<std::size_t>(vertex)] = rgba(defective);
    }
  }
  if (lights_up) {
    const std::vector<int> lit = in_order(highlights.nodes);
    for (Eigen::Index v = 0; v < surface.positions.rows(); ++v) {
      if (holds(lit, skeleton->node_of_vertex[v])) {
        colours[static_cast<std::size_t>(v)] = rgba(lit_up);
      }
    }
  }
  return colours;
}

}  // namespace curveskel::viewer
