#include <numbers>

#include "meshes/shapes.hpp"

namespace curveskel::shapes {
namespace {

using std::numbers::pi;

Shape rings(int loops) { return tube_union("", ring_chain(loops, 3, 1), {0.25, 2}); }

std::vector<CatalogueEntry> entries() {
  return {
      {"tube", "straight tube, round caps", [] { return tube("", straight(10), constant(1), 24); }},
      {"taper", "straight tube that thins out to a fifth",
       [] { return tube("", straight(10), tapered(1, 0.2), 24); }},
      {"wavy", "straight tube with swellings",
       [] { return tube("", straight(14), wavy(1, 0.3, 3.5), 24); }},
      {"arc", "three quarters of a ring",
       [] { return tube("", arc(4, 1.5 * pi), constant(1), 24); }},
      {"s", "tube bent like an S", [] { return tube("", s_curve(16, 6), constant(1), 24); }},
      {"helix", "three turns", [] { return tube("", helix(3, 3, 3), constant(0.7), 20); }},
      {"torus", "one ring", [] { return torus(3, 1, 20); }},
      {"trefoil", "tube tied into a knot", [] { return tube("", trefoil(2), constant(0.7), 11); }},
      {"linked-rings", "two rings, each through the other",
       [] { return linked_rings(3, 0.8, 14); }},
      {"box", "cube",
       [] {
         return box({1, 1, 1}, 12);
       }},
      {"plate", "flat box",
       [] {
         return box({10, 10, 1}, 20);
       }},
      {"sphere", "unit sphere",
       [] {
         return ellipsoid({1, 1, 1}, 4);
       }},
      {"ellipsoid", "half axes 3, 1, 1",
       [] {
         return ellipsoid({3, 1, 1}, 4);
       }},
      {"cone", "apex with 60 neighbours", [] { return cone(1, 4, 60); }},
      {"double-torus", "two rings and a bar",
       [] {
         return tube_union("", ring_chain(2, 3, 1), {0.25, 1.7});
       }},
      {"algebraic-double-torus", "a smooth figure of eight",
       [] { return algebraic_double_torus(0.07); }},
      {"rings-5", "five rings in a row", [] { return rings(5); }},
      {"rings-10", "ten rings in a row", [] { return rings(10); }},
      {"y", "three arms in a plane", [] { return tube_union("", star(3, 6, 1)); }},
      {"x", "four arms in a plane", [] { return tube_union("", star(4, 6, 1)); }},
      {"star", "seven arms in space", [] { return tube_union("", star(7, 7, 0.8)); }},
      {"h", "the letter", [] { return tube_union("", letter_h(12, 6, 1)); }},
      {"ladder", "six loops", [] { return tube_union("", ladder(6, 5, 0.8)); }},
      {"tree", "eight twigs", [] { return tube_union("", tree(3, 8, 1)); }},
      {"random", "random graph of tubes with two loops",
       [] { return tube_union("", random_graph(1, 12, 2, 1)); }},
  };
}

}  // namespace

const std::vector<CatalogueEntry>& catalogue() {
  static const std::vector<CatalogueEntry> all = [] {
    std::vector<CatalogueEntry> named = entries();
    for (auto& entry : named) {
      entry.make = [name = entry.name, make = std::move(entry.make)] {
        Shape shape = make();
        shape.name = name;
        return shape;
      };
    }
    return named;
  }();
  return all;
}

}  // namespace curveskel::shapes
