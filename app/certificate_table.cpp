#include "app/certificate_table.hpp"

#include <fmt/core.h>

namespace curveskel {
namespace {

const char* verdict(bool good) { return good ? "ok" : "WRONG"; }

}  // namespace

std::string certificate_table(const Certificate& c, const CertificateOptions& options) {
  // D is the diagonal of the surface's bounding box.
  std::string text = "certificate          skeleton   surface\n";
  text += fmt::format("  components       {:>10} {:>9}   {}\n", c.components,
                      c.components_of_surface, verdict(c.components_right()));
  text += fmt::format("  cycles, genus    {:>10} {:>9}   {}\n", c.cycle_rank, c.genus,
                      verdict(c.cycle_rank == c.genus));
  text += fmt::format("  round handles    {:>10} {:>9}   {}\n", c.homology_rank, c.genus,
                      verdict(c.homology_rank == c.genus));
  text += fmt::format("  length inside    {:>8.3f} %  >= {:.1f} %   {}\n", 100 * c.inside_fraction,
                      100 * options.inside_needed, verdict(c.inside_enough));
  text += fmt::format("  ahead of tips    {:>10.4f} D  <= {:.1f} D    {}\n", c.reach_at_tips,
                      reach_at_tips_allowed, c.reaches_ends() ? "ok" : "STOPS SHORT");
  text += fmt::format("  made of tubes    {:>8.1f} %  >= {:.0f} %     {}\n", 100 * c.tube_share,
                      100 * tube_share_needed, c.curve_like ? "ok" : "NOT MADE OF TUBES");
  if (c.wrap_followed < 1) {
    text +=
        fmt::format("  wrap follows     {:>8.1f} %  >= {:.0f} %     {}\n", 100 * c.wrap_followed,
                    100 * wrap_followed_needed, c.wrap_follows() ? "ok" : "ANOTHER SHAPE");
  }
  text += fmt::format("  deepest exit     {:>10.2g} D\n", c.deepest_exit);
  text += fmt::format("  centredness      {:>10.3f} median, {:.3f} 90th percentile (0 = centred)\n",
                      c.centredness_median, c.centredness_p90);
  text += fmt::format("  coverage         {:>8.1f} %  of the vertices within 1.5 local radii\n",
                      100 * c.coverage);
  text += fmt::format("  reach            {:>10.4f} D, 95th percentile to the inscribed balls\n",
                      c.reach);
  text +=
      fmt::format("  tips             {:>10}\n  junctions        {:>10}\n", c.tips, c.junctions);
  text += fmt::format("  spurs            {:>10}\n", c.spurs);
  text += fmt::format("  length           {:>10.3f} D\n", c.length);
  text += fmt::format("  total curvature  {:>10.1f} rad per D\n", c.total_curvature);
  return text;
}

std::string all_failures(const Certificate& certificate, const CertificateOptions& options) {
  std::string text = failures(certificate, options);
  for (const std::string& other :
       {tip_failure(certificate), shape_failure(certificate), wrap_failure(certificate)}) {
    text += (text.empty() || other.empty() ? "" : "; ") + other;
  }
  return text;
}

}  // namespace curveskel
