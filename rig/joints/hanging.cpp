#include "rig/joints/hanging.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include <curveskel/advanced/graph.hpp>
#include <curveskel/advanced/indices.hpp>

namespace curveskel {
namespace {

constexpr double endless = std::numeric_limits<double>::infinity();

/// Neighbouring nodes of a component.
struct Bunch {
  std::vector<int> nodes;
  Eigen::AlignedBox3d box;
  double radius = 0;  // the largest
};

/// All that there is to say of a component without its bunches.
struct Whole {
  Eigen::AlignedBox3d box;
  double radius = 0;  // the largest
};

struct Link {
  double length = endless;
  double gap = endless;  // decides where lengths are equal: the deeper, the better
  Hinge hinge;
  int contact = -1;  // of the skeleton's, between the two

  [[nodiscard]] bool operator<(const Link& other) const {
    return length < other.length || (length == other.length && gap < other.gap);
  }
};

/// No link between two balls within these boxes is shorter.
double least_length(double apart, double radius, double other_radius) {
  return std::max(apart - radius - other_radius, -2 * std::min(radius, other_radius));
}

class Hanging {
 public:
  Hanging(const CurveSkeleton& skeleton, const Eigen::VectorXd& radii)
      : skeleton_(skeleton),
        radii_(radii),
        graph_(graph_of(skeleton.nodes.rows(), skeleton.edges)) {
    directions_.resize(skeleton.nodes.rows(), 3);
    for (int node = 0; node < skeleton.nodes.rows(); ++node) {
      directions_.row(node) = direction(node).transpose();
    }
  }

  /// Prim (1957) for those that others may hang from; the rest hang from the nearest of these.
  std::vector<Hinge> hang(const std::vector<std::vector<int>>& components,
                          const std::vector<char>& is_ground, const Eigen::Vector3d& up) {
    constexpr std::size_t most_above = 1000;
    const std::size_t above = std::min(components.size(), most_above);
    for (const auto& component : components) {
      parts_.push_back(bunches(component));
      wholes_.push_back(whole_of(parts_.back()));
    }
    links_.resize(components.size());
    find_contacts(components);
    std::vector<std::size_t> open;
    for (std::size_t part = 1; part < above; ++part) {
      if (is_ground[part] == 0) open.push_back(part);
    }
    std::size_t last = 0;
    std::vector<std::size_t> order;  // in which they came to hang together
    while (true) {
      mark_contacts(last);
      for (const std::size_t part : open) link(part, last);
      order.push_back(last);
      if (open.empty()) break;
      const auto next = std::min_element(open.begin(), open.end(),
                                         [this](auto a, auto b) { return links_[a] < links_[b]; });
      last = *next;
      open.erase(next);
    }
    for (std::size_t part = above; part < parts_.size(); ++part) {
      if (is_ground[part] == 0) link_to_nearest(part, order);
    }
    std::vector<Hinge> hinges;
    for (const Link& link : links_) {
      hinges.push_back(moved_to_end(link.contact < 0 ? link.hinge : at_contact(link, up)));
    }
    let_go(hinges, components);
    return hinges;
  }

 private:
  [[nodiscard]] Eigen::Vector3d point(int node) const {
    return skeleton_.nodes.row(node).transpose();
  }
  [[nodiscard]] int degree(int node) const { return graph_.degree(node); }

  /// The next node of a chain, -1 where it ends.
  [[nodiscard]] int beyond(int before, int node) const {
    if (degree(node) != 2) return -1;
    const auto both = graph_.neighbours(node);
    return both[both[0] == before ? 1 : 0];
  }

  /// About a radius along the curve.
  [[nodiscard]] Eigen::Vector3d place_beside(int node, int neighbour) const {
    int before = node;
    while ((point(neighbour) - point(node)).norm() < radii_[node]) {
      const int next = beyond(before, neighbour);
      if (next < 0 || next == node) break;
      before = neighbour;
      neighbour = next;
    }
    return point(neighbour);
  }

  /// Of the curve, none at a junction or where it is a point.
  [[nodiscard]] Eigen::Vector3d direction(int node) const {
    if (degree(node) == 0 || degree(node) > 2) return Eigen::Vector3d::Zero();
    const Eigen::Vector3d from = place_beside(node, graph_.neighbours(node).front());
    const Eigen::Vector3d to =
        degree(node) == 1 ? point(node) : place_beside(node, graph_.neighbours(node).back());
    return (to - from).stableNormalized();
  }

  /// Along the curve, so that they are small.
  [[nodiscard]] std::vector<Bunch> bunches(const std::vector<int>& component) {
    constexpr std::size_t most_nodes = 32;
    std::vector<Bunch> all;
    seen_.resize(idx(graph_.nodes()));
    std::vector<int> open{component.front()};
    seen_[idx(component.front())] = true;
    while (!open.empty()) {
      const int node = open.back();
      open.pop_back();
      if (all.empty() || all.back().nodes.size() == most_nodes) all.emplace_back();
      all.back().nodes.push_back(node);
      all.back().box.extend(point(node));
      all.back().radius = std::max(all.back().radius, radii_[node]);
      for (const int other : graph_.neighbours(node)) {
        if (!seen_[idx(other)]) open.push_back(other);
        seen_[idx(other)] = true;
      }
    }
    return all;
  }

  static Whole whole_of(const std::vector<Bunch>& bunches) {
    Whole whole;
    for (const Bunch& bunch : bunches) {
      whole.box.extend(bunch.box);
      whole.radius = std::max(whole.radius, bunch.radius);
    }
    return whole;
  }

  /// Part by part, so that the boxes asked again and again stay in the cache.
  void link_to_nearest(std::size_t part, const std::vector<std::size_t>& all_above) {
    std::map<std::size_t, int> contact_with;
    for (const auto& [other, contact] : contacts_[part]) contact_with[other] = contact;
    for (const std::size_t above : all_above) {
      const auto found = contact_with.find(above);
      if (found == contact_with.end()) {
        link_by_nodes(part, above);
      } else {
        links_[part] = std::min(links_[part], link_by_contact(found->second, part));
      }
    }
  }

  /// Takes the link to `above`, of which the contacts are marked, if it is the best so far.
  void link(std::size_t part, std::size_t above) {
    if (marked_[part].above == above) {
      links_[part] = std::min(links_[part], link_by_contact(marked_[part].contact, part));
    } else {
      link_by_nodes(part, above);
    }
  }

  void link_by_nodes(std::size_t part, std::size_t above) {
    Link& best = links_[part];
    const Whole& own = wholes_[part];
    const Whole& its = wholes_[above];
    const double least = least_length(own.box.exteriorDistance(its.box), own.radius, its.radius);
    if (least > best.length) return;
    for (const Bunch& lower : parts_[part]) {
      for (const Bunch& upper : parts_[above]) {
        const double apart = lower.box.exteriorDistance(upper.box);
        if (least_length(apart, lower.radius, upper.radius) > best.length) continue;
        for (const int node : lower.nodes) {
          const double way = upper.box.exteriorDistance(point(node));
          if (least_length(way, radii_[node], upper.radius) > best.length) continue;
          for (const int other : upper.nodes) best = std::min(best, link_between(node, other));
        }
      }
    }
  }

  [[nodiscard]] Link link_between(int node, int above) const {
    const Eigen::Vector3d way = point(above) - point(node);
    const double distance = way.norm();
    const double smaller = std::min(radii_[node], radii_[above]);
    const double gap = distance - radii_[node] - radii_[above];
    return {std::max(gap, -2 * smaller) + smaller * sideways(way, distance, node, above),
            gap,
            {node, above, gap},
            -1};
  }

  /// By their numbers, either way.
  void find_contacts(const std::vector<std::vector<int>>& components) {
    part_of_.resize(idx(graph_.nodes()));
    contacts_.resize(components.size());
    marked_.assign(components.size(), {components.size(), -1});
    for (std::size_t part = 0; part < components.size(); ++part) {
      for (const int node : components[part]) part_of_[idx(node)] = part;
    }
    for (std::size_t k = 0; k < skeleton_.contacts.size(); ++k) {
      const Contact& contact = skeleton_.contacts[k];
      const std::size_t one = part_of_[idx(contact.one.node)];
      const std::size_t other = part_of_[idx(contact.other.node)];
      contacts_[one].emplace_back(other, static_cast<int>(k));
      contacts_[other].emplace_back(one, static_cast<int>(k));
    }
  }

  /// Of two contacts with one component the last counts.
  void mark_contacts(std::size_t above) {
    for (const auto& [part, contact] : contacts_[above]) marked_[part] = {above, contact};
  }

  [[nodiscard]] Link link_by_contact(int number, std::size_t part) const {
    const Contact& contact = skeleton_.contacts[idx(number)];
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
  [[nodiscard]] double aside_of(int node, const Eigen::Vector3d& place) const {
    const Eigen::Vector3d direction = directions_.row(node).transpose();
    return std::min(1.0, direction.cross(place - point(node)).norm() / radii_[node]);
  }

  /// At the end of its curve that the contact reaches, the upper one of both.
  [[nodiscard]] Hinge at_contact(const Link& link, const Eigen::Vector3d& up) const {
    constexpr double upright = 0.5;  // of the way between the ends
    const Contact& contact = skeleton_.contacts[idx(link.contact)];
    Hinge hinge = link.hinge;
    const bool is_one = contact.one.node == hinge.node;
    const std::vector<int>& tips = (is_one ? contact.one : contact.other).tips;
    if (tips.empty()) return hinge;
    hinge.node = tips.front();
    if (tips.size() == 2) {
      const Eigen::Vector3d way = point(tips.back()) - point(tips.front());
      const double rise = way.dot(up);
      if (std::abs(rise) < upright * way.norm()) return link.hinge;
      hinge.node = rise > 0 ? tips.back() : tips.front();
    }
    double nearest = endless;
    for (const Bunch& bunch : parts_[part_of_[idx(link.hinge.above)]]) {
      for (const int node : bunch.nodes) {
        const double distance = (point(node) - point(hinge.node)).norm();
        if (distance >= nearest) continue;
        nearest = distance;
        hinge.above = node;
      }
    }
    return hinge;
  }

  /// 0 where one of the curves leads to the other, 1 where they lie side by side.
  [[nodiscard]] double sideways(const Eigen::Vector3d& way, double distance, int node,
                                int above) const {
    const auto along = [&](int of) {
      const Eigen::Vector3d direction = directions_.row(of).transpose();
      return direction.isZero() ? distance : std::abs(direction.dot(way));
    };
    return distance > 0 ? std::max(0.0, 1 - std::max(along(node), along(above)) / distance) : 0;
  }

  /// Links hold where the gap is short beside either of the bodies that they join, which grow with
  /// each link that holds.
  void let_go(std::vector<Hinge>& hinges, const std::vector<std::vector<int>>& components) const {
    constexpr double far_apart = 0.25;
    std::vector<Eigen::AlignedBox3d> boxes(components.size());
    for (std::size_t part = 0; part < components.size(); ++part) {
      for (const Bunch& bunch : parts_[part]) {
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
        const std::size_t above = part_of_[idx(hinges[part].above)];
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

  [[nodiscard]] Hinge moved_to_end(Hinge hinge) const {
    if (hinge.node < 0 || degree(hinge.node) != 2) return hinge;
    const int middle = hinge.node;
    double least = endless;
    for (const int neighbour : graph_.neighbours(middle)) {
      double way = 0;
      int before = middle;
      int node = neighbour;
      while (node != middle) {
        way += (point(node) - point(before)).norm();
        const int next = beyond(before, node);
        if (next < 0 || way > 2 * radii_[middle]) break;
        before = node;
        node = next;
      }
      const double far = way / ((degree(node) == 1 ? 2 : 1) * radii_[middle]);
      if (degree(node) == 2 || far > 1 || far >= least) continue;
      least = far;
      hinge.node = node;
    }
    return hinge;
  }

  const CurveSkeleton& skeleton_;
  const Eigen::VectorXd& radii_;
  Graph graph_;
  Eigen::MatrixX3d directions_;  // by node
  std::vector<bool> seen_;       // by node
  std::vector<std::vector<Bunch>> parts_;
  std::vector<std::size_t> part_of_;                                // by node
  std::vector<std::vector<std::pair<std::size_t, int>>> contacts_;  // by part: with which, numbers
  struct Marked {
    std::size_t above;
    int contact;
  };
  std::vector<Whole> wholes_;   // by part
  std::vector<Marked> marked_;  // by part: its contact with the one whose contacts were marked last
  std::vector<Link> links_;     // by part, to those that others hang from so far
};

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

std::vector<Hinge> hang_components(const CurveSkeleton& skeleton, const Eigen::VectorXd& radii,
                                   const std::vector<std::vector<int>>& components,
                                   const std::vector<int>& ground, const Eigen::Vector3d& up) {
  return Hanging(skeleton, radii).hang(components, are_ground(components, ground), up);
}

}  // namespace curveskel
