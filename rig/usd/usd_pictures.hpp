// The pictures of a glTF file as files of their own. Internal to rig/.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <curveskel/rig_files.hpp>
#include "surface/read/file_bytes.hpp"

namespace tinygltf {
class Model;
}

namespace curveskel {

class UsdPictures {
 public:
  /// `folder` is the one that they go to; `packed`: into an archive, which takes PNG and JPEG
  /// alone. `notes` gets a line for each that no program for USD shows.
  UsdPictures(const FileBytes& file, const tinygltf::Model& model, std::string folder, bool packed,
              std::vector<std::string>& notes);

  /// "./hero_textures/skin.png"; empty where the file has no such picture, or USD cannot.
  [[nodiscard]] std::string path_of(int image);

  /// Those whose paths were asked for.
  [[nodiscard]] std::vector<SideFile> taken() &&;

 private:
  [[nodiscard]] std::string bytes_in_json(int image);
  [[nodiscard]] std::string bytes_of(int image);
  [[nodiscard]] std::string add(int image);

  const FileBytes& file_;
  const tinygltf::Model& model_;
  std::string folder_;
  bool packed_;
  std::vector<std::string>& notes_;
  std::optional<std::vector<std::string>> addresses_;  // parsed once, for the first that needs it
  std::map<int, std::string> paths_;                   // by image
  std::set<std::string> names_;                        // of files, in lower case
  std::vector<SideFile> taken_;
};

}  // namespace curveskel
