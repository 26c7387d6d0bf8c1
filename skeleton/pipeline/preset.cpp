#include <curveskel/preset.hpp>

#include "base/option_ranges.hpp"

namespace curveskel {
namespace {

void use_paper(RepairOptions& repair, ExtractOptions& options) {
  repair.wrap = Wrapping::never;
  options.fairing = true;
  options.fair.method = FairMethod::opencl;
  options.fair.iterations = 3;
  options.fair.volume = VolumeRule::offset;
  options.resolution = 1000;
  options.least_resolution = 500;
  options.contraction.flow = Flow::paper;
  options.contraction.solver = Solver::vcl_lsm;
  options.contraction.max_iterations = 3;
  options.surgery.method = SurgeryMethod::cgal;
  options.embed.method = EmbedMethod::none;
  options.fair_if_outside = options.all_vertices_if_failed = false;
}

}  // namespace

void use_preset(Preset preset, RepairOptions& repair, ExtractOptions& options) {
  OptionCheck("use_preset").choice("preset", preset, presets);
  switch (preset) {
    case Preset::standard:
      break;
    case Preset::paper:
      use_paper(repair, options);
      break;
  }
}

}  // namespace curveskel
