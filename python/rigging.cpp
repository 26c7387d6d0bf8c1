#include "python/rigging.hpp"

#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <curveskel/advanced/write_file.hpp>
#include <curveskel/clean.hpp>
#include <curveskel/rest_pose.hpp>
#include <curveskel/rig_files.hpp>
#include <curveskel/rig_polygons.hpp>
#include "app/kernel_cache.hpp"
#include "app/report.hpp"
#include "app/rig_findings.hpp"
#include "app/rig_report.hpp"
#include "app/rig_sources.hpp"
#include "python/background_work.hpp"
#include "python/options.hpp"
#include "python/views.hpp"

namespace curveskel {
namespace {

namespace py = pybind11;

struct PythonRig {
  PolygonSoup soup;
  Surface given;  ///< the same in triangles
  CharacterRig character;
  Rig exported;          ///< as it is written
  bool as_bound = true;  ///< the soup was read so
  OldRig old_rig = OldRig::replaced;
  bool joints_are_given = false;  ///< or those of the file are kept
  RestPose pose = RestPose::input;
  std::string shortcomings;           ///< of the skeleton's certificate
  std::vector<std::string> findings;  ///< all else that the program warns of
};

struct Wanted {
  bool as_bound = true;
  bool keep_rig = false;
  std::optional<CurveSkeleton> skeleton;
  std::optional<std::filesystem::path> joints;
};

struct RigSettings {
  RigPolygonsOptions make;
  ExportOptions form;
};

RigSettings rig_settings_of(const py::dict& options) {
  RigSettings settings;
  RigPolygonsOptions& make = settings.make;
  make.extract.fair.iterations = 0;
  make.extract.contraction.program_cache = kernel_cache();
  make.extract.fair.program_cache = kernel_cache();
  CharacterOptions& character = make.character;
  OptionSetters setters = repair_setters(make.repair);
  setters["bone_length"] = sets(character.rig.joints.bone_length);
  setters["detail"] = sets(make.extract.embed.detail);
  setters["ends"] = sets(settings.form.ends);
  setters["fair"] = sets(make.extract.fair.iterations);
  setters["follow"] = sets(character.parts.follow);
  setters["front"] = sets(character.plan.front, "front", directions);
  setters["ground_root"] = sets(settings.form.ground_root);
  setters["joint_budget"] = sets(character.joint_budget);
  setters["names"] = sets(character.names, "names", name_styles);
  setters["plan"] = sets(character.plan.plan, "plan", body_kinds);
  setters["pose"] = sets(settings.form.pose, "pose", rest_poses);
  setters["root"] = sets(character.rig.joints.root);
  setters["softness"] = sets(character.rig.skin.softness);
  setters["threads"] = sets(make.threads);
  setters["up"] = sets(character.plan.up, "up", directions);
  set_options(options, setters);
  make.extract.fairing = make.extract.fair.iterations > 0;
  require_program_range("bone_length", character.rig.joints.bone_length, 0.5, 1000);
  require_program_range("joint_budget", character.joint_budget, 0, 1e6);
  require_program_range("softness", character.rig.skin.softness, 0.05, 20);
  require_valid_keywords(make.extract);
  require_valid(character.rig);
  require_valid(character.parts);
  require_together(make.repair);
  require_root_alone(character.rig.joints.root, character.plan);
  return settings;
}

/// As on the command line: what would have no effect is refused.
void require_effect(const Wanted& wanted, const py::dict& options) {
  const auto refuse = [&](const char* program_name, const char* beside) {
    std::string name = program_name;
    std::replace(name.begin(), name.end(), '-', '_');
    if (!options.contains(name.c_str())) return;
    throw Error(Fault::usage,
                name + " has no effect beside " + beside + "; leave out one of the two");
  };
  if (wanted.skeleton) {
    for (const char* name : idle_beside_skeleton) refuse(name, "skeleton");
  }
  const char* const given = wanted.keep_rig ? "keep_rig" : "joints";
  if (wanted.keep_rig || wanted.joints) {
    for (const char* name : idle_beside_joints) refuse(name, given);
  }
  if (!wanted.keep_rig) return;
  for (const char* name : idle_beside_kept_rig) refuse(name, given);
  refuse("ends", given);
}

/// `result.soup` is there.
RigSources sources_of(const Wanted& wanted, PythonRig& result, const Monitor& monitor) {
  RigSources sources;
  sources.skeleton = wanted.skeleton;
  if (sources.skeleton) require_skeleton_of(result.soup, *sources.skeleton, "skeleton");
  if (wanted.keep_rig) {
    const std::filesystem::path& file = result.soup.file;
    if (file.empty()) throw Error(Fault::usage, "keep_rig needs a file, not arrays");
    sources.joints = rig_in(file, result.soup.format, monitor);
    result.old_rig = OldRig::kept;
  }
  if (!wanted.joints) return sources;
  GivenJoints given = joints_for(*wanted.joints, result.soup, monitor);
  if (!given.finding.empty()) result.findings.push_back(given.finding);
  sources.joints = std::move(given.rig);
  return sources;
}

PythonRig rig_in_background(PolygonSoup soup, bool as_bound, bool keep_rig,
                            const std::optional<CurveSkeleton>& skeleton,
                            const std::optional<std::filesystem::path>& joints,
                            const py::dict& options, const py::object& listener) {
  const Wanted wanted{as_bound, keep_rig, skeleton, joints};
  require_effect(wanted, options);
  RigSettings settings = rig_settings_of(options);
  PythonRig result;
  result.as_bound = as_bound;
  result.pose = settings.form.pose;
  run_beside_interpreter(listener, [&](const Monitor& monitor) {
    result.soup = std::move(soup);
    const RigSources sources = sources_of(wanted, result, monitor);
    settings.form.as_given = result.joints_are_given = sources.joints.has_value();
    result.given = {result.soup.positions, triangulate(result.soup)};
    if (as_bound && result.soup.posed) {
      const auto finding = bind_pose_finding(result.soup.file, result.soup, monitor);
      if (finding) result.findings.push_back(*finding);
    }
    PolygonsRig found = rig_polygons(result.soup, sources, settings.make, monitor);
    result.shortcomings = skeleton_findings(found, settings.make);
    if (!sources.joints) {
      for (std::string& finding : rig_findings(found.character, settings.make.character)) {
        result.findings.push_back(std::move(finding));
      }
    }
    result.character = std::move(found.character);
    result.exported = rig_for_export(result.character.rig, result.character.plan, result.given,
                                     settings.form, result.character.other_plans);
  });
  return result;
}

/// The file itself with the rig in it, where it is one that keeps more than the surface. Returns
/// what the program warns of.
std::vector<std::string> save_rig(const PythonRig& rig, const std::filesystem::path& output,
                                  const std::string& format, VrmMeta vrm) {
  const py::gil_scoped_release others_may_run;
  const auto chosen = choice_of(rig_formats, format);
  if (!chosen) {
    throw Error(Fault::usage,
                output.string() + ": the extension is none of: " + names_in(rig_formats));
  }
  const std::filesystem::path& file = rig.soup.file;
  if (*chosen == RigFormat::vrm) {
    vrm = vrm_meta_for(file, rig.old_rig, vrm);
    if (rig.joints_are_given) require_human_roles(file, rig.exported, rig.old_rig);
  }
  require_pose(*chosen, rig.pose, output.string());
  std::filesystem::path name = file.empty() ? "surface" : file.stem();
  if (file.extension() == ".gz") name = name.stem();
  std::vector<std::string> findings;
  std::optional<EditedFile> edited;
  if (!file.empty()) {
    edited = format_rig_into(file, rig.exported,
                             {*chosen, rig.old_rig, name.string() + " rig", program_and_version(),
                              vrm, rig.as_bound, picture_folder_of(output)});
    if (const auto finding = look_finding(file)) findings.push_back(*finding);
  }
  if (*chosen == RigFormat::vrm) {
    const auto finding =
        posture_finding(rig.character, {file, rig.old_rig, rig.joints_are_given, rig.pose});
    if (finding) findings.push_back(*finding);
  }
  if (edited) {
    for (const std::string& note : edited->notes) {
      findings.push_back(file.filename().string() + ": " + note);
    }
  }
  if (edited) {
    write_rig_file(output, edited->bytes, edited->side_files);
  } else {
    write_file(output, format_rig(rig.given, rig.exported, *chosen, name.string(),
                                  program_and_version(), vrm));
  }
  return findings;
}

std::string report(const PythonRig& rig) {
  return rig_report_json(
      {rig.given, rig.character, rig.exported, rig.soup.file.filename().string(), 0});
}

/// data, indices, indptr: what scipy.sparse.csr_matrix is made of.
py::tuple rows_of(const PythonRig& rig) {
  SkinWeights weights = rig.exported.weights;
  weights.makeCompressed();
  const auto count = static_cast<std::size_t>(weights.nonZeros());
  const auto rows = static_cast<std::size_t>(weights.rows()) + 1;
  return py::make_tuple(py::array_t<float>(count, weights.valuePtr()),
                        py::array_t<std::int32_t>(count, weights.innerIndexPtr()),
                        py::array_t<std::int32_t>(rows, weights.outerIndexPtr()));
}

}  // namespace

void bind_rig(py::module_& module) {
  py::class_<PythonRig>(module, "Rig")
      .def_property_readonly("joints", view_of([](const PythonRig& one) -> const auto& {
                               return one.exported.joints;
                             }))
      .def_property_readonly("parents", view_of([](const PythonRig& one) -> const auto& {
                               return one.exported.parents;
                             }))
      .def_property_readonly("names", [](const PythonRig& one) { return one.exported.names; })
      .def_property_readonly("roles", [](const PythonRig& one) { return one.exported.roles; })
      .def("weights", &rows_of)
      .def("report", &report)
      .def_readonly("shortcomings", &PythonRig::shortcomings)
      .def_readonly("findings", &PythonRig::findings)
      .def("save",
           [](const PythonRig& one, const std::filesystem::path& output, const std::string& format,
              const std::string& name, const std::string& author, const std::string& licence) {
             return save_rig(one, output, format, {name, author, licence});
           });
  module.def("rig", &rig_in_background);
}

}  // namespace curveskel
