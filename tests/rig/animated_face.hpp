// A box with sliders and a joint that animations of an FBX file move, in layers.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "tests/rig/animated_limbs.hpp"
#include "tests/surface/scene_encodings.hpp"

namespace curveskel::animated_face {

using encodings::FbxForm;
using encodings::FbxItem;
using encodings::FbxItems;

/// The numbers of an object that curves move; those without a curve have none.
struct Moved {
  std::int64_t object;
  std::string property;
  std::vector<std::pair<std::string, FbxItem>> curves;  ///< by axis
};

struct Layer {
  std::vector<Moved> moved;
  std::vector<encodings::FbxProperty> properties = {};
};

struct Slider {
  std::string name;
  double percent = 0;
  std::vector<double> full_weights = {100};  ///< of as many shapes
};

inline constexpr std::int64_t face_joint = 100;

/// Slider k is object 500 + k; stop j of it moves vertex k by j + 1 along x.
struct Face {
  std::vector<Slider> sliders;
  std::vector<std::vector<Layer>> stacks;
  std::vector<encodings::FbxProperty> joint = {};  ///< its properties

  [[nodiscard]] FbxItems scene() const {
    FbxItem limb = encodings::fbx_model(face_joint, joint, "LimbNode");
    limb.values[1] = "Model::jaw";
    FbxItems made =
        encodings::fbx_scene({encodings::fbx_box(),
                              encodings::fbx_model(2),
                              limb,
                              {"Deformer", {std::int64_t{40}, "Deformer::m", "BlendShape"}}},
                             {{1, 2}, {2, 0}, {face_joint, 0}, {40, 1}});
    for (std::size_t k = 0; k < sliders.size(); ++k) add_slider(made, static_cast<int>(k));
    std::int64_t number = 1000;
    for (const std::vector<Layer>& stack : stacks) add_stack(made, stack, number);
    return made;
  }

  [[nodiscard]] std::string text(FbxForm form = FbxForm::binary) const {
    return encodings::fbx(scene(), form);
  }

 private:
  static void link(FbxItems& made, std::int64_t child, std::int64_t parent) {
    made[1].children.push_back({"C", {"OO", child, parent}});
  }

  void add_slider(FbxItems& made, int number) const {
    const Slider& slider = sliders[static_cast<std::size_t>(number)];
    made[0].children.push_back(
        {"Deformer",
         {std::int64_t{500} + number, "SubDeformer::" + slider.name, "BlendShapeChannel"},
         {{"DeformPercent", {slider.percent}}, {"FullWeights", {slider.full_weights}}}});
    link(made, 500 + number, 40);
    for (std::size_t stop = 0; stop < slider.full_weights.size(); ++stop) {
      const std::int64_t shape = 600 + 10 * number + static_cast<std::int64_t>(stop);
      const std::vector<double> move{1.0 + static_cast<double>(stop), 0, 0};
      made[0].children.push_back(
          {"Geometry",
           {shape, "Geometry::" + slider.name + " stop " + std::to_string(stop), "Shape"},
           {{"Indexes", {std::vector<int>{number}}}, {"Vertices", {move}}}});
      link(made, shape, 500 + number);
    }
  }

  static void add_stack(FbxItems& made, const std::vector<Layer>& layers, std::int64_t& number) {
    const std::int64_t stack = number++;
    const std::string name = "AnimStack::take " + std::to_string(stack);
    made[0].children.push_back({"AnimationStack", {stack, name, ""}});
    for (const Layer& layer : layers) {
      FbxItem item = encodings::fbx_model(number++, layer.properties);
      item.name = "AnimationLayer";
      const auto layer_number = std::get<std::int64_t>(item.values[0]);
      made[0].children.push_back(item);
      link(made, layer_number, stack);
      for (const Moved& moved : layer.moved) add_moved(made, moved, layer_number, number);
    }
  }

  static void add_moved(FbxItems& made, const Moved& moved, std::int64_t layer,
                        std::int64_t& number) {
    const std::int64_t node = number++;
    made[0].children.push_back({"AnimationCurveNode", {node, "AnimCurveNode::n", ""}});
    link(made, node, layer);
    made[1].children.push_back({"C", {"OP", node, moved.object, moved.property}});
    for (const auto& [axis, curve] : moved.curves) {
      FbxItem own = curve;
      own.values[0] = number;
      made[0].children.push_back(own);
      made[1].children.push_back({"C", {"OP", number++, node, axis}});
    }
  }
};

inline Moved slid(int slider, const std::vector<double>& seconds,
                  const std::vector<double>& percents, int flags = 4) {
  return {500 + slider,
          "DeformPercent",
          {{"d|DeformPercent", animated_limbs::curve_item(0, seconds, percents, flags)}}};
}

inline Moved jaw(const std::string& property, const std::vector<double>& seconds,
                 const std::vector<std::vector<double>>& by_axis) {
  Moved moved{face_joint, property, {}};
  for (std::size_t axis = 0; axis < by_axis.size(); ++axis) {
    moved.curves.emplace_back(std::string("d|") + "XYZ"[axis],
                              animated_limbs::curve_item(0, seconds, by_axis[axis]));
  }
  return moved;
}

}  // namespace curveskel::animated_face
