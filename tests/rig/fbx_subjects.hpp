// FBX files of a box with materials, and what becomes of them.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <curveskel/read.hpp>
#include <curveskel/rig_files.hpp>
#include "tests/own_folder.hpp"
#include "tests/rig/random_rigs.hpp"
#include "tests/surface/scene_encodings.hpp"

namespace curveskel::fbx_subjects {

using encodings::FbxForm;
using encodings::FbxItem;
using encodings::FbxItems;

inline const std::string png("\x89PNG\r\n\x1a\n no true picture", 24);
constexpr std::array all_forms{FbxForm::text, FbxForm::binary, FbxForm::binary_wide_and_zipped};
constexpr std::int64_t first_material = 10;

inline FbxItem properties(const std::vector<encodings::FbxProperty>& given) {
  FbxItem list{"Properties70", {}};
  for (const encodings::FbxProperty& property : given) {
    FbxItem one{"P", {property.name, "Color", "", "A"}};
    one.values.insert(one.values.end(), property.values.begin(), property.values.end());
    list.children.push_back(std::move(one));
  }
  return list;
}

inline FbxItem material(int number, const std::vector<encodings::FbxProperty>& given) {
  return {"Material",
          {first_material + number, "Material::m " + std::to_string(number), ""},
          {properties(given)}};
}

/// The box with these objects beside it; those of kind "Material" are on it.
inline FbxItems scene(FbxItem box, FbxItem model, const FbxItems& beside,
                      const std::vector<FbxItem>& links = {}) {
  FbxItems objects{std::move(box), std::move(model)};
  objects.insert(objects.end(), beside.begin(), beside.end());
  FbxItems all = encodings::fbx_scene(objects, {{2, 0}, {1, 2}});
  for (const FbxItem& object : beside) {
    if (object.name != "Material") continue;
    all[1].children.push_back({"C", {"OO", object.values[0], std::int64_t{2}}});
  }
  all[1].children.insert(all[1].children.end(), links.begin(), links.end());
  return all;
}

class FbxDressing : public testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path written(const FbxItems& records,
                                              FbxForm form = FbxForm::binary,
                                              const std::string& creator = "nobody") const {
    return folder_.write("a thing.fbx", encodings::fbx(records, form, 7500, creator));
  }

  [[nodiscard]] EditedFile dressed(const std::filesystem::path& file,
                                   RigFormat format = RigFormat::glb, bool as_bound = true) const {
    const Eigen::Index rows = read_polygons(file).positions.rows();
    const auto edited =
        format_rig_into(file, random_rig(rows, 5, "bone "),
                        {format, OldRig::replaced, "rig", "curveskel, a test", {}, as_bound});
    EXPECT_TRUE(edited);
    return edited.value_or(EditedFile{});
  }

  OwnFolder folder_;
};

}  // namespace curveskel::fbx_subjects
