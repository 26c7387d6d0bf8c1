// The surface of a verb: a file, or standard input.
#pragma once

#include <filesystem>
#include <string>

#include <curveskel/monitor.hpp>
#include <curveskel/read.hpp>

namespace curveskel {

/// The name that stands for standard input among the arguments.
[[nodiscard]] bool is_standard_input(const std::filesystem::path& mesh);

/// The file's name without its folder, for reports and messages; "standard input" of "-".
[[nodiscard]] std::string name_of_input(const std::filesystem::path& mesh);

/// `read_polygons`; of "-" everything that standard input gives, once. Its format follows from the
/// content alone, and files beside it (buffers of a .gltf) are not found.
[[nodiscard]] PolygonSoup read_surface(const std::filesystem::path& mesh, const Monitor& monitor);

/// The same of standard input; `loses_look` is set where the content may have materials, texture
/// coordinates or colours, which come with a file alone.
[[nodiscard]] PolygonSoup read_standard_input(const Monitor& monitor, bool& loses_look);

}  // namespace curveskel
