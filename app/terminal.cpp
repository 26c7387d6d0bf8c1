#include "app/terminal.hpp"

#include <fmt/core.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>

#include <curveskel/error.hpp>

namespace curveskel {
namespace {

constexpr std::chrono::milliseconds between_drawings{50};
constexpr std::string_view erase_line = "\r\x1b[K";

int columns() {
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

void write_error(std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

}  // namespace

Terminal::Terminal() : bars_(isatty(STDERR_FILENO) == 1) {}

void Terminal::progress(std::string_view stage, double fraction) {
  if (quiet_) return;
  const auto now = Clock::now();
  if (stage != stage_) {
    // A stage that comes again, for the next component, takes the line that is there.
    const bool known = !seen_.insert(std::string(stage)).second;
    if (!known) end_progress();
    stage_ = stage;
    stage_began_ = drawn_ = now;
    fraction_ = 0;
    if (bars_) {
      draw(fraction);
    } else if (!known) {
      write_error(fmt::format("{} ...\n", stage));
    }
    return;
  }
  const double shown = std::clamp(fraction, fraction_, 1.0);
  if (!bars_ || (now - drawn_ < between_drawings && shown < 1) || shown == fraction_) return;
  drawn_ = now;
  draw(shown);
}

void Terminal::draw(double fraction) {
  fraction_ = std::clamp(fraction, 0.0, 1.0);
  const double seconds = std::chrono::duration<double>(Clock::now() - stage_began_).count();
  const int width = std::clamp(columns() - 32, 0, 40);
  const int filled = static_cast<int>(std::lround(fraction_ * width));
  write_error(fmt::format("{}{:<10} [{:=<{}}{:<{}}] {:3.0f} % {:6.1f} s", erase_line, stage_, "",
                          filled, "", width - filled, 100 * fraction_, seconds));
}

void Terminal::end_progress() {
  if (stage_.empty()) return;
  if (bars_ && !quiet_) {
    draw(1);
    write_error("\n");
  }
  stage_.clear();
}

void Terminal::note(std::string_view line) {
  if (quiet_) return;
  end_progress();
  write_error(fmt::format("{}\n", line));
}

void Terminal::warn(std::string_view line) {
  if (quiet_) return;
  end_progress();
  write_error(fmt::format("curveskel: warning: {}\n", line));
}

void Terminal::error(std::string_view line) {
  if (bars_ && !stage_.empty()) write_error("\n");
  stage_.clear();
  write_error(fmt::format("curveskel: {}\n", line));
}

void Terminal::result(std::string_view text) {
  end_progress();
  if (clean_) {
    write_error(text);
  } else {
    write_output(text);
  }
}

void Terminal::write_output(std::string_view bytes) {
  const std::size_t written = std::fwrite(bytes.data(), 1, bytes.size(), stdout);
  if (written == bytes.size() && std::fflush(stdout) == 0) return;
  throw Error(Fault::output,
              fmt::format("standard output: could not write all of {} bytes ({}); write to a file "
                          "with -o FILE",
                          bytes.size(), std::strerror(errno)));
}

}  // namespace curveskel
