#include <Eigen/Geometry>
#include <string>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include "base/utf8.hpp"
#include "rig/gltf/skin_numbers.hpp"
#include "rig/io/rig_writers.hpp"
#include "rig/joints/bone_axes.hpp"

namespace curveskel {
namespace {

/// Points of rows, as USD has them: a row times the matrix.
std::string matrix_text(const Eigen::Affine3d& frame) {
  const Eigen::Matrix4d rows = frame.matrix().transpose();
  std::string text = "(";
  for (int i = 0; i < 4; ++i) {
    text += i == 0 ? "(" : ", (";
    for (int j = 0; j < 4; ++j) text += (j == 0 ? "" : ", ") + number_text(rows(i, j) + 0.0);
    text += ")";
  }
  return text + ")";
}

template <typename Item>
std::string list(std::size_t count, const Item& item) {
  std::string text = "[";
  for (std::size_t k = 0; k < count; ++k) text += (k == 0 ? "" : ", ") + item(k);
  return text + "]";
}

std::string point_text(const Eigen::RowVector3d& p) {
  return "(" + number_text(p.x()) + ", " + number_text(p.y()) + ", " + number_text(p.z()) + ")";
}

/// "hips/spine/chest".
std::vector<std::string> paths_of(const Rig& rig) {
  const std::vector<std::string> names = names_by(rig, NameRule::identifier);
  std::vector<std::string> paths;
  for (std::size_t joint = 0; joint < names.size(); ++joint) {
    const int parent = rig.parents[static_cast<Eigen::Index>(joint)];
    paths.push_back(parent < 0 ? names[joint] : paths[idx(parent)] + "/" + names[joint]);
  }
  return paths;
}

std::string skeleton_text(const Rig& rig) {
  const std::vector<Eigen::Quaterniond> axes = bone_axes(rig);
  const std::vector<LocalFrame> frames = local_frames(rig, axes);
  const std::vector<std::string> paths = paths_of(rig);
  const auto bind = [&](std::size_t k) {
    const auto row = static_cast<Eigen::Index>(k);
    return matrix_text(Eigen::Translation3d(rig.joints.row(row).transpose()) * axes[k]);
  };
  const auto rest = [&](std::size_t k) {
    return matrix_text(Eigen::Translation3d(frames[k].offset) * frames[k].turn);
  };
  return "    def Skeleton \"Skeleton\"\n    {\n        uniform token[] joints = " +
         list(paths.size(), [&](std::size_t k) { return "\"" + paths[k] + "\""; }) +
         "\n        uniform matrix4d[] bindTransforms = " + list(paths.size(), bind) +
         "\n        uniform matrix4d[] restTransforms = " + list(paths.size(), rest) + "\n    }\n";
}

std::string mesh_text(const Surface& surface, const Rig& rig) {
  std::vector<FourWeights> rows;
  for (Eigen::Index v = 0; v < rig.weights.rows(); ++v) {
    rows.push_back(four_weights(rig.weights, v));
  }
  const auto corners = static_cast<std::size_t>(surface.triangles.size());
  const std::string four =
      " (\n            elementSize = 4\n            interpolation = "
      "\"vertex\"\n        )\n";
  return "    def Mesh \"Surface\" (\n        prepend apiSchemas = [\"SkelBindingAPI\"]\n    )\n"
         "    {\n        uniform token subdivisionScheme = \"none\"\n        int[] "
         "faceVertexCounts = " +
         list(corners / 3, [](std::size_t) { return std::string("3"); }) +
         "\n        int[] faceVertexIndices = " +
         list(corners,
              [&](std::size_t k) {
                return std::to_string(surface.triangles(static_cast<Eigen::Index>(k / 3),
                                                        static_cast<Eigen::Index>(k % 3)));
              }) +
         "\n        point3f[] points = " +
         list(idx(surface.positions.rows()),
              [&](std::size_t v) {
                return point_text(surface.positions.row(static_cast<Eigen::Index>(v)));
              }) +
         "\n        int[] primvars:skel:jointIndices = " +
         list(4 * rows.size(),
              [&](std::size_t k) { return std::to_string(rows[k / 4].joints[k % 4]); }) +
         four + "        float[] primvars:skel:jointWeights = " +
         list(4 * rows.size(),
              [&](std::size_t k) { return number_text(rows[k / 4].weights[k % 4]); }) +
         four + "        matrix4d primvars:skel:geomBindTransform = " +
         matrix_text(Eigen::Affine3d::Identity()) +
         "\n        rel skel:skeleton = </Model/Skeleton>\n    }\n";
}

/// In quotes.
std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : as_utf8(text)) {
    const bool is_plain = static_cast<unsigned char>(c) >= ' ' && c != '"' && c != '\\';
    result += is_plain ? c : '_';
  }
  return result + "\"";
}

}  // namespace

std::string format_usda_rig(const Surface& surface, const Rig& rig, const std::string& name,
                            const std::string& provenance) {
  return "#usda 1.0\n(\n    defaultPrim = \"Model\"\n    doc = " +
         quoted(name + ", by " + provenance) +
         "\n    metersPerUnit = 1\n    upAxis = \"Y\"\n)\n\ndef SkelRoot \"Model\"\n{\n" +
         skeleton_text(rig) + "\n" + mesh_text(surface, rig) + "}\n";
}

}  // namespace curveskel
