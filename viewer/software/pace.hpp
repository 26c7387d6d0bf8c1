// The fineness of a picture that is there in time, from the times of earlier ones.
#pragma once

#include <array>
#include <cstddef>

namespace curveskel::viewer {

struct Fineness {
  int level = 0;    ///< of the given surface: 0 = whole, the higher the simpler
  int samples = 4;  ///< a pixel
  int shrink = 1;   ///< each side of the picture is drawn this many times smaller
  bool operator==(const Fineness&) const = default;
  [[nodiscard]] bool lit_at_vertices() const { return level >= 2; }
};

/// True if `one` shows more than `other` in any respect.
[[nodiscard]] bool finer(const Fineness& one, const Fineness& other);

class Pace {
 public:
  static constexpr int levels = 4;
  /// Triangles at each level.
  using Sizes = std::array<std::size_t, levels>;
  /// The things to draw.
  struct Load {
    Sizes triangles{};
    double pixels = 0;
  };

  /// A picture that was drawn so took so long.
  void measured(const Fineness& fineness, const Load& load, double milliseconds);
  /// The rest of a frame (panels, handing it over to the screen) took so long.
  void measured_rest(double milliseconds);

  /// While things move: what gives sixty frames a second, or the coarsest. It changes only where
  /// the last choice is too slow, or a finer one has room to spare. The finest before anything was
  /// measured.
  [[nodiscard]] Fineness while_moving(const Load& load);
  /// The finest of which a picture takes no longer than a person waits for.
  [[nodiscard]] Fineness at_rest(const Load& load) const;
  /// The wanted time of a picture; 0 before the first was measured.
  [[nodiscard]] double predicted(const Fineness& fineness, const Load& load) const;

 private:
  [[nodiscard]] Fineness finest_within(const Load& load, double milliseconds) const;

  std::array<double, 5> recent_{};  // milliseconds by work, of the last pictures
  std::size_t count_ = 0;
  double rest_ = 0;  // milliseconds
  std::size_t rests_ = 0;
  Fineness moving_;
};

}  // namespace curveskel::viewer
