// The parts of the page that `html_page` writes, as the build embeds them.
#pragma once

#include <string_view>

namespace curveskel {

extern const std::string_view page_style_source;
extern const std::string_view page_body_source;
extern const std::string_view page_script_source;

}  // namespace curveskel
