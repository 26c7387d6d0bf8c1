// One error type; the fault says who can mend it, and becomes the exit code of the command line.
#pragma once

#include <exception>
#include <stdexcept>
#include <string>

namespace curveskel {

enum class Fault {
  usage,   ///< an option or an argument out of its range: no other try mends it
  input,   ///< the file or the surface in it
  device,  ///< the OpenCL device, its driver or a kernel
  solver,  ///< a linear solver, or a certificate that failed
  output   ///< a file could not be written
};

/// The message names the file or element, the value found, the value needed and a remedy.
class Error : public std::runtime_error {
 public:
  Error(Fault fault, const std::string& message) : std::runtime_error(message), fault_(fault) {}
  [[nodiscard]] Fault fault() const noexcept { return fault_; }

 private:
  Fault fault_;
};

/// Thrown by a stage whose Monitor was asked to stop; nothing has been written.
class Cancelled : public std::exception {
 public:
  [[nodiscard]] const char* what() const noexcept override { return "cancelled"; }
};

}  // namespace curveskel
