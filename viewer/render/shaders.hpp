// The shaders of viewer/shaders, embedded at build time. Those that are lit have no #version line:
// `with_light` puts it and the light before them.
#pragma once

#include <string>
#include <string_view>

namespace curveskel {

extern const std::string_view light_source;
extern const std::string_view surface_vertex_source;
extern const std::string_view coarse_vertex_source;
extern const std::string_view coarse_fragment_source;
extern const std::string_view place_vertex_source;
extern const std::string_view surface_fragment_source;
extern const std::string_view thickness_fragment_source;
extern const std::string_view screen_vertex_source;
extern const std::string_view body_fragment_source;
extern const std::string_view skin_fragment_source;
extern const std::string_view background_fragment_source;
extern const std::string_view tube_vertex_source;
extern const std::string_view tube_fragment_source;
extern const std::string_view wire_fragment_source;

namespace viewer {

[[nodiscard]] inline std::string with_light(std::string_view body) {
  return "#version 330 core\n" + std::string(light_source) + std::string(body);
}

}  // namespace viewer
}  // namespace curveskel
