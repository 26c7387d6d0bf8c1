// The objects of an FBX file and how they hang together. Internal to rig/.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "rig/fbx/fbx_records.hpp"

namespace curveskel {

/// Objects are numbered as they are added, and written in that order.
class FbxDocument {
 public:
  static constexpr std::int64_t root = 0;  ///< of all models

  /// `write` adds what lies within the object's record. `type` is the record's name, `kind` the
  /// name behind the object's own.
  std::int64_t add(std::string_view type, const std::string& name, std::string_view kind,
                   std::string_view subclass, std::function<void(FbxRecords&)> write);
  void connect(std::int64_t child, std::int64_t parent);
  /// To one of the parent's properties.
  void connect(std::int64_t child, std::int64_t parent, std::string_view property);

  /// The whole file. Throws Error(Fault::output) beyond 4 GB.
  [[nodiscard]] std::string bytes(const std::string& provenance) const;

 private:
  struct Object {
    std::string type;
    std::int64_t number;
    std::string name;  // and kind
    std::string subclass;
    std::function<void(FbxRecords&)> write;
  };
  struct Connection {
    std::int64_t child;
    std::int64_t parent;
    std::string property;
  };

  void write_definitions(FbxRecords& records) const;
  void write_objects(FbxRecords& records) const;
  void write_connections(FbxRecords& records) const;

  std::vector<Object> objects_;
  std::map<std::string, std::int32_t> count_;  // by type
  std::vector<Connection> connections_;
};

/// Columns one after the other.
[[nodiscard]] std::vector<double> fbx_matrix(const Eigen::Affine3d& frame);

}  // namespace curveskel
