// Laws of glTF files with a part of their JSON gone or wrong: a rig goes into the file, or the file
// is refused by name; nothing else happens.
#include <gtest/gtest.h>

#include <cstddef>
#include <exception>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include <curveskel/error.hpp>
#include <curveskel/read.hpp>
#include <curveskel/rig_files.hpp>
#include "tests/own_folder.hpp"
#include "tests/rig/edit_subjects.hpp"
#include "tests/rig/random_rigs.hpp"

namespace curveskel::broken_gltf_laws {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// All places in a document, the whole left out.
void places_in(const Json& value, const Json::json_pointer& at,
               std::vector<Json::json_pointer>& found) {
  if (!value.is_structured()) return;
  for (const auto& [key, member] : value.items()) {
    const Json::json_pointer place = value.is_array() ? at / std::stoul(key) : at / key;
    found.push_back(place);
    places_in(member, place, found);
  }
}

/// One place is missing, of another type, or another number.
Json broken(Json json, std::mt19937& lot) {
  std::vector<Json::json_pointer> places;
  places_in(json, Json::json_pointer(""), places);
  const Json::json_pointer place = places[lot() % places.size()];
  Json& owner = json[place.parent_pointer()];
  const std::vector<Json> others{
      nullptr,          -1,  0, 1, 4000000000U, 1e300, "", "word", Json::array(), Json::object(),
      Json::array({0}), true};
  const std::size_t way = lot() % (others.size() + 2);
  if (way < others.size()) {
    json[place] = others[way];
  } else if (owner.is_array()) {
    owner.push_back(json[place]);
  } else {
    owner.erase(place.back());
  }
  return json;
}

/// The refusal's words, none if there is a rig.
std::string refusal_of(const fs::path& file) {
  try {
    const auto rows = read_polygons(file, {}, {true}).positions.rows();
    require_editable(file, OldRig::replaced);
    (void)format_rig_into(file, random_rig(rows, 3, "bone "));
    EditOptions text;
    text.format = RigFormat::gltf;
    (void)format_rig_into(file, random_rig(rows, 3, "bone "), text);
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::input) << error.what();
    return error.what();
  } catch (const std::exception& failure) {
    ADD_FAILURE() << failure.what();
  }
  return "";
}

TEST(BrokenGltf, IsRefusedOrRigged) {
  constexpr int tries = 60;  // a case
  const OwnFolder folder;
  std::mt19937 lot(7);
  int refused = 0;
  int rigged = 0;
  for (EditCase one : edit_cases()) {
    one.text = true;
    const EditSubject subject(folder.path(), one);
    for (int k = 0; k < tries; ++k) {
      const std::string json = broken(subject.json(), lot).dump();
      SCOPED_TRACE(one.name + ": " + json);
      (refusal_of(folder.write("broken.gltf", json)).empty() ? rigged : refused) += 1;
    }
  }
  EXPECT_GT(refused, 100);
  EXPECT_GT(rigged, 100);
}

TEST(BrokenGltf, WithoutAnythingIsRefusedAsEmpty) {
  const OwnFolder folder;
  const Json bare{{"asset", {{"version", "2.0"}}}};
  Json with_scene = bare;
  with_scene["scene"] = 0;
  with_scene["scenes"] = {Json::object()};
  for (const Json& json : {bare, with_scene}) {
    const fs::path file = folder.write("empty.gltf", json.dump());
    EXPECT_NO_THROW(require_editable(file, OldRig::replaced));
    EXPECT_THROW((void)read_polygons(file, {}, {true}), Error);
  }
}

}  // namespace
}  // namespace curveskel::broken_gltf_laws
