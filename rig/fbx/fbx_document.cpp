#include "rig/fbx/fbx_document.hpp"

#include <utility>

namespace curveskel {
namespace {

// As the format's own programs have it in a file without a date; its marks at the end go with it.
constexpr std::string_view file_number(
    "\x28\xb3\x2a\xeb\xb6\x24\xcc\xc2\xbf\xc8\xb0\x2a\xa9\x2b\xfc\xf1", 16);
constexpr const char* no_date = "1970-01-01 10:00:00:000";

void write_header(FbxRecords& records, const std::string& provenance) {
  records.begin("FBXHeaderExtension");
  records.record("FBXHeaderVersion", 1003);
  records.record("FBXVersion", 7400);
  records.record("EncryptionType", 0);
  records.record("Creator", provenance);
  records.end();
  records.begin("FileId");
  records.add_bytes(file_number);
  records.end();
  records.record("CreationTime", no_date);
  records.record("Creator", provenance);
}

/// y up, +z ahead, metres: as glTF.
void write_settings(FbxRecords& records, bool moves) {
  records.begin("GlobalSettings");
  records.record("Version", 1000);
  records.begin("Properties70");
  const auto number = [&](const char* name, std::int32_t value) {
    records.property(name, "int", "Integer", "", value);
  };
  number("UpAxis", 1);
  number("UpAxisSign", 1);
  number("FrontAxis", 2);
  number("FrontAxisSign", 1);
  number("CoordAxis", 0);
  number("CoordAxisSign", 1);
  number("OriginalUpAxis", 1);
  number("OriginalUpAxisSign", 1);
  constexpr double centimetres_a_metre = 100;
  records.property("UnitScaleFactor", "double", "Number", "", centimetres_a_metre);
  records.property("OriginalUnitScaleFactor", "double", "Number", "", centimetres_a_metre);
  constexpr std::int32_t thirty_frames_a_second = 6;
  if (moves) records.property("TimeMode", "enum", "", "", thirty_frames_a_second);
  records.end();
  records.end();
}

void write_scene(FbxRecords& records) {
  records.begin("Documents");
  records.record("Count", 1);
  records.begin("Document");
  records.add(std::int64_t{1});
  records.add("Scene");
  records.add("Scene");
  records.record("RootNode", FbxDocument::root);
  records.end();
  records.end();
  records.record("References");
}

}  // namespace

std::int64_t FbxDocument::add(std::string_view type, const std::string& name, std::string_view kind,
                              std::string_view subclass, std::function<void(FbxRecords&)> write) {
  constexpr std::int64_t first = 1000;
  constexpr std::string_view between("\0\x01", 2);
  const std::int64_t number = first + static_cast<std::int64_t>(objects_.size());
  objects_.push_back({std::string(type), number, name + std::string(between) + std::string(kind),
                      std::string(subclass), std::move(write)});
  ++count_[std::string(type)];
  return number;
}

void FbxDocument::connect(std::int64_t child, std::int64_t parent) {
  connections_.push_back({child, parent, ""});
}

void FbxDocument::connect(std::int64_t child, std::int64_t parent, std::string_view property) {
  connections_.push_back({child, parent, std::string(property)});
}

void FbxDocument::write_definitions(FbxRecords& records) const {
  records.begin("Definitions");
  records.record("Version", 100);
  records.record("Count", static_cast<std::int32_t>(objects_.size()) + 1);
  const auto define = [&](const std::string& type, std::int32_t count) {
    records.begin("ObjectType");
    records.add(type);
    records.record("Count", count);
    records.end();
  };
  define("GlobalSettings", 1);
  for (const auto& [type, count] : count_) define(type, count);
  records.end();
}

void FbxDocument::write_objects(FbxRecords& records) const {
  records.begin("Objects");
  for (const Object& object : objects_) {
    records.begin(object.type);
    records.add(object.number);
    records.add(object.name);
    records.add(object.subclass);
    object.write(records);
    records.end();
  }
  records.end();
}

void FbxDocument::write_connections(FbxRecords& records) const {
  records.begin("Connections");
  for (const Connection& one : connections_) {
    if (one.property.empty()) {
      records.record("C", "OO", one.child, one.parent);
    } else {
      records.record("C", "OP", one.child, one.parent, one.property);
    }
  }
  records.end();
}

std::string FbxDocument::bytes(const std::string& provenance) const {
  FbxRecords records;
  write_header(records, provenance);
  write_settings(records, count_.contains("AnimationStack"));
  write_scene(records);
  write_definitions(records);
  write_objects(records);
  write_connections(records);
  return std::move(records).finish();
}

std::vector<double> fbx_matrix(const Eigen::Affine3d& frame) {
  const Eigen::Matrix4d& matrix = frame.matrix();
  return {matrix.data(), matrix.data() + matrix.size()};
}

}  // namespace curveskel
