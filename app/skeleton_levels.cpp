#include "app/skeleton_levels.hpp"

#include <curveskel/levels.hpp>

namespace curveskel {
namespace {

Extraction at_level(const RepairedSurface& repaired, const Extraction& extraction,
                    const CertificateOptions& options, double least_life, const Monitor& monitor) {
  Extraction level = extraction;
  level.skeleton = level_of(extraction.skeleton, least_life);
  if (level.skeleton.edges.rows() == extraction.skeleton.edges.rows()) return level;
  level.certificate = evaluate(repaired.surface, level.skeleton, options, monitor);
  level.certificate.wrap_followed = extraction.certificate.wrap_followed;
  return level;
}

}  // namespace

std::optional<std::string> detail_finding(const EmbedOptions& embed) {
  if (embed.method != EmbedMethod::none || embed.detail == EmbedOptions().detail) return {};
  return "--detail has no effect without embedding, as branches have no lives";
}

std::vector<ExtractionLevel> levels_of(const RepairedSurface& repaired,
                                       const Extraction& extraction,
                                       const CertificateOptions& options, int most,
                                       const Monitor& monitor) {
  const std::vector<double> limits = level_limits(extraction.skeleton, most);
  const auto count = static_cast<int>(limits.size());
  std::vector<ExtractionLevel> levels;
  levels.reserve(limits.size());
  for (const double limit : limits) {
    const auto before = static_cast<int>(levels.size());
    monitor.report("levels", double(before) / double(count));
    levels.push_back(
        {{before + 1, count, limit}, at_level(repaired, extraction, options, limit, monitor)});
  }
  return levels;
}

}  // namespace curveskel
