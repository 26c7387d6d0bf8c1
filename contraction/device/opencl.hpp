// One OpenCL device with its memory and programs; the API's own types stay in the .cpp file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include <curveskel/advanced/device.hpp>

namespace curveskel::opencl {

/// Memory on a device; freed with its last copy.
struct Buffer {
  std::shared_ptr<void> handle;  // cl_mem
  std::size_t bytes = 0;
};

/// A kernel and the arguments set so far; not for use by two threads at once.
class Kernel {
 public:
  explicit Kernel(std::shared_ptr<void> handle) : handle_(std::move(handle)) {}
  /// Sets all arguments, in order: buffers and plain values of the kernel's own types.
  template <typename... Arguments>
  void set(const Arguments&... arguments) {
    int index = 0;
    (set_one(index++, arguments), ...);
  }
  [[nodiscard]] void* handle() const { return handle_.get(); }

 private:
  void set_one(int index, const Buffer& buffer);
  template <typename Value>
  void set_one(int index, const Value& value) {
    set_bytes(index, sizeof(Value), &value);
  }
  void set_bytes(int index, std::size_t bytes, const void* value);
  std::shared_ptr<void> handle_;  // cl_kernel
};

class Program {
 public:
  explicit Program(std::shared_ptr<void> handle) : handle_(std::move(handle)) {}
  [[nodiscard]] Kernel kernel(const char* name) const;

 private:
  std::shared_ptr<void> handle_;  // cl_program
};

/// A context and an in-order queue. All failures throw Error(Fault::device) that names the call,
/// the device and OpenCL's error.
class Session {
 public:
  /// `index` into devices(); `properties` of the context, as pairs of OpenCL's names and values.
  explicit Session(std::size_t index, std::span<const std::intptr_t> properties = {});

  [[nodiscard]] const Device& device() const { return device_; }

  /// `bytes` > 0, uninitialised.
  [[nodiscard]] Buffer allocate(std::size_t bytes) const;
  /// A buffer that holds a copy of the range's elements.
  template <typename Range>
  [[nodiscard]] Buffer upload(const Range& range) const {
    const std::size_t bytes = range.size() * sizeof(*range.data());
    Buffer buffer = allocate(bytes);
    write(buffer, range.data(), bytes);
    return buffer;
  }
  void write(const Buffer& buffer, const void* from, std::size_t bytes) const;  ///< blocking
  void read(const Buffer& buffer, void* to, std::size_t bytes) const;           ///< blocking

  /// Compiles OpenCL C. The error of a failed build holds the compiler's log. A binary is kept in
  /// the folder `cache`, if one is given, and used by the next call for the same source, options,
  /// device and driver; the folder is made when missing, and a cache that cannot be read or written
  /// costs time only.
  [[nodiscard]] Program build(std::string_view source, const std::string& options,
                              const std::filesystem::path& cache) const;

  /// Enqueues `global` work-items in groups of `local` (0 = the driver's choice).
  void launch(const Kernel& kernel, std::size_t global, std::size_t local) const;
  void finish() const;

  [[nodiscard]] void* id() const { return id_; }                  ///< cl_device_id
  [[nodiscard]] void* context() const { return context_.get(); }  ///< cl_context
  [[nodiscard]] void* queue() const { return queue_.get(); }      ///< cl_command_queue

 private:
  Device device_;
  void* id_ = nullptr;  // cl_device_id
  std::shared_ptr<void> context_;
  std::shared_ptr<void> queue_;
};

}  // namespace curveskel::opencl
