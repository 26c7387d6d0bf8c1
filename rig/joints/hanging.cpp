#include "rig/joints/hanging.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <curveskel/advanced/indices.hpp>

namespace curveskel {
namespace {

constexpr double endless = std::numeric_limits<double>::infinity();

std::vector<char> are_ground(const std::vector<std::vector<int>>& components,
                             const std::vector<int>& ground) {
  std::vector<char> is_ground(components.size(), 0);
  for (std::size_t part = 0; part < components.size(); ++part) {
    const auto found = std::find(ground.begin(), ground.end(), components[part].front());
    if (found != ground.end()) is_ground[part] = 1;
  }
  return is_ground;
}

}  // namespace

HangingComponents::HangingComponents(const CurveSkeleton& skeleton, const Eigen::VectorXd& radii,
                                     const std::vector<std::vector<int>>& components,
                                     const std::vector<int>& ground)
    : curves_(skeleton),
      radii_(radii),
      links_(curves_, radii_, components, are_ground(components, ground)) {}

std::vector<Hinge> HangingComponents::hinges(const Eigen::Vector3d& up) const {
  std::vector<Hinge> hinges;
  for (const ComponentLink& link : links_.links()) {
    hinges.push_back(moved_to_end(link.contact < 0 ? link.hinge : at_contact(link, up)));
  }
  let_go(hinges);
  return hinges;
}

/// At the end of its curve that the contact reaches, the upper one of both.
Hinge HangingComponents::at_contact(const ComponentLink& link, const Eigen::Vector3d& up) const {
  constexpr double upright = 0.5;  // of the way between the ends
  const Contact& contact = curves_.skeleton.contacts[idx(link.contact)];
  Hinge hinge = link.hinge;
  const bool is_one = contact.one.node == hinge.node;
  const std::vector<int>& tips = (is_one ? contact.one : contact.other).tips;
  if (tips.empty()) return hinge;
  hinge.node = tips.front();
  if (tips.size() == 2) {
    const Eigen::Vector3d way = curves_.point(tips.back()) - curves_.point(tips.front());
    const double rise = way.dot(up);
    if (std::abs(rise) < upright * way.norm()) return link.hinge;
    hinge.node = rise > 0 ? tips.back() : tips.front();
  }
  double nearest = endless;
  for (const Bunch& bunch : links_.bunches()[links_.component_of(link.hinge.above)]) {
    for (const int node : bunch.nodes) {
      const double distance = (curves_.point(node) - curves_.point(hinge.node)).norm();
      if (distance >= nearest) continue;
      nearest = distance;
      hinge.above = node;
    }
  }
  return hinge;
}

/// Links hold where the gap is short beside either of the bodies that they join, which grow with
/// each link that holds.
void HangingComponents::let_go(std::vector<Hinge>& hinges) const {
  const std::vector<std::vector<Bunch>>& components = links_.bunches();
  constexpr double far_apart = 0.25;
  std::vector<Eigen::AlignedBox3d> boxes(components.size());
  for (std::size_t part = 0; part < components.size(); ++part) {
    for (const Bunch& bunch : components[part]) {
      boxes[part].extend(bunch.box.min() - Eigen::Vector3d::Constant(bunch.radius));
      boxes[part].extend(bunch.box.max() + Eigen::Vector3d::Constant(bunch.radius));
    }
  }
  UnionFind bodies(static_cast<int>(components.size()));
  const auto box_of = [&](std::size_t part) -> Eigen::AlignedBox3d& {
    return boxes[idx(bodies.root(static_cast<int>(part)))];
  };
  std::vector<char> holds(components.size(), 0);
  for (bool grew = true; grew;) {
    grew = false;
    for (std::size_t part = 1; part < components.size(); ++part) {
      if (holds[part] != 0 || hinges[part].above < 0) continue;
      const std::size_t above = links_.component_of(hinges[part].above);
      Eigen::AlignedBox3d both = box_of(part);
      const double larger = std::max(both.diagonal().norm(), box_of(above).diagonal().norm());
      if (hinges[part].gap > far_apart * larger) continue;
      both.extend(box_of(above));
      bodies.unite(static_cast<int>(part), static_cast<int>(above));
      box_of(part) = both;
      holds[part] = 1;
      grew = true;
    }
  }
  for (std::size_t part = 0; part < components.size(); ++part) {
    if (holds[part] == 0) hinges[part].above = -1;
  }
}

Hinge HangingComponents::moved_to_end(Hinge hinge) const {
  if (hinge.node < 0 || curves_.degree(hinge.node) != 2) return hinge;
  const int middle = hinge.node;
  double least = endless;
  for (const int neighbour : curves_.graph.neighbours(middle)) {
    double way = 0;
    int before = middle;
    int node = neighbour;
    while (node != middle) {
      way += (curves_.point(node) - curves_.point(before)).norm();
      const int next = curves_.beyond(before, node);
      if (next < 0 || way > 2 * radii_[middle]) break;
      before = node;
      node = next;
    }
    const double far = way / ((curves_.degree(node) == 1 ? 2 : 1) * radii_[middle]);
    if (curves_.degree(node) == 2 || far > 1 || far >= least) continue;
    least = far;
    hinge.node = node;
  }
  return hinge;
}

std::vector<Hinge> hang_components(const CurveSkeleton& skeleton, const Eigen::VectorXd& radii,
                                   const std::vector<std::vector<int>>& components,
                                   const std::vector<int>& ground, const Eigen::Vector3d& up) {
  return HangingComponents(skeleton, radii, components, ground).hinges(up);
}

}  // namespace curveskel
