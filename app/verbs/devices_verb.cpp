// curveskel devices: OpenCL's devices on this machine.
#include <fmt/core.h>

#include <curveskel/advanced/device.hpp>
#include <curveskel/advanced/least_squares.hpp>
#include <curveskel/fair.hpp>
#include "app/arguments.hpp"
#include "app/command_line.hpp"
#include "app/verbs/verbs.hpp"

namespace curveskel {
namespace {

const char* yes_no(bool yes) { return yes ? "yes" : "no"; }

/// "opencl, opencl-transfer", or "none".
std::string fairing_methods(const Device& device, bool double_precision) {
  std::string text;
  for (const FairMethod method : fair_methods_on(device, double_precision)) {
    text += (text.empty() ? "" : ", ") + std::string(name_of(fair_methods, method));
  }
  return text.empty() ? "none" : text;
}

/// Those that need a device and can use this one.
std::string solvers_on(const Device& device) {
  std::string text;
  for (const auto& entry : solvers) {
    if (!needs_device(entry.value) || !device.double_precision) continue;
    text += (text.empty() ? "" : ", ") + std::string(entry.name);
  }
  return text.empty() ? "none: they need double precision" : text;
}

int run_devices(Session& session) {
  const std::vector<Device> found = devices();
  if (found.empty()) {
    session.terminal.error(
        "no OpenCL device was found; install a driver for the graphics card, or pocl-opencl-icd to "
        "use the processor");
    return ExitCode::device;
  }
  std::string text;
  for (const Device& device : found) {
    text += fmt::format(
        "{}\n  platform          {}\n  version           {}, driver {}\n"
        "  kind              {}, {} compute units, {:.1f} GiB\n"
        "  double precision  {}\n  GL sharing        {}\n"
        "  fair, single      {}\n  fair, double      {}\n  solvers           {}\n",
        device.name, device.platform, device.version, device.driver, device.gpu ? "GPU" : "CPU",
        device.compute_units, static_cast<double>(device.memory_bytes) / (1024.0 * 1024.0 * 1024.0),
        yes_no(device.double_precision), yes_no(device.gl_sharing), fairing_methods(device, false),
        fairing_methods(device, true), solvers_on(device));
  }
  session.terminal.result(text);
  return ExitCode::done;
}

}  // namespace

Verb add_devices(CLI::App& program) {
  return {program.add_subcommand("devices", "List the OpenCL devices of this machine"),
          run_devices};
}

}  // namespace curveskel
