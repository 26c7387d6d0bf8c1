// Log-log plots as SVG.
#pragma once

#include <string>
#include <vector>

namespace curveskel::bench {

struct Series {
  std::string name;
  std::vector<double> x, y;     ///< > 0
  std::vector<bool> predicted;  ///< drawn hollow; as long as x
  bool other = false;           ///< of another source: dotted, with hollow squares
  int beside = -1;              ///< the series whose colour it takes; -1 = one of its own
};

/// An SVG document of 760 x 480.
[[nodiscard]] std::string log_log_plot(const std::string& title, const std::string& x_name,
                                       const std::string& y_name,
                                       const std::vector<Series>& series);

}  // namespace curveskel::bench
