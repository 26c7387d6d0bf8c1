// Sets of options that belong together.
#pragma once

#include <curveskel/advanced/names.hpp>
#include <curveskel/extract.hpp>
#include <curveskel/repair.hpp>

namespace curveskel {

enum class Preset { standard, paper };

inline constexpr NameTable<Preset, 2> presets{{
    {Preset::standard, "default", "all options as they are"},
    {Preset::paper, "paper",
     "the paper's chain: fairing on OpenCL, its volume restored; eq. 3 by vcl-lsm, three "
     "iterations; surgery by CGAL; no embedding, no inscribed balls, no second try"},
}};

/// Sets what the preset is about and leaves all other options as they are. With `paper` a component
/// has about 1,000 working vertices, as many as a dense QR does in a second, and whatever the
/// certificate says, nothing is tried again or wrapped.
void use_preset(Preset preset, RepairOptions& repair, ExtractOptions& options);

}  // namespace curveskel
