// Ctrl-C and termination: a polite request to the running stage, and a second later the end.
#pragma once

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>

namespace curveskel {

/// While one exists, SIGINT and SIGTERM request a stop; a stage that has not obeyed after 0.8 s is
/// ended together with the process, unless a file is being written just then. There can be one at a
/// time.
class Interruption {
 public:
  /// `remedy` is advice beside allowing more time, if a time limit is reached.
  explicit Interruption(std::string remedy);
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  [[nodiscard]] std::stop_token token() const { return stop_.get_token(); }
  /// 128 + the signal's number, once there was one.
  [[nodiscard]] int exit_code() const;
  /// From now on at most so many seconds, then it is as if a signal came; 0 = no limit.
  void limit(double seconds);
  /// The limit that was reached, in seconds; 0 = none was.
  [[nodiscard]] double reached_limit() const { return reached_limit_; }
  /// Throws Cancelled if a stop was requested.
  void check() const;
  /// The message: interrupted, or the limit that was reached, with a remedy and the number of files
  /// written before.
  [[nodiscard]] std::string message() const;
  /// While held, the process does not end halfway through a file. Not for a pipe, whose reader may
  /// have it wait for ever.
  [[nodiscard]] std::unique_lock<std::mutex> hold() { return std::unique_lock(writing_); }
  /// One more file is there, for the message.
  void count_written() { ++files_; }

 private:
  void watch(const std::stop_token& finished);
  void end_process_soon(const std::stop_token& finished, int exit_code);

  std::string remedy_;
  std::stop_source stop_;
  std::mutex writing_;
  std::mutex mutex_;
  std::condition_variable_any ended_;
  std::atomic<double> reached_limit_ = 0;
  std::atomic<int> files_ = 0;  // written
  std::jthread watcher_;
  std::jthread timer_;
};

}  // namespace curveskel
