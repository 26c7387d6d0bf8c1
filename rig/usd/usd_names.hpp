// Names of prims and of pictures' files. Internal to rig/.
#pragma once

#include <set>
#include <string>

namespace curveskel {

/// Letters, digits and _ alone, no digit first: other characters of the name become _ each. A name
/// that is empty becomes `otherwise`.
[[nodiscard]] std::string usd_identifier(const std::string& name, const std::string& otherwise);

/// Names that are taken already; of several alike the later ones get a number.
class UsdNames {
 public:
  [[nodiscard]] std::string free(const std::string& name, const std::string& otherwise);

 private:
  std::set<std::string> taken_;
};

/// The true name where it is not the prim's.
[[nodiscard]] std::string usd_true_name(const std::string& name, const std::string& of_prim);

/// A file's name that all systems, archives and asset paths take: letters and digits of ASCII,
/// `-`, `_` and `.`, which is not the first; others become _.
[[nodiscard]] std::string plain_file_name(const std::string& name);

}  // namespace curveskel
