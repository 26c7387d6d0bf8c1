// A body and its curve, divided into components once. Internal to rig/.
#pragma once

#include <optional>
#include <vector>

#include <curveskel/curve_skeleton.hpp>
#include <curveskel/repair.hpp>
#include <curveskel/topology.hpp>

namespace curveskel {

/// The vertices of the file that have one of the body, ascending: `vertex_of_input` is then by
/// these, as the figures of a crowd would else have the whole file each. None: it is by all.
using OwnInputs = std::optional<std::vector<int>>;

/// Some components of a body alone.
struct PartOfBody {
  RepairedSurface body;  ///< without `vertex_of_input` and rims
  CurveSkeleton skeleton;
  OwnInputs inputs = {};
};

/// `body` and `skeleton`, which has node_of_vertex by its vertices, must outlive this.
class DividedBody {
 public:
  /// O(#V + #F + #N log #N).
  DividedBody(const RepairedSurface& body, const CurveSkeleton& skeleton, const Topology& counted);

  /// The same as `body_of` and `skeleton_of_body` make where all other components follow, in time
  /// that its own size takes. Precondition: ascending numbers.
  [[nodiscard]] PartOfBody part(const std::vector<int>& components);

  /// With `inputs`, `vertex_of_input` by these, rims and all else that `body_of` keeps.
  [[nodiscard]] PartOfBody part_of_file(const std::vector<int>& components);

  /// Ascending, those of `part`.
  [[nodiscard]] std::vector<int> vertices(const std::vector<int>& components) const;
  [[nodiscard]] std::vector<int> nodes(const std::vector<int>& components) const;

 private:
  [[nodiscard]] std::vector<int> curves(const std::vector<int>& components) const;
  void add_inputs(PartOfBody& part, const std::vector<int>& components) const;
  /// Surface vertices are numbered in `number_of_vertex_` afterwards, nodes in `number_of_node_`.
  void add_surface(PartOfBody& part, const std::vector<int>& components,
                   const std::vector<int>& vertices);
  void add_skeleton(PartOfBody& part, const std::vector<int>& curves,
                    const std::vector<int>& nodes);

  const RepairedSurface& body_;
  const CurveSkeleton& skeleton_;
  // By component, each ascending.
  std::vector<std::vector<int>> vertices_;
  std::vector<std::vector<int>> faces_;
  std::vector<std::vector<int>> inputs_;  // vertices of the file
  std::vector<std::vector<int>> rims_;    // places in `body_.rims`, by the first vertex
  std::vector<std::vector<int>> sheets_;  // places in `body_.sheets`
  std::vector<std::vector<int>> curves_;  // to which its vertices collapsed
  // By component of the skeleton, each ascending.
  std::vector<std::vector<int>> nodes_;
  std::vector<std::vector<int>> edges_;
  std::vector<std::vector<int>> contacts_;  // on its side `one`
  std::vector<int> curves_of_none_;         // which go with any part
  std::vector<int> number_of_vertex_;       // in the part that is made; -1 = not in it
  std::vector<int> number_of_node_;
};

}  // namespace curveskel
