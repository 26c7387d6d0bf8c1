// The times that pictures took.
#pragma once

#include <string>
#include <vector>

namespace curveskel::viewer {

/// The last few hundred for the status bar, all of them for a file.
class FrameTimes {
 public:
  void add(double milliseconds) { all_.push_back(milliseconds); }
  [[nodiscard]] double last() const { return all_.empty() ? 0 : all_.back(); }
  /// Of the last 300 pictures; 0 if there are none. `share` in 0..1.
  [[nodiscard]] double percentile(double share) const;
  /// One number a line.
  [[nodiscard]] std::string text() const;

 private:
  std::vector<double> all_;
};

}  // namespace curveskel::viewer
