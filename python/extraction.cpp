#include "python/extraction.hpp"

#include <optional>
#include <utility>

#include <curveskel/branch_territories.hpp>
#include <curveskel/extract_repaired.hpp>
#include <curveskel/html_page.hpp>
#include "app/certificate_table.hpp"
#include "app/report.hpp"
#include "app/skeleton_levels.hpp"

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
  if (found.repaired_again) result.repaired = std::move(*found.repaired_again);
  result.extraction = std::move(found.extraction);
  result.skeleton = on_input_vertices(result.repaired, result.extraction.skeleton);
  return result;
}

std::vector<PythonExtraction> levels_of(const PythonExtraction& extraction, int most,
                                        const Monitor& monitor) {
  auto levels = levels_of(extraction.repaired, extraction.extraction,
                          extraction.settings.extract.certificate, most, monitor);
  std::vector<PythonExtraction> results;
  results.reserve(levels.size());
  for (ExtractionLevel& one : levels) {
    PythonExtraction& result = results.emplace_back();
    result.soup = extraction.soup;
    result.settings = extraction.settings;
    result.repaired = extraction.repaired;
    result.extraction = std::move(one.extraction);
    result.skeleton = on_input_vertices(result.repaired, result.extraction.skeleton);
    result.notes = extraction.notes;
    result.level = one.level;
  }
  return results;
}

namespace {

ExtractionRecord record_of(const PythonExtraction& extraction) {
  return {extraction.soup,
          extraction.repaired,
          extraction.settings.repair,
          extraction.settings.extract,
          extraction.extraction,
          extraction.notes,
          extraction.settings.preset,
          extraction.level};
}

}  // namespace

std::string provenance_of(const PythonExtraction& extraction) {
  const std::filesystem::path& file = extraction.soup.file;
  return program_and_version() + ", " + (file.empty() ? "arrays" : file.filename().string());
}

std::string format_extraction(const PythonExtraction& extraction, SkeletonFormat format) {
  SkeletonContext context;
  context.surface = &extraction.repaired.surface;
  context.up = customary_up(extraction.soup.format, extraction.soup.to_gltf);
  context.provenance = provenance_of(extraction);
  context.report_json = result_json(record_of(extraction));
  std::optional<BranchTerritories> territories;
  if (format == SkeletonFormat::csv) {
    territories = branch_territories(extraction.repaired.surface, extraction.extraction.skeleton);
    context.territories = &*territories;
  }
  return format_skeleton(extraction.skeleton, format, context);
}

std::string shortcomings(const PythonExtraction& extraction) {
  return all_failures(extraction.extraction.certificate, extraction.settings.extract.certificate);
}

std::string page_of(const PythonExtraction& extraction) {
  const Certificate& certificate = extraction.extraction.certificate;
  const std::filesystem::path& file = extraction.soup.file;
  return html_page(
      extraction.repaired.surface, extraction.extraction.skeleton,
      {file.empty() ? "arrays" : file.filename().string(),
       certificate_table(certificate, extraction.settings.extract.certificate),
       shortcomings(extraction), history_in_lines(record_of(extraction), provenance_of(extraction)),
       extraction.repaired.rims, customary_up(extraction.soup.format, extraction.soup.to_gltf)},
      extraction.settings.extract.threads);
}

}  // namespace curveskel
