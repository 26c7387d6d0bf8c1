// From any file's content to a surface with an inside.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include <curveskel/advanced/names.hpp>
#include <curveskel/clean.hpp>
#include <curveskel/monitor.hpp>
#include <curveskel/read.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

/// The parts that are put into a closed surface shrunk onto them from outside.
enum class Wrapping : std::uint8_t { never, needed, all };

inline constexpr NameTable<Wrapping, 3> wrappings{{
    {Wrapping::never, "never", "nothing: what encloses nothing is left out or refused"},
    {Wrapping::needed, "needed",
     "what encloses nothing, and components whose certificate fails (what crosses itself)"},
    {Wrapping::all, "all", "everything together: parts that overlap or touch become one body"},
}};

struct RepairOptions {
  /// Vertices on the boundary that lie nearer to each other become one, of D, but no farther apart
  /// than a quarter of the median edge there. Rounding tears a surface by 1e-7 D.
  double join_distance = 1e-6;
  /// Components with less area are left out, of the largest component's area; 0 keeps all.
  double least_area = 1e-4;
  int components = 0;  ///< the largest by area that are kept; 0 = all
  /// An open component is a sheet and no body when closing it takes more than this share of the
  /// area of both. A half sphere has 1/3, a flat sheet 1/2. A third more is allowed where the
  /// volume is .04 area^1.5 or more (a cube .068) and the closed surface does not cross itself.
  double most_added_area = 0.45;
  /// If cutting a non-manifold leaves pieces that touch, those with less area, of the
  /// largest one's, are crumbs: left out, their vertices follow the nearest one that stays.
  double least_crumb = 1e-2;
  Wrapping wrap = Wrapping::needed;
  /// Of D of what is wrapped: gaps up to this are spanned, and some up to twice as wide. 0 =
  /// chosen among 1/100, 1/40 and 1/15: the narrowest that encloses something, or after an
  /// extraction the one whose skeleton explains most.
  double wrap_gap = 0;
  /// Components that cross or touch one another become one body, their exact union; those that lie
  /// wholly inside another are left out. Those that merely come near stay apart.
  bool merge_overlapping = false;
  /// Sheets that no wrap makes a body of get a second side near the first one and so become thin
  /// bodies, if their extent is at least this, of D: wings and ears of one layer of triangles. 0 =
  /// all sheets are left out.
  double least_sheet = 0;
  /// Short handles with a loop no longer than this, of D, that does not part the surface are cut:
  /// of scans and volumes whose noise has handles. Wires and deep holes are long, and stay. 0 =
  /// none are cut, unless a certificate fails (see `extract_repaired`).
  double least_handle = 0;

  [[nodiscard]] bool operator==(const RepairOptions&) const = default;
};

/// Throws Error(Fault::usage) that names the first option out of its range, the value and the
/// range.
void require_valid(const RepairOptions& options);

/// What came of RepairOptions::merge_overlapping. Components are numbered as they are without it.
struct Merging {
  struct Covered {
    int component = 0;
    int inside = 0;  ///< the smallest component around it, or the first of the body in whose filled
                     ///< cavity it lies
  };
  struct Apart {
    int component = 0;
    int other = 0;    ///< it meets this one
    std::string why;  ///< they did not become one body
  };
  int components = 0;                    ///< before; 0 = not asked for
  std::vector<std::vector<int>> bodies;  ///< the components of each body that is made of several
  std::vector<Covered> covered;          ///< left out; their vertices follow the body's nearest
  std::vector<Apart> apart;
  int cavities_filled = 0;  ///< that the components of a body close in between them
  int handles_made = 0;     ///< round openings that the components of a body leave between them
};

/// The repairs beyond those that `Changes` counts. `lines` says the same in words.
struct Repairs {
  std::int64_t vertices_joined = 0;  ///< with another that lay within the join distance
  std::int64_t edges_split = 0;      ///< of rims, at vertices of another rim that lie on them
  std::int64_t vertices_copied = 0;  ///< where faces met in no orientable 2-manifold
  std::int64_t holes_closed = 0;
  std::int64_t longest_hole = 0;    ///< edges round the longest of them
  std::int64_t holes_narrowed = 0;  ///< by rings before they were closed, see `ClosedParts`
  std::int64_t faces_added = 0;
  std::int64_t vertices_added = 0;
  std::int64_t copies_dropped = 0;      ///< components that coincide with an earlier one
  std::int64_t crumbs_dropped = 0;      ///< small components cut off a much larger one
  std::int64_t specks_dropped = 0;      ///< components below the least area
  std::int64_t sheets_dropped = 0;      ///< components that enclose nothing
  std::int64_t sheets_thickened = 0;    ///< see RepairOptions::least_sheet
  std::int64_t handles_cut = 0;         ///< see RepairOptions::least_handle
  double longest_handle_loop = 0;       ///< of those along which they were cut, of D
  std::int64_t not_chosen = 0;          ///< components beyond the number wanted
  std::int64_t faces_wrapped = 0;       ///< that a wrap stands for
  bool wrapped_as_asked = false;        ///< see Wrapping::all
  std::int64_t components_wrapped = 0;  ///< whose certificate failed, see `extract_repaired`
  double wrap_gap = 0;                  ///< gaps up to this are spanned, of D
  double wrap_distance = 0;       ///< greatest distance from the wrap to the faces given, of D
  double wrap_mean_distance = 0;  ///< mean over the wrap's area, of D
  double wrap_followed = 1;       ///< share of the repaired surface's area that lies within D / 100
                                  ///< of the faces given, D of what is wrapped; 1 without a wrap
  Merging merging;
  std::vector<std::string> lines;
};

struct RepairedSurface {
  Surface surface;
  /// #V of the file; index into surface, -1 = dropped. A wrapped vertex has the nearest one of the
  /// wrap. Vertices that closing a hole added are nobody's.
  Eigen::VectorXi vertex_of_input;
  Changes changes;
  Repairs repairs;
  /// The vertices of the surface round each hole that was closed, in order: what closes it lies on
  /// the left as seen from outside.
  std::vector<std::vector<std::int32_t>> rims;
  /// A vertex of the surface on each sheet that got a thickness.
  std::vector<std::int32_t> sheets;
};

/// `clean`, and where that refuses: joins vertices that nearly coincide, cuts and stitches what is
/// no orientable 2-manifold, closes holes (see `close_surface`), wraps what still encloses nothing
/// (see `wrap`) if the wrap holds more than its own thickness, gives large sheets a thickness if so
/// wanted. With `Wrapping::all`, wraps what the file holds, whole or not. Then leaves out
/// coincident copies of components, crumbs, specks and sheets, merges components that overlap and
/// leaves out all but the largest, if so wanted, and cuts small handles, if so wanted. Throws
/// Error(Fault::input) if nothing with an inside is left, Cancelled on a stop. Deterministic. As
/// fast as `clean` for a whole surface.
[[nodiscard]] RepairedSurface repair(const PolygonSoup& soup, const RepairOptions& options = {},
                                     const Monitor& monitor = {}, int threads = 0);

}  // namespace curveskel
