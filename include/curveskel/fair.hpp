// Local Laplacian fairing: the surface is smoothed, its connectivity and volume stay.
#pragma once

#include <filesystem>
#include <vector>

#include <curveskel/advanced/device.hpp>
#include <curveskel/advanced/names.hpp>
#include <curveskel/monitor.hpp>
#include <curveskel/surface.hpp>

namespace curveskel {

enum class FairMethod { automatic, cpu, host, opencl, opencl_transfer, opencl_interop };

inline constexpr NameTable<FairMethod, 6> fair_methods{{
    {FairMethod::automatic, "auto", "host: the same bytes with and without an OpenCL device"},
    {FairMethod::cpu, "cpu", "the reference: one thread, one QR per vertex (Eigen)"},
    {FairMethod::host, "host", "in double precision on all cores"},
    {FairMethod::opencl, "opencl", "resident on the OpenCL device for all iterations"},
    {FairMethod::opencl_transfer, "opencl-transfer",
     "opencl, the positions copied there and back at every iteration"},
    {FairMethod::opencl_interop, "opencl-interop",
     "opencl, in vertex buffers of OpenGL; the device must have cl_khr_gl_sharing"},
}};

enum class LocalSolver { closed, qr };

inline constexpr NameTable<LocalSolver, 2> local_solvers{{
    {LocalSolver::closed, "closed", "the closed form (rings = 1; larger patches by qr)"},
    {LocalSolver::qr, "qr", "a QR per vertex, as in the paper"},
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
  int rings = 1;  ///< K >= 1: a patch has the vertices within K edges of its centre
  LocalSolver local_solver = LocalSolver::closed;  ///< of host and OpenCL; cpu is always a QR
  double smoothing = 1;  ///< mu = W_L / W_H of each patch's least-squares problem; unit-free
  VolumeRule volume = VolumeRule::offset;
  bool double_precision = false;        ///< on the OpenCL device; the host computes in double
  int threads = 0;                      ///< host: 0 = one per core; the result is the same
  std::filesystem::path program_cache;  ///< folder for compiled kernels; empty = compile each time

  [[nodiscard]] bool operator==(const FairOptions&) const = default;
};

/// Throws Error(Fault::usage) that names the first option out of its range, the value and the
/// range.
void require_valid(const FairOptions& options);

/// The meaning of `auto`: always `host`, so that the result for a file does not depend on
/// the drivers of the machine. Pure.
[[nodiscard]] FairMethod choose_fair_method(FairMethod wanted);

/// The needs of `method` of an OpenCL device; none for those that run on the host. Pure.
[[nodiscard]] DeviceNeeds fair_needs(FairMethod method, bool double_precision);

/// The OpenCL methods that `device` can run in this precision, in the order of `fair_methods`.
/// Pure.
[[nodiscard]] std::vector<FairMethod> fair_methods_on(const Device& device, bool double_precision);

/// K-ring patches: each vertex moves to where the least-squares solution of contraction and
/// attraction rows of its patch (min ||mu L X||^2 + ||X - V||^2, L the cotangent Laplacian of the
/// faces round all vertices within K - 1 edges) puts the centre; all vertices at once. Boundary
/// vertices and those whose faces are not one fan are held. The volume of every closed component is
/// then restored by `volume` to within 1e-9 (relative). A component so coarse that the flow leaves
/// less than a tenth of its volume, or that its volume cannot be restored without half as much area
/// again, stays as it was; a note tells how many do. Each component is faired in a unit box of its
/// own: any scale and position, beside components of any other. The triangles are returned as they
/// came. An iteration costs O(#V n) in closed form, O(#V n^3) by QR, n the size of a patch, about
/// 3 K^2 + 3 K + 1. Frame k is the result of k iterations; without a callback for frames nothing is
/// spent on them.
/// Throws Error(Fault::device) when OpenCL was asked for and no device can do it or hold the
/// patches, Error(Fault::input) for corners that are no vertices, coordinates that are no finite
/// numbers, and a bounding box whose diagonal is above 1.8e308.
[[nodiscard]] Surface fair(const Surface& surface, const FairOptions& options = {},
                           const Monitor& monitor = {});

}  // namespace curveskel
