#include <curveskel/repair.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/measures.hpp>
#include <curveskel/advanced/tree.hpp>
#include "base/option_ranges.hpp"
#include "surface/mesh/loose_parts.hpp"
#include "surface/mesh/nearest_vertex.hpp"
#include "surface/repair/bodies_and_sheets.hpp"
#include "surface/repair/close_surface.hpp"
#include "surface/repair/cut_handles.hpp"
#include "surface/repair/describe_repairs.hpp"
#include "surface/repair/join_soup.hpp"
#include "surface/repair/lies_in_plane.hpp"
#include "surface/repair/merge_overlapping.hpp"
#include "surface/repair/select_components.hpp"
#include "surface/repair/sound_soup.hpp"
#include "surface/repair/tangles.hpp"
#include "surface/repair/thicken.hpp"
#include "surface/repair/weld.hpp"
#include "surface/repair/wrap.hpp"
#include "surface/repair/wrap_solid.hpp"

namespace curveskel {
namespace {

/// The final vertex of each vertex of the file, while the surface is put together.
class VertexMap {
 public:
  explicit VertexMap(const Joined& joined)
      : joined_(joined), of_joined_(joined.merged_into.size(), -1) {}

  void add_closed(const ClosedParts& closed, const std::vector<std::int32_t>& number) {
    std::map<std::array<double, 3>, std::int32_t> at_position;
    for (std::size_t v = closed.vertex_given.size(); v-- > 0;) {
      if (closed.vertex_given[v] < 0 || number[v] < 0) continue;
      of_joined_[idx(closed.vertex_given[v])] = number[v];
      at_position[position(closed.surface.positions.row(std::int64_t(v)))] = number[v];
    }
    // Stitching put one vertex in the place of several.
    for (const std::int32_t v : joined_.surface.triangles.reshaped()) {
      if (of_joined_[idx(v)] >= 0) continue;
      const auto found = at_position.find(position(joined_.surface.positions.row(v)));
      if (found != at_position.end()) of_joined_[idx(v)] = found->second;
    }
  }

  /// A part outside the wrap and farther from the wrap than the wrap spans is none of it.
  void add_wrapped(const Surface& sheets, const WrappedSolid& wrapped, std::int32_t first_vertex) {
    const double farthest = (wrapped.gap + wrapped.offset) * extent_of_faces(sheets);
    const SurfaceTree tree(wrapped.surface);
    for (const std::int32_t v : sheets.triangles.reshaped()) {
      if (of_joined_[idx(v)] >= 0) continue;
      const Eigen::Vector3d p = sheets.positions.row(v);
      if (tree.nearest(p).distance > farthest && tree.inscribed_radius(p) <= 0) continue;
      of_joined_[idx(v)] = first_vertex + nearest_vertex(wrapped.surface, tree, p.transpose());
    }
  }

  [[nodiscard]] bool has(std::int32_t joined) const { return of_joined_[idx(joined)] >= 0; }

  [[nodiscard]] Eigen::VectorXi of_file() const {
    Eigen::VectorXi result(static_cast<Eigen::Index>(of_joined_.size()));
    for (std::size_t v = 0; v < of_joined_.size(); ++v) {
      result[static_cast<Eigen::Index>(v)] = of_joined_[idx(joined_.merged_into[v])];
    }
    return result;
  }

 private:
  static std::array<double, 3> position(const Eigen::RowVector3d& p) {
    return {p.x() + 0.0, p.y() + 0.0, p.z() + 0.0};  // -0.0 becomes 0.0
  }
  const Joined& joined_;
  std::vector<std::int32_t> of_joined_;
};

void append_surface(Surface& surface, const Surface& more) {
  const auto vertices = static_cast<std::int32_t>(surface.positions.rows());
  const Eigen::Index faces = surface.triangles.rows();
  surface.positions.conservativeResize(vertices + more.positions.rows(), 3);
  surface.positions.bottomRows(more.positions.rows()) = more.positions;
  surface.triangles.conservativeResize(faces + more.triangles.rows(), 3);
  surface.triangles.bottomRows(more.triangles.rows()) = more.triangles.array() + vertices;
}

/// #V: 1 of those on components that are turned as they lie inward.
std::vector<char> turned_vertices(const ClosedParts& closed, const JudgedParts& judged) {
  std::vector<char> turned(closed.vertex_given.size(), 0);
  for (Eigen::Index f = 0; f < closed.surface.triangles.rows(); ++f) {
    const std::int32_t component = judged.orientation.component_of_face[idx(f)];
    if (judged.parts[idx(component)].volume >= 0) continue;
    for (const std::int32_t v : closed.surface.triangles.row(f)) turned[idx(v)] = 1;
  }
  return turned;
}

void count_holes(const ClosedParts& closed, const JudgedParts& judged,
                 const std::vector<std::int32_t>& number, RepairedSurface& result) {
  const std::vector<char> turned = turned_vertices(closed, judged);
  for (const auto& hole : closed.holes) {
    std::vector<std::int32_t> rim;
    rim.reserve(hole.size());
    for (const std::int32_t v : hole) rim.push_back(number[idx(v)]);
    if (std::find(rim.begin(), rim.end(), -1) != rim.end()) continue;
    ++result.repairs.holes_closed;
    result.repairs.longest_hole =
        std::max(result.repairs.longest_hole, static_cast<std::int64_t>(rim.size()));
    if (turned[idx(hole.front())] != 0) std::reverse(rim.begin(), rim.end());
    result.rims.push_back(std::move(rim));
  }
  for (std::size_t f = 0; f < closed.face_given.size(); ++f) {
    const bool in_body = judged.parts[idx(judged.orientation.component_of_face[f])].is_body;
    result.repairs.faces_added += in_body && closed.face_given[f] < 0 ? 1 : 0;
  }
  for (std::size_t v = 0; v < closed.vertex_given.size(); ++v) {
    result.repairs.vertices_added += number[v] >= 0 && closed.vertex_given[v] < 0 ? 1 : 0;
  }
}

const std::string give_thickness =
    "give it thickness (--least-sheet 0.01 does so with sheets of a hundredth of the whole and "
    "more; Blender: the Solidify modifier)";

[[noreturn]] void refuse(const PolygonSoup& soup, const std::string& found) {
  const std::string file = soup.file.empty() ? "surface" : soup.file.string();
  throw Error(Fault::input, file + ": found " + found + ", needed a surface with an inside; " +
                                give_thickness + " or close it first");
}

[[noreturn]] void refuse(const PolygonSoup& soup, const Sheets& sheets) {
  std::ostringstream found;
  found << "a surface that encloses nothing: " << sheets.surface.triangles.rows() << " faces in "
        << sheets.components << (sheets.components == 1 ? " part" : " parts")
        << ", flat, or so open that closing would make up about half of the surface";
  refuse(soup, found.str());
}

/// True if more of the area is a tangle than is not.
bool is_a_tangle(const JudgedParts& judged) {
  double balance = 0;
  for (const JudgedPart& part : judged.parts) balance += part.is_tangle ? part.area : -part.area;
  return balance > 0;
}

[[noreturn]] void refuse_tangle(const PolygonSoup& soup) {
  const std::string file = soup.file.empty() ? "surface" : soup.file.string();
  throw Error(
      Fault::input,
      file +
          ": found triangles that pass through one another everywhere, needed a surface "
          "with an inside; do the numbers of the faces belong to these vertices, in this order? "
          "(--wrap all takes what encloses them all)");
}

void note_wrap(Repairs& repairs, const WrappedSolid& wrapped) {
  repairs.wrap_gap = wrapped.gap;
  repairs.wrap_distance = wrapped.distance;
  repairs.wrap_mean_distance = wrapped.mean_distance;
}

/// Faces as they were joined; the refusal stands where there are none, or too many to count.
Joined joined_faces(const PolygonSoup& soup, const RepairOptions& options, const Error& refusal,
                    const std::stop_token& stop, RepairedSurface& result) {
  constexpr std::int64_t most_corners = 2147483647 / 2;
  if (static_cast<std::int64_t>(soup.corners.size()) > most_corners) throw refusal;
  JoinCounts counts;
  Joined joined =
      join_soup(soup, {options.join_distance, options.least_area, stop}, result.changes, counts);
  result.repairs.vertices_joined = counts.vertices_joined;
  result.repairs.edges_split = counts.edges_split;
  if (joined.surface.triangles.rows() == 0) throw refusal;
  return joined;
}

/// The faces of the parts that are wanted; vertices stay.
Surface faces_of(const Surface& surface, const LooseParts& parts, const std::vector<char>& wanted) {
  std::vector<Eigen::Index> rows;
  for (std::size_t f = 0; f < parts.part_of_face.size(); ++f) {
    if (wanted[idx(parts.part_of_face[f])]) rows.push_back(static_cast<Eigen::Index>(f));
  }
  return {surface.positions, surface.triangles(rows, Eigen::all)};
}

/// Without specks: one far away would set the scale of the wrap.
Surface what_to_wrap(const Surface& joined, const RepairOptions& options, Repairs& repairs) {
  const LooseParts parts = loose_parts(joined);
  const double largest = *std::max_element(parts.areas.begin(), parts.areas.end());
  std::vector<char> wanted;
  for (const double one : parts.areas) wanted.push_back(one >= options.least_area * largest);
  repairs.specks_dropped = std::count(wanted.begin(), wanted.end(), char{0});
  return repairs.specks_dropped == 0 ? joined : faces_of(joined, parts, wanted);
}

/// Parts of which no vertex is in the map: the wrap has left them out.
std::int64_t parts_left_out(const Surface& given, const VertexMap& map) {
  const LooseParts parts = loose_parts(given);
  std::vector<char> seen(parts.areas.size(), 0);
  for (Eigen::Index f = 0; f < given.triangles.rows(); ++f) {
    for (const std::int32_t v : given.triangles.row(f)) {
      if (map.has(v)) seen[idx(parts.part_of_face[idx(f)])] = 1;
    }
  }
  return std::count(seen.begin(), seen.end(), char{0});
}

std::optional<RepairedSurface> wrap_all(const PolygonSoup& soup, const RepairOptions& options,
                                        const Monitor& monitor) {
  const std::string file = soup.file.empty() ? "surface" : soup.file.string();
  RepairedSurface result;
  const Joined joined = joined_faces(
      soup, options, Error(Fault::input, file + ": found no faces to wrap"), monitor.stop, result);
  const Surface given = what_to_wrap(joined.surface, options, result.repairs);
  std::optional<WrappedSolid> wrapped;
  if (options.wrap_gap > 0) {
    wrapped = wrap_solid(given, options.wrap_gap, WrapBudget(), monitor);
  } else {  // a wide one may have webs between limbs where a narrow one has none
    const double narrowest = narrowest_gap(given) / extent_of_faces(given);
    for (std::size_t i = 0; i < wrap_gaps.size() && !wrapped; ++i) {
      if (wrap_gaps[i] < narrowest && i + 1 < wrap_gaps.size()) continue;
      try {
        wrapped = wrap_solid(given, wrap_gaps[i], budget_of_wanted_wraps, monitor);
      } catch (const WrapTooLarge&) {
        if (i + 1 == wrap_gaps.size()) throw;
      }
    }
  }
  if (!wrapped) return std::nullopt;
  result.repairs.faces_wrapped = given.triangles.rows();
  result.repairs.wrapped_as_asked = true;
  note_wrap(result.repairs, *wrapped);
  result.repairs.wrap_followed = wrapped->followed;
  VertexMap vertex_map(joined);
  vertex_map.add_wrapped(given, *wrapped, 0);
  result.repairs.sheets_dropped = parts_left_out(given, vertex_map);
  result.surface = wrapped->surface;
  result.vertex_of_input = vertex_map.of_file();
  return result;
}

/// Returns their number.
std::int64_t add_thick_sheets(const ClosedParts& closed, const JudgedParts& judged,
                              const Joined& joined, const RepairOptions& options,
                              VertexMap& vertex_map, RepairedSurface& result) {
  if (options.least_sheet <= 0) return 0;
  ThickSheets thick =
      thicken(closed, judged, options.least_sheet * extent_of_faces(joined.surface));
  const auto first = static_cast<std::int32_t>(result.surface.positions.rows());
  for (std::int32_t& v : thick.number) v = v < 0 ? -1 : v + first;
  for (std::int32_t& v : thick.firsts) v += first;
  vertex_map.add_closed(closed, thick.number);
  append_surface(result.surface, thick.surface);
  result.sheets = std::move(thick.firsts);
  return result.repairs.sheets_thickened = static_cast<std::int64_t>(result.sheets.size());
}

/// If `clean` refuses. The refusal stands where there are no faces, or too many to count.
RepairedSurface rebuild(const PolygonSoup& soup, const Error& refusal, const RepairOptions& options,
                        const Monitor& monitor, int threads) {
  const Surface given{soup.positions, triangulate(soup, monitor.stop)};
  if (is_mostly_tangle(given)) refuse_tangle(soup);  // to join it takes long
  RepairedSurface result;
  const Joined joined = joined_faces(soup, options, refusal, monitor.stop, result);
  if (is_mostly_tangle(joined.surface)) refuse_tangle(soup);
  const ClosedParts closed = close_surface(joined.surface, monitor);
  result.repairs.vertices_copied = closed.vertices_copied;
  result.repairs.holes_narrowed = closed.holes_narrowed;
  const JudgedParts judged = judge_parts(closed, joined, options, threads, monitor);
  if (is_a_tangle(judged)) refuse_tangle(soup);
  result.surface = {closed.surface.positions, outward_bodies(closed, judged, result.changes)};
  const auto number = drop_unused_vertices(result.surface);
  count_holes(closed, judged, number, result);
  VertexMap vertex_map(joined);
  vertex_map.add_closed(closed, number);

  const Sheets sheets = sheets_of(closed, judged, joined);
  const double all_area = area(joined.surface);
  constexpr double negligible = 0.05;  // of the area
  std::optional<WrappedSolid> wrapped;
  if (options.wrap != Wrapping::never &&
      (sheets.area > negligible * all_area || result.surface.triangles.rows() == 0)) {
    try {
      wrapped = wrap_solid(sheets.surface, options.wrap_gap,
                           options.wrap_gap > 0 ? WrapBudget() : budget_of_needed_wraps, monitor);
    } catch (const WrapTooLarge&) {
      if (options.wrap_gap > 0 || result.surface.triangles.rows() == 0) throw;
    }
  }
  if (wrapped) {
    result.repairs.faces_wrapped = sheets.surface.triangles.rows();
    note_wrap(result.repairs, *wrapped);
    vertex_map.add_wrapped(sheets.surface, *wrapped,
                           static_cast<std::int32_t>(result.surface.positions.rows()));
    result.repairs.sheets_dropped = parts_left_out(sheets.surface, vertex_map);
    append_surface(result.surface, wrapped->surface);
    result.repairs.wrap_followed =
        1 - (1 - wrapped->followed) * area(wrapped->surface) / area(result.surface);
  } else {
    const std::int64_t thickened =
        add_thick_sheets(closed, judged, joined, options, vertex_map, result);
    if (result.surface.triangles.rows() == 0) refuse(soup, sheets);
    result.repairs.sheets_dropped = sheets.components - thickened;
  }
  result.vertex_of_input = vertex_map.of_file();
  return result;
}

/// Closed, before anything is left out.
struct Mended {
  RepairedSurface result;
  bool has_one_component = false;
  bool was_cut = false;  // pieces may have come off
};

Mended clean_or_rebuilt(const PolygonSoup& soup, const RepairOptions& options,
                        const Monitor& monitor, int threads) {
  std::optional<CleanSurface> cleaned;
  std::optional<Error> refusal;
  try {
    cleaned = clean(soup, monitor, threads);
  } catch (const Error& error) {
    refusal = error;  // the fault is found again, and mended, below
  }
  if (!cleaned) {
    RepairedSurface rebuilt = rebuild(soup, *refusal, options, monitor, threads);
    describe_changes(rebuilt.changes, monitor);
    return {std::move(rebuilt), false, true};
  }
  const bool has_one_component = cleaned->components == 1;
  const bool is_tangled =
      has_one_component ? is_tangle(cleaned->surface, false) : is_mostly_tangle(cleaned->surface);
  if (is_tangled) refuse_tangle(soup);
  return {{std::move(cleaned->surface),
           std::move(cleaned->vertex_of_input),
           std::move(cleaned->changes),
           {},
           {},
           {}},
          has_one_component,
          false};
}

/// For a surface of which no wrap encloses anything: the other way, if there is one.
std::string instead_of_wrap(const PolygonSoup& soup, RepairOptions options, const Monitor& monitor,
                            int threads) {
  options.wrap = Wrapping::never;
  Monitor silent;
  silent.stop = monitor.stop;
  try {
    (void)clean_or_rebuilt(soup, options, silent, threads);
    return "leave --wrap all out: with its holes closed it has an inside";
  } catch (const Error&) {
    return "give the surface thickness (Blender: the Solidify modifier)";
  }
}

Mended wrapped_whole(const PolygonSoup& soup, const RepairOptions& options, const Monitor& monitor,
                     int threads) {
  std::optional<RepairedSurface> wrapped = wrap_all(soup, options, monitor);
  if (!wrapped) {
    throw Error(Fault::input,
                (soup.file.empty() ? "surface" : soup.file.string()) +
                    ": found nothing that a wrap encloses more of than its own thickness; try a "
                    "wider --wrap-gap, or " +
                    instead_of_wrap(soup, options, monitor, threads));
  }
  describe_changes(wrapped->changes, monitor);
  return {std::move(*wrapped), false, false};
}

}  // namespace

void require_valid(const RepairOptions& options) {
  constexpr OptionRange distance{0, 0.1};
  constexpr OptionRange gap{0, 0.5};
  const OptionCheck check("RepairOptions");
  check.number("join_distance", options.join_distance, distance);
  check.number("least_area", options.least_area, share_range);
  check.number("components", options.components, {});
  check.number("most_added_area", options.most_added_area, share_range);
  check.number("least_crumb", options.least_crumb, share_range);
  check.choice("wrap", options.wrap, wrappings);
  check.number("wrap_gap", options.wrap_gap, gap);
  check.number("least_sheet", options.least_sheet, share_range);
  check.number("least_handle", options.least_handle, share_range);
}

RepairedSurface repair(const PolygonSoup& soup, const RepairOptions& options,
                       const Monitor& monitor, int threads) {
  require_valid(options);
  require_sound(soup);
  require_polygons(soup);
  RepairOptions its = options;
  if (lies_in_plane(soup)) {
    if (options.least_sheet <= 0 || options.wrap == Wrapping::all) {
      refuse(soup,
             "a flat drawing, of which all vertices lie in one plane and which encloses nothing");
    }
    its.wrap = Wrapping::never;  // none makes a body of it, and to try would take long
  }
  Mended mended = options.wrap == Wrapping::all ? wrapped_whole(soup, options, monitor, threads)
                                                : clean_or_rebuilt(soup, its, monitor, threads);
  RepairedSurface& result = mended.result;
  if (!mended.has_one_component) {
    const double least_crumb = mended.was_cut ? options.least_crumb : 0;
    const double copy_distance =
        options.join_distance * bounding_box_diagonal(result.surface.positions);
    const bool floors_stay = options.least_sheet > 0;
    leave_out_components(result,
                         {copy_distance, options.least_area, floors_stay, least_crumb,
                          options.merge_overlapping ? 0 : options.components},
                         monitor.stop);
    if (options.merge_overlapping) {
      merge_overlapping(result, monitor);
      leave_out_components(result, {copy_distance, 0, false, 0, options.components}, monitor.stop);
    }
  }
  cut_small_handles(result, options.least_handle, monitor.stop);
  describe_repairs(result.repairs, monitor);
  if (mended.was_cut) monitor.report("repair", 1);
  return std::move(result);
}

}  // namespace curveskel
