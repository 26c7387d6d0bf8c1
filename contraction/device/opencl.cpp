// The C API of OpenCL 1.2, reached through the ICD loader; drivers are loaded by its first call.
#define CL_TARGET_OPENCL_VERSION 120
#define CL_USE_DEPRECATED_OPENCL_1_2_APIS

#include "contraction/device/opencl.hpp"

#include <CL/cl.h>

#include <array>
#include <utility>
#include <vector>

#include <curveskel/error.hpp>
#include "contraction/device/program_cache.hpp"

namespace curveskel {
namespace {

std::string name_of_error(cl_int code) {
  static constexpr std::array<std::pair<cl_int, const char*>, 21> names{{
      {CL_DEVICE_NOT_FOUND, "CL_DEVICE_NOT_FOUND"},
      {CL_DEVICE_NOT_AVAILABLE, "CL_DEVICE_NOT_AVAILABLE"},
      {CL_COMPILER_NOT_AVAILABLE, "CL_COMPILER_NOT_AVAILABLE"},
      {CL_MEM_OBJECT_ALLOCATION_FAILURE, "CL_MEM_OBJECT_ALLOCATION_FAILURE"},
      {CL_OUT_OF_RESOURCES, "CL_OUT_OF_RESOURCES"},
      {CL_OUT_OF_HOST_MEMORY, "CL_OUT_OF_HOST_MEMORY"},
      {CL_BUILD_PROGRAM_FAILURE, "CL_BUILD_PROGRAM_FAILURE"},
      {CL_INVALID_VALUE, "CL_INVALID_VALUE"},
      {CL_INVALID_DEVICE, "CL_INVALID_DEVICE"},
      {CL_INVALID_CONTEXT, "CL_INVALID_CONTEXT"},
      {CL_INVALID_COMMAND_QUEUE, "CL_INVALID_COMMAND_QUEUE"},
      {CL_INVALID_MEM_OBJECT, "CL_INVALID_MEM_OBJECT"},
      {CL_INVALID_BINARY, "CL_INVALID_BINARY"},
      {CL_INVALID_BUILD_OPTIONS, "CL_INVALID_BUILD_OPTIONS"},
      {CL_INVALID_KERNEL_NAME, "CL_INVALID_KERNEL_NAME"},
      {CL_INVALID_ARG_INDEX, "CL_INVALID_ARG_INDEX"},
      {CL_INVALID_ARG_SIZE, "CL_INVALID_ARG_SIZE"},
      {CL_INVALID_KERNEL_ARGS, "CL_INVALID_KERNEL_ARGS"},
      {CL_INVALID_WORK_GROUP_SIZE, "CL_INVALID_WORK_GROUP_SIZE"},
      {CL_INVALID_BUFFER_SIZE, "CL_INVALID_BUFFER_SIZE"},
      {-1001, "CL_PLATFORM_NOT_FOUND_KHR"},
  }};
  for (const auto& [value, name] : names) {
    if (value == code) return name;
  }
  return "error " + std::to_string(code);
}

constexpr const char* remedy = "; use a method or solver that runs on the host";

void check(cl_int code, const std::string& call) {
  if (code != CL_SUCCESS) throw Error(Fault::device, call + ": " + name_of_error(code) + remedy);
}

void check(cl_int code, const std::string& call, const std::string& device) {
  check(code, call + " failed on OpenCL device '" + device + "'");
}

std::string text_of(cl_device_id id, cl_device_info what) {
  std::size_t size = 0;
  if (clGetDeviceInfo(id, what, 0, nullptr, &size) != CL_SUCCESS || size == 0) return {};
  std::string text(size, '\0');
  if (clGetDeviceInfo(id, what, size, text.data(), nullptr) != CL_SUCCESS) return {};
  text.resize(size - 1);  // the terminating zero
  return text;
}

std::string text_of(cl_platform_id id, cl_platform_info what) {
  std::size_t size = 0;
  if (clGetPlatformInfo(id, what, 0, nullptr, &size) != CL_SUCCESS || size == 0) return {};
  std::string text(size, '\0');
  if (clGetPlatformInfo(id, what, size, text.data(), nullptr) != CL_SUCCESS) return {};
  text.resize(size - 1);
  return text;
}

template <typename Value>
Value value_of(cl_device_id id, cl_device_info what) {
  Value value{};
  clGetDeviceInfo(id, what, sizeof value, &value, nullptr);
  return value;
}

Device describe(cl_platform_id platform, cl_device_id id) {
  // Spaces at both ends, so that a name is found only as a whole word.
  const std::string extensions = " " + text_of(id, CL_DEVICE_EXTENSIONS) + " ";
  Device device;
  device.platform = text_of(platform, CL_PLATFORM_NAME);
  device.name = text_of(id, CL_DEVICE_NAME);
  device.version = text_of(id, CL_DEVICE_VERSION);
  device.driver = text_of(id, CL_DRIVER_VERSION);
  device.gpu = (value_of<cl_device_type>(id, CL_DEVICE_TYPE) & CL_DEVICE_TYPE_GPU) != 0;
  device.double_precision = extensions.find(" cl_khr_fp64 ") != std::string::npos;
  device.gl_sharing = extensions.find(" cl_khr_gl_sharing ") != std::string::npos;
  device.compute_units = static_cast<int>(value_of<cl_uint>(id, CL_DEVICE_MAX_COMPUTE_UNITS));
  device.memory_bytes = value_of<cl_ulong>(id, CL_DEVICE_GLOBAL_MEM_SIZE);
  return device;
}

struct Found {
  cl_platform_id platform;
  cl_device_id id;
};

// A platform that fails or has no device adds nothing; a loader without drivers reports an error
// instead of zero platforms.
std::vector<Found> find_devices() {
  cl_uint count = 0;
  if (clGetPlatformIDs(0, nullptr, &count) != CL_SUCCESS || count == 0) return {};
  std::vector<cl_platform_id> platforms(count);
  if (clGetPlatformIDs(count, platforms.data(), nullptr) != CL_SUCCESS) return {};
  std::vector<Found> found;
  for (cl_platform_id platform : platforms) {
    count = 0;
    if (clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, 0, nullptr, &count) != CL_SUCCESS) continue;
    std::vector<cl_device_id> ids(count);
    if (clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, count, ids.data(), nullptr) != CL_SUCCESS) {
      continue;
    }
    for (cl_device_id id : ids) found.push_back({platform, id});
  }
  return found;
}

std::string build_log(cl_program program, cl_device_id id) {
  std::size_t size = 0;
  clGetProgramBuildInfo(program, id, CL_PROGRAM_BUILD_LOG, 0, nullptr, &size);
  std::string log(size, '\0');
  clGetProgramBuildInfo(program, id, CL_PROGRAM_BUILD_LOG, size, log.data(), nullptr);
  while (!log.empty() && (log.back() == '\0' || log.back() == '\n')) log.pop_back();
  return log.empty() ? "(the compiler left no log)" : log;
}

std::shared_ptr<void> own(cl_program program) { return {program, clReleaseProgram}; }

// Null when the binary is not one for this device.
std::shared_ptr<void> program_of(const std::vector<unsigned char>& binary, cl_context context,
                                 cl_device_id id, const std::string& options) {
  if (binary.empty()) return nullptr;
  const unsigned char* data = binary.data();
  const std::size_t size = binary.size();
  cl_int code = CL_SUCCESS;
  cl_program raw = clCreateProgramWithBinary(context, 1, &id, &size, &data, nullptr, &code);
  if (code != CL_SUCCESS) return nullptr;
  std::shared_ptr<void> program = own(raw);
  if (clBuildProgram(raw, 1, &id, options.c_str(), nullptr, nullptr) != CL_SUCCESS) return nullptr;
  return program;
}

std::vector<unsigned char> binary_of(cl_program program) {
  std::size_t size = 0;
  if (clGetProgramInfo(program, CL_PROGRAM_BINARY_SIZES, sizeof size, &size, nullptr) !=
      CL_SUCCESS) {
    return {};
  }
  std::vector<unsigned char> binary(size);
  unsigned char* data = binary.data();
  if (size == 0 ||
      clGetProgramInfo(program, CL_PROGRAM_BINARIES, sizeof data, &data, nullptr) != CL_SUCCESS) {
    return {};
  }
  return binary;
}

}  // namespace

std::vector<Device> devices() {
  std::vector<Device> result;
  for (const auto& [platform, id] : find_devices()) result.push_back(describe(platform, id));
  return result;
}

namespace opencl {

void Kernel::set_one(int index, const Buffer& buffer) {
  void* memory = buffer.handle.get();
  set_bytes(index, sizeof memory, static_cast<const void*>(&memory));
}

void Kernel::set_bytes(int index, std::size_t bytes, const void* value) {
  check(clSetKernelArg(static_cast<cl_kernel>(handle_.get()), static_cast<cl_uint>(index), bytes,
                       value),
        "setting argument " + std::to_string(index) + " of an OpenCL kernel failed");
}

Kernel Program::kernel(const char* name) const {
  cl_int code = CL_SUCCESS;
  cl_kernel raw = clCreateKernel(static_cast<cl_program>(handle_.get()), name, &code);
  check(code, "creating the OpenCL kernel " + std::string(name) + " failed");
  return Kernel({raw, clReleaseKernel});
}

Session::Session(std::size_t index, std::span<const std::intptr_t> properties) {
  const std::vector<Found> found = find_devices();
  if (index >= found.size()) {
    throw Error(Fault::device, "OpenCL device " + std::to_string(index) + " was asked for and " +
                                   std::to_string(found.size()) +
                                   " were found; use an index that the list of devices has");
  }
  cl_device_id id = found[index].id;
  device_ = describe(found[index].platform, id);
  id_ = id;
  cl_int code = CL_SUCCESS;
  std::vector<cl_context_properties> context_properties{
      CL_CONTEXT_PLATFORM, reinterpret_cast<cl_context_properties>(found[index].platform)};
  context_properties.insert(context_properties.end(), properties.begin(), properties.end());
  context_properties.push_back(0);
  cl_context raw_context =
      clCreateContext(context_properties.data(), 1, &id, nullptr, nullptr, &code);
  check(code, "creating a context", device_.name);
  context_ = {raw_context, clReleaseContext};
  cl_command_queue raw_queue = clCreateCommandQueue(raw_context, id, 0, &code);
  check(code, "creating a command queue", device_.name);
  queue_ = {raw_queue, clReleaseCommandQueue};
}

Buffer Session::allocate(std::size_t bytes) const {
  cl_int code = CL_SUCCESS;
  cl_mem raw = clCreateBuffer(static_cast<cl_context>(context_.get()), CL_MEM_READ_WRITE, bytes,
                              nullptr, &code);
  check(code, "allocating " + std::to_string(bytes) + " bytes", device_.name);
  return {{raw, clReleaseMemObject}, bytes};
}

void Session::write(const Buffer& buffer, const void* from, std::size_t bytes) const {
  check(clEnqueueWriteBuffer(static_cast<cl_command_queue>(queue_.get()),
                             static_cast<cl_mem>(buffer.handle.get()), CL_TRUE, 0, bytes, from, 0,
                             nullptr, nullptr),
        "copying to the device", device_.name);
}

void Session::read(const Buffer& buffer, void* to, std::size_t bytes) const {
  check(clEnqueueReadBuffer(static_cast<cl_command_queue>(queue_.get()),
                            static_cast<cl_mem>(buffer.handle.get()), CL_TRUE, 0, bytes, to, 0,
                            nullptr, nullptr),
        "copying from the device", device_.name);
}

Program Session::build(std::string_view source, const std::string& options,
                       const std::filesystem::path& cache) const {
  cl_context context = static_cast<cl_context>(context_.get());
  cl_device_id id = static_cast<cl_device_id>(id_);
  const std::string key = device_.platform + '\n' + device_.name + '\n' + device_.version + '\n' +
                          device_.driver + '\n' + options + '\n' + std::string(source);
  if (auto program = program_of(cached_binary(cache, key), context, id, options)) {
    return Program(std::move(program));
  }
  const char* text = source.data();
  const std::size_t length = source.size();
  cl_int code = CL_SUCCESS;
  cl_program raw = clCreateProgramWithSource(context, 1, &text, &length, &code);
  check(code, "creating a program", device_.name);
  std::shared_ptr<void> program = own(raw);
  code = clBuildProgram(raw, 1, &id, options.c_str(), nullptr, nullptr);
  if (code != CL_SUCCESS) {
    throw Error(Fault::device, "building a kernel with the options '" + options +
                                   "' failed on OpenCL device '" + device_.name + "' (driver " +
                                   device_.driver + "): " + name_of_error(code) + remedy +
                                   ". The compiler says:\n" + build_log(raw, id));
  }
  if (!cache.empty()) keep_binary(cache, key, binary_of(raw));
  return Program(std::move(program));
}

void Session::launch(const Kernel& kernel, std::size_t global, std::size_t local) const {
  check(clEnqueueNDRangeKernel(static_cast<cl_command_queue>(queue_.get()),
                               static_cast<cl_kernel>(kernel.handle()), 1, nullptr, &global,
                               local == 0 ? nullptr : &local, 0, nullptr, nullptr),
        "starting a kernel", device_.name);
}

void Session::finish() const {
  check(clFinish(static_cast<cl_command_queue>(queue_.get())), "running a kernel", device_.name);
}

}  // namespace opencl
}  // namespace curveskel
