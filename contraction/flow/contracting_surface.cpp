#include "contraction/flow/contracting_surface.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <queue>

namespace curveskel {
namespace {

struct ShortEdge {
  double squared_length;
  int half_edge;
  bool operator<(const ShortEdge& other) const {  // the queue's top is the shortest
    return squared_length != other.squared_length ? squared_length > other.squared_length
                                                  : half_edge > other.half_edge;
  }
};

}  // namespace

bool within(const Extent& extent, const Extent& limit) {
  return extent.area <= limit.area && std::abs(extent.volume) <= std::abs(limit.volume);
}

ContractingSurface::ContractingSurface(const Surface& surface, const Positions& ball_centres)
    : mesh(surface.triangles, static_cast<int>(surface.positions.rows())),
      positions(surface.positions),
      centres(ball_centres),
      origin(surface.positions.rows()),
      merged_into(surface.positions.rows()) {
  std::iota(origin.begin(), origin.end(), 0);
  std::iota(merged_into.begin(), merged_into.end(), 0);
  initial_areas = vertex_areas();
}

Extent ContractingSurface::extent(const Positions& at) const {
  Extent sum;
  const Eigen::RowVector3d origin_point = at.row(0);
  for (int h = 0; h < mesh.count(); h += 3) {
    const Eigen::RowVector3d a = at.row(mesh.from(h)) - origin_point;
    const Eigen::RowVector3d b = at.row(mesh.from(h + 1)) - origin_point;
    const Eigen::RowVector3d c = at.row(mesh.from(h + 2)) - origin_point;
    const Eigen::RowVector3d normal = (b - a).cross(c - a);
    sum.area += 0.5 * normal.norm();
    sum.volume += a.dot(normal) / 6;
  }
  return sum;
}

Positions ContractingSurface::volume_gradient(const Positions& at) const {
  Positions gradient = Positions::Zero(at.rows(), 3);
  for (int h = 0; h < mesh.count(); h += 3) {
    const Eigen::RowVector3d a = at.row(mesh.from(h));
    const Eigen::RowVector3d u = at.row(mesh.from(h + 1)) - a;
    const Eigen::RowVector3d v = at.row(mesh.from(h + 2)) - a;
    const Eigen::RowVector3d share = u.cross(v) / 6;
    for (int k = h; k < h + 3; ++k) gradient.row(mesh.from(k)) += share;
  }
  return gradient;
}

Eigen::VectorXd ContractingSurface::vertex_areas() const {
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(positions.rows());
  for (int h = 0; h < mesh.count(); h += 3) {
    const Eigen::RowVector3d a = positions.row(mesh.from(h));
    const Eigen::RowVector3d u = positions.row(mesh.from(h + 1)) - a;
    const Eigen::RowVector3d v = positions.row(mesh.from(h + 2)) - a;
    const double third = u.cross(v).norm() / 6;
    for (int k = h; k < h + 3; ++k) areas[mesh.from(k)] += third;
  }
  return areas;
}

Eigen::VectorXi ContractingSurface::vertex_of_input() const {
  std::vector<int> index(merged_into.size(), -1);
  for (std::size_t v = 0; v < origin.size(); ++v) index[origin[v]] = static_cast<int>(v);
  Eigen::VectorXi result(merged_into.size());
  std::vector<int> path;
  for (std::size_t v = 0; v < merged_into.size(); ++v) {
    int root = static_cast<int>(v);
    path.clear();
    while (index[root] < 0) {
      path.push_back(root);
      root = merged_into[root];
    }
    for (const int p : path) index[p] = index[root];
    result[static_cast<Eigen::Index>(v)] = index[root];
  }
  return result;
}

namespace {

/// One sweep of collapses over a surface.
class ShortEdgeCollapse {
 public:
  ShortEdgeCollapse(ContractingSurface& surface, double length, Extent now, const Extent& limit)
      : surface_(surface), squared_limit_(length * length), now_(now), limit_(limit) {}

  Extent run(const Monitor& monitor, double progress) {
    std::vector<ShortEdge> initial;
    for (int h = 0; h < surface_.mesh.count(); ++h) {
      if (h < surface_.mesh.twin(h) && squared_length(h) < squared_limit_) {
        initial.push_back({squared_length(h), h});
      }
    }
    queue_ = std::priority_queue<ShortEdge>({}, std::move(initial));
    for (int count = 0; !queue_.empty(); ++count) {
      if (count % 4096 == 0) monitor.report("contract", progress);
      const ShortEdge edge = queue_.top();
      queue_.pop();
      const int h = edge.half_edge;
      // A stale entry: the edge is gone, or has moved and was queued anew.
      if (!surface_.mesh.alive(h) || squared_length(h) != edge.squared_length) continue;
      if (surface_.mesh.can_collapse(h)) try_collapse(h);
    }
    return now_;
  }

 private:
  [[nodiscard]] double squared_length(int h) const {
    return (surface_.positions.row(surface_.mesh.from(h)) -
            surface_.positions.row(surface_.mesh.to(h)))
        .squaredNorm();
  }

  /// Adds what the faces around from(h) have, and will have with that vertex at `point`; the faces
  /// that hold `partner` vanish, and their old share is counted with its ring.
  void add_ring(int h, int partner, const Eigen::RowVector3d& point, Extent& change) const {
    const CollapsibleMesh& mesh = surface_.mesh;
    const Positions& x = surface_.positions;
    int e = h;
    do {
      const int i = mesh.to(e);
      const int j = mesh.from(CollapsibleMesh::prev(e));
      const Eigen::RowVector3d a = x.row(mesh.from(e));
      const Eigen::RowVector3d b = x.row(i);
      const Eigen::RowVector3d c = x.row(j);
      const bool vanishes = i == partner || j == partner;
      // Both ends of the edge see the two faces that vanish: count them at one of them.
      if (!vanishes || mesh.from(e) < partner) {
        const Eigen::RowVector3d normal = (b - a).cross(c - a);
        change.area -= 0.5 * normal.norm();
        change.volume -= (a - point).dot(normal) / 6;  // the new faces contain `point`: no volume
      }
      if (!vanishes) change.area += 0.5 * (b - point).cross(c - point).norm();
      e = mesh.around(e);
    } while (e != h);
  }

  void try_collapse(int h) {
    CollapsibleMesh& mesh = surface_.mesh;
    const int a = mesh.from(h);
    const int b = mesh.to(h);
    const double whole = surface_.initial_areas[a] + surface_.initial_areas[b];
    const double share = whole > 0 ? surface_.initial_areas[b] / whole : 0.5;
    const auto mean = [share](const auto& p, const auto& q) {
      return Eigen::RowVector3d((1 - share) * p + share * q);
    };
    const Eigen::RowVector3d point = mean(surface_.positions.row(a), surface_.positions.row(b));
    Extent after = now_;
    add_ring(h, b, point, after);
    add_ring(mesh.twin(h), a, point, after);
    if (!within(after, limit_)) return;

    now_ = after;
    surface_.positions.row(a) = point;
    if (surface_.centres.rows() > 0) {
      surface_.centres.row(a) = mean(surface_.centres.row(a), surface_.centres.row(b));
    }
    surface_.initial_areas[a] = whole;
    surface_.merged_into[surface_.origin[b]] = surface_.origin[a];
    mesh.collapse(h);
    const int first = mesh.outgoing(a);
    int e = first;
    do {
      const double squared = squared_length(e);
      if (squared < squared_limit_) queue_.push({squared, e});
      e = mesh.around(e);
    } while (e != first);
  }

  ContractingSurface& surface_;
  double squared_limit_;
  Extent now_;
  Extent limit_;
  std::priority_queue<ShortEdge> queue_;
};

template <typename Rows>
void keep_rows(Rows& rows, const std::vector<int>& new_index, Eigen::Index count) {
  for (std::size_t v = 0; v < new_index.size(); ++v) {
    if (new_index[v] >= 0) rows.row(new_index[v]) = rows.row(static_cast<Eigen::Index>(v)).eval();
  }
  rows.conservativeResize(count, rows.cols());
}

}  // namespace

Extent ContractingSurface::collapse_short_edges(double length, Extent now, const Extent& limit,
                                                const Monitor& monitor, double progress) {
  const Extent after = ShortEdgeCollapse(*this, length, now, limit).run(monitor, progress);
  const std::vector<int> new_index = mesh.compact();
  const Eigen::Index count = mesh.vertices();
  if (count == positions.rows()) return after;
  keep_rows(positions, new_index, count);
  if (centres.rows() > 0) keep_rows(centres, new_index, count);
  for (std::size_t v = 0; v < new_index.size(); ++v) {
    if (new_index[v] < 0) continue;
    initial_areas[new_index[v]] = initial_areas[static_cast<Eigen::Index>(v)];
    origin[new_index[v]] = origin[v];
  }
  initial_areas.conservativeResize(count);
  origin.resize(count);
  return after;
}

}  // namespace curveskel
