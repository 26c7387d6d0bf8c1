// The motion of small parts: with the surface that they sit on.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "skeleton/match/motions.hpp"

namespace curveskel {

/// Of the components with less than `least_body_share`. Refers to what it is made of.
class PartSeats {
 public:
  PartSeats(const MatchedBodies& bodies, int threads);
  ~PartSeats();
  PartSeats(const PartSeats&) = delete;
  PartSeats& operator=(const PartSeats&) = delete;

  [[nodiscard]] bool empty() const { return parts_.empty(); }

  /// All vertices of a that some part may sit on, ascending.
  [[nodiscard]] const std::vector<int>& vertices() const { return vertices_; }

  /// Each part moves as the nearest vertices of the larger components do, of those whose partners
  /// are known: by the rigid motion that leaves the sum of their squares least, without those that
  /// fit worst. vertex_of_a: #V of a, -1 = not known. O(#parts).
  void seat(NodeMotions& motions, const Eigen::VectorXi& vertex_of_a) const;

  /// Lays each part onto the component of b that it is paired with.
  void lay_onto_partners(NodeMotions& motions, const std::vector<int>& component_pairs) const;

 private:
  struct Part {
    int component;
    std::vector<int> nodes;
    Eigen::Matrix3Xd points;  ///< some of its vertices
    std::vector<int> seats;   ///< vertices of larger components, the nearest first
  };
  void find_seats(const std::vector<int>& vertices);
  void move_part(const Part& part, const std::vector<int>& seats,
                 const Eigen::VectorXi& vertex_of_a, NodeMotions& motions) const;

  const MatchSide& a_;
  const MatchSide& b_;
  int threads_;
  std::vector<Part> parts_;
  std::vector<int> vertices_;
  std::vector<std::unique_ptr<const SurfaceTree>> surface_of_b_;  ///< per component of b, if small
};

}  // namespace curveskel
