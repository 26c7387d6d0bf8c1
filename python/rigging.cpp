#include "python/rigging.hpp"

#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <curveskel/advanced/write_file.hpp>
#include <curveskel/clean.hpp>
#include <curveskel/read_rig.hpp>
#include <curveskel/rest_pose.hpp>
#include <curveskel/rig_files.hpp>
#include <curveskel/rig_polygons.hpp>
#include "app/kernel_cache.hpp"
#include "app/report.hpp"
#include "app/rig_report.hpp"
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
};

struct RigSettings {
  RigPolygonsOptions make;
  ExportOptions form;
};

RigSettings settings_of(const py::dict& options) {
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
  require_valid(make.extract);
  require_valid(character.rig);
  require_valid(character.parts);
  require_together(make.repair);
  return settings;
}

PythonRig rig_in_background(PolygonSoup soup, bool as_bound,
                            const std::optional<CurveSkeleton>& skeleton,
                            const std::optional<std::filesystem::path>& joints,
                            const py::dict& options, const py::object& listener) {
  RigSettings settings = settings_of(options);
  PythonRig result;
  result.as_bound = as_bound;
  run_beside_interpreter(listener, [&](const Monitor& monitor) {
    RigSources sources;
    sources.skeleton = skeleton;
    if (joints) sources.joints = read_joints(*joints, monitor);
    settings.form.as_given = joints.has_value();
    result.soup = std::move(soup);
    result.given = {result.soup.positions, triangulate(result.soup)};
    result.character = rig_polygons(result.soup, sources, settings.make, monitor).character;
    result.exported = rig_for_export(result.character.rig, result.character.plan, result.given,
                                     settings.form, result.character.other_plans);
  });
  return result;
}

/// The file itself with the rig in it, where it is one that keeps more than the surface.
void save_rig(const PythonRig& rig, const std::filesystem::path& output, const std::string& format,
              const std::string& vrm_name, const std::string& vrm_author,
              const std::string& vrm_licence) {
  const py::gil_scoped_release others_may_run;
  const auto chosen = choice_of(rig_formats, format);
  if (!chosen) {
    throw Error(Fault::usage,
                output.string() + ": the extension is none of: " + names_in(rig_formats));
  }
  const VrmMeta vrm{vrm_name, vrm_author, vrm_licence};
  if (*chosen == RigFormat::vrm) require_whole(vrm);
  const std::filesystem::path& file = rig.soup.file;
  std::filesystem::path name = file.empty() ? "surface" : file.stem();
  if (file.extension() == ".gz") name = name.stem();
  std::optional<EditedFile> edited;
  if (!file.empty()) {
    edited = format_rig_into(file, rig.exported,
                             {*chosen, OldRig::replaced, name.string() + " rig",
                              program_and_version(), vrm, rig.as_bound});
  }
  write_file(output, edited ? edited->bytes
                            : format_rig(rig.given, rig.exported, *chosen, name.string(),
                                         program_and_version(), vrm));
}

std::string report(const PythonRig& rig) {
  return rig_report_json({rig.given, rig.character, rig.soup.file.filename().string(), 0});
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
      .def("save", &save_rig);
  module.def("rig", &rig_in_background);
}

}  // namespace curveskel
