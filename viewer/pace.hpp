// How finely a picture may be drawn so that it is there in time, from what earlier ones took.
#pragma once

#include <array>
#include <cstddef>

namespace curveskel::viewer {

struct Fineness {
  int level = 0;    ///< of the given surface: 0 = whole, the higher the simpler
  int samples = 4;  ///< a pixel
  int shrink = 1;   ///< each side of the picture is drawn this many times smaller
  bool operator==(const Fineness&) const = default;
};

class Pace {
 public:
  static constexpr int levels = 3;
  /// Triangles at each level.
  using Sizes = std::array<std::size_t, levels>;
  /// What there is to draw.
  struct Load {
    Sizes triangles{};
    double pixels = 0;
  };

  /// A picture that was drawn so took so long.
  void measured(const Fineness& fineness, const Load& load, double milliseconds);
  /// The finest that should take no longer; the coarsest if all do.
  [[nodiscard]] Fineness choose(const Load& load, double milliseconds) const;
  /// What a picture should take; 0 before the first was measured.
  [[nodiscard]] double predicted(const Fineness& fineness, const Load& load) const;

 private:
  double milliseconds_per_work_ = 0;
  int count_ = 0;
};

}  // namespace curveskel::viewer
