#include "viewer/workbench/workbench.hpp"

#include <malloc.h>

#include <algorithm>
#include <exception>
#include <utility>

#include <curveskel/advanced/file_names.hpp>
#include <curveskel/advanced/write_file.hpp>
#include <curveskel/error.hpp>
#include "app/report.hpp"
#include "viewer/software/priority.hpp"

namespace curveskel::viewer {
namespace {

namespace fs = std::filesystem;

fs::file_time_type time_of(const fs::path& file) {
  std::error_code error;
  const auto time = fs::last_write_time(file, error);
  return error ? fs::file_time_type::min() : time;
}

std::string names_of(const std::vector<fs::path>& files) {
  std::string names;
  for (const fs::path& file : files) {
    names += (names.empty() ? "" : ", ") + file.filename().string();
  }
  return names;
}

/// The C library keeps the memory of reading and sorting for a while: several times the surface.
void give_back_memory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

Monitor heeding(const std::stop_source& source) {
  Monitor monitor;
  monitor.stop = source.get_token();
  return monitor;
}

}  // namespace

Workbench::Workbench(ViewOptions options)
    : scene(std::make_shared<Scene>(Document{})),
      pipeline(options.pipeline),
      vrm(options.vrm),
      options_(std::move(options)),
      run_memory_(std::make_shared<RunMemory>()) {
  news_.state = Run::State::finished;
  scene->look = options_.look;
  if (!options_.files.empty()) open(options_.files);
}

Workbench::~Workbench() {
  // All at once, and then wait for each.
  if (run_) run_->cancel();
  for (const auto& run : retired_) run->cancel();
  rigging_stop_.request_stop();
  opening_stop_.request_stop();
  document_stop_.request_stop();
}

void Workbench::say(std::string text, bool bad) {
  constexpr std::size_t most = 50;
  const auto now = std::chrono::steady_clock::now();
  if (!messages_.empty() && messages_.back().text == text && messages_.back().bad == bad) {
    messages_.back().since = now;
    return;
  }
  messages_.push_back({std::move(text), bad, now});
  if (messages_.size() > most) messages_.pop_front();
}

bool Workbench::busy() const {
  return opening_.valid() || run_ != nullptr || !retired_.empty() || inspecting_.valid() ||
         judging_.valid() || rigging_.valid() || materials_.valid();
}

bool Workbench::update() {
  bool changed = take_opened();
  changed = take_news() || changed;
  changed = take_defects() || changed;
  changed = take_judgement() || changed;
  changed = take_rig() || changed;
  changed = take_materials() || changed;
  heed_time_limit();
  std::erase_if(retired_, [](const std::unique_ptr<Run>& run) {
    return run->take().state != Run::State::running;
  });
  if (wants_start_ && retired_.empty()) start(*wants_start_);
  return changed;
}

void Workbench::open(const std::vector<fs::path>& files, bool may_abandon) {
  if (opening_.valid()) {
    say("another file is still being opened", true);
    return;
  }
  if (would_lose() && !reloading_ && !may_abandon) {  // reading again keeps corrections
    wants_to_abandon = files;
    return;
  }
  say("opening " + names_of(files));
  opening_stop_ = {};
  opening_news_ = std::make_shared<StageNews>();
  Monitor told = heeding(opening_stop_);
  told.progress = [news = opening_news_](std::string_view stage, double fraction) {
    news->tell(stage, fraction);
  };
  opening_ = std::async(std::launch::async, [files, monitor = std::move(told)] {
    Opened opened;
    opened.files = files;
    for (const fs::path& file : files) opened.times.push_back(time_of(file));
    try {
      Document document = open_document(files, monitor);
      throw_if_stopped(monitor.stop);
      opened.scene = std::make_shared<Scene>(std::move(document), monitor);
    } catch (const std::bad_alloc&) {
      opened.error = names_of(files) + ": out of memory";
    } catch (const std::exception& error) {
      opened.error = error.what();
    }
    give_back_memory();
    return opened;
  });
}

bool Workbench::take_opened() {
  if (!is_ready(opening_)) return false;
  Opened opened = opening_.get();
  if (opening_stop_.stop_requested()) {
    // The same state of a file is not read again by itself.
    if (std::exchange(reloading_, false)) read_times_ = opened.times;
    say("opening was cancelled");
    return true;
  }
  // If another file could not be opened, the open ones have not changed.
  if (opened.scene || reloading_) read_times_ = opened.times;
  if (!opened.scene) {
    reloading_ = false;
    say(opened.error, true);
    return true;
  }
  files_ = std::move(opened.files);
  say("opened " + names_of(files_));
  take_document(std::move(opened.scene), std::exchange(reloading_, false));
  const Document& document = scene->document;
  if (scene->rig()) {
    choose_wished_joint();
  } else if (!options_.joint.empty()) {
    say("the joint " + options_.joint + " is chosen once there is a rig (G)");
  }
  if (options_.run && document.has_surface() && !document.rig && !document.skeleton) start(false);
  return true;
}

void Workbench::choose_wished_joint() {
  try {
    look_at_rig(*scene, options_.joint);
    selected_joint_ = scene->highlights.joint;
  } catch (const Error& error) {
    say(error.what(), true);
    options_.joint.clear();  // it is said once
  }
}

/// Corrections of a file that has changed on the disk stay in the history.
void Workbench::take_document(std::shared_ptr<Scene> opened, bool same_place) {
  retire_run();
  rigging_stop_.request_stop();
  document_stop_.request_stop();
  document_stop_ = {};
  rig_again_ = false;
  if (!save_rig_to_.empty()) {
    say(save_rig_to_.string() + " was not saved: its surface was read anew meanwhile", true);
    save_rig_to_.clear();
  }
  wants_to_replace.reset();
  wants_to_abandon.reset();
  after_saving.reset();
  opened->look = scene->look;
  if (same_place) opened->camera = scene->camera;
  scene = std::move(opened);
  shown_rig_ = scene->rig();
  wants_fit = !same_place;
  run_memory_ = std::make_shared<RunMemory>();
  news_ = {};
  news_.state = Run::State::finished;
  result_.reset();
  judgement_.reset();
  ground_.reset();
  made_rig_.reset();
  rig_memory_.reset();
  if (same_place && history_.has_corrections()) {
    history_.go_over_to(scene->document.surface.positions.rows());
  } else {
    history_ = History();
  }
  clear_selection();
  failed_edges_.clear();
  failed_faces_.clear();
  if (scene->own_skeleton) {
    const int root = scene->document.root;
    Edited read{scene->own_skeleton, root, false, {}, scene->own_skeleton, root};
    read.detail = pipeline.extract.embed.detail;
    show_made(std::move(read), true);
  } else if (!history_.empty()) {
    show_state();
  }
  inspect();
}

void Workbench::cancel_opening() {
  if (opening_.valid()) opening_stop_.request_stop();
}

StageNews::Stage Workbench::opening_stage() const {
  return opening_.valid() ? opening_news_->now() : StageNews::Stage{};
}

void Workbench::reload() {
  if (files_.empty() || opening_.valid()) return;
  reloading_ = true;
  open(files_);
}

void Workbench::watch_files() {
  if (opening_.valid()) return;
  for (std::size_t i = 0; i < files_.size() && i < read_times_.size(); ++i) {
    const auto now = time_of(files_[i]);
    if (now == fs::file_time_type::min() || now == read_times_[i]) continue;
    reload();
    return;
  }
}

void Workbench::save(const fs::path& file, bool may_replace) {
  if (history_.empty()) {
    say(run_ ? "the skeleton is not there yet" : "there is no skeleton to save yet", true);
    return;
  }
  std::error_code none;
  if (fs::equivalent(file, scene->document.mesh_file, none)) {
    say(file.string() + " is the input; name another output", true);
    return;
  }
  const std::string extension = lower_extension(file);
  const auto format = choice_of(skeleton_formats, extension);
  const auto rig_format = choice_of(rig_formats, extension);
  if (!format && !rig_format) {
    say(file.filename().string() + ": the extension is none of " + names_in(skeleton_formats) +
            "; for a rig, " + names_in(rig_formats),
        true);
    return;
  }
  if (!may_replace && fs::exists(file, none)) {
    wants_to_replace = file;
    return;
  }
  try {
    if (format) {
      save_skeleton(file, *format);
    } else {
      save_rig(file, *rig_format);
    }
  } catch (const std::exception& error) {
    say(error.what(), true);
  }
}

void Workbench::save_skeleton(const fs::path& file, SkeletonFormat format) {
  const Edited& now = history_.now();
  SkeletonContext context;
  context.root = now.root;
  context.provenance = program_and_version() + ", " + names_of(files_) +
                       (now.corrected ? ", corrected by hand" : "");
  if (scene->document.has_surface()) context.surface = &scene->document.surface;
  context.up = customary_up(scene->document.format, scene->document.to_gltf);
  write_file(file, format_skeleton(*now.skeleton, format, context));
  if (format != SkeletonFormat::png && format != SkeletonFormat::svg) history_.note_saved();
  note_saved(file);
  say("saved " + file.string());
  go_on_after_saving();
}

/// With what waits for it, or is asked for meanwhile; which asks again where the file was none of
/// the corrections, such as a picture.
void Workbench::go_on_after_saving() {
  auto next = std::exchange(after_saving, std::nullopt);
  if (!next) next = std::exchange(wants_to_abandon, std::nullopt);
  if (!next) return;
  if (next->empty()) {
    wants_to_leave = true;
  } else {
    open(*next);
  }
}

std::string Workbench::suggested_name() const {
  const Document& document = scene->document;
  const fs::path name =
      without_gz((document.has_surface() ? document.mesh_file : document.skeleton_file).filename());
  const std::string stem = name.empty() ? "skeleton" : name.stem().string();
  const char* const extension = shows_made_rig() ? ".glb" : ".json";
  const std::string wanted = stem + extension;
  return wanted == name.string() ? stem + (shows_made_rig() ? "-rig" : "-skeleton") + extension
                                 : wanted;
}

/// Its own change of an open file is none to be read again.
void Workbench::note_saved(const fs::path& file) {
  std::error_code none;
  for (std::size_t i = 0; i < files_.size() && i < read_times_.size(); ++i) {
    if (fs::equivalent(files_[i], file, none)) read_times_[i] = time_of(file);
  }
}

/// The defects of the surface as it was read; nobody waits for them.
void Workbench::inspect() {
  defects_.reset();
  // The ends of older ones are waited for by threads that have nothing else to do.
  const auto leave = [&](auto& future) {
    if (!future.valid()) return;
    background_.push_back(std::async(
        std::launch::async, [](auto old) { old.wait(); }, std::move(future)));
  };
  leave(inspecting_);
  leave(materials_);
  std::erase_if(background_, [](const std::future<void>& one) { return is_ready(one); });
  if (scene->document.surface.triangles.rows() == 0) return;
  const Monitor monitor = heeding(document_stop_);
  inspecting_ = std::async(std::launch::async, [held = scene, monitor] {
    give_way();
    auto found = std::make_shared<const Defects>(defects_of(held->document.surface, monitor));
    give_back_memory();
    return found;
  });
  materials_ = std::async(std::launch::async, [held = scene, monitor] {
    give_way();
    auto found =
        materials_of(held->document.mesh_file,
                     static_cast<std::size_t>(held->document.surface.positions.rows()), monitor);
    give_back_memory();
    return found;
  });
}

bool Workbench::take_materials() {
  if (!is_ready(materials_)) return false;
  try {
    scene->materials = materials_.get();
  } catch (const std::exception& error) {
    say(std::string("the surface is shown without its materials: ") + error.what(), true);
  }
  return scene->materials != nullptr;
}

bool Workbench::take_defects() {
  if (!is_ready(inspecting_)) return false;
  try {
    defects_ = inspecting_.get();
  } catch (const std::exception& error) {
    say(std::string("defects of the file were not looked for: ") + error.what(), true);
  }
  return true;
}

const Judgement* Workbench::judgement() const {
  const bool current = judgement_ && judgement_->skeleton == scene->skeleton();
  return current ? &*judgement_ : nullptr;
}

/// Of the skeleton that is shown, on another thread; `take_judgement` starts the next one where it
/// has changed meanwhile.
void Workbench::judge() {
  const auto skeleton = scene->skeleton();
  if (!skeleton || !scene->document.has_surface() || judging_.valid() || judgement() != nullptr)
    return;
  auto repaired = result_ ? result_->repaired : nullptr;
  judging_ = std::async(
      std::launch::async,
      [skeleton, repaired, ground = ground_, held = scene, options = pipeline.extract.certificate,
       monitor = heeding(document_stop_), repair_options = pipeline.repair]() mutable {
        give_way();
        Judgement found;
        found.scene = held;
        found.skeleton = skeleton;
        try {
          repaired = repaired_of(held->document, std::move(repaired), repair_options, monitor);
          ground = ground_of(repaired, monitor, std::move(ground));
          found.ground = ground;
          found.certificate = certificate_of(*ground, *skeleton, options, monitor);
          found.findings = findings(ground->tree, ground->diagonal, *skeleton, options, monitor);
        } catch (const std::exception& error) {
          found.error = error.what();
        }
        return found;
      });
}

bool Workbench::take_judgement() {
  if (!is_ready(judging_)) return false;
  Judgement found = judging_.get();
  if (found.scene != scene) {  // of another file, or of the same one before it changed
    judge();
    return false;
  }
  if (found.ground) ground_ = found.ground;
  if (found.skeleton == scene->skeleton()) {
    judgement_ = std::move(found);
  } else {
    judge();
  }
  return true;
}

}  // namespace curveskel::viewer
