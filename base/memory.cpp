#include "base/memory.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>
#include <limits>
#include <optional>
#include <string>

namespace curveskel {
namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();

/// The file's first number; nothing where there is none ("max").
std::optional<double> number_in(const char* file) {
  std::ifstream in(file);
  double value = 0;
  if (in >> value) return value;
  return std::nullopt;
}

double available_to_the_system() {
  std::ifstream in("/proc/meminfo");
  for (std::string key; in >> key;) {
    double kilobytes = 0;
    if (key == "MemAvailable:" && in >> kilobytes) return 1024 * kilobytes;
    in.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  }
  return unlimited;
}

double available_to_the_control_group() {
  constexpr std::array<std::array<const char*, 2>, 2> limit_and_use{
      {{"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory.current"},
       {"/sys/fs/cgroup/memory/memory.limit_in_bytes",
        "/sys/fs/cgroup/memory/memory.usage_in_bytes"}}};
  for (const auto& [limit, use] : limit_and_use) {
    const auto most = number_in(limit);
    const auto used = number_in(use);
    // The page cache of this group's files counts as used, but can be had.
    if (most && used) return std::max(*most - *used, *most / 4);
  }
  return unlimited;
}

double available_address_space() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return unlimited;
  const double used = number_in("/proc/self/statm").value_or(0) * double(sysconf(_SC_PAGESIZE));
  return std::max(0.0, double(limit.rlim_cur) - used);
}

std::string in_megabytes(double bytes) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.0f MB", bytes / 1e6);
  return text.data();
}

}  // namespace

double available_memory_bytes() {
  return std::min(
      {available_to_the_system(), available_to_the_control_group(), available_address_space()});
}

void require_memory(double bytes, double available, std::string_view purpose, Fault fault,
                    std::string_view remedy) {
  if (bytes <= available) return;
  std::string message(purpose);
  message += ": found " + in_megabytes(available) + " of memory left, needed " +
             in_megabytes(bytes) + "; ";
  message += remedy;
  throw Error(fault, message);
}

}  // namespace curveskel
