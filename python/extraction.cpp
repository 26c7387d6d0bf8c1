#include "python/extraction.hpp"

#include <utility>

#include <curveskel/extract_repaired.hpp>
#include "app/certificate_table.hpp"
#include "app/report.hpp"

namespace curveskel {

PythonExtraction extract_soup(PolygonSoup soup, const ExtractSettings& settings,
                              const Monitor& monitor) {
  PythonExtraction result;
  result.settings = settings;
  result.soup = std::move(soup);
  result.repaired = repair(result.soup, settings.repair, monitor, settings.extract.threads);
  Monitor noting = monitor;
  noting.note = [&result](std::string_view line) { result.notes.emplace_back(line); };
  RepairedExtraction found =
      extract_repaired(result.repaired, settings.repair, settings.extract, noting);
  if (found.wrapped) result.repaired = std::move(*found.wrapped);
  result.extraction = std::move(found.extraction);
  result.skeleton = on_input_vertices(result.repaired, result.extraction.skeleton);
  return result;
}

std::string format_extraction(const PythonExtraction& extraction, SkeletonFormat format) {
  const std::filesystem::path& file = extraction.soup.file;
  SkeletonContext context;
  context.surface = &extraction.repaired.surface;
  context.provenance =
      program_and_version() + ", " + (file.empty() ? "arrays" : file.filename().string());
  context.report_json =
      result_json({extraction.soup, extraction.repaired, extraction.settings.repair,
                   extraction.settings.extract, extraction.extraction, extraction.notes,
                   extraction.settings.preset});
  return format_skeleton(extraction.skeleton, format, context);
}

std::string shortcomings(const PythonExtraction& extraction) {
  return all_failures(extraction.extraction.certificate, extraction.settings.extract.certificate);
}

}  // namespace curveskel
