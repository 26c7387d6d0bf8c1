// The components of a body so far, and how thick it is where.
#pragma once

#include <Eigen/Geometry>
#include <map>
#include <vector>

#include <curveskel/advanced/tree.hpp>
#include <curveskel/topology.hpp>
#include "surface/spatial/box_tree.hpp"

namespace curveskel {

/// A component as it is asked about: places on it, its extent.
struct ProbedPart {
  std::vector<Eigen::Vector3d> places;  ///< vertices, and points spread over its area
  Eigen::AlignedBox3d box;

  [[nodiscard]] double diagonal() const { return box.diagonal().norm(); }
};

[[nodiscard]] ProbedPart probed(const Component& component);

class BodySoFar {
 public:
  /// Of some of the components.
  explicit BodySoFar(const std::vector<Component>& components);

  void add(int number, const Component& component, int threads);

  struct NearestPlace {
    double distance;
    int component;
    Eigen::Vector3d point;
  };
  /// For each place of the part the nearest place of the body. Precondition: the body has a
  /// component.
  [[nodiscard]] std::vector<NearestPlace> contacts(const ProbedPart& part) const;

  /// The radius of the largest inscribed ball of the component about the place.
  [[nodiscard]] double thickness_at(const NearestPlace& contact) const;
  /// The upper quartile of the thickness of what lies within a distance of one of the places; 0
  /// where nothing does.
  [[nodiscard]] double thickness_within(const ProbedPart& part, double distance) const;
  /// The largest radius of all.
  [[nodiscard]] double most_thickness() const { return most_thickness_; }
  [[nodiscard]] double distance_to_boxes(const Eigen::AlignedBox3d& box) const;

 private:
  struct Piece {
    int number;
    Eigen::AlignedBox3d box;
    SurfaceTree tree;
    std::vector<Eigen::Vector3d> places;   // on the surface
    std::vector<SurfaceTree::Ball> balls;  // that touch it there
  };
  /// All that may hold the nearest place of one of the part's, in their order.
  [[nodiscard]] std::vector<const Piece*> near(const ProbedPart& part) const;
  /// `guess` is one of the pieces or null, and becomes the nearest.
  [[nodiscard]] static NearestPlace nearest_of(const std::vector<const Piece*>& pieces,
                                               const Eigen::Vector3d& place, const Piece*& guess);

  std::vector<Piece> pieces_;
  std::map<int, std::size_t> piece_of_number_;
  BoxTree boxes_;  // by number of the component
  double most_thickness_ = 0;
};

}  // namespace curveskel
