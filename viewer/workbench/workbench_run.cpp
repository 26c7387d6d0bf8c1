// The workbench's runs and its timeline.
#include <algorithm>
#include <thread>
#include <utility>

#include <curveskel/levels.hpp>
#include "viewer/workbench/workbench.hpp"

namespace curveskel::viewer {
namespace {

bool is_done(Run::State state) {
  return state == Run::State::finished || state == Run::State::cancelled ||
         state == Run::State::failed;
}

}  // namespace

void Workbench::start(bool paused) {
  wants_start_.reset();
  if (!scene->document.has_surface()) {
    say("open a surface first: a skeleton alone has nothing to be contracted", true);
    return;
  }
  retire_run();
  if (!retired_.empty()) {
    wants_start_ = paused;  // the memory that they share serves one at a time
    return;
  }
  RunOptions options = pipeline;
  options.gives_way = true;
  options.extract.fairing = options.extract.fair.iterations > 0;
  // Coarser levels are parts of the one that is made.
  options.extract.embed.detail = std::max(options.extract.embed.detail, EmbedOptions().detail);
  // One core stays for the picture; the result is the same.
  if (options.extract.threads == 0) {
    options.extract.threads =
        std::max(1, static_cast<int>(std::thread::hardware_concurrency()) - 1);
  }
  options.extract.certificate.threads = options.extract.threads;
  options.extract.fair.threads = options.extract.threads;
  run_options_ = std::make_shared<const RunOptions>(options);
  run_ = std::make_unique<Run>(scene->document.polygons(), options, scene->document.space,
                               run_memory_, paused);
  news_ = {};
  run_seconds_ = 0;
  first_moment_ = true;
  follow_ = true;
  scene->own_skeleton.reset();  // the one that is made comes in its place
  clear_selection();
}

void Workbench::retire_run() {
  wants_start_.reset();
  if (!run_) return;
  run_->cancel();
  retired_.push_back(std::move(run_));
  run_.reset();
  news_.state = Run::State::cancelled;
}

void Workbench::pause() {
  if (run_) run_->pause();
}

void Workbench::resume() {
  if (run_) {
    follow_ = true;
    go_to(scene->recording.moments().size() - 1);
    run_->resume();
  } else {
    start(false);
  }
}

void Workbench::step(bool held) {
  if (scene->moment + 1 < scene->recording.moments().size()) {
    go_to(scene->moment + 1);
  } else if (run_) {
    follow_ = true;
    run_->step();
  } else if (!result_) {
    start(true);  // up to its first moment
  } else if (!has_rig() && !making_rig() && !held) {
    rig();
  }
}

void Workbench::cancel() {
  if (!run_) return;
  retire_run();
  put_back_skeleton();
  show_state();
  say("cancelled; what was recorded is kept");
}

bool Workbench::can_cancel() const { return opening() || running() || making_rig(); }

void Workbench::cancel_what_goes_on() {
  if (opening()) {
    cancel_opening();
  } else if (running()) {
    cancel();
  } else {
    cancel_rig();
  }
}

/// After a run that did not come to its end: what there was before is the last moment again.
void Workbench::put_back_skeleton() {
  const auto& moments = scene->recording.moments();
  const bool is_there = std::any_of(moments.begin(), moments.end(),
                                    [](const Moment& one) { return one.stage == "skeleton"; });
  if (is_there || history_.empty() || moments.size() == 1) return;
  const Edited& now = history_.now();
  Moment last;
  last.stage = "skeleton";
  last.skeleton = now.whole ? now.whole : now.skeleton;
  if (result_) last.seconds = result_->seconds;
  scene->recording.add(std::move(last));
}

/// A limit is for the work, not for the person who looks at it.
void Workbench::heed_time_limit() {
  const auto now = std::chrono::steady_clock::now();
  const double gone = std::chrono::duration<double>(now - std::exchange(updated_, now)).count();
  if (!run_ || news_.state != Run::State::running) return;
  run_seconds_ += gone;
  if (options_.time_limit_seconds <= 0 || run_seconds_ < options_.time_limit_seconds) return;
  cancel();
  say("the run took longer than --time-limit, so it was cancelled", true);
}

void Workbench::rewind() {
  if (run_) run_->pause();
  go_to(0);
}

void Workbench::go_to(std::size_t moment) {
  scene->moment = std::min(moment, scene->recording.moments().size() - 1);
  follow_ = scene->moment + 1 == scene->recording.moments().size();
  show_state();
}

void Workbench::show_all_tries(bool all) {
  scene->recording.show_all_tries(all);
  go_to(scene->recording.moments().size() - 1);
}

void Workbench::take_moments(std::vector<Moment> moments) {
  const bool cuts = first_moment_ && !moments.empty();
  for (Moment& moment : moments) {
    if (first_moment_) {
      // Moments that this run shows anew take the place of those of an earlier run.
      scene->recording.cut_from(moment.stage);
      scene->moment = std::min(scene->moment, scene->recording.moments().size() - 1);
      first_moment_ = false;
    }
    scene->recording.add(std::move(moment));
  }
  if (follow_) scene->moment = scene->recording.moments().size() - 1;
  if (cuts) show_state();  // a rig that was shown has gone, and the choice of its joint
}

CurveSkeleton Workbench::at_level(const CurveSkeleton& whole) const {
  return level_of(whole, least_life(pipeline.extract.embed.detail));
}

double Workbench::detail_made() const {
  if (run_) return run_options_->extract.embed.detail;
  return history_.empty() ? EmbedOptions().detail : history_.now().detail_made;
}

bool Workbench::wants_finer_run() const {
  const double wanted = std::max(pipeline.extract.embed.detail, EmbedOptions().detail);
  return wanted != detail_made() && (run_ || !history_.corrected());
}

void Workbench::show_level() {
  double& detail = pipeline.extract.embed.detail;
  if (run_ || history_.empty()) return;  // a run shows its own at its end
  const Edited& now = history_.now();
  if (detail == now.detail) return;
  if (now.corrected) {
    detail = now.detail;
    say("a level is of the skeleton as it was made: take the corrections back (Ctrl-Z) first",
        true);
    return;
  }
  if (now.whole == nullptr) return;
  Edited whole = now;
  whole.detail = detail;
  whole.skeleton = whole.whole;
  whole.root = whole.whole_root;
  show_made(changed_with_root(whole, [&](const CurveSkeleton& one) { return at_level(one); }),
            false);
}

void Workbench::take_result(RunResult result) {
  say("extracted in " + duration_text(result.seconds));
  for (const std::string& line : result.repaired->repairs.lines) say("repaired: " + line);
  for (const std::string& note : result.notes) say(note);
  scene->recording.settle(result.extraction->history);
  scene->moment = std::min(scene->moment, scene->recording.moments().size() - 1);
  if (follow_) scene->moment = scene->recording.moments().size() - 1;
  const bool had_root = root() >= 0;
  Edited made{std::make_shared<const CurveSkeleton>(at_level(*result.skeleton)), -1, false, {}};
  made.whole = result.skeleton;
  made.detail = pipeline.extract.embed.detail;
  made.detail_made = run_options_->extract.embed.detail;
  made.run = run_options_;
  rig_memory_.reset();
  if (!history_.empty()) made.roles = history_.now().roles;
  show_made(std::move(made), true);
  if (had_root) say("the root was a node of the skeleton before; set it again (T)");
  result_ = std::move(result);
}

bool Workbench::take_news() {
  if (!run_) return false;
  Run::News news = run_->take();
  const bool changed =
      !news.moments.empty() || news.state != news_.state || news.stage != news_.stage;
  take_moments(std::move(news.moments));
  news.moments.clear();
  const bool done = is_done(news.state);
  if (news.result) {
    take_result(std::move(*news.result));
    news.result.reset();
  }
  if (news.state == Run::State::failed) say(news.error, true);
  news_ = std::move(news);
  if (done) {
    run_.reset();
    put_back_skeleton();
    show_state();
  }
  return changed;
}

}  // namespace curveskel::viewer
