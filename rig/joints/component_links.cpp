#include "rig/joints/component_links.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include <curveskel/advanced/indices.hpp>
#include "surface/spatial/box_tree.hpp"

namespace curveskel {
namespace {

/// No link between two balls within these boxes is shorter.
double least_length(double apart, double radius, double other_radius) {
  return std::max(apart - radius - other_radius, -2 * std::min(radius, other_radius));
}

/// All that there is to say of a component without its bunches.
Bunch whole_of(const std::vector<Bunch>& bunches) {
  Bunch whole;
  for (const Bunch& bunch : bunches) {
    whole.box.extend(bunch.box);
    whole.radius = std::max(whole.radius, bunch.radius);
  }
  return whole;
}

}  // namespace

/// Finds the one of those above from which a component hangs.
class ComponentLinks::Nearest {
 public:
  /// `above` in the order in which they came to hang together.
  Nearest(const ComponentLinks& links, const std::vector<std::size_t>& above)
      : links_(links),
        none_(above.size()),
        rank_(links.parts_.size(), none_),
        tree_(middles_of(above)) {
    for (std::size_t rank = 0; rank < above.size(); ++rank) rank_[above[rank]] = rank;
    Eigen::AlignedBox3d all;
    for (std::size_t k = 0; k < bunches_.size(); ++k) {
      const Bunch& bunch = bunch_at(k);
      tree_.put(k, {bunch.box, bunch.radius});
      all.extend(bunch.box);
      rounding_ = std::max(rounding_, bunch.radius);
    }
    rounding_ = 1e-12 * (rounding_ + all.diagonal().norm());
  }

  /// Of equally long links the one to the first of those above, by the first bunches.
  ComponentLink link(std::size_t part) {
    best_ = {};
    most_ = best_.length;
    std::map<std::size_t, int> contact_with;
    for (const auto& [other, contact] : links_.contacts_[part]) contact_with[other] = contact;
    for (const auto& [other, contact] : contact_with) {
      if (rank_[other] == none_) continue;
      consider(links_.link_by_contact(contact, part), {rank_[other], 0, 0});
    }
    const Bunch& own = links_.wholes_[part];
    const auto bound = [&](const BoxTree::Item& its) {
      return least_length(own.box.exteriorDistance(its.box), own.radius, its.weight);
    };
    tree_.search(bound, most_, [&](std::size_t k) {
      const auto [above, number] = bunches_[k];
      if (contact_with.count(above) > 0) return;
      const std::vector<Bunch>& lower = links_.parts_[part];
      for (std::size_t i = 0; i < lower.size(); ++i) {
        ComponentLink start;
        start.length = best_.length;
        consider(links_.shortest_between(lower[i], bunch_at(k), start, rounding_),
                 {rank_[above], i, number});
      }
    });
    return best_;
  }

 private:
  using Rank = std::array<std::size_t, 3>;  // above, bunch, bunch above

  Positions middles_of(const std::vector<std::size_t>& above) {
    for (const std::size_t part : above) {
      for (std::size_t k = 0; k < links_.parts_[part].size(); ++k) bunches_.emplace_back(part, k);
    }
    Positions middles(static_cast<Eigen::Index>(bunches_.size()), 3);
    for (std::size_t k = 0; k < bunches_.size(); ++k) {
      middles.row(static_cast<Eigen::Index>(k)) = bunch_at(k).box.center().transpose();
    }
    return middles;
  }

  [[nodiscard]] const Bunch& bunch_at(std::size_t k) const {
    return links_.parts_[bunches_[k].first][bunches_[k].second];
  }

  void consider(const ComponentLink& link, const Rank& rank) {
    if (link.hinge.node < 0 || best_ < link) return;
    if (!(link < best_) && !(rank < best_rank_)) return;
    best_ = link;
    best_rank_ = rank;
    most_ = link.length + rounding_;
  }

  const ComponentLinks& links_;
  std::size_t none_;
  std::vector<std::size_t> rank_;  // by part, of those above; none_ of all else
  std::vector<std::pair<std::size_t, std::size_t>> bunches_;  // of those above: part, number
  BoxTree tree_;                                              // of these
  double rounding_ = 0;
  ComponentLink best_;
  Rank best_rank_{};
  double most_ = 0;
};

ComponentLinks::ComponentLinks(const CurveGraph& curves, const Eigen::VectorXd& radii,
                               const std::vector<std::vector<int>>& components,
                               const std::vector<char>& is_ground)
    : curves_(curves), radii_(radii) {
  constexpr std::size_t most_above = 1000;
  const auto nodes = static_cast<int>(curves.skeleton.nodes.rows());
  directions_.resize(nodes, 3);
  for (int node = 0; node < nodes; ++node) directions_.row(node) = direction(node).transpose();
  find_bunches(components);
  find_contacts(components);
  links_.resize(components.size());
  const std::size_t above = std::min(components.size(), most_above);
  const std::vector<std::size_t> order = span(above, is_ground);
  if (above == components.size()) return;
  Nearest nearest(*this, order);
  for (std::size_t part = above; part < components.size(); ++part) {
    if (is_ground[part] == 0) links_[part] = nearest.link(part);
  }
}

/// Prim (1957) for those that others may hang from, the first; their order.
std::vector<std::size_t> ComponentLinks::span(std::size_t above,
                                              const std::vector<char>& is_ground) {
  std::vector<std::size_t> open;
  for (std::size_t part = 1; part < above; ++part) {
    if (is_ground[part] == 0) open.push_back(part);
  }
  std::vector<std::size_t> order{0};
  while (true) {
    const std::size_t last = order.back();
    mark_contacts(last);
    for (const std::size_t part : open) link(part, last);
    if (open.empty()) return order;
    const auto next = std::min_element(open.begin(), open.end(),
                                       [this](auto a, auto b) { return links_[a] < links_[b]; });
    order.push_back(*next);
    open.erase(next);
  }
}

/// About a radius along the curve.
Eigen::Vector3d ComponentLinks::place_beside(int node, int neighbour) const {
  int before = node;
  while ((curves_.point(neighbour) - curves_.point(node)).norm() < radii_[node]) {
    const int next = curves_.beyond(before, neighbour);
    if (next < 0 || next == node) break;
    before = neighbour;
    neighbour = next;
  }
  return curves_.point(neighbour);
}

/// Of the curve, none at a junction or where it is a point.
Eigen::Vector3d ComponentLinks::direction(int node) const {
  const int degree = curves_.degree(node);
  if (degree == 0 || degree > 2) return Eigen::Vector3d::Zero();
  const auto neighbours = curves_.graph.neighbours(node);
  const Eigen::Vector3d from = place_beside(node, neighbours.front());
  const Eigen::Vector3d to =
      degree == 1 ? curves_.point(node) : place_beside(node, neighbours.back());
  return (to - from).stableNormalized();
}

/// Along the curve, so that they are small.
void ComponentLinks::find_bunches(const std::vector<std::vector<int>>& components) {
  constexpr std::size_t most_nodes = 32;
  std::vector<char> seen(idx(curves_.graph.nodes()), 0);
  for (const std::vector<int>& component : components) {
    std::vector<Bunch>& all = parts_.emplace_back();
    std::vector<int> open{component.front()};
    seen[idx(component.front())] = 1;
    while (!open.empty()) {
      const int node = open.back();
      open.pop_back();
      if (all.empty() || all.back().nodes.size() == most_nodes) all.emplace_back();
      all.back().nodes.push_back(node);
      all.back().box.extend(curves_.point(node));
      all.back().radius = std::max(all.back().radius, radii_[node]);
      for (const int other : curves_.graph.neighbours(node)) {
        if (seen[idx(other)] == 0) open.push_back(other);
        seen[idx(other)] = 1;
      }
    }
    wholes_.push_back(whole_of(all));
  }
}

/// By their numbers, either way.
void ComponentLinks::find_contacts(const std::vector<std::vector<int>>& components) {
  part_of_.resize(idx(curves_.graph.nodes()));
  contacts_.resize(components.size());
  marked_.assign(components.size(), {components.size(), -1});
  for (std::size_t part = 0; part < components.size(); ++part) {
    for (const int node : components[part]) part_of_[idx(node)] = part;
  }
  const std::vector<Contact>& contacts = curves_.skeleton.contacts;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const std::size_t one = part_of_[idx(contacts[k].one.node)];
    const std::size_t other = part_of_[idx(contacts[k].other.node)];
    contacts_[one].emplace_back(other, static_cast<int>(k));
    contacts_[other].emplace_back(one, static_cast<int>(k));
  }
}

/// Of two contacts with one component the last counts.
void ComponentLinks::mark_contacts(std::size_t above) {
  for (const auto& [part, contact] : contacts_[above]) marked_[part] = {above, contact};
}

/// Takes the link to `above`, of which the contacts are marked, if it is the best so far.
void ComponentLinks::link(std::size_t part, std::size_t above) {
  if (marked_[part].above == above) {
    links_[part] = std::min(links_[part], link_by_contact(marked_[part].contact, part));
  } else {
    link_by_nodes(part, above);
  }
}

void ComponentLinks::link_by_nodes(std::size_t part, std::size_t above) {
  ComponentLink& best = links_[part];
  const Bunch& own = wholes_[part];
  const Bunch& its = wholes_[above];
  const double least = least_length(own.box.exteriorDistance(its.box), own.radius, its.radius);
  if (least > best.length) return;
  for (const Bunch& lower : parts_[part]) {
    for (const Bunch& upper : parts_[above]) best = shortest_between(lower, upper, best, 0);
  }
}

/// The best so far where none is shorter. Bounds may be too large by rounding.
ComponentLink ComponentLinks::shortest_between(const Bunch& lower, const Bunch& upper,
                                               ComponentLink best, double rounding) const {
  const double apart = lower.box.exteriorDistance(upper.box);
  if (least_length(apart, lower.radius, upper.radius) > best.length + rounding) return best;
  for (const int node : lower.nodes) {
    const double way = upper.box.exteriorDistance(curves_.point(node));
    if (least_length(way, radii_[node], upper.radius) > best.length + rounding) continue;
    for (const int other : upper.nodes) best = std::min(best, link_between(node, other));
  }
  return best;
}

ComponentLink ComponentLinks::link_between(int node, int above) const {
  const Eigen::Vector3d way = curves_.point(above) - curves_.point(node);
  const double distance = way.norm();
  const double smaller = std::min(radii_[node], radii_[above]);
  const double gap = distance - radii_[node] - radii_[above];
  return {std::max(gap, -2 * smaller) + smaller * sideways(way, distance, node, above),
          gap,
          {node, above, gap},
          -1};
}

ComponentLink ComponentLinks::link_by_contact(int number, std::size_t part) const {
  const Contact& contact = curves_.skeleton.contacts[idx(number)];
  int node = contact.one.node;
  int above = contact.other.node;
  if (part_of_[idx(node)] != part) std::swap(node, above);
  const double thicker = std::max(radii_[node], radii_[above]);
  const double width = std::min(thicker, std::sqrt(contact.area / std::numbers::pi));
  const double aside = std::min(aside_of(node, contact.middle), aside_of(above, contact.middle));
  return {contact.gap + width * (aside - 2),
          contact.gap - std::sqrt(contact.area),
          {node, above, contact.gap},
          number};
}

/// The distance of the place from the curve's line at the node, in radii; 1 at most.
double ComponentLinks::aside_of(int node, const Eigen::Vector3d& place) const {
  const Eigen::Vector3d direction = directions_.row(node).transpose();
  return std::min(1.0, direction.cross(place - curves_.point(node)).norm() / radii_[node]);
}

/// 0 where one of the curves leads to the other, 1 where they lie side by side.
double ComponentLinks::sideways(const Eigen::Vector3d& way, double distance, int node,
                                int above) const {
  const auto along = [&](int of) {
    const Eigen::Vector3d direction = directions_.row(of).transpose();
    return direction.isZero() ? distance : std::abs(direction.dot(way));
  };
  return distance > 0 ? std::max(0.0, 1 - std::max(along(node), along(above)) / distance) : 0;
}

}  // namespace curveskel
