// The pipeline on a thread of its own, steered and watched from the one that draws.
#pragma once

#include <Eigen/Core>
#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <curveskel/advanced/extraction_cache.hpp>
#include <curveskel/error.hpp>
#include <curveskel/extract.hpp>
#include <curveskel/read.hpp>
#include <curveskel/repair.hpp>
#include <curveskel/rig_character.hpp>
#include "viewer/model/recording.hpp"

namespace curveskel::viewer {

struct RunOptions {
  RepairOptions repair;
  ExtractOptions extract;
  CharacterOptions character;
  bool gives_way = false;  ///< to the threads that draw
};

/// Values that the runs over one file share, so that a later one with other options begins at the
/// first stage that they change.
struct RunMemory {
  std::shared_ptr<const RepairedSurface> repaired;
  RepairOptions repair_options;
  ExtractionCache extraction;
};

/// The values that a finished run leaves.
struct RunResult {
  std::shared_ptr<const RepairedSurface> repaired;
  std::shared_ptr<const Extraction> extraction;
  std::shared_ptr<const CurveSkeleton> skeleton;  ///< node_of_vertex by the file's vertices
  std::vector<std::string> notes;
  double seconds = 0;
};

/// "1.23 s", "12.3 s", "123 s": no more digits than a person reads.
[[nodiscard]] std::string duration_text(double seconds);

/// One run. Every function returns at once: the drawing thread never waits for the pipeline.
class Run {
 public:
  enum class State { running, paused, finished, cancelled, failed };

  /// Starts. `memory` must not be used by another run at the same time.
  Run(std::shared_ptr<const PolygonSoup> soup, RunOptions options, DrawnSpace space,
      std::shared_ptr<RunMemory> memory, bool paused);
  /// Cancels, and waits until the pipeline heeds it (within 0.1 s or so).
  ~Run();
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  void pause();
  void resume();
  /// Goes on to the next moment, and pauses there.
  void step();
  void cancel();

  /// The events since the last call.
  struct News {
    State state = State::running;
    std::string stage;    ///< the stage that runs
    double fraction = 0;  ///< of it
    std::vector<Moment> moments;
    std::optional<RunResult> result;  ///< once, after it has finished
    std::string error;                ///< why it failed
    Fault fault = Fault::solver;      ///< whose it is that it failed
  };
  [[nodiscard]] News take();

 private:
  void work(const std::stop_token& stop);
  void extract_all(const Monitor& monitor);
  void show(Moment moment, const std::stop_token& stop);
  [[nodiscard]] double seconds() const;

  const std::shared_ptr<const PolygonSoup> soup_;
  const RunOptions options_;
  const DrawnSpace space_;
  const std::shared_ptr<RunMemory> memory_;
  std::shared_ptr<const ShownSurface> shown_;  // of the pipeline's thread alone
  const std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();

  std::mutex mutex_;
  std::condition_variable_any go_on_;
  bool paused_ = false;  // guarded by mutex_, as all below
  int steps_ = 0;        // moments to go on for although paused
  bool waiting_ = false;
  News news_;
  std::jthread worker_;  // last: ends before what it uses
};

}  // namespace curveskel::viewer
