// Which component of a skeleton hangs from which, and by which link. Internal to rig/.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include <curveskel/curve_skeleton.hpp>
#include "rig/joints/curve_graph.hpp"

namespace curveskel {

/// The place from which a component hangs.
struct Hinge {
  int node = -1;   ///< its own
  int above = -1;  ///< of the component that it hangs from; -1 = of none
  double gap = 0;  ///< between the balls of the two
};

/// Neighbouring nodes of a component.
struct Bunch {
  std::vector<int> nodes;
  Eigen::AlignedBox3d box;
  double radius = 0;  ///< the largest
};

struct ComponentLink {
  double length = std::numeric_limits<double>::infinity();
  /// Decides where lengths are equal: the deeper, the better.
  double gap = std::numeric_limits<double>::infinity();
  Hinge hinge;
  int contact = -1;  ///< of the skeleton's, between the two

  [[nodiscard]] bool operator<(const ComponentLink& other) const {
    return length < other.length || (length == other.length && gap < other.gap);
  }
};

/// The least spanning tree of links, see `hang_components`. Refers to the curves and the radii.
class ComponentLinks {
 public:
  ComponentLinks(const CurveGraph& curves, const Eigen::VectorXd& radii,
                 const std::vector<std::vector<int>>& components,
                 const std::vector<char>& is_ground);

  /// By component: to the one that it hangs from.
  [[nodiscard]] const std::vector<ComponentLink>& links() const { return links_; }
  [[nodiscard]] std::size_t component_of(int node) const {
    return part_of_[static_cast<std::size_t>(node)];
  }
  /// By component.
  [[nodiscard]] const std::vector<std::vector<Bunch>>& bunches() const { return parts_; }

 private:
  class Nearest;

  struct Marked {
    std::size_t above;
    int contact;
  };

  [[nodiscard]] Eigen::Vector3d place_beside(int node, int neighbour) const;
  [[nodiscard]] Eigen::Vector3d direction(int node) const;
  void find_bunches(const std::vector<std::vector<int>>& components);
  void find_contacts(const std::vector<std::vector<int>>& components);
  [[nodiscard]] std::vector<std::size_t> span(std::size_t above,
                                              const std::vector<char>& is_ground);
  void mark_contacts(std::size_t above);
  void link(std::size_t part, std::size_t above);
  void link_by_nodes(std::size_t part, std::size_t above);
  [[nodiscard]] ComponentLink shortest_between(const Bunch& lower, const Bunch& upper,
                                               ComponentLink best, double rounding) const;
  [[nodiscard]] ComponentLink link_between(int node, int above) const;
  [[nodiscard]] ComponentLink link_by_contact(int number, std::size_t part) const;
  [[nodiscard]] double aside_of(int node, const Eigen::Vector3d& place) const;
  [[nodiscard]] double sideways(const Eigen::Vector3d& way, double distance, int node,
                                int above) const;

  const CurveGraph& curves_;
  const Eigen::VectorXd& radii_;
  Eigen::MatrixX3d directions_;  // by node
  std::vector<std::vector<Bunch>> parts_;
  std::vector<Bunch> wholes_;                                       // by part, without nodes
  std::vector<std::size_t> part_of_;                                // by node
  std::vector<std::vector<std::pair<std::size_t, int>>> contacts_;  // by part: with which, numbers
  std::vector<Marked> marked_;  // by part: its contact with the one whose contacts were marked last
  std::vector<ComponentLink> links_;  // by part, to those that others hang from so far
};

}  // namespace curveskel
