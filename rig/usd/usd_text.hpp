// Text of a USD layer (.usda). Internal to rig/.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace curveskel {

/// In double quotes; `"`, `\` and control characters are escaped, what is no UTF-8 is replaced.
[[nodiscard]] std::string usd_quoted(const std::string& text);

/// "</Model/Body>".
[[nodiscard]] std::string usd_target(const std::string& path);

/// Metadata in the brackets behind a prim's name.
struct UsdPrim {
  std::vector<const char*> schemas;
  std::string true_name;  ///< where the prim's name could not be that
  const char* kind = "";
};

/// Metadata in the brackets behind an attribute.
struct UsdAttribute {
  const char* interpolation = "";
  std::size_t element_size = 0;  ///< 0 = none is said
};

/// Numbers are single precision, the shortest that read back as the same; what is no number is 0.
class UsdText {
 public:
  /// `depth` is that of the first prim below others.
  explicit UsdText(std::size_t depth = 0) : depth_(depth) {}

  void begin(const char* type, const std::string& name, const UsdPrim& prim = {});
  void end();
  void line(std::string_view text);
  /// Tuples of `width` numbers; plain numbers of width 1. `head` is "point3f[] points".
  void numbers(std::string_view head, const std::vector<double>& rows, std::size_t width,
               const UsdAttribute& attribute = {});
  void integers(std::string_view head, const std::vector<std::int32_t>& numbers,
                const UsdAttribute& attribute = {});
  void words(std::string_view head, const std::vector<std::string>& words);
  /// In double precision.
  void matrices(std::string_view head, const std::vector<Eigen::Affine3d>& frames);
  /// One row of `samples` at each time code; a value without time where there is one alone.
  void samples(const std::string& head, const std::vector<double>& time_codes,
               const std::vector<std::vector<double>>& samples, std::size_t width,
               bool is_array = true);
  void append(std::string_view text) { text_ += text; }

  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  void indent() { text_.append(4 * depth_, ' '); }
  void end_attribute(const UsdAttribute& attribute);

  std::size_t depth_;
  std::string text_;
};

/// "(1, 0.5, 0)".
[[nodiscard]] std::string usd_tuple(const std::vector<double>& numbers);

/// By rows that a point, as a row, is multiplied with.
[[nodiscard]] std::string usd_matrix(const Eigen::Affine3d& frame);

}  // namespace curveskel
