#include "rig/joints/contacts.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/measures.hpp>
#include <curveskel/advanced/tree.hpp>
#include <curveskel/advanced/union_find.hpp>
#include <curveskel/monitor.hpp>
#include <curveskel/topology.hpp>
#include "rig/joints/rooted_tree.hpp"
#include "surface/mesh/meeting_boxes.hpp"

namespace curveskel {
namespace {

using Eigen::Vector3d;

/// A piece of a surface.
struct Patch {
  Vector3d place;
  Vector3d normal;
  double area;
};

/// A component's surface and curve.
struct Piece {
  Surface surface;
  std::unique_ptr<SurfaceTree> tree;
  Eigen::AlignedBox3d box;
  std::vector<int> nodes;
  std::vector<int> tips;  // both of a chain, else none
  double thickness = 0;
  double area = 0;
  std::vector<Patch> patches;
};

/// A patch that faces the other component.
struct Facing {
  Vector3d place;
  double weight;
  Vector3d area;  // along the normal
};

Vector3d normal_of(const Surface& surface, int triangle) {
  const auto corner = [&](int k) -> Vector3d {
    return surface.positions.row(surface.triangles(triangle, k)).transpose();
  };
  return (corner(1) - corner(0)).cross(corner(2) - corner(0)).stableNormalized();
}

/// About so many or, of large triangles, more, as alike in area as these allow: a large triangle is
/// cut into alike ones, so that the middle of its patches is its own; small ones stand for those
/// before them.
std::vector<Patch> patches_of(const Surface& surface, double area, int wanted) {
  const double each = area / wanted;
  std::vector<Patch> patches;
  double passed = 0;
  for (Eigen::Index t = 0; t < surface.triangles.rows(); ++t) {
    const auto corner = [&](int k) -> Vector3d {
      return surface.positions.row(surface.triangles(t, k)).transpose();
    };
    const Vector3d a = corner(1) - corner(0);
    const Vector3d b = corner(2) - corner(0);
    const Vector3d normal = a.cross(b);
    const double size = 0.5 * normal.norm();
    const int cuts = std::max(1, static_cast<int>(std::ceil(std::sqrt(size / each))));
    if (cuts == 1) {
      passed += size;
      if (passed < each && t + 1 < surface.triangles.rows()) continue;
      patches.push_back({corner(0) + (a + b) / 3, normal.stableNormalized(), passed});
      passed = 0;
      continue;
    }
    for (int i = 0; i < cuts; ++i) {
      for (int j = 0; i + j < cuts; ++j) {
        for (const double third : {1.0 / 3, 2.0 / 3}) {
          if (third > 0.5 && i + j + 1 == cuts) continue;
          const Vector3d place = corner(0) + ((i + third) * a + (j + third) * b) / cuts;
          patches.push_back({place, normal.normalized(), size / (cuts * cuts)});
        }
      }
    }
  }
  return patches;
}

/// The vector sum of the areas.
Vector3d section_of(const std::vector<Facing>& found) {
  Vector3d section = Vector3d::Zero();
  for (const Facing& facing : found) section += facing.area;
  return section;
}

/// Of places farther apart than this, as of a forearm's in its sleeve and its hand's on the waist,
/// those of the largest section.
std::vector<Facing> widest(const std::vector<Facing>& found, double apart) {
  UnionFind joined(static_cast<Eigen::Index>(found.size()));
  for (std::size_t a = 0; a < found.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      if ((found[a].place - found[b].place).squaredNorm() > apart * apart) continue;
      joined.unite(static_cast<int>(a), static_cast<int>(b));
    }
  }
  std::vector<std::vector<Facing>> places(found.size());
  for (std::size_t k = 0; k < found.size(); ++k) {
    places[idx(joined.root(static_cast<int>(k)))].push_back(found[k]);
  }
  const auto largest =
      std::max_element(places.begin(), places.end(), [](const auto& a, const auto& b) {
        return section_of(a).squaredNorm() < section_of(b).squaredNorm();
      });
  return largest == places.end() ? found : *largest;
}

class ContactFinder {
 public:
  ContactFinder(const Surface& surface, const CurveSkeleton& skeleton, const std::stop_token& stop)
      : skeleton_(skeleton), stop_(stop), radii_(usable_radii(skeleton)) {
    const std::vector<int> curve_of_node = component_of_node(skeleton);
    const int curves = 1 + *std::max_element(curve_of_node.begin(), curve_of_node.end());
    pieces_.resize(idx(curves));
    std::vector<int> degree(curve_of_node.size(), 0);
    for (const int node : skeleton.edges.reshaped()) ++degree[idx(node)];
    for (int node = 0; node < static_cast<int>(degree.size()); ++node) {
      Piece& piece = pieces_[idx(curve_of_node[idx(node)])];
      piece.nodes.push_back(node);
      piece.thickness = std::max(piece.thickness, radii_[node]);
    }
    for (Piece& piece : pieces_) find_tips(piece, degree);
    give_surfaces(surface, curve_of_node);
  }

  std::vector<Contact> find() {
    const std::vector<std::pair<int, int>> near = near_pairs();
    if (near.empty()) return {};
    constexpr std::size_t most_places = 500;  // of each component
    constexpr std::size_t queries = 1000000;
    const auto places =
        static_cast<int>(std::clamp<std::size_t>(queries / near.size(), 20, most_places));
    std::vector<Contact> contacts;
    for (const auto& [one, other] : near) {
      throw_if_stopped(stop_);
      for (const int piece : {one, other}) prepare(pieces_[idx(piece)], places);
      Contact contact;
      if (meet(pieces_[idx(one)], pieces_[idx(other)], contact)) contacts.push_back(contact);
    }
    return contacts;
  }

 private:
  static void find_tips(Piece& piece, const std::vector<int>& degree) {
    for (const int node : piece.nodes) {
      if (degree[idx(node)] > 2) {
        piece.tips.clear();
        return;
      }
      if (degree[idx(node)] == 1) piece.tips.push_back(node);
    }
  }

  /// A component of the surface is its of whose curve one of its vertices is.
  void give_surfaces(const Surface& surface, const std::vector<int>& curve_of_node) {
    std::vector<Component> components = split_components(surface, topology(surface));
    for (Component& component : components) {
      int curve = -1;
      for (const int v : component.vertex_in_whole) {
        const int node = skeleton_.node_of_vertex[v];
        if (node < 0) continue;
        curve = curve_of_node[idx(node)];
        break;
      }
      if (curve < 0) continue;
      const double size = area(component.surface);
      Piece& piece = pieces_[idx(curve)];
      if (size <= piece.area) continue;
      piece.area = size;
      piece.surface = std::move(component.surface);
      piece.box.setEmpty();
      for (const auto& p : piece.surface.positions.rowwise()) piece.box.extend(p.transpose());
    }
  }

  [[nodiscard]] static double limit_of(const Piece& one, const Piece& other) {
    return std::max(one.thickness, other.thickness);
  }

  /// The smaller one first.
  [[nodiscard]] std::vector<std::pair<int, int>> near_pairs() const {
    // Two pieces within the thickness of either meet once each has grown by its own.
    constexpr double rounding = 1e-9;
    std::vector<Eigen::AlignedBox3d> grown(pieces_.size());
    for (std::size_t k = 0; k < pieces_.size(); ++k) {
      const Piece& piece = pieces_[k];
      if (piece.area <= 0) continue;
      const double size = piece.box.min().cwiseAbs().maxCoeff() + piece.box.sizes().maxCoeff();
      const Vector3d by = Vector3d::Constant(piece.thickness + rounding * size);
      grown[k] = {piece.box.min() - by, piece.box.max() + by};
    }
    std::vector<std::pair<int, int>> near;
    for_meeting_boxes(grown, [&](int one, int other) {
      throw_if_stopped(stop_);
      const auto& [a, b] = std::minmax(one, other);
      if (pieces_[idx(a)].box.exteriorDistance(pieces_[idx(b)].box) >
          limit_of(pieces_[idx(a)], pieces_[idx(b)])) {
        return;
      }
      near.emplace_back(a, b);
    });
    std::sort(near.begin(), near.end());
    for (auto& [a, b] : near) {
      if (pieces_[idx(a)].area > pieces_[idx(b)].area) std::swap(a, b);
    }
    return near;
  }

  static void prepare(Piece& piece, int places) {
    if (piece.tree) return;
    piece.tree = std::make_unique<SurfaceTree>(piece.surface);
    piece.patches = patches_of(piece.surface, piece.area, places);
  }

  /// Between the surfaces, infinite beyond the limit; 0 where they overlap.
  [[nodiscard]] static double gap_between(const Piece& one, const Piece& other, double limit) {
    double gap = std::numeric_limits<double>::infinity();
    const auto try_place = [&](const Vector3d& place, const Piece& of) {
      if (gap <= 0 || of.box.exteriorDistance(place) > std::min(gap, limit)) return;
      const SurfaceTree::Nearest nearest = of.tree->nearest(place, std::min(gap, limit));
      if (nearest.triangle >= 0) gap = std::min(gap, nearest.distance);
      if (of.box.contains(place) && of.tree->inside(place)) gap = 0;
    };
    for (const Patch& patch : one.patches) try_place(patch.place, other);
    for (const Patch& patch : other.patches) try_place(patch.place, one);
    const auto try_vertices = [&](const Piece& from, const Piece& of) {
      const auto count = static_cast<Eigen::Index>(from.patches.size());
      const Eigen::Index stride = std::max<Eigen::Index>(1, from.surface.positions.rows() / count);
      for (Eigen::Index v = 0; v < from.surface.positions.rows(); v += stride) {
        try_place(from.surface.positions.row(v).transpose(), of);
      }
    };
    try_vertices(one, other);
    try_vertices(other, one);
    return gap;
  }

  /// Of the smaller one.
  [[nodiscard]] static std::vector<Facing> facing(const Piece& one, const Piece& other,
                                                  double within) {
    constexpr double touching = 1e-5;  // of the smaller one's diagonal
    std::vector<Facing> found;
    const double least = touching * one.box.diagonal().norm();
    for (const auto& [place, normal, area] : one.patches) {
      if (other.box.exteriorDistance(place) > within) continue;
      if (other.box.contains(place) && other.tree->inside(place)) {
        found.push_back({place, area, area * normal});
        continue;
      }
      const SurfaceTree::Nearest nearest = other.tree->nearest(place, within);
      if (nearest.triangle < 0) continue;
      const Vector3d way = nearest.point - place;
      const Vector3d ahead = nearest.distance > least
                                 ? Vector3d(way / nearest.distance)
                                 : Vector3d(-normal_of(other.surface, nearest.triangle));
      const double share = ahead.dot(normal);
      if (share > 0) found.push_back({place + 0.5 * way, share * area, area * normal});
    }
    return found;
  }

  [[nodiscard]] int nearest_node(const Piece& piece, const Vector3d& place) const {
    return *std::min_element(piece.nodes.begin(), piece.nodes.end(), [&](int a, int b) {
      return (skeleton_.nodes.row(a).transpose() - place).squaredNorm() <
             (skeleton_.nodes.row(b).transpose() - place).squaredNorm();
    });
  }

  /// Tips within a radius of which something faces the other component.
  [[nodiscard]] ContactSide side_of(const Piece& piece, const std::vector<Facing>& found,
                                    const Vector3d& middle) const {
    ContactSide side{nearest_node(piece, middle), {}};
    std::vector<char> is_reached(piece.tips.size(), 0);
    for (const Facing& facing : found) {
      if (piece.tips.empty()) break;
      const int node = nearest_node(piece, facing.place);
      for (std::size_t k = 0; k < piece.tips.size(); ++k) {
        const int tip = piece.tips[k];
        const double way = (skeleton_.nodes.row(node) - skeleton_.nodes.row(tip)).norm();
        if (way < radii_[tip]) is_reached[k] = 1;
      }
    }
    for (std::size_t k = 0; k < piece.tips.size(); ++k) {
      if (is_reached[k] != 0) side.tips.push_back(piece.tips[k]);
    }
    return side;
  }

  bool meet(const Piece& one, const Piece& other, Contact& contact) const {
    const double limit = limit_of(one, other);
    contact.gap = gap_between(one, other, limit);
    if (contact.gap > limit) return false;
    const double thinner = std::min(one.thickness, other.thickness);
    const std::vector<Facing> found =
        widest(facing(one, other, contact.gap + 0.5 * thinner), limit);
    Vector3d sum = Vector3d::Zero();
    double whole = 0;
    for (const Facing& facing : found) {
      whole += facing.weight;
      sum += facing.weight * facing.place;
    }
    if (!(whole > 0)) return false;
    contact.middle = sum / whole;
    contact.area = section_of(found).norm();
    contact.one = side_of(one, found, contact.middle);
    contact.other = side_of(other, found, contact.middle);
    return true;
  }

  const CurveSkeleton& skeleton_;
  const std::stop_token& stop_;
  Eigen::VectorXd radii_;
  std::vector<Piece> pieces_;
};

}  // namespace

std::vector<Contact> contacts_of(const Surface& surface, const CurveSkeleton& skeleton,
                                 const std::stop_token& stop) {
  const bool says_of = skeleton.node_of_vertex.size() == surface.positions.rows();
  if (!says_of || skeleton.nodes.rows() == 0 || skeleton.node_of_vertex.maxCoeff() < 0) return {};
  if (graph_topology(skeleton).components < 2) return {};
  return ContactFinder(surface, skeleton, stop).find();
}

}  // namespace curveskel
