#include "app/interruption.hpp"

#include <fmt/core.h>
#include <semaphore.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <initializer_list>
#include <utility>

#include <curveskel/error.hpp>
#include "app/command_line.hpp"

namespace curveskel {
namespace {

using namespace std::chrono_literals;

// A signal handler reaches static data only.
sem_t arrived;
volatile std::sig_atomic_t last_signal = 0;

extern "C" void on_signal(int signal) {
  last_signal = signal;
  sem_post(&arrived);
}

void handle(int signal) {
  struct sigaction action {};
  // Started with the signal ignored (nohup, a shell's background job): it stays so.
  if (sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN) return;
  action = {};
  action.sa_handler = on_signal;
  action.sa_flags = SA_RESTART;
  sigaction(signal, &action, nullptr);
}

}  // namespace

Interruption::Interruption(std::string remedy) : remedy_(std::move(remedy)) {
  sem_init(&arrived, 0, 0);
  last_signal = 0;
  // A reader that closes its end of the pipe is an error of the write, not the end of the process.
  std::signal(SIGPIPE, SIG_IGN);
  handle(SIGINT);
  handle(SIGTERM);
  watcher_ = std::jthread([this](const std::stop_token& finished) { watch(finished); });
}

Interruption::~Interruption() {
  timer_ = {};
  watcher_.request_stop();
  sem_post(&arrived);
  watcher_.join();
  for (const int signal : {SIGINT, SIGTERM}) {
    struct sigaction action {};
    if (sigaction(signal, nullptr, &action) == 0 && action.sa_handler == on_signal) {
      std::signal(signal, SIG_DFL);
    }
  }
  sem_destroy(&arrived);
}

int Interruption::exit_code() const { return 128 + (last_signal != 0 ? last_signal : SIGINT); }

std::string Interruption::message() const {
  const double limit = reached_limit_;
  const int files = files_;
  const std::string before =
      fmt::format("{} file{} written", files, files == 1 ? " was" : "s were");
  if (limit <= 0) return files == 0 ? "interrupted" : "interrupted; " + before + " before";
  return fmt::format("the time limit of {:g} s was reached, {}; allow more, or {}", limit,
                     files == 0 ? "nothing was written" : before + " before", remedy_);
}

void Interruption::check() const {
  if (stop_.stop_requested()) throw Cancelled();
}

void Interruption::watch(const std::stop_token& finished) {
  while (sem_wait(&arrived) != 0 && errno == EINTR) {
  }
  if (finished.stop_requested()) return;
  stop_.request_stop();
  end_process_soon(finished, exit_code());
}

void Interruption::limit(double seconds) {
  if (seconds <= 0) return;
  timer_ = std::jthread([this, seconds](const std::stop_token& finished) {
    {
      std::unique_lock lock(mutex_);
      ended_.wait_for(lock, finished, std::chrono::duration<double>(seconds), [] { return false; });
    }
    if (finished.stop_requested()) return;
    reached_limit_ = seconds;
    stop_.request_stop();
    end_process_soon(finished, ExitCode::solver);
  });
}

/// Unless the stage obeys first.
void Interruption::end_process_soon(const std::stop_token& finished, int exit_code) {
  {
    std::unique_lock lock(mutex_);
    ended_.wait_for(lock, finished, 800ms, [] { return false; });
  }
  if (finished.stop_requested()) return;
  const std::unique_lock writing(writing_);
  const std::string line = "\ncurveskel: " + message() + "\n";
  [[maybe_unused]] const auto written = write(STDERR_FILENO, line.data(), line.size());
  _exit(exit_code);
}

}  // namespace curveskel
