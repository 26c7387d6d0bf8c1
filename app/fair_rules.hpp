// Rules of both doors to fairing, the command line and Python, besides the options' ranges.
#pragma once

#include <string>

#include <curveskel/error.hpp>
#include <curveskel/fair.hpp>

namespace curveskel {

inline constexpr NameTable<bool, 2> precisions{{
    {false, "single", "on the device"},
    {true, "double", "on the device; cpu and host always compute in double"},
}};

/// Throws Error(Fault::usage) where the closed form was asked for and a QR would be taken.
inline void require_closed_form(const FairOptions& options, bool is_asked_for) {
  if (!is_asked_for || options.local_solver != LocalSolver::closed) return;
  const bool is_reference = options.method == FairMethod::cpu;
  if (options.rings == 1 && !is_reference) return;
  const std::string found =
      is_reference ? "the method cpu" : "patches of " + std::to_string(options.rings) + " rings";
  throw Error(Fault::usage, "the local solver closed beside " + found +
                                ": the closed form is of patches of one ring, on host and device; "
                                "needed is the local solver qr");
}

/// Throws Error(Fault::usage) where single precision was asked for of a method of the host.
inline void require_single_on_device(const FairOptions& options, bool is_asked_for) {
  const FairMethod method = choose_fair_method(options.method);
  const bool is_of_host = method == FairMethod::cpu || method == FairMethod::host;
  if (!is_asked_for || options.double_precision || !is_of_host) return;
  throw Error(Fault::usage, "the precision single beside the method " +
                                std::string(name_of(fair_methods, options.method)) +
                                ", which computes in double; needed is a method of OpenCL");
}

}  // namespace curveskel
