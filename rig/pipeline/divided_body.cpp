#include "rig/pipeline/divided_body.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

#include <curveskel/advanced/indices.hpp>

namespace curveskel {
namespace {

using Lists = std::vector<std::vector<int>>;

/// The members of the chosen lists, ascending, each once.
std::vector<int> members_of(const Lists& lists, const std::vector<int>& chosen) {
  std::vector<int> members;
  for (const int k : chosen)
    members.insert(members.end(), lists[idx(k)].begin(), lists[idx(k)].end());
  std::sort(members.begin(), members.end());
  members.erase(std::unique(members.begin(), members.end()), members.end());
  return members;
}

void number_in_order(const std::vector<int>& members, std::vector<int>& number) {
  for (std::size_t k = 0; k < members.size(); ++k) number[idx(members[k])] = static_cast<int>(k);
}

void forget(const std::vector<int>& members, std::vector<int>& number) {
  for (const int member : members) number[idx(member)] = -1;
}

}  // namespace

DividedBody::DividedBody(const RepairedSurface& body, const CurveSkeleton& skeleton,
                         const Topology& counted)
    : body_(body),
      skeleton_(skeleton),
      vertices_(idx(counted.components())),
      faces_(vertices_.size()),
      inputs_(vertices_.size()),
      rims_(vertices_.size()),
      sheets_(vertices_.size()),
      curves_(vertices_.size()),
      number_of_vertex_(idx(body.surface.positions.rows()), -1),
      number_of_node_(idx(skeleton.nodes.rows()), -1) {
  const std::vector<int> curve = component_of_node(skeleton);
  nodes_.resize(curve.empty() ? 0 : idx(1 + *std::max_element(curve.begin(), curve.end())));
  edges_.resize(nodes_.size());
  contacts_.resize(nodes_.size());
  std::vector<char> has_vertices(nodes_.size(), 0);
  const auto component = [&](int v) { return idx(counted.component_of_vertex[v]); };
  for (int v = 0; v < static_cast<int>(number_of_vertex_.size()); ++v) {
    vertices_[component(v)].push_back(v);
    const int node = skeleton.node_of_vertex[v];
    if (node < 0) continue;
    std::vector<int>& own = curves_[component(v)];
    if (own.empty() || own.back() != curve[idx(node)]) own.push_back(curve[idx(node)]);
    has_vertices[idx(curve[idx(node)])] = 1;
  }
  for (int f = 0; f < static_cast<int>(body.surface.triangles.rows()); ++f) {
    faces_[component(body.surface.triangles(f, 0))].push_back(f);
  }
  for (int input = 0; input < static_cast<int>(body.vertex_of_input.size()); ++input) {
    const int v = body.vertex_of_input[input];
    if (v >= 0) inputs_[component(v)].push_back(input);
  }
  for (std::size_t k = 0; k < body.rims.size(); ++k) {
    if (!body.rims[k].empty()) rims_[component(body.rims[k][0])].push_back(static_cast<int>(k));
  }
  for (std::size_t k = 0; k < body.sheets.size(); ++k) {
    sheets_[component(body.sheets[k])].push_back(static_cast<int>(k));
  }
  for (std::size_t node = 0; node < curve.size(); ++node) {
    nodes_[idx(curve[node])].push_back(static_cast<int>(node));
  }
  for (int e = 0; e < static_cast<int>(skeleton.edges.rows()); ++e) {
    edges_[idx(curve[idx(skeleton.edges(e, 0))])].push_back(e);
  }
  for (std::size_t k = 0; k < skeleton.contacts.size(); ++k) {
    contacts_[idx(curve[idx(skeleton.contacts[k].one.node)])].push_back(static_cast<int>(k));
  }
  for (std::size_t k = 0; k < has_vertices.size(); ++k) {
    if (has_vertices[k] == 0) curves_of_none_.push_back(static_cast<int>(k));
  }
}

PartOfBody DividedBody::part(const std::vector<int>& components) {
  const std::vector<int> own_vertices = vertices(components);
  const std::vector<int> own_nodes = nodes(components);
  number_in_order(own_vertices, number_of_vertex_);
  number_in_order(own_nodes, number_of_node_);
  PartOfBody made;
  add_surface(made, components, own_vertices);
  add_skeleton(made, curves(components), own_nodes);
  made.skeleton.node_of_vertex = skeleton_.node_of_vertex(own_vertices).unaryExpr([&](int node) {
    return node < 0 ? -1 : number_of_node_[idx(node)];
  });
  forget(own_vertices, number_of_vertex_);
  forget(own_nodes, number_of_node_);
  return made;
}

PartOfBody DividedBody::part_of_file(const std::vector<int>& components) {
  PartOfBody made = part(components);
  made.body.changes = body_.changes;
  made.body.repairs = body_.repairs;
  const std::vector<int> own_vertices = vertices(components);
  number_in_order(own_vertices, number_of_vertex_);
  add_inputs(made, components);
  forget(own_vertices, number_of_vertex_);
  return made;
}

std::vector<int> DividedBody::vertices(const std::vector<int>& components) const {
  return members_of(vertices_, components);
}

std::vector<int> DividedBody::nodes(const std::vector<int>& components) const {
  return members_of(nodes_, curves(components));
}

std::vector<int> DividedBody::curves(const std::vector<int>& components) const {
  std::vector<int> own = members_of(curves_, components);
  own.insert(own.end(), curves_of_none_.begin(), curves_of_none_.end());
  return own;
}

/// A rim with a vertex that is not in the part is none.
void DividedBody::add_inputs(PartOfBody& part, const std::vector<int>& components) const {
  part.inputs = members_of(inputs_, components);
  part.body.vertex_of_input = body_.vertex_of_input(*part.inputs).unaryExpr([&](int v) {
    return number_of_vertex_[idx(v)];
  });
  for (const int k : members_of(rims_, components)) {
    std::vector<std::int32_t> rim = body_.rims[idx(k)];
    for (std::int32_t& v : rim) v = number_of_vertex_[idx(v)];
    if (std::find(rim.begin(), rim.end(), -1) == rim.end()) part.body.rims.push_back(rim);
  }
}

void DividedBody::add_surface(PartOfBody& part, const std::vector<int>& components,
                              const std::vector<int>& vertices) {
  Surface& surface = part.body.surface;
  surface.positions = body_.surface.positions(vertices, Eigen::all);
  surface.triangles = body_.surface.triangles(members_of(faces_, components), Eigen::all);
  for (std::int32_t& v : surface.triangles.reshaped()) v = number_of_vertex_[idx(v)];
  for (const int k : members_of(sheets_, components)) {
    part.body.sheets.push_back(number_of_vertex_[idx(body_.sheets[idx(k)])]);
  }
}

void DividedBody::add_skeleton(PartOfBody& part, const std::vector<int>& curves,
                               const std::vector<int>& nodes) {
  CurveSkeleton& skeleton = part.skeleton;
  skeleton.nodes = skeleton_.nodes(nodes, Eigen::all);
  if (skeleton_.radii.size() > 0) skeleton.radii = skeleton_.radii(nodes);
  skeleton.edges = skeleton_.edges(members_of(edges_, curves), Eigen::all);
  for (std::int32_t& node : skeleton.edges.reshaped()) node = number_of_node_[idx(node)];
  for (const int k : members_of(contacts_, curves)) {
    Contact contact = skeleton_.contacts[idx(k)];
    for (ContactSide* const side : {&contact.one, &contact.other}) {
      side->node = number_of_node_[idx(side->node)];
      for (int& tip : side->tips) tip = number_of_node_[idx(tip)];
    }
    if (contact.other.node >= 0) skeleton.contacts.push_back(std::move(contact));
  }
}

}  // namespace curveskel
