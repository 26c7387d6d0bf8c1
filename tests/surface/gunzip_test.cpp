// Laws of unzipping, beside those of reading: the processor is left as it was found.
#include <gtest/gtest.h>
#include <zlib.h>

#ifdef __x86_64__
#include <cpuid.h>
#endif

#include <optional>
#include <sstream>
#include <string>

#include <curveskel/read.hpp>
#include "tests/own_folder.hpp"

namespace curveskel::gunzip_laws {
namespace {

/// True if the upper halves of the vector registers are in use; nothing where that cannot be asked.
std::optional<bool> upper_halves_in_use() {
#ifdef __x86_64__
  constexpr unsigned state_leaf = 0xd;
  constexpr unsigned can_tell = 1U << 2U;
  constexpr unsigned upper_halves = 1U << 2U;
  unsigned a = 0;
  unsigned b = 0;
  unsigned c = 0;
  unsigned d = 0;
  if (__get_cpuid_count(state_leaf, 1, &a, &b, &c, &d) == 0 || (a & can_tell) == 0) return {};
  if (__builtin_cpu_supports("avx") == 0) return {};
  asm volatile("xgetbv" : "=a"(a), "=d"(d) : "c"(1));
  return (a & upper_halves) != 0;
#else
  return {};
#endif
}

/// A strip of triangles as OFF.
std::string strip(int triangles) {
  std::ostringstream text;
  text << "OFF\n" << triangles + 2 << " " << triangles << " 0\n";
  for (int v = 0; v < triangles + 2; ++v) text << v << " " << v % 2 << " " << v % 3 << "\n";
  for (int f = 0; f < triangles; ++f) text << "3 " << f << " " << f + 1 << " " << f + 2 << "\n";
  return text.str();
}

TEST(Gunzip, LeavesArithmeticAsFastAsBefore) {
  if (upper_halves_in_use() != false) GTEST_SKIP() << "the processor does not tell";
  const OwnFolder folder;
  const std::string path = (folder.path() / "strip.off.gz").string();
  const std::string bytes = strip(10000);
  const gzFile file = gzopen(path.c_str(), "wb");
  gzwrite(file, bytes.data(), static_cast<unsigned>(bytes.size()));
  gzclose(file);
  const PolygonSoup soup = read_polygons(path, {});
  EXPECT_EQ(upper_halves_in_use(), false);
  EXPECT_EQ(soup.positions.rows(), 10002);
}

}  // namespace
}  // namespace curveskel::gunzip_laws
