#include "python/background_work.hpp"

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>

namespace curveskel {
namespace {

namespace py = pybind11;

/// The last word of the working thread.
struct Shared {
  std::mutex mutex;
  std::condition_variable changed;
  std::optional<std::pair<std::string, double>> progress;  ///< not yet passed on
  std::exception_ptr failure;
  bool done = false;
};

Monitor monitor_of(Shared& shared, std::stop_token stop) {
  Monitor monitor;
  monitor.stop = std::move(stop);
  monitor.progress = [&shared](std::string_view stage, double fraction) {
    const std::lock_guard lock(shared.mutex);
    shared.progress = {std::string(stage), fraction};
  };
  return monitor;
}

/// Throws what Python has raised: a signal, or an error of the listener.
void serve_interpreter(Shared& shared, const py::object& listener) {
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  if (listener.is_none()) return;
  std::optional<std::pair<std::string, double>> news;
  {
    const std::lock_guard lock(shared.mutex);
    news = std::exchange(shared.progress, std::nullopt);
  }
  if (news) listener.attr("tell")(news->first, news->second);
}

bool wait_for(Shared& shared, std::chrono::milliseconds time) {
  const py::gil_scoped_release others_may_run;
  std::unique_lock lock(shared.mutex);
  return shared.changed.wait_for(lock, time, [&] { return shared.done; });
}

}  // namespace

void run_beside_interpreter(const py::object& listener,
                            const std::function<void(const Monitor&)>& work) {
  Shared shared;
  std::jthread worker([&](const std::stop_token& stop) {
    std::exception_ptr failure;
    try {
      work(monitor_of(shared, stop));
    } catch (...) {
      failure = std::current_exception();
    }
    const std::lock_guard lock(shared.mutex);
    shared.failure = failure;
    shared.done = true;
    shared.changed.notify_all();
  });
  try {
    while (!wait_for(shared, std::chrono::milliseconds(100))) {
      serve_interpreter(shared, listener);
      if (!listener.is_none()) listener.attr("look")();
    }
    serve_interpreter(shared, listener);
  } catch (...) {
    worker.request_stop();
    const py::gil_scoped_release others_may_run;
    worker.join();
    throw;
  }
  worker.join();
  if (shared.failure) std::rethrow_exception(shared.failure);
}

}  // namespace curveskel
