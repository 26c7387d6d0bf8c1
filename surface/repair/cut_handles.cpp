// Compare Guskov and Wood, Topological noise removal, Graphics Interface 2001.
#include "surface/repair/cut_handles.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/measures.hpp>
#include <curveskel/advanced/union_find.hpp>
#include <curveskel/topology.hpp>
#include "surface/mesh/half_edges.hpp"
#include "surface/mesh/short_loops.hpp"
#include "surface/repair/describe_repairs.hpp"
#include "surface/repair/renumber.hpp"

namespace curveskel {
namespace {

/// Loops round short necks, of which none shares a vertex with an earlier, shorter one.
std::vector<EdgeLoop> loops_apart(const Stars& stars, double longest, const std::stop_token& stop) {
  std::vector<char> taken(idx(stars.surface().positions.rows()), 0);
  std::vector<EdgeLoop> chosen;
  for (EdgeLoop& loop : short_loops(stars, longest, stop)) {
    const auto is_free = [&](std::int32_t v) { return taken[idx(v)] == 0; };
    if (!std::all_of(loop.begin(), loop.end(), is_free) || !opens_out(stars, loop, longest)) {
      continue;
    }
    for (const std::int32_t v : loop) taken[idx(v)] = 1;
    chosen.push_back(std::move(loop));
  }
  return chosen;
}

/// Those that part nothing all together. All of them would cut the surface into regions; a tree
/// that joins the regions again takes the longest.
std::vector<EdgeLoop> loops_to_cut(const Stars& stars, double longest,
                                   const std::stop_token& stop) {
  std::vector<EdgeLoop> loops = loops_apart(stars, longest, stop);
  std::vector<char> is_on_loop(idx(stars.half_edges()), 0);
  std::vector<std::int32_t> edge_of;  // one of each loop
  for (const EdgeLoop& loop : loops) {
    std::int32_t h = -1;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      h = stars.between(loop[i], loop[(i + 1) % loop.size()]);
      is_on_loop[idx(h)] = is_on_loop[idx(stars.twin(h))] = 1;
    }
    edge_of.push_back(h);
  }
  UnionFind regions(stars.surface().triangles.rows());
  for (std::int32_t h = 0; h < stars.half_edges(); ++h) {
    if (is_on_loop[idx(h)] == 0) regions.unite(h / 3, stars.twin(h) / 3);
  }
  std::vector<EdgeLoop> chosen;
  for (std::size_t k = loops.size(); k-- > 0;) {
    const std::int32_t h = edge_of[k];
    if (!regions.unite(h / 3, stars.twin(h) / 3)) chosen.push_back(std::move(loops[k]));
  }
  return chosen;
}

/// A surface while it is cut. The stars are those of the surface given: the loops share no vertex.
class Cutting {
 public:
  explicit Cutting(const Stars& stars) : stars_(stars) {
    for (const auto& p : stars.surface().positions.rowwise()) positions_.emplace_back(p);
    for (const auto& t : stars.surface().triangles.rowwise()) {
      triangles_.push_back({t[0], t[1], t[2]});
    }
  }

  /// The loop's own vertices stay on its left, copies of them are on its right.
  void cut(const EdgeLoop& loop) {
    const std::size_t count = loop.size();
    EdgeLoop copies(count);
    for (std::size_t i = 0; i < count; ++i) {
      const std::int32_t v = loop[i];
      const std::int32_t ahead = loop[(i + 1) % count];
      const std::int32_t behind = loop[(i + count - 1) % count];
      copies[i] = static_cast<std::int32_t>(positions_.size()) + static_cast<std::int32_t>(i);
      sides_.push_back(side(stars_.between(v, ahead), behind));
      sides_.push_back(side(stars_.between(v, behind), ahead));
    }
    for (std::size_t i = 0; i < count; ++i) {
      Point& place = positions_[idx(loop[i])];
      const Point copy = place + sides_[2 * i + 1].away;
      place += sides_[2 * i].away;
      positions_.push_back(copy);
      for (const std::int32_t h : sides_[2 * i + 1].corners) {
        triangles_[idx(h / 3)][idx(h % 3)] = copies[i];
      }
    }
    sides_.clear();
    close({loop.rbegin(), loop.rend()});
    close(copies);
  }

  [[nodiscard]] Surface surface() const {
    Surface result;
    result.positions.resize(std::ssize(positions_), 3);
    for (std::size_t v = 0; v < positions_.size(); ++v) {
      result.positions.row(std::int64_t(v)) = positions_[v];
    }
    result.triangles.resize(std::ssize(triangles_), 3);
    for (std::size_t f = 0; f < triangles_.size(); ++f) {
      const auto& [a, b, c] = triangles_[f];
      result.triangles.row(std::int64_t(f)) << a, b, c;
    }
    return result;
  }

 private:
  using Point = Eigen::RowVector3d;

  /// One side of a loop at one of its vertices.
  struct Side {
    std::vector<std::int32_t> corners;  // the half-edges out of the vertex whose faces lie there
    Point away = Point::Zero();         // from the cut
  };

  /// From this half-edge against the clock to the one that leads to `last`.
  [[nodiscard]] Side side(std::int32_t h, std::int32_t last) const {
    constexpr double share = 0.25;  // of the way to the middle of the neighbours there
    const Surface& surface = stars_.surface();
    const auto here = surface.positions.row(stars_.from(h));
    Side result;
    Point sum = Point::Zero();
    int between = 0;
    for (; stars_.to(h) != last; h = stars_.turned(h)) {
      result.corners.push_back(h);
      const std::int32_t next = stars_.to(stars_.turned(h));
      if (next == last) continue;
      sum += surface.positions.row(next) - here;
      ++between;
    }
    if (between > 0) result.away = share / between * sum;
    return result;
  }

  /// A fan on the left of the rim.
  void close(const EdgeLoop& rim) {
    Point sum = Point::Zero();
    for (const std::int32_t v : rim) sum += positions_[idx(v)];
    const auto middle = static_cast<std::int32_t>(positions_.size());
    positions_.emplace_back(sum / static_cast<double>(rim.size()));
    for (std::size_t i = 0; i < rim.size(); ++i) {
      triangles_.push_back({rim[i], rim[(i + 1) % rim.size()], middle});
    }
  }

  const Stars& stars_;
  std::vector<Point> positions_;
  std::vector<std::array<std::int32_t, 3>> triangles_;
  std::vector<Side> sides_;
};

/// Rims that a cut went through are none any more.
void drop_rims(RepairedSurface& repaired, const std::vector<std::int32_t>& on_a_loop) {
  if (on_a_loop.empty() || repaired.rims.empty()) return;
  std::vector<char> gone(idx(repaired.surface.positions.rows()), 0);
  for (const std::int32_t v : on_a_loop) gone[idx(v)] = 1;
  std::erase_if(repaired.rims, [&](const auto& rim) {
    return std::any_of(rim.begin(), rim.end(), [&](std::int32_t v) { return gone[idx(v)] != 0; });
  });
}

void note(Repairs& repairs, const CutSurface& cut, double diagonal) {
  repairs.handles_cut += cut.handles_cut;
  repairs.longest_handle_loop = std::max(repairs.longest_handle_loop, cut.longest_loop / diagonal);
}

}  // namespace

CutSurface cut_handles(const Surface& surface, double longest, const std::stop_token& stop) {
  CutSurface cut;
  cut.surface = surface;
  for (;;) {
    throw_if_stopped(stop);
    const HalfEdges pairs = pair_half_edges(
        cut.surface.triangles, static_cast<std::int32_t>(cut.surface.positions.rows()));
    const Stars stars(cut.surface, pairs);
    const std::vector<EdgeLoop> loops = loops_to_cut(stars, longest, stop);
    if (loops.empty()) break;
    Cutting cutting(stars);
    for (const EdgeLoop& loop : loops) {
      cutting.cut(loop);
      cut.longest_loop = std::max(cut.longest_loop, length_of(stars, loop));
      cut.on_a_loop.insert(cut.on_a_loop.end(), loop.begin(), loop.end());
    }
    cut.handles_cut += std::ssize(loops);
    cut.surface = cutting.surface();
  }
  std::vector<std::int32_t>& moved = cut.on_a_loop;
  std::sort(moved.begin(), moved.end());
  moved.erase(std::unique(moved.begin(), moved.end()), moved.end());
  return cut;
}

CutSurface without_small_handles(const Surface& component, const std::stop_token& stop) {
  return cut_handles(component, small_handle * bounding_box_diagonal(component.positions), stop);
}

void cut_small_handles(RepairedSurface& repaired, double least_handle,
                       const std::stop_token& stop) {
  if (least_handle <= 0) return;
  const double diagonal = bounding_box_diagonal(repaired.surface.positions);
  CutSurface cut = cut_handles(repaired.surface, least_handle * diagonal, stop);
  note(repaired.repairs, cut, diagonal);
  drop_rims(repaired, cut.on_a_loop);
  repaired.surface = std::move(cut.surface);
}

RepairedSurface with_handles_cut(const RepairedSurface& repaired,
                                 const std::vector<ComponentCut>& cuts, const Monitor& monitor) {
  const Surface& whole = repaired.surface;
  const Topology counted = topology(whole);
  const auto parts = split_components(whole, counted);
  const double diagonal = bounding_box_diagonal(whole.positions);
  RepairedSurface result = repaired;
  Eigen::Index added = 0;
  Eigen::Index faces_added = 0;
  for (const auto& [component, cut] : cuts) {
    const Surface& before = parts[idx(component)].surface;
    added += cut.surface.positions.rows() - before.positions.rows();
    faces_added += cut.surface.triangles.rows() - before.triangles.rows();
  }
  Surface& surface = result.surface;
  surface.positions.conservativeResize(whole.positions.rows() + added, Eigen::NoChange);
  surface.triangles.conservativeResize(whole.triangles.rows() + faces_added, Eigen::NoChange);
  std::vector<std::int32_t> on_a_loop;
  auto next = static_cast<std::int32_t>(whole.positions.rows());
  Eigen::Index last_face = whole.triangles.rows();
  for (const auto& [component, cut] : cuts) {
    std::vector<std::int32_t> number = parts[idx(component)].vertex_in_whole;
    for (const std::int32_t v : cut.on_a_loop) on_a_loop.push_back(number[idx(v)]);
    while (std::ssize(number) < cut.surface.positions.rows()) number.push_back(next++);
    for (std::size_t v = 0; v < number.size(); ++v) {
      surface.positions.row(number[v]) = cut.surface.positions.row(std::int64_t(v));
    }
    const auto renamed = [&](std::int32_t v) { return number[idx(v)]; };
    // Faces keep their places, those that the cut added are the last.
    Eigen::Index face = 0;
    for (Eigen::Index f = 0; f < whole.triangles.rows(); ++f) {
      if (counted.component_of_vertex[whole.triangles(f, 0)] != component) continue;
      surface.triangles.row(f) = cut.surface.triangles.row(face++).unaryExpr(renamed);
    }
    for (; face < cut.surface.triangles.rows(); ++face) {
      surface.triangles.row(last_face++) = cut.surface.triangles.row(face).unaryExpr(renamed);
    }
    note(result.repairs, cut, diagonal);
  }
  drop_rims(result, on_a_loop);
  describe_cut_handles(result.repairs, true, monitor);
  return result;
}

}  // namespace curveskel
