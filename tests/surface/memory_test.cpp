#include "base/memory.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstdlib>
#include <string>

namespace curveskel::memory_laws {
namespace {

TEST(Memory, IsAskedForBeforeItIsTaken) {
  EXPECT_NO_THROW(require_memory(5e6, 5e6, "x.ply", Fault::input, "buy more"));
  try {
    require_memory(7e6, 5e6, "x.ply", Fault::input, "buy more");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::input);
    EXPECT_EQ(std::string(error.what()), "x.ply: found 5 MB of memory left, needed 7 MB; buy more");
  }
}

TEST(Memory, KnowsTheLimitOfTheAddressSpace) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "AddressSanitizer has taken more address space than any limit";
#endif
  const double before = available_memory_bytes();
  EXPECT_GT(before, 1e6);
  EXPECT_EXIT(
      {
        rlimit limit{};
        getrlimit(RLIMIT_AS, &limit);
        limit.rlim_cur = 4000000000;
        setrlimit(RLIMIT_AS, &limit);
        std::exit(available_memory_bytes() <= 4e9 ? 0 : 1);
      },
      testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace curveskel::memory_laws
