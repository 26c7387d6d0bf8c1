// Log-log plots as SVG.
#pragma once

#include <string>
#include <vector>

namespace curveskel::bench {

struct Series {
  std::string name;
  std::vector<double> x, y;     ///< > 0
  std::vector<bool> predicted;  ///< drawn hollow; as long as x
};

/// An SVG document of 720 x 480.
[[nodiscard]] std::string log_log_plot(const std::string& title, const std::string& x_name,
                                       const std::string& y_name,
                                       const std::vector<Series>& series);

}  // namespace curveskel::bench
