// The workbench's rig, made on another thread.
#include <exception>
#include <new>
#include <optional>
#include <string>
#include <utility>

#include <curveskel/advanced/file_names.hpp>
#include <curveskel/advanced/measures.hpp>
#include <curveskel/advanced/write_file.hpp>
#include <curveskel/error.hpp>
#include <curveskel/rest_pose.hpp>
#include <curveskel/rig_files.hpp>
#include "app/report.hpp"
#include "app/rig_findings.hpp"
#include "viewer/model/rigging.hpp"
#include "viewer/software/priority.hpp"
#include "viewer/workbench/workbench.hpp"

namespace curveskel::viewer {

void Workbench::rig() {
  const bool ready = !run_ && !history_.empty() && scene->document.has_surface();
  if (!ready) {
    save_rig_to_.clear();
    say(run_ ? "the rig is made of the skeleton, which is not there yet"
             : "a rig needs a surface and its skeleton: open or extract them first",
        true);
    return;
  }
  if (rigging_.valid()) {
    rigging_stop_.request_stop();  // `take_rig` begins anew
    rig_again_ = true;
    return;
  }
  rigging_stop_ = {};
  say("making the rig");
  rigging_news_ = std::make_shared<StageNews>();
  Monitor told;
  told.stop = rigging_stop_.get_token();
  told.progress = [news = rigging_news_](std::string_view stage, double fraction) {
    news->tell(stage, fraction);
  };
  const Edited& now = history_.now();
  rigging_ = std::async(
      std::launch::async, [of = now, held = scene, monitor = std::move(told),
                           work = is_as_made(now) ? work_of_surface(now) : work_of_skeleton(now)] {
        give_way();
        Rigged made;
        made.scene = held;
        made.of = of;
        try {
          made.rig = work(held->document, monitor);
        } catch (const Cancelled&) {
        } catch (const std::bad_alloc&) {
          made.error = "out of memory; a rig needs a smaller surface, or a coarser resolution";
        } catch (const std::exception& error) {
          made.error = error.what();
        }
        return made;
      });
}

/// The first begins with what the run leaves, others with what the one before left.
Workbench::RigWork Workbench::work_of_surface(const Edited& made) {
  if (!rig_memory_) {
    const bool is_at_rest = retired_.empty();  // runs that were cancelled may still write to it
    rig_memory_ = std::make_shared<ExtractionCache>(is_at_rest ? run_memory_->extraction.copy()
                                                               : ExtractionCache());
  }
  return [options = options_for_rig(*made.run, made.detail, pipeline.character),
          memory = rig_memory_](const Document& document, const Monitor& monitor) {
    return rig_of_surface(document, options, monitor, *memory);
  };
}

Workbench::RigWork Workbench::work_of_skeleton(const Edited& given) const {
  CharacterOptions options = pipeline.character;
  options.rig.joints.root = given.root;
  // Always that of this very skeleton, so that a rig does not depend on when it was asked for.
  std::optional<Certificate> known;
  if (judgement_ && judgement_->error.empty() && judgement_->skeleton == given.skeleton) {
    known = judgement_->certificate;
  }
  auto surface = result_ ? result_->repaired : ground_ ? ground_->repaired : nullptr;
  return [options, known, surface, skeleton = given.skeleton, near = ground_,
          certificate_options = pipeline.extract.certificate,
          repair_options = pipeline.repair](const Document& document, const Monitor& monitor) {
    const auto repaired = repaired_of(document, surface, repair_options, monitor);
    const Certificate certificate = known ? *known
                                          : certificate_of(*ground_of(repaired, monitor, near),
                                                           *skeleton, certificate_options, monitor);
    FoundRig found{rig_of(document, *repaired, *skeleton, &certificate, options, monitor), {}};
    found.findings = rig_findings(*found.character, options);
    const std::string on_sheets = words_on_sheets(*repaired, repair_options);
    if (!on_sheets.empty()) found.findings.push_back(on_sheets);
    return found;
  };
}

StageNews::Stage Workbench::rig_stage() const {
  return rigging_.valid() ? rigging_news_->now() : StageNews::Stage{};
}

void Workbench::cancel_rig() {
  if (!rigging_.valid()) return;
  rigging_stop_.request_stop();
  rig_again_ = false;
  save_rig_to_.clear();
  say("the rig was cancelled");
}

bool Workbench::take_rig() {
  if (!is_ready(rigging_)) return false;
  const Rigged made = rigging_.get();
  // By a person, or by a change, even one taken back.
  const bool stopped =
      rigging_stop_.stop_requested() || (!made.rig.character && made.error.empty());
  const bool stale = stopped || run_ || made.scene != scene || history_.empty() ||
                     made.of.skeleton != history_.now().skeleton ||
                     made.of.root != history_.now().root;
  const bool again = std::exchange(rig_again_, false) || (stale && !save_rig_to_.empty());
  if (again) {
    rig();
    return true;
  }
  if (stale) return true;
  if (!made.error.empty()) {
    save_rig_to_.clear();
    say(made.error, true);
    return true;
  }
  drop_rig();
  made_rig_ = made.rig.character;
  place_rig();
  go_to(scene->recording.moments().size() - 1);
  say(words_of(*made_rig_));
  for (const std::string& finding : made.rig.findings) say(finding);
  if (!options_.joint.empty()) choose_wished_joint();
  options_.joint.clear();  // from now on a person chooses
  if (!save_rig_to_.empty()) save(std::exchange(save_rig_to_, {}), true);  // was asked for
  return true;
}

void Workbench::drop_rig() {
  rigging_stop_.request_stop();
  made_rig_.reset();
  if (!has_rig()) return;
  scene->recording.cut_from("rig");
  scene->moment = std::min(scene->moment, scene->recording.moments().size() - 1);
}

/// At the end of the timeline, with the roles that were given by hand.
void Workbench::place_rig() {
  auto shown = std::make_shared<CharacterRig>(*made_rig_);
  const double size = bounding_box_diagonal(scene->document.surface.positions);
  give_roles(*shown, history_.now().roles, size, pipeline.character.names);
  scene->recording.cut_from("rig");
  scene->recording.add(moment_of(std::move(shown)));
}

/// Pose and chosen joint stay.
void Workbench::change_roles() {
  if (!has_rig()) return;
  const auto turns = scene->turns();
  const int joint = selected_joint_;
  place_rig();
  show_state();
  if (turns) scene->turn(*turns);
  select_joint(joint);
}

void Workbench::turn_joint(int joint, const Eigen::Quaterniond& more) {
  const auto rig = scene->rig();
  if (!rig || joint < 0 || joint >= rig->joints.rows()) return;
  JointTurns turns(rig->names.size(), Eigen::Quaterniond::Identity());
  if (const auto before = scene->turns()) turns = *before;
  Eigen::Quaterniond& turn = turns[static_cast<std::size_t>(joint)];
  turn = (more * turn).normalized();
  scene->turn(std::move(turns));
}

void Workbench::pull_joint(int joint, const glm::vec3& place) {
  const auto rig = scene->rig();
  if (!rig || joint < 0 || joint >= rig->joints.rows() || rig->parents[joint] < 0) return;
  const int parent = rig->parents[joint];
  const int above = rig->parents[parent];
  const Positions now = scene->joints_now();
  const Eigen::Vector3d wanted = model_point(place, scene->document.space);
  Eigen::Quaterniond way = Eigen::Quaterniond::FromTwoVectors(
      (now.row(joint) - now.row(parent)).transpose(), wanted - now.row(parent).transpose());
  const auto turns = scene->turns();
  if (turns && above >= 0) {
    const Eigen::Matrix3d turned =
        joint_motions(*rig, *turns)[static_cast<std::size_t>(above)].linear();
    way = Eigen::Quaterniond(turned.transpose() * way * turned);
  }
  turn_joint(parent, way);
}

void Workbench::turn_back() {
  if (!scene->turns()) return;
  begin_turning();
  scene->turn_back();
}

void Workbench::begin_turning() {
  const auto rig = scene->rig();
  if (!rig) return;
  if (poses_.rig != rig) poses_ = {rig, {}, {}};
  poses_.after.clear();
  poses_.before.push_back(scene->turns());
}

bool Workbench::has_pose(const std::vector<std::shared_ptr<const JointTurns>>& poses) const {
  return !poses.empty() && poses_.rig == scene->rig();
}

void Workbench::go_to_pose(std::vector<std::shared_ptr<const JointTurns>>& from,
                           std::vector<std::shared_ptr<const JointTurns>>& to) {
  to.push_back(scene->turns());
  const auto wanted = from.back();
  from.pop_back();
  if (wanted) {
    scene->turn(*wanted);
  } else {
    scene->turn_back();
  }
}

void Workbench::set_role(const std::string& role) {
  const auto shown = scene->character();
  if (!shown || selected_joint_ < 0) return;
  Edited next = history_.now();
  next.roles.push_back({selected_joint_, shown->rig.joints.row(selected_joint_), role});
  history_.add(std::move(next));
  change_roles();
  say(shown->rig.names[static_cast<std::size_t>(selected_joint_)] +
      (role.empty() ? " has no role now" : " is now the " + role));
}

void Workbench::save_rig(const std::filesystem::path& file, RigFormat format) {
  require_pose(format, exported.pose, file.string());
  if (format == RigFormat::vrm) require_whole(vrm);
  if (!has_rig() || rigging_.valid()) {
    save_rig_to_ = file;
    if (!rigging_.valid()) rig();
    return;
  }
  const Document& document = scene->document;
  const CharacterRig& character = *scene->recording.moments().back().character;
  const Rig rig = rig_for_export(character.rig, character.plan, document.surface, exported,
                                 character.other_plans);
  const std::string name = without_gz(document.mesh_file).stem().string();
  std::optional<EditedFile> edited;
  std::string without;  // why the file's own content is not in what is saved
  try {
    constexpr bool as_bound = false;  // the viewer's surface rests as shown
    const EditOptions options{
        format, OldRig::replaced, name + " rig",          program_and_version(),
        vrm,    as_bound,         picture_folder_of(file)};
    edited = format_rig_into(document.mesh_file, rig, options);
  } catch (const Error& error) {
    without = error.what();
  }
  if (edited) {
    write_rig_file(file, edited->bytes, edited->side_files);
  } else {
    write_file(file, format_rig(document.surface, rig, format, name, program_and_version(), vrm));
  }
  history_.note_saved();
  note_saved(file);
  say("saved " + file.string() + (without.empty() ? "" : ", the surface alone: " + without));
  if (format == RigFormat::vrm) {
    const auto finding =
        posture_finding(character, {document.mesh_file, OldRig::replaced, false, exported.pose});
    if (finding) say(*finding);
  }
  go_on_after_saving();
}

}  // namespace curveskel::viewer
