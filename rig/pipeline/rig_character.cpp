#include <curveskel/rig_character.hpp>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <curveskel/advanced/closed_manifold.hpp>
#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/union_find.hpp>
#include <curveskel/error.hpp>
#include <curveskel/levels.hpp>
#include <curveskel/rig_polygons.hpp>
#include "base/option_ranges.hpp"
#include "rig/joints/contacts.hpp"
#include "rig/joints/fully_mapped.hpp"
#include "rig/joints/idle_joints.hpp"
#include "rig/parts/sound_parts.hpp"
#include "rig/pipeline/figures.hpp"
#include "skeleton/certify/tube_share.hpp"
#include "skeleton/graph/sound_skeleton.hpp"
#include "surface/repair/sound_repaired.hpp"

namespace curveskel {

std::vector<int> nodes_of_body(const CurveSkeleton& skeleton, const RigParts& parts) {
  const Eigen::Index count = skeleton.nodes.rows();
  UnionFind joined(count);
  for (const auto& edge : skeleton.edges.rowwise()) joined.unite(edge[0], edge[1]);
  std::vector<char> is_body(idx(count), 0);
  std::vector<char> follows(idx(count), 0);
  for (Eigen::Index v = 0; v < skeleton.node_of_vertex.size(); ++v) {
    const int node = skeleton.node_of_vertex[v];
    if (node < 0) continue;
    const bool is_follower = parts.parts[idx(parts.part_of_vertex[v])].follows;
    (is_follower ? follows : is_body)[idx(joined.root(node))] = 1;
  }
  std::vector<int> nodes;
  for (int node = 0; node < static_cast<int>(count); ++node) {
    const std::size_t root = idx(joined.root(node));
    if (is_body[root] != 0 || follows[root] == 0) nodes.push_back(node);
  }
  return nodes;
}

namespace {

/// Those of which both components have a number, of their nodes.
std::vector<Contact> contacts_among(const std::vector<Contact>& contacts,
                                    const std::vector<int>& number) {
  std::vector<Contact> among;
  for (Contact contact : contacts) {
    for (ContactSide* const side : {&contact.one, &contact.other}) {
      side->node = number[idx(side->node)];
      for (int& tip : side->tips) tip = number[idx(tip)];
    }
    if (contact.one.node >= 0 && contact.other.node >= 0) among.push_back(std::move(contact));
  }
  return among;
}

}  // namespace

CurveSkeleton skeleton_of_body(const CurveSkeleton& skeleton, const RigParts& parts) {
  require_sound(skeleton, "skeleton_of_body");
  require_parts_of(parts, skeleton.node_of_vertex.size(), "skeleton_of_body");
  const std::vector<int> nodes = nodes_of_body(skeleton, parts);
  std::vector<int> number(idx(skeleton.nodes.rows()), -1);
  for (std::size_t k = 0; k < nodes.size(); ++k) number[idx(nodes[k])] = static_cast<int>(k);
  CurveSkeleton body;
  body.nodes = skeleton.nodes(nodes, Eigen::all);
  if (skeleton.radii.size() > 0) body.radii = skeleton.radii(nodes);
  if (has_lives(skeleton)) body.lives = skeleton.lives(nodes);
  std::vector<Eigen::Index> edges;
  for (Eigen::Index e = 0; e < skeleton.edges.rows(); ++e) {
    if (number[idx(skeleton.edges(e, 0))] >= 0) edges.push_back(e);
  }
  body.edges = skeleton.edges(edges, Eigen::all);
  for (int& node : body.edges.reshaped()) node = number[idx(node)];
  body.contacts = contacts_among(skeleton.contacts, number);
  std::vector<int> node_of_vertex;
  for (Eigen::Index v = 0; v < skeleton.node_of_vertex.size(); ++v) {
    if (parts.parts[idx(parts.part_of_vertex[v])].follows) continue;
    const int node = skeleton.node_of_vertex[v];
    node_of_vertex.push_back(node < 0 ? -1 : number[idx(node)]);
  }
  body.node_of_vertex = Eigen::Map<const Eigen::VectorXi>(
      node_of_vertex.data(), static_cast<Eigen::Index>(node_of_vertex.size()));
  return body;
}

namespace {

/// With names; the joints of the plan first.
RiggedBody rigged(Figure figure, const CharacterOptions& options, const Monitor& monitor) {
  RiggedBody made{std::move(figure.body), std::move(figure.skeleton), {}, std::move(figure.inputs)};
  made.rig = without_idle_joints(
      make_planned_rig(made.body.surface, made.skeleton, figure.plan, options.rig, monitor),
      figure.plan.joints.size(), made.body.vertex_of_input);
  name_roles(made.rig, figure.plan, options.names);
  return made;
}

void make_all_body(RigParts& parts) {
  for (RigPart& part : parts.parts) {
    part.follows = false;
    part.host = -1;
  }
}

/// All that gets joints.
struct Body {
  RepairedSurface surface;
  CurveSkeleton skeleton;
};

void require_sound_body(const Surface& given, const RepairedSurface& body,
                        const CharacterOptions& options, std::string_view purpose) {
  require_valid(options.rig);
  require_valid(options.plan);
  OptionCheck("CharacterOptions").choice("names", options.names, name_styles);
  require_corners(given, purpose);
  require_sound(body, purpose);
  if (body.vertex_of_input.size() == given.positions.rows()) return;
  throw Error(Fault::input, std::string(purpose) + ": found a map of " +
                                std::to_string(body.vertex_of_input.size()) +
                                " vertices, needed one of the file's " +
                                std::to_string(given.positions.rows()));
}

}  // namespace

CharacterRig rig_body(const Surface& given, const RepairedSurface& body,
                      const CurveSkeleton& skeleton, const CharacterOptions& options,
                      const Monitor& monitor) {
  require_sound_body(given, body, options, "rig_body");
  CurveSkeleton dense = dense_skeleton(body.surface, skeleton, monitor);
  const bool is_root_chosen = options.rig.joints.root >= 0;  // it stays in its place
  if (!is_root_chosen) turn_to_contacts(dense, body.surface);
  PlanOptions wanted = options.plan;
  if (is_root_chosen) wanted.plan = BodyKind::none;
  std::vector<Figure> figures =
      find_figures(body, dense, {wanted, options.rig.skin.threads}, monitor.stop);
  CharacterRig result;
  result.plan = figures.front().plan;
  std::vector<RiggedBody> made;
  made.reserve(figures.size());
  for (Figure& figure : figures) {
    if (!made.empty()) result.other_plans.push_back(figure.plan);
    made.push_back(rigged(std::move(figure), options, monitor));
  }
  const RiggedBody all = side_by_side(std::move(made), given.positions.rows());
  result.rig = rig_of_given(all.rig, all.body.surface, all.skeleton, all.body.vertex_of_input,
                            given, options.rig.skin);
  result.follows = followers_of(all.body.vertex_of_input);
  return result;
}

CharacterRig rig_character(const Surface& given, const RepairedSurface& repaired,
                           const CurveSkeleton& skeleton, const CharacterOptions& options,
                           const Monitor& monitor, const Certificate* certificate) {
  require_sound_body(given, repaired, options, "rig_character");
  PartOptions wanted = options.parts;
  const bool is_mapped = skeleton.node_of_vertex.size() > 0;
  if (options.rig.joints.root >= 0 || !is_mapped) wanted.follow = 0;
  RigParts parts = find_parts(repaired.surface, wanted, monitor);
  // Plans are by the vertices of limbs, too; most formats of skeletons have none.
  Body body{repaired, is_mapped
                          ? skeleton
                          : fully_mapped(repaired.surface, skeleton, wanted.threads, monitor)};
  if (!parts.all_body()) {
    CurveSkeleton of_body = skeleton_of_body(skeleton, parts);
    if (of_body.nodes.rows() > 0) {
      body = {body_of(repaired, parts), std::move(of_body)};
    } else {  // its curves are of other parts alone
      make_all_body(parts);
    }
  }
  CharacterOptions judged = options;
  if (certificate != nullptr) {
    const double share = parts.all_body() ? certificate->tube_share
                                          : tube_share(body.surface.surface, body.skeleton,
                                                       {.threads = options.parts.threads}, monitor);
    judged.plan.made_of_tubes = made_of_tubes_but_for_sheets(share, body.surface);
  }
  CharacterRig result = rig_body(given, body.surface, body.skeleton, judged, monitor);
  result = within_budget(std::move(result), given, options.joint_budget);
  result.parts = std::move(parts);
  return result;
}

}  // namespace curveskel
