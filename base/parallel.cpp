#include "base/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <deque>
#include <exception>
#include <map>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#ifdef __linux__
#include <sys/resource.h>
#include <unistd.h>
#endif

namespace curveskel {
namespace {

/// The ranges of one parallel_for, taken by whoever comes next.
class RangeJob {
 public:
  RangeJob(std::size_t count, std::size_t grain,
           const std::function<void(std::size_t, std::size_t)>& body)
      : count_(count), grain_(grain), chunks_((count + grain - 1) / grain), body_(body) {
    failures_.resize(chunks_);
  }

  [[nodiscard]] std::size_t chunks() const { return chunks_; }

  void work() {
    for (std::size_t chunk = next_++; chunk < chunks_; chunk = next_++) {
      try {
        body_(chunk * grain_, std::min(count_, (chunk + 1) * grain_));
      } catch (...) {
        failures_[chunk] = std::current_exception();
      }
    }
  }

  void rethrow() const {
    for (const auto& failure : failures_) {
      if (failure) std::rethrow_exception(failure);
    }
  }

  std::size_t places = 0;   ///< for helpers that have not come yet; under the crew's lock
  std::size_t helpers = 0;  ///< at work; under the crew's lock

 private:
  std::size_t count_;
  std::size_t grain_;
  std::size_t chunks_;
  const std::function<void(std::size_t, std::size_t)>& body_;
  std::vector<std::exception_ptr> failures_;
  std::atomic<std::size_t> next_{0};
};

/// Threads that stay between jobs: starting one costs more than most jobs of small surfaces. A
/// job's owner works on it too, and waits for no helper that has not come by the time the ranges
/// are taken, so jobs within jobs always end.
class Crew {
 public:
  Crew() = default;
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;
  ~Crew() {
    {
      const std::lock_guard lock(mutex_);
      closing_ = true;
    }
    wanted_.notify_all();
    for (std::thread& thread : threads_) thread.join();
  }

  void run(RangeJob& job, std::size_t helpers) {
    {
      const std::lock_guard lock(mutex_);
      helpers = std::min(helpers, grow(helpers));
      job.places = helpers;
      if (helpers > 0) open_.push_back(&job);
    }
    for (std::size_t i = 0; i < helpers; ++i) wanted_.notify_one();
    job.work();
    std::unique_lock lock(mutex_);
    if (job.places > 0) open_.erase(std::find(open_.begin(), open_.end(), &job));
    left_.wait(lock, [&] { return job.helpers == 0; });
  }

 private:
  /// Returns how many there are then: fewer than wanted where the system has no room for more, as
  /// in a container with few processes; the job's owner can do without.
  std::size_t grow(std::size_t wanted) {
    try {
      while (threads_.size() < wanted) threads_.emplace_back([this] { help(); });
    } catch (const std::exception&) {  // of the system, or out of memory
    }
    return threads_.size();
  }

  void help() {
    std::unique_lock lock(mutex_);
    while (true) {
      wanted_.wait(lock, [&] { return closing_ || !open_.empty(); });
      if (closing_) return;
      RangeJob& job = *open_.front();
      if (--job.places == 0) open_.pop_front();
      ++job.helpers;
      lock.unlock();
      job.work();
      lock.lock();
      if (--job.helpers == 0) left_.notify_all();
    }
  }

  std::mutex mutex_;
  std::condition_variable wanted_;
  std::condition_variable left_;
  std::deque<RangeJob*> open_;  // those with places left
  std::vector<std::thread> threads_;
  bool closing_ = false;
};

/// Of the calling thread: on Linux threads differ in it.
int niceness() {
#ifdef __linux__
  return getpriority(PRIO_PROCESS, 0);
#else
  return 0;
#endif
}

int process() {
#ifdef __linux__
  return getpid();
#else
  return 0;
#endif
}

/// A forked process has its parent's crews without their threads: to end those would take for ever.
struct EndOwnCrew {
  int its_process;
  void operator()(const Crew* crew) const {
    if (its_process == process()) delete crew;
  }
};

/// A thread is as nice as the one that started it, so callers that give way have a crew that does.
Crew& crew() {
  static std::mutex mutex;
  static std::map<std::pair<int, int>, std::unique_ptr<Crew, EndOwnCrew>> crews;
  const std::lock_guard lock(mutex);
  const std::pair whose(process(), niceness());
  const auto found = crews.find(whose);
  if (found != crews.end()) return *found->second;
  return *crews.try_emplace(whose, new Crew, EndOwnCrew{whose.first}).first->second;
}

}  // namespace

std::size_t thread_count(int threads) {
  return static_cast<std::size_t>(threads > 0 ? threads
                                              : std::max(1U, std::thread::hardware_concurrency()));
}

void parallel_for(std::size_t count, std::size_t grain, int threads,
                  const std::function<void(std::size_t, std::size_t)>& body) {
  if (count == 0) return;
  RangeJob job(count, std::max<std::size_t>(grain, 1), body);
  // The number of cores is asked of the system, which takes longer than many a small job.
  const std::size_t workers = job.chunks() > 1 ? std::min(thread_count(threads), job.chunks()) : 1;
  if (workers > 1) {
    crew().run(job, workers - 1);
  } else {
    job.work();
  }
  job.rethrow();
}

}  // namespace curveskel
