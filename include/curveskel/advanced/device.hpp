// The OpenCL devices of this machine.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace curveskel {

struct Device {
  std::string platform;
  std::string name;
  std::string version;  ///< of OpenCL on it, "OpenCL 3.0 ..."
  std::string driver;
  bool gpu = false;
  bool double_precision = false;  ///< cl_khr_fp64
  bool gl_sharing = false;        ///< cl_khr_gl_sharing
  int compute_units = 0;
  std::size_t memory_bytes = 0;
};

/// Every device of every platform, in the order of the OpenCL runtime. Empty when there is none.
/// The OpenCL drivers are loaded by the first call, which takes about 0.1 s.
[[nodiscard]] std::vector<Device> devices();

struct DeviceNeeds {
  bool double_precision = false;
  bool gl_sharing = false;
};

/// True if the device has everything that is needed. Pure.
[[nodiscard]] bool serves(const Device& device, const DeviceNeeds& needs);

/// The index in `candidates` of the device to run on: the first GPU that has what is needed, else
/// the first device that has. Pure. Throws Error(Fault::device) when there is none, which names
/// what was found, what `purpose` ("the method opencl in double precision") lacks, and `remedy`.
[[nodiscard]] std::size_t choose_device(const std::vector<Device>& candidates,
                                        const DeviceNeeds& needs, std::string_view purpose,
                                        std::string_view remedy);

}  // namespace curveskel
