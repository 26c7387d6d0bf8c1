// Text for a person: results, progress, notes and warnings.
#pragma once

#include <chrono>
#include <set>
#include <string>
#include <string_view>

namespace curveskel {

/// Results go to standard output, all else to standard error: progress as one bar per stage on a
/// terminal, as one line per stage otherwise.
class Terminal {
 public:
  Terminal();

  /// From now on neither progress nor notes nor warnings; results are up to the caller.
  void be_quiet() { quiet_ = true; }
  [[nodiscard]] bool quiet() const { return quiet_; }
  /// Standard output carries a file: results go to standard error.
  void keep_output_clean() { clean_ = true; }

  void progress(std::string_view stage, double fraction);
  /// One line about something that was decided or changed.
  void note(std::string_view line);
  /// The result still stands, but has to be looked at.
  void warn(std::string_view line);
  /// Shown even when quiet.
  void error(std::string_view line);
  /// Text with its line ends.
  void result(std::string_view text);
  /// Ends a bar that is being drawn.
  void end_progress();

  /// All bytes to standard output. Throws Error(Fault::output).
  static void write_output(std::string_view bytes);

 private:
  using Clock = std::chrono::steady_clock;
  void draw(double fraction);

  bool quiet_ = false;
  bool clean_ = false;
  bool bars_;
  std::string stage_;
  std::set<std::string, std::less<>> seen_;
  Clock::time_point stage_began_;
  Clock::time_point drawn_;
  double fraction_ = 0;
};

}  // namespace curveskel
