// Reports: everything that was measured, decided and changed, as JSON.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <curveskel/compare_rigs.hpp>
#include <curveskel/extract.hpp>
#include <curveskel/preset.hpp>
#include <curveskel/read.hpp>
#include <curveskel/repair.hpp>
#include "app/compare_skeletons.hpp"

namespace curveskel {

/// "curveskel 0.1.0".
[[nodiscard]] std::string program_and_version();

/// The surface that a skeleton is of, after repair. Lengths in the units of its file.
struct SurfaceSize {
  std::int64_t vertices = 0;
  std::int64_t triangles = 0;
  int components = 0;
  int genus = 0;
  double diagonal = 0;  ///< of the bounding box: D, which lengths of the certificate are over
  double area = 0;
  double volume = 0;
};

/// `certificate` is that of a skeleton of it. O(#V + #F).
[[nodiscard]] SurfaceSize size_of(const Surface& surface, const Certificate& certificate);

/// One level of a skeleton of which several are written.
struct SkeletonLevel {
  int number = 1;  ///< 1 = the finest
  int of = 1;
  double least_life = 0;  ///< of its branches
};

/// The values of one extraction that its reports show.
struct ExtractionRecord {
  const PolygonSoup& soup;
  const RepairedSurface& repaired;
  const RepairOptions& repair_options;
  const ExtractOptions& options;
  const Extraction& extraction;
  const std::vector<std::string>& notes;  ///< notes of the stages on the way
  Preset preset = Preset::standard;       ///< that the options started from
  SkeletonLevel level = {};               ///< that the extraction's skeleton is
};

/// Values that depend on the run and not on input and options.
struct RunRecord {
  std::vector<StageTime> times;
  double seconds = 0;                ///< by the clock, so far
  std::vector<std::string> outputs;  ///< files, but for the report itself
};

/// All that was done to the surface on its way, a line each, after `provenance`.
[[nodiscard]] std::string history_in_lines(const ExtractionRecord& record,
                                           const std::string& provenance);

/// A JSON object: the same input and options give the same text.
[[nodiscard]] std::string result_json(const ExtractionRecord& record);

/// The same and the run: times, threads, peak memory, outputs. Ends with a newline.
[[nodiscard]] std::string report_json(const ExtractionRecord& record, const RunRecord& run);

/// The findings of `evaluate` about a skeleton file.
struct Evaluation {
  Certificate certificate;
  CertificateOptions options;
  Repairs repairs;                ///< of the surface, before
  SkeletonComparison comparison;  ///< with another skeleton; of no file = none
};

/// Certificate of a skeleton file against a surface file. Ends with a newline.
[[nodiscard]] std::string evaluation_json(const std::string& surface_file,
                                          const std::string& skeleton_file,
                                          const Evaluation& evaluation);

/// The rig of one file beside that of the other, the truth. Ends with a newline.
[[nodiscard]] std::string rig_comparison_json(const std::string& rig_file,
                                              const std::string& truth_file,
                                              const RigComparison& comparison);

/// The largest resident memory of the process so far.
[[nodiscard]] std::size_t peak_memory_bytes();

}  // namespace curveskel
