// Run, parameters, corrections.
#include <fmt/core.h>

#include <algorithm>
#include <string>
#include <utility>

#include "viewer/window/panel_parts.hpp"
#include "viewer/window/reading_order.hpp"

namespace curveskel::viewer {
namespace {

/// A slider's label, a button back to the default where it is another, and whether a person has
/// just finished changing it.
template <typename Number>
bool finish_slider(const char* label, Number& value, Number standard, const char* meaning) {
  bool finished = ImGui::IsItemDeactivatedAfterEdit();
  tip(meaning);
  if (value == standard) return finished;
  ImGui::SameLine();
  ImGui::PushID(label);
  if (ImGui::SmallButton("x")) {
    value = standard;
    finished = true;
  }
  tip("back to the default");
  ImGui::PopID();
  return finished;
}

bool slide(const char* label, int& value, int standard, int least, int most, const char* meaning,
           ImGuiSliderFlags flags = 0) {
  const std::string name = place_control(label, control_share);
  ImGui::SliderInt(name.c_str(), &value, least, most, "%d", flags | ImGuiSliderFlags_AlwaysClamp);
  return finish_slider(label, value, standard, meaning);
}

bool slide(const char* label, double& value, double standard, double least, double most,
           const char* meaning) {
  const std::string name = place_control(label, control_share);
  ImGui::SliderScalar(name.c_str(), ImGuiDataType_Double, &value, &least, &most, "%.3g",
                      ImGuiSliderFlags_AlwaysClamp);
  return finish_slider(label, value, standard, meaning);
}

void run_buttons(Workbench& bench) {
  const bool active = bench.running() && bench.run_state() == Run::State::running;
  if (active) {
    if (ImGui::Button("Pause")) bench.pause();
  } else if (ImGui::Button(bench.running() ? "Go on" : "Run")) {
    bench.resume();
  }
  tip("Space");
  beside_if_it_fits("Step");
  if (ImGui::Button("Step")) bench.step();
  tip("one moment on (Right)");
  beside_if_it_fits("Rewind");
  if (ImGui::Button("Rewind")) bench.rewind();
  tip("to the input (Home)");
  beside_if_it_fits("Cancel");
  ImGui::BeginDisabled(!bench.can_cancel());
  if (ImGui::Button("Cancel")) bench.cancel_what_goes_on();
  ImGui::EndDisabled();
  tip(bench.opening()   ? "stop the opening, keep what is open (Esc)"
      : bench.running() ? "stop the run, keep what was recorded (Esc)"
                        : "stop what goes on (Esc)");
}

/// Of what is being opened, or of the run that goes on, or how the last one ended.
void progress(const Workbench& bench, const Glance& glance) {
  float done = 0;
  std::string word;
  if (bench.opening()) {
    const StageNews::Stage stage = bench.opening_stage();
    done = static_cast<float>(stage.fraction);
    word = "opening: " + stage.name;
  } else if (bench.running()) {
    done = static_cast<float>(glance.fraction);
    word = bench.news().stage;
  } else if (bench.making_rig()) {
    const StageNews::Stage stage = bench.rig_stage();
    done = static_cast<float>(stage.fraction);
    word = stage.name.empty() ? "rig" : "rig: " + stage.name;
  } else if (bench.run_state() == Run::State::cancelled) {
    word = "cancelled";
  } else if (bench.run_state() == Run::State::failed) {
    word = "failed";
  } else if (bench.result() != nullptr) {
    done = 1;
    word = "done";
  }
  ImGui::ProgressBar(done, {-1, 0}, word.c_str());
}

void parameters(Workbench& bench) {
  const ExtractOptions standard;
  ExtractOptions& options = bench.pipeline.extract;
  bool changed = false;
  changed |=
      slide("fairing", options.fair.iterations, 0, 0, 50,
            "Iterations of smoothing before anything else. For noisy scans: about ten times the "
            "noise in % of the diagonal; 0 = none.");
  changed |=
      slide("vertices", options.resolution, standard.resolution, options.least_resolution, 60000,
            "How many vertices the surface is coarsened to before it is contracted. More = "
            "finer and slower.",
            ImGuiSliderFlags_Logarithmic);
  const double detail = options.embed.detail;
  const bool finished = slide("detail", options.embed.detail, standard.embed.detail, 0, 1,
                              "How small a branch may be and stay: 0 = only the main limbs, 1 = "
                              "every bump that makes one. Each branch has a life, how clearly the "
                              "surface has its limb; less detail hides those of short lives. "
                              "Below the default branches are hidden and shown at once, above it "
                              "some are added; nothing moves.");
  if (options.embed.detail != detail) bench.show_level();
  changed |= finished && bench.wants_finer_run();
  if (ImGui::TreeNode("More")) {
    ContractionOptions& flow = options.contraction;
    const ContractionOptions& usual = standard.contraction;
    changed |= slide("first weight", flow.contraction_weight, usual.contraction_weight, 0.1, 20,
                     "How strongly the first iteration contracts.");
    changed |= slide("growth", flow.contraction_growth, usual.contraction_growth, 1.05, 5,
                     "Factor on that weight from one iteration to the next. Small = slow and "
                     "careful.");
    changed |= slide("medial pull", flow.medial_weight, usual.medial_weight, 0, 10,
                     "How strongly vertices are drawn to the middle of the body.");
    changed |= slide("iterations", flow.max_iterations, usual.max_iterations, 1, 200,
                     "Of the contraction, at most.");
    changed |= slide("merge", options.embed.merge, standard.embed.merge, 0, 3,
                     "Junctions nearer to each other than so many inscribed radii become one.");
    changed |= slide("straight", options.embed.straight, standard.embed.straight, 0, 2,
                     "Within so many inscribed radii of a junction, branches run straight.");
    changed |=
        slide("least sheet", bench.pipeline.repair.least_sheet, RepairOptions().least_sheet, 0, 1,
              "Open or flat parts of at least this extent, in diagonals of the box round "
              "the model, become thin bodies, with a skeleton and joints. 0 = no skeleton "
              "has them, and a rig has those of 0.1 and more, such as wings and ears.");
    changed |= slide("least handle", bench.pipeline.repair.least_handle,
                     RepairOptions().least_handle, 0, 1,
                     "Small handles are cut, as noise leaves them in scans and volumes: short ones "
                     "with a loop round them or through them up to this long, in diagonals of the "
                     "box round the model. 0 = none, unless the certificate fails; 0.03 is a good "
                     "first try.");
    ImGui::TreePop();
  }
  if (ImGui::Button("Defaults")) {
    const auto cache = options.contraction.program_cache;
    options = standard;
    options.fair.iterations = 0;
    bench.pipeline.repair.least_sheet = RepairOptions().least_sheet;
    bench.pipeline.repair.least_handle = RepairOptions().least_handle;
    options.contraction.program_cache = options.fair.program_cache = cache;
    changed = true;
  }
  tip("all parameters as they are without choosing any");
  if (changed && bench.scene->document.has_surface()) bench.start(false);
}

/// The rig that is shown stays as it is.
void exported(ExportOptions& options) {
  ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
  ImGui::TextWrapped("in the file that is saved:");
  ImGui::PopStyleColor();
  choose("pose", options.pose, rest_poses,
         "The pose at rest of a rig that is saved; vertices stay as they are. The picture keeps "
         "the pose of the file.");
  tick("end bones", options.ends);
  tip("joints at tips without a role, which move nothing, are in the file that is saved, too");
  tick("root on the ground", options.ground_root);
  tip("the file that is saved has one more joint, on the ground, that all hangs from");
}

void rig(Workbench& bench) {
  const CharacterOptions usual;
  CharacterOptions& options = bench.pipeline.character;
  const PlanOptions plan = options.plan;
  const NameStyle names = options.names;
  choose("plan", options.plan.plan, body_kinds,
         "What kind of body it is: it says which joints there are, and what they are. auto = found "
         "from the curve.");
  choose("names", options.names, name_styles, "Whose words the joints' names are in.");
  choose("up", options.plan.up, directions, "The axis of the file that leads up. auto = found.");
  choose("front", options.plan.front, directions,
         "The axis of the file that the body looks along; left and right follow from it. auto = "
         "found.");
  bool changed = plan.plan != options.plan.plan || plan.up != options.plan.up ||
                 plan.front != options.plan.front || names != options.names;
  changed |= slide("followers", options.parts.follow, usual.parts.follow, 0, 5,
                   "Parts that reach out of the body no farther than this, in its thickness, have "
                   "no joints. 0 = all have.");
  changed |=
      slide("bone length", options.rig.joints.bone_length, usual.rig.joints.bone_length, 1, 30,
            "Of straight limbs, in their radius, where no body's plan was found: small = "
            "many joints. A plan says itself how many joints its limbs have.");
  changed |= slide("softness", options.rig.skin.softness, usual.rig.skin.softness, 0.2, 5,
                   "How gently the skin goes over from one joint to the next.");
  changed |= slide("joint budget", options.joint_budget, usual.joint_budget, 0, 500,
                   "The most joints of a figure: those that move the least of the surface are "
                   "left out, and what a body needs stays. 0 = any number.");
  ImGui::BeginDisabled(bench.running() || bench.history().empty());
  if (ImGui::Button("Make rig")) bench.rig();
  ImGui::EndDisabled();
  tip(bench.history().empty()
          ? "a rig is made of a skeleton: press Run first"
          : "joints and skin weights for the skeleton as it is (G); Save writes them as .glb");
  if (changed && (bench.has_rig() || bench.making_rig())) bench.rig();
  exported(bench.exported);
}

void corrections(Workbench& bench) {
  bool first = true;
  const auto button = [&](const char* label, const char* meaning, auto action) {
    if (!std::exchange(first, false)) beside_if_it_fits(label);
    if (ImGui::Button(label)) action();
    tip(meaning);
  };
  button("Prune", "take out the leaf branch of the selected edge or tip (Delete)",
         [&] { bench.prune(); });
  button("Remove", "take out the selected node (Backspace)", [&] { bench.remove(); });
  button("Merge", "make one node of the two selected (M)", [&] { bench.merge(); });
  button("Cut", "take out the selected edge (C)", [&] { bench.cut(); });
  button("Join", "an edge between the two selected nodes (J)", [&] { bench.join(); });
  button("Split", "a node in the middle of the selected edge (N)", [&] { bench.split(); });
  button("Root", "the selected node is where the hierarchy begins (T)", [&] { bench.set_root(); });
  first = true;
  ImGui::BeginDisabled(!bench.can_undo());
  button("Undo", "Ctrl-Z", [&] { bench.undo(); });
  ImGui::EndDisabled();
  ImGui::BeginDisabled(!bench.can_redo());
  button("Redo", "Ctrl-Y", [&] { bench.redo(); });
  ImGui::EndDisabled();
  if (bench.root() >= 0) {
    beside_if_it_fits("root: node 10000");
    ImGui::Text("root: node %d", bench.root());
  }
}

/// The newest first.
void kept_messages(const Workbench& bench) {
  if (bench.messages().empty()) ImGui::TextDisabled("none yet");
  for (auto message = bench.messages().rbegin(); message != bench.messages().rend(); ++message) {
    const ImVec4 colour = message->bad ? verdict_colour(false, bench.scene->look.theme)
                                       : ImGui::GetStyleColorVec4(ImGuiCol_Text);
    ImGui::PushStyleColor(ImGuiCol_Text, colour);
    ImGui::TextWrapped("%s", in_reading_order(message->text).c_str());
    ImGui::PopStyleColor();
  }
}

}  // namespace

void draw_left_panel(Workbench& bench, Panels& panels, const Area& area) {
  if (!begin_panel("run", area)) return;
  if (ImGui::Button("Open")) ask_to_open(panels);
  tip("Ctrl-O, or drop a file on the window");
  beside_if_it_fits("Save");
  if (ImGui::Button("Save")) ask_to_save(bench, panels);
  tip("Ctrl-S; the format follows from the extension");
  beside_if_it_fits("Picture");
  if (ImGui::Button("Picture")) panels.wants_picture = true;
  tip("F12: a PNG beside the file that is open");
  beside_if_it_fits("Help");
  if (ImGui::Button("Help")) panels.help = !panels.help;
  tip("H");
  ImGui::Separator();
  run_buttons(bench);
  progress(bench, panels.glance);
  if (ImGui::CollapsingHeader("Parameters", ImGuiTreeNodeFlags_DefaultOpen)) parameters(bench);
  if (ImGui::CollapsingHeader("Corrections", ImGuiTreeNodeFlags_DefaultOpen)) corrections(bench);
  if (ImGui::CollapsingHeader("Rig", ImGuiTreeNodeFlags_DefaultOpen)) rig(bench);
  if (ImGui::CollapsingHeader("Messages")) kept_messages(bench);
  if (!bench.measured().nodes.empty()) {
    ImGui::Text("path: %.6g units, %d edges", bench.measured().length,
                static_cast<int>(bench.measured().nodes.size()) - 1);
  } else if (bench.selected_nodes().size() == 2) {
    ImGui::TextUnformatted("no path between the two nodes");
  }
  ImGui::End();
}

}  // namespace curveskel::viewer
