// Laws of the loops on all cores.
#include "base/parallel.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#ifdef __linux__
#include <sys/resource.h>
#include <unistd.h>
#endif

namespace curveskel::parallel_laws {
namespace {

TEST(ParallelFor, VisitsEachElementOnce) {
  for (const int threads : {0, 1, 2, 7}) {
    for (const std::size_t count : {0UL, 1UL, 5UL, 1000UL}) {
      for (const std::size_t grain : {0UL, 1UL, 3UL, 5000UL}) {
        std::vector<int> visits(count, 0);
        parallel_for(count, grain, threads, [&](std::size_t begin, std::size_t end) {
          for (std::size_t i = begin; i < end; ++i) ++visits[i];
        });
        EXPECT_EQ(visits, std::vector<int>(count, 1));
      }
    }
  }
}

TEST(ParallelFor, EndsWithinItselfAndFromManyThreads) {
  std::atomic<int> visits{0};
  const auto nested = [&] {
    for (int round = 0; round < 50; ++round) {
      parallel_for(8, 1, 4, [&](std::size_t, std::size_t) {
        parallel_for(8, 1, 4, [&](std::size_t, std::size_t) {
          parallel_for(3, 1, 2, [&](std::size_t, std::size_t) { ++visits; });
        });
      });
    }
  };
  {
    std::vector<std::jthread> beside;
    beside.reserve(4);
    for (int i = 0; i < 4; ++i) beside.emplace_back(nested);
    nested();
  }
  EXPECT_EQ(visits, 5 * 50 * 8 * 8 * 3);
}

TEST(ParallelFor, RethrowsTheFirstFailureAndDoesTheRest) {
  for (const int threads : {1, 2, 6}) {
    std::atomic<int> visits{0};
    try {
      parallel_for(100, 1, threads, [&](std::size_t begin, std::size_t) {
        ++visits;
        if (begin % 10 == 7) throw std::runtime_error(std::to_string(begin));
      });
      ADD_FAILURE() << "nothing was thrown";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "7");
    }
    EXPECT_EQ(visits, 100);
  }
}

#ifdef __linux__
// A sanitizer needs memory of its own for each thread that it is told of.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
/// As in a container that may not have as many: a thread gets no stack.
void let_no_thread_start() {
  const rlimit none{1, 1};
  setrlimit(RLIMIT_AS, &none);
}

TEST(NoMoreThreads, LeavesTheWorkToThoseThatThereAre) {
  const auto with_no_thread = [] {
    std::vector<int> visits(200, 0);
    visits.reserve(1000);
    let_no_thread_start();
    parallel_for(visits.size(), 1, 64, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) ++visits[i];
    });
    const bool each_once = std::all_of(visits.begin(), visits.end(), [](int n) { return n == 1; });
    std::_Exit(each_once && in_background(0, [] { return 7; }).get() == 7 ? 0 : 1);
  };
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  EXPECT_EXIT(with_no_thread(), testing::ExitedWithCode(0), "");
}
#endif

// The pipeline gives way to the thread that draws; threads that stay must not forget that.
TEST(ParallelFor, HelpersGiveWayAsTheirCallerDoes) {
  const auto expect_all_as_nice = [] {
    const int wanted = getpriority(PRIO_PROCESS, 0);
    std::atomic<int> others{0};
    parallel_for(40, 1, 4, [&](std::size_t, std::size_t) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      others += getpriority(PRIO_PROCESS, 0) == wanted ? 0 : 1;
    });
    EXPECT_EQ(others, 0) << "as nice as " << wanted;
  };
  for (const int nicer : {0, 2, 5}) {
    std::jthread([&] {
      setpriority(PRIO_PROCESS, 0, getpriority(PRIO_PROCESS, 0) + nicer);
      expect_all_as_nice();
    }).join();
  }
}

TEST(ParallelFor, AForkedProcessHasThreadsOfItsOwnAndEnds) {
  parallel_for(100, 1, 4, [](std::size_t, std::size_t) {});  // so that there are some
  const auto in_child = [] {
    alarm(60);
    std::atomic<int> at_work{0};
    std::atomic<bool> met{false};
    parallel_for(2, 1, 2, [&](std::size_t, std::size_t) {
      ++at_work;
      while (at_work < 2) std::this_thread::yield();  // for ever, if it is alone
      met = true;
    });
    std::exit(met ? 0 : 1);
  };
  EXPECT_EXIT(in_child(), testing::ExitedWithCode(0), "");
}
#endif

}  // namespace
}  // namespace curveskel::parallel_laws
