#include "contraction/fairing/device/fairing_device.hpp"

#include <string>

#include <curveskel/advanced/device.hpp>

namespace curveskel {
namespace {

bool on_device(FairMethod method) {
  return method == FairMethod::opencl || method == FairMethod::opencl_transfer ||
         method == FairMethod::opencl_interop;
}

}  // namespace

DeviceNeeds fair_needs(FairMethod method, bool double_precision) {
  return {.double_precision = on_device(method) && double_precision,
          .gl_sharing = method == FairMethod::opencl_interop};
}

std::vector<FairMethod> fair_methods_on(const Device& device, bool double_precision) {
  std::vector<FairMethod> methods;
  for (const auto& entry : fair_methods) {
    if (on_device(entry.value) && serves(device, fair_needs(entry.value, double_precision))) {
      methods.push_back(entry.value);
    }
  }
  return methods;
}

std::size_t fairing_device(const FairOptions& options) {
  std::string purpose = "the method " + std::string(name_of(fair_methods, options.method));
  std::string instead = "use the method host";
  if (options.double_precision) {
    purpose += " in double precision";
    instead = "use single precision or the method host";
  }
  if (options.method == FairMethod::opencl_interop) {
    instead = "use the method opencl, which gives the same result without OpenGL, or host";
  }
  return choose_device(devices(), fair_needs(options.method, options.double_precision), purpose,
                       instead);
}

}  // namespace curveskel
