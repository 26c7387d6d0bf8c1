#include <curveskel/advanced/device.hpp>

#include <curveskel/error.hpp>

namespace curveskel {
namespace {

std::string missing(const Device& device, const DeviceNeeds& needs) {
  std::string text;
  if (needs.double_precision && !device.double_precision) text = "cl_khr_fp64";
  if (needs.gl_sharing && !device.gl_sharing) {
    text += (text.empty() ? "" : " and ") + std::string("cl_khr_gl_sharing");
  }
  return text;
}

}  // namespace

bool serves(const Device& device, const DeviceNeeds& needs) {
  return (!needs.double_precision || device.double_precision) &&
         (!needs.gl_sharing || device.gl_sharing);
}

std::size_t choose_device(const std::vector<Device>& candidates, const DeviceNeeds& needs,
                          std::string_view purpose, std::string_view remedy) {
  for (const bool gpu : {true, false}) {
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      if (candidates[i].gpu == gpu && serves(candidates[i], needs)) return i;
    }
  }
  std::string message(purpose);
  if (candidates.empty()) {
    message +=
        " needs an OpenCL device and none was found; install a driver (pocl-opencl-icd runs on any "
        "processor) or ";
  } else {
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      message += (i == 0 ? " needs " : "; ") + missing(candidates[i], needs) + ", which device '" +
                 candidates[i].name + "' does not offer";
    }
    message += "; ";
  }
  throw Error(Fault::device, message + std::string(remedy));
}

}  // namespace curveskel
