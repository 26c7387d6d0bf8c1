// One extraction as Python holds it: the file, its repaired surface, the skeleton.
#pragma once

#include <string>
#include <vector>

#include <curveskel/extract.hpp>
#include <curveskel/monitor.hpp>
#include <curveskel/preset.hpp>
#include <curveskel/read.hpp>
#include <curveskel/repair.hpp>
#include <curveskel/skeleton_files.hpp>
#include "app/report.hpp"

namespace curveskel {

struct ExtractSettings {
  Preset preset = Preset::standard;
  RepairOptions repair;
  ExtractOptions extract;
};

struct PythonExtraction {
  PolygonSoup soup;  ///< as given
  ExtractSettings settings;
  RepairedSurface repaired;  ///< the surface of the extraction: a wrap, if one took its place
  Extraction extraction;
  CurveSkeleton skeleton;  ///< that of the extraction; node_of_vertex is by the vertices given
  std::vector<std::string> notes;
  SkeletonLevel level = {};  ///< that the skeleton is
};

/// As `curveskel extract` does, in the same order. Errors as of `repair` and `extract_repaired`.
[[nodiscard]] PythonExtraction extract_soup(PolygonSoup soup, const ExtractSettings& settings,
                                            const Monitor& monitor);

/// The levels that `curveskel extract --levels` writes, see `levels_of`.
[[nodiscard]] std::vector<PythonExtraction> levels_of(const PythonExtraction& extraction, int most,
                                                      const Monitor& monitor);

/// One line for files: the program, and the file that the surface is from.
[[nodiscard]] std::string provenance_of(const PythonExtraction& extraction);

/// The bytes of the skeleton file that `curveskel extract` writes. Errors as of `format_skeleton`.
[[nodiscard]] std::string format_extraction(const PythonExtraction& extraction,
                                            SkeletonFormat format);

/// The page of `curveskel extract --html`.
[[nodiscard]] std::string page_of(const PythonExtraction& extraction);

/// All that keeps the certificate from holding, in one line; empty if it holds.
[[nodiscard]] std::string shortcomings(const PythonExtraction& extraction);

}  // namespace curveskel
