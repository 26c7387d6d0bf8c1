// Local Laplacian fairing: the surface is smoothed, its connectivity and volume stay.
#pragma once

#include <filesystem>
#include <vector>

#include "surface/monitor.hpp"
#include "surface/names.hpp"
#include "surface/surface.hpp"

namespace curveskel {

enum class FairMethod { automatic, cpu, host, opencl };

inline constexpr NameTable<FairMethod, 4> fair_methods{{
    {FairMethod::automatic, "auto", "host: the same bytes with and without an OpenCL device"},
    {FairMethod::cpu, "cpu", "the reference: one thread, one QR per vertex (Eigen)"},
    {FairMethod::host, "host", "closed form in double precision on all cores"},
    {FairMethod::opencl, "opencl", "resident on the OpenCL device for all iterations"},
}};

enum class VolumeRule { offset, scale, keep };

inline constexpr NameTable<VolumeRule, 3> volume_rules{{
    {VolumeRule::offset, "offset", "moved along the normals until the volume is as before"},
    {VolumeRule::scale, "scale", "scaled until the volume is as before (Desbrun et al. 1999)"},
    {VolumeRule::keep, "keep", "left as the flow made it"},
}};

struct FairOptions {
  FairMethod method = FairMethod::automatic;
  int iterations = 3;
  double smoothing = 1;  ///< mu = W_L / W_H of each patch's least-squares problem; unit-free
  VolumeRule volume = VolumeRule::offset;
  bool double_precision = false;        ///< on the OpenCL device; the host computes in double
  int threads = 0;                      ///< host: 0 = one per core; the result is the same
  std::filesystem::path program_cache;  ///< folder for compiled kernels; empty = compile each time
};

/// What `auto` stands for. Always `host`, so that what is extracted from a file does not depend on
/// the drivers of the machine. Pure.
[[nodiscard]] FairMethod choose_fair_method(FairMethod wanted);

/// One-ring patches: each vertex moves to where the least-squares solution of contraction and
/// attraction rows of its patch (min ||mu L X||^2 + ||X - V||^2, L the cotangent Laplacian of the
/// patch) puts the centre; all vertices at once. Boundary vertices and those whose faces are not
/// one fan are held. The volume of every closed component is then restored by `volume` to within
/// 1e-9 (relative). Any scale and position; the triangles are returned as they came.
/// Throws Error(Fault::device) when OpenCL was asked for and no device can do it,
/// Error(Fault::solver) when a component was smoothed until it has no volume left to restore.
[[nodiscard]] Surface fair(const Surface& surface, const FairOptions& options,
                           const Monitor& monitor);

}  // namespace curveskel
