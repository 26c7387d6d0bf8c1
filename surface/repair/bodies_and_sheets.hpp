// Which components of the closed parts are bodies, and which are sheets.
#pragma once

#include <cstdint>
#include <vector>

#include <curveskel/monitor.hpp>
#include <curveskel/repair.hpp>
#include <curveskel/surface.hpp>
#include "surface/repair/close_surface.hpp"
#include "surface/repair/join_soup.hpp"
#include "surface/repair/orient.hpp"

namespace curveskel {

/// One component of the closed parts.
struct JudgedPart {
  double area = 0;
  double added_area = 0;   ///< that closes holes
  double volume = 0;       ///< relative, see ComponentSums
  bool is_body = false;    ///< else a sheet
  bool is_tangle = false;  ///< of triangles that pass through one another everywhere: a sheet
  std::int64_t given_faces = 0;
  std::int64_t faces_as_given = 0;  ///< same orientation as in the file
};

struct JudgedParts {
  Orientation orientation;
  std::vector<JudgedPart> parts;
};

/// A body encloses something and is mostly given: closing it added no more than
/// `most_added_area`, a third more where it encloses much and does not cross itself. No part of a
/// one-sided surface is one, and no tangle.
/// `closed` comes from `joined`. Throws Cancelled on a stop.
[[nodiscard]] JudgedParts judge_parts(const ClosedParts& closed, const Joined& joined,
                                      const RepairOptions& options, int threads,
                                      const Monitor& monitor);

/// The bodies alone, outward; every vertex keeps its number in the closed parts. Adds the faces and
/// components that were turned to `changes`.
[[nodiscard]] Triangles outward_bodies(const ClosedParts& closed, const JudgedParts& judged,
                                       Changes& changes);

/// The given faces that enclose nothing as they are.
struct Sheets {
  Surface surface;  ///< positions as joined
  std::int64_t components = 0;
  double area = 0;
};

[[nodiscard]] Sheets sheets_of(const ClosedParts& closed, const JudgedParts& judged,
                               const Joined& joined);

}  // namespace curveskel
