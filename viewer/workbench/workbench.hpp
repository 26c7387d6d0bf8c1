// Everything a person does with the viewer, without window, mouse or panels: files, runs, the
// timeline, selection, corrections. The window draws it and calls it.
#pragma once

#include <chrono>
#include <deque>
#include <filesystem>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include <curveskel/edit.hpp>
#include <curveskel/findings.hpp>
#include <curveskel/rest_pose.hpp>
#include <curveskel/rig_files.hpp>
#include <curveskel/skeleton_files.hpp>
#include "viewer/model/defects.hpp"
#include "viewer/model/ground.hpp"
#include "viewer/model/history.hpp"
#include "viewer/model/rigging.hpp"
#include "viewer/model/run.hpp"
#include "viewer/render/scene.hpp"
#include "viewer/view_options.hpp"
#include "viewer/workbench/pick.hpp"

namespace curveskel::viewer {

/// A line for the person, shown for a while.
struct Message {
  std::string text;
  bool bad = false;
  std::chrono::steady_clock::time_point since;
};

/// A certificate and where it fails, of one skeleton.
struct Judgement {
  std::shared_ptr<const Scene> scene;  ///< whose surface it is
  std::shared_ptr<const CurveSkeleton> skeleton;
  std::shared_ptr<const Ground> ground;
  Certificate certificate;
  Findings findings;
  std::string error;  ///< why there is none
};

/// The progress of another thread, told by that thread.
class StageNews {
 public:
  struct Stage {
    std::string name;
    double fraction = 0;
  };
  void tell(std::string_view stage, double fraction) {
    const std::lock_guard lock(mutex_);
    now_ = {std::string(stage), fraction};
  }
  [[nodiscard]] Stage now() const {
    const std::lock_guard lock(mutex_);
    return now_;
  }

 private:
  mutable std::mutex mutex_;
  Stage now_;
};

/// True if `get` would not wait.
template <typename Value>
[[nodiscard]] bool is_ready(const std::future<Value>& future) {
  return future.valid() && future.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

class Workbench {
 public:
  explicit Workbench(ViewOptions options);
  ~Workbench();
  Workbench(const Workbench&) = delete;
  Workbench& operator=(const Workbench&) = delete;

  /// Takes in what other threads have finished; true if something that is seen has changed, apart
  /// from how far a stage has come. Never waits.
  bool update();
  /// True if another thread is at work, so that `update` should be called soon again.
  [[nodiscard]] bool busy() const;
  [[nodiscard]] bool opening() const { return opening_.valid(); }
  [[nodiscard]] bool judging() const { return judging_.valid(); }

  // Files. A failure becomes a message, and the open files stay.
  /// Only sets `wants_to_abandon` if something would be lost (see `would_lose`), unless it may.
  void open(const std::vector<std::filesystem::path>& files, bool may_abandon = false);
  /// The open files stay.
  void cancel_opening();
  /// Of the files that are being opened.
  [[nodiscard]] StageNews::Stage opening_stage() const;
  void reload();
  /// Reloads if the files on the disk are newer than those that were read.
  void watch_files();
  /// The skeleton at the end of the timeline, in the format of the extension; also a picture, or
  /// its rig, which is made first if need be. Never onto the open surface; where another file would
  /// be replaced, `wants_to_replace` is set instead, unless it may be.
  void save(const std::filesystem::path& file, bool may_replace = false);
  /// A rig is being made, to be saved here; empty = none.
  [[nodiscard]] const std::filesystem::path& saving_rig_to() const { return save_rig_to_; }
  /// Corrections that are in no file, or a save that waits for its rig, would be lost with what is
  /// open.
  [[nodiscard]] bool would_lose() const { return history_.unsaved() || !save_rig_to_.empty(); }
  [[nodiscard]] const std::vector<std::filesystem::path>& files() const { return files_; }
  /// For the skeleton, or for the rig where that is shown: after the open file, and never its own.
  [[nodiscard]] std::string suggested_name() const;

  // The run.
  void start(bool paused);
  void pause();
  void resume();  ///< starts one where none is under way
  /// One moment on: of the run, or of the recording. At the end of all, a rig is begun, but not by
  /// a key that is held.
  void step(bool held = false);
  void cancel();
  void rewind();
  /// Hides and shows branches of the skeleton that was made, by the detail wanted. One that was
  /// corrected has no other levels: its detail stays, and a message says so.
  void show_level();
  /// The detail wanted is of another run.
  [[nodiscard]] bool wants_finer_run() const;
  /// The detail of the run that goes on, or of what is shown, of which coarser levels are parts.
  [[nodiscard]] double detail_made() const;
  [[nodiscard]] Run::State run_state() const { return news_.state; }
  [[nodiscard]] bool running() const { return run_ != nullptr; }
  [[nodiscard]] const Run::News& news() const { return news_; }
  void go_to(std::size_t moment);
  /// The timeline has the moments of all tries of the run, or of those that were kept.
  void show_all_tries(bool all);

  // Selection: nodes in the order in which they were picked, or one edge; and a joint of the rig.
  void select(const Pick& picked, bool more);
  void clear_selection();
  [[nodiscard]] const std::vector<int>& selected_nodes() const { return selected_nodes_; }
  [[nodiscard]] int selected_edge() const { return selected_edge_; }
  [[nodiscard]] int selected_joint() const { return selected_joint_; }
  /// -1 = none: the weights of all joints are shown.
  void select_joint(int joint);
  /// Between the two selected nodes along the curve; empty otherwise.
  [[nodiscard]] const Path& measured() const { return measured_; }
  void show_exits();
  void show_spurs();
  /// Colours faces of the given surface red and flies to the first.
  void show_faces(const std::vector<int>& faces);
  /// Nothing is red any more. `show_...` of what is red already does the same.
  void clear_faults();

  /// Makes joints and skin weights, beside what goes on; they become the last moment of the
  /// timeline, until the skeleton changes. Of a skeleton as its run made it they are those of
  /// `rig_of_surface`, else of `rig_of`.
  void rig();
  /// True if a rig is being made, of a skeleton chosen before now.
  [[nodiscard]] bool making_rig() const { return rigging_.valid(); }
  /// Of the rig that is being made.
  [[nodiscard]] StageNews::Stage rig_stage() const;
  /// A rig that was made before stays.
  void cancel_rig();
  /// The work that can be cancelled: files that are opened, else the run, else a rig.
  [[nodiscard]] bool can_cancel() const;
  void cancel_what_goes_on();
  [[nodiscard]] bool shows_made_rig() const { return scene->character() != nullptr; }
  [[nodiscard]] bool has_rig() const { return scene->recording.moments().back().rig != nullptr; }

  /// Turns a joint about itself, in the surface's coordinates, on top of how it is turned; those
  /// below it and the surface follow. For the eye: files keep the pose in which the surface is.
  void turn_joint(int joint, const Eigen::Quaterniond& more);
  /// So that the joint, turned about the one above it, comes as near to this place (in the
  /// document's space) as it can.
  void pull_joint(int joint, const glm::vec3& place);
  /// All joints as they are in the file.
  void turn_back();
  /// The turns from now on are one step, which `undo` takes back before all corrections. Any
  /// correction, and any other rig, ends that: the pose stays as it is then.
  void begin_turning();
  [[nodiscard]] bool can_undo() const;
  [[nodiscard]] bool can_redo() const;
  /// Corrects the role of the selected joint, which is named and saved so; rigs that are made later
  /// have it, too, where they have a joint in its place. "" = none.
  void set_role(const std::string& role);

  // Corrections of the skeleton.
  void prune();
  void remove();
  void merge();
  void cut();
  void join();
  void split();
  void move(int node, const glm::vec3& place);
  void set_root();
  void undo();
  void redo();
  [[nodiscard]] const History& history() const { return history_; }
  [[nodiscard]] int root() const { return history_.empty() ? -1 : history_.now().root; }

  void say(std::string text, bool bad = false);
  [[nodiscard]] const std::deque<Message>& messages() const { return messages_; }
  /// Over the repaired surface; null until a skeleton has been judged by it.
  [[nodiscard]] const SurfaceTree* tree() const { return ground_ ? &ground_->tree : nullptr; }
  /// Of the surface as it was read; null until they are known.
  [[nodiscard]] const Defects* defects() const { return defects_.get(); }
  /// Of the skeleton that is shown, once it is known.
  [[nodiscard]] const Judgement* judgement() const;
  [[nodiscard]] const RunResult* result() const { return result_ ? &*result_ : nullptr; }

  std::shared_ptr<Scene> scene;  ///< never null
  RunOptions pipeline;
  VrmMeta vrm;             ///< of rigs that are saved as .vrm
  ExportOptions exported;  ///< of rigs that are saved
  /// Set when a person should be asked whether what `would_lose` says may be lost: for these files,
  /// or, if there are none, for leaving.
  std::optional<std::vector<std::filesystem::path>> wants_to_abandon;
  /// Set when the next save that succeeds is to be followed by this: these files are opened, or, if
  /// there are none, `wants_to_leave` is set.
  std::optional<std::vector<std::filesystem::path>> after_saving;
  bool wants_to_leave = false;
  /// Set when the camera should go to where the scene is seen best.
  bool wants_fit = true;
  /// Set when a person should be asked whether this file may be replaced.
  std::optional<std::filesystem::path> wants_to_replace;
  /// Set when the camera should fly here; in the document's space.
  std::optional<glm::vec3> wants_look_at;

 private:
  struct Opened {
    std::shared_ptr<Scene> scene;
    std::vector<std::filesystem::path> files;
    std::vector<std::filesystem::file_time_type> times;
    std::string error;
  };
  struct Rigged {
    std::shared_ptr<const Scene> scene;
    Edited of;
    FoundRig rig;  // null where it was stopped
    std::string error;
  };
  using RigWork = std::function<FoundRig(const Document& document, const Monitor& monitor)>;
  /// Poses before and after the one that is shown, of one rig.
  struct Poses {
    std::shared_ptr<const Rig> rig;
    std::vector<std::shared_ptr<const JointTurns>> before;
    std::vector<std::shared_ptr<const JointTurns>> after;
  };
  [[nodiscard]] bool has_pose(const std::vector<std::shared_ptr<const JointTurns>>& poses) const;
  void go_to_pose(std::vector<std::shared_ptr<const JointTurns>>& from,
                  std::vector<std::shared_ptr<const JointTurns>>& to);
  bool take_opened();
  bool take_news();
  bool take_defects();
  bool take_judgement();
  bool take_rig();
  [[nodiscard]] RigWork work_of_surface(const Edited& made);
  [[nodiscard]] RigWork work_of_skeleton(const Edited& given) const;
  bool take_materials();
  void drop_rig();
  void place_rig();
  void change_roles();
  void save_rig(const std::filesystem::path& file, RigFormat format);
  void take_moments(std::vector<Moment> moments);
  void take_result(RunResult result);
  void inspect();
  void retire_run();
  [[nodiscard]] CurveSkeleton at_level(const CurveSkeleton& whole) const;
  void heed_time_limit();
  void put_back_skeleton();
  void choose_wished_joint();
  void save_skeleton(const std::filesystem::path& file, SkeletonFormat format);
  void note_saved(const std::filesystem::path& file);
  void go_on_after_saving();
  void take_document(std::shared_ptr<Scene> opened, bool same_place);
  void show_made(Edited made, bool as_next_step);
  [[nodiscard]] bool shows_what_is_corrected();
  void go_in_history(const std::function<void()>& way);
  void edit(const std::function<CurveSkeleton(const CurveSkeleton&)>& change,
            const std::string& what);
  void show_state();
  void judge();
  void set_highlights();
  [[nodiscard]] bool show_or_hide(std::vector<int>& red, std::vector<int> wanted);

  ViewOptions options_;
  std::vector<std::filesystem::path> files_;
  std::vector<std::filesystem::file_time_type> read_times_;
  std::stop_source opening_stop_;
  std::shared_ptr<StageNews> opening_news_;
  std::future<Opened> opening_;
  std::stop_source document_stop_;  // of all work for the present one but runs and rigs
  bool reloading_ = false;
  std::unique_ptr<Run> run_;
  std::vector<std::unique_ptr<Run>> retired_;  // cancelled, not yet at their ends
  std::optional<bool> wants_start_;            // paused or not, once those are gone
  std::shared_ptr<RunMemory> run_memory_;
  Run::News news_;
  std::shared_ptr<const RunOptions> run_options_;  // of the last one
  std::chrono::steady_clock::time_point updated_ = std::chrono::steady_clock::now();
  double run_seconds_ = 0;  // without pauses
  bool first_moment_ = true;
  bool follow_ = true;
  bool rig_again_ = false;  // once the one that is made has stopped
  std::optional<RunResult> result_;
  History history_;
  std::vector<std::future<void>> background_;  // so that nobody has to wait for them
  std::shared_ptr<const Defects> defects_;
  std::future<std::shared_ptr<const Defects>> inspecting_;
  std::shared_ptr<const Ground> ground_;
  std::optional<Judgement> judgement_;
  std::future<Judgement> judging_;
  std::future<std::shared_ptr<const DrawnMaterials>> materials_;
  std::stop_source rigging_stop_;
  std::shared_ptr<StageNews> rigging_news_;
  std::future<Rigged> rigging_;
  std::shared_ptr<ExtractionCache> rig_memory_;  // of the rig that is made, one at a time
  std::filesystem::path save_rig_to_;            // once it is there; empty = nowhere
  std::vector<int> selected_nodes_;
  int selected_edge_ = -1;
  int selected_joint_ = -1;
  std::shared_ptr<const Rig> shown_rig_;          // whose joint that is
  std::shared_ptr<const CharacterRig> made_rig_;  // before roles were corrected
  Poses poses_;
  std::vector<int> failed_edges_;
  std::vector<int> failed_faces_;
  Path measured_;
  std::deque<Message> messages_;
};

}  // namespace curveskel::viewer
