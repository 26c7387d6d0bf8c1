#include "viewer/model/run.hpp"

#include <fmt/core.h>

#include <exception>
#include <new>
#include <utility>

#include <curveskel/extract_repaired.hpp>
#include "viewer/software/priority.hpp"

namespace curveskel::viewer {
std::string duration_text(double seconds) {
  const int digits = seconds < 9.995 ? 2 : seconds < 99.95 ? 1 : 0;
  return fmt::format("{:.{}f} s", seconds, digits);
}

Run::Run(std::shared_ptr<const PolygonSoup> soup, RunOptions options, DrawnSpace space,
         std::shared_ptr<RunMemory> memory, bool paused)
    : soup_(std::move(soup)),
      options_(std::move(options)),
      space_(std::move(space)),
      memory_(std::move(memory)),
      paused_(paused),
      worker_([this](const std::stop_token& stop) { work(stop); }) {}

Run::~Run() { cancel(); }

void Run::pause() {
  const std::lock_guard lock(mutex_);
  paused_ = true;
}

void Run::resume() {
  const std::lock_guard lock(mutex_);
  paused_ = false;
  steps_ = 0;
  go_on_.notify_all();
}

void Run::step() {
  const std::lock_guard lock(mutex_);
  if (paused_) ++steps_;  // else pausing is what ends at the next moment
  paused_ = true;
  go_on_.notify_all();
}

void Run::cancel() { worker_.request_stop(); }

Run::News Run::take() {
  const std::lock_guard lock(mutex_);
  News taken = news_;
  news_.moments.clear();
  news_.result.reset();
  if (taken.state == State::running && paused_ && waiting_ && steps_ == 0) {
    taken.state = State::paused;
  }
  return taken;
}

double Run::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count();
}

/// Hands the moment over; while paused, waits here until someone wants to see the next one.
void Run::show(Moment moment, const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  news_.moments.push_back(std::move(moment));
  waiting_ = true;
  const bool on = go_on_.wait(lock, stop, [this] { return !paused_ || steps_ > 0; });
  waiting_ = false;
  if (!on) throw Cancelled();
  if (paused_) --steps_;
}

void Run::extract_all(const Monitor& monitor) {
  if (!memory_->repaired || memory_->repair_options != options_.repair) {
    memory_->repaired = std::make_shared<const RepairedSurface>(
        repair(*soup_, options_.repair, monitor, options_.extract.threads));
    memory_->repair_options = options_.repair;
  }
  RunResult result;
  result.repaired = memory_->repaired;
  Monitor noting = monitor;
  noting.note = [&result](std::string_view line) { result.notes.emplace_back(line); };
  RepairedExtraction found = extract_repaired(*result.repaired, options_.repair, options_.extract,
                                              noting, memory_->extraction);
  if (found.repaired_again) {
    result.repaired = std::make_shared<const RepairedSurface>(std::move(*found.repaired_again));
  }
  result.extraction = std::make_shared<const Extraction>(std::move(found.extraction));
  result.skeleton = std::make_shared<const CurveSkeleton>(
      on_input_vertices(*result.repaired, result.extraction->skeleton));
  result.seconds = seconds();
  Moment last;
  last.stage = "skeleton";
  last.seconds = result.seconds;
  last.skeleton = result.skeleton;
  const std::lock_guard lock(mutex_);
  news_.moments.push_back(std::move(last));
  news_.result = std::move(result);
  news_.state = State::finished;
}

/// Every exception ends here; its message is news.
void Run::work(const std::stop_token& stop) {
  if (options_.gives_way) give_way();
  Monitor monitor;
  monitor.stop = stop;
  monitor.progress = [this](std::string_view stage, double fraction) {
    const std::lock_guard lock(mutex_);
    news_.stage = stage;
    news_.fraction = fraction;
  };
  monitor.frame = [&](const Frame& frame) {
    Moment moment = moment_of(frame, space_, seconds(), shown_.get());
    shown_ = moment.surface;
    show(std::move(moment), stop);
  };
  monitor.curve = [&](const CurveFrame& curve) { show(moment_of(curve, seconds()), stop); };
  const auto end = [this](State state, const std::string& why, Fault fault = Fault::solver) {
    const std::lock_guard lock(mutex_);
    news_.state = state;
    news_.error = why;
    news_.fault = fault;
  };
  try {
    extract_all(monitor);
  } catch (const Cancelled&) {
    end(State::cancelled, {});
  } catch (const Error& error) {
    end(State::failed, error.what(), error.fault());
  } catch (const std::bad_alloc&) {
    end(State::failed, "out of memory; use a smaller surface or a coarser resolution");
  } catch (const std::exception& error) {
    end(State::failed, error.what());
  }
}

}  // namespace curveskel::viewer
