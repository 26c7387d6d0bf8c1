// Laws of an extraction that takes what it can from the one before: it is the one that starts anew.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <set>
#include <stop_token>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <curveskel/extract.hpp>
#include "meshes/shapes.hpp"
#include "tests/skeleton/thin_walled.hpp"

namespace curveskel::extraction_cache_laws {
namespace {

using shapes::Shape;

void expect_equal(const Certificate& a, const Certificate& b) {
  EXPECT_EQ(a.components, b.components);
  EXPECT_EQ(a.components_of_surface, b.components_of_surface);
  EXPECT_EQ(a.cycle_rank, b.cycle_rank);
  EXPECT_EQ(a.genus, b.genus);
  EXPECT_EQ(a.length, b.length);
  EXPECT_EQ(a.inside_fraction, b.inside_fraction);
  EXPECT_EQ(a.deepest_exit, b.deepest_exit);
  EXPECT_EQ(a.centredness_median, b.centredness_median);
  EXPECT_EQ(a.centredness_p90, b.centredness_p90);
  EXPECT_EQ(a.coverage, b.coverage);
  EXPECT_EQ(a.reach, b.reach);
  EXPECT_EQ(a.spurs, b.spurs);
  EXPECT_EQ(a.total_curvature, b.total_curvature);
  EXPECT_EQ(a.inside_enough, b.inside_enough);
}

/// All but times, and the lists of what ran.
void expect_equal(const Extraction& a, const Extraction& b) {
  EXPECT_EQ(a.skeleton.nodes, b.skeleton.nodes);
  EXPECT_EQ(a.skeleton.edges, b.skeleton.edges);
  EXPECT_EQ(a.skeleton.radii, b.skeleton.radii);
  EXPECT_EQ(a.skeleton.node_of_vertex, b.skeleton.node_of_vertex);
  expect_equal(a.certificate, b.certificate);
  ASSERT_EQ(a.history.size(), b.history.size());
  for (std::size_t t = 0; t < a.history.size(); ++t) {
    EXPECT_EQ(a.history[t].name, b.history[t].name);
    EXPECT_EQ(a.history[t].component, b.history[t].component);
    EXPECT_EQ(a.history[t].part_of, b.history[t].part_of);
    EXPECT_EQ(a.history[t].why, b.history[t].why);
    EXPECT_EQ(a.history[t].outcome, b.history[t].outcome);
  }
  ASSERT_EQ(a.components.size(), b.components.size());
  for (std::size_t c = 0; c < a.components.size(); ++c) {
    const ComponentRecord& one = a.components[c];
    const ComponentRecord& other = b.components[c];
    EXPECT_EQ(one.vertices, other.vertices);
    EXPECT_EQ(one.working_vertices, other.working_vertices);
    EXPECT_EQ(one.genus, other.genus);
    EXPECT_EQ(one.stop, other.stop);
    ASSERT_EQ(one.steps.size(), other.steps.size());
    for (std::size_t k = 0; k < one.steps.size(); ++k) {
      EXPECT_EQ(one.steps[k].area_ratio, other.steps[k].area_ratio);
      EXPECT_EQ(one.steps[k].volume_ratio, other.steps[k].volume_ratio);
      EXPECT_EQ(one.steps[k].residual, other.steps[k].residual);
      EXPECT_EQ(one.steps[k].vertices, other.steps[k].vertices);
    }
  }
}

const std::vector<std::string>& stages() {
  static const std::vector<std::string> all{"normalise", "fair",  "coarsen", "balls",  "contract",
                                            "surgery",   "embed", "level",   "certify"};
  return all;
}

std::set<std::string> ran(const Extraction& extraction) {
  std::set<std::string> names;
  for (const StageTime& time : extraction.times) names.insert(time.stage);
  return names;
}

/// Reused are the stages before `first`, and all others ran. "" = all were reused. Curves without
/// embedding have no levels.
void expect_run_from(const std::string& first, bool fairing, const Extraction& extraction,
                     bool has_levels = true) {
  std::vector<std::string> reused;
  std::set<std::string> run;
  bool before = true;
  for (const std::string& stage : stages()) {
    before = before && stage != first;
    if (stage == "fair" && !fairing) continue;
    if (stage == "level" && !has_levels) continue;
    if (before) {
      reused.push_back(stage);
    } else {
      run.insert(stage);
    }
  }
  EXPECT_EQ(extraction.reused, reused);
  EXPECT_EQ(ran(extraction), run);
}

struct Change {
  std::string name;
  std::string first;  ///< stage that reads the option
  std::function<void(ExtractOptions&)> make;
};

const std::vector<Change>& changes() {
  static const std::vector<Change> all{
      {"nothing", "", [](ExtractOptions&) {}},
      {"threads", "",
       [](ExtractOptions& o) { o.threads = o.fair.threads = o.certificate.threads = 1; }},
      {"program cache", "",
       [](ExtractOptions& o) { o.fair.program_cache = o.contraction.program_cache = "/tmp/none"; }},
      {"fair iterations", "fair", [](ExtractOptions& o) { o.fair.iterations = 2; }},
      {"fair smoothing", "fair", [](ExtractOptions& o) { o.fair.smoothing = 0.5; }},
      {"resolution", "coarsen", [](ExtractOptions& o) { o.resolution = 800; }},
      {"least resolution", "coarsen", [](ExtractOptions& o) { o.least_resolution = 700; }},
      {"contraction weight", "contract",
       [](ExtractOptions& o) { o.contraction.contraction_weight = 2; }},
      {"most iterations", "contract", [](ExtractOptions& o) { o.contraction.max_iterations = 9; }},
      {"flow", "contract", [](ExtractOptions& o) { o.contraction.flow = Flow::paper; }},
      {"shape weight", "surgery", [](ExtractOptions& o) { o.surgery.shape_weight = 2; }},
      {"surgery method", "surgery",
       [](ExtractOptions& o) { o.surgery.method = SurgeryMethod::cgal; }},
      {"no embedding", "contract", [](ExtractOptions& o) { o.embed.method = EmbedMethod::none; }},
      {"detail", "level", [](ExtractOptions& o) { o.embed.detail = 0.9; }},
      {"relax rounds", "embed", [](ExtractOptions& o) { o.embed.relax_rounds = 3; }},
      {"sample spacing", "certify", [](ExtractOptions& o) { o.certificate.sample_spacing = 0.01; }},
      {"rays", "certify", [](ExtractOptions& o) { o.certificate.rays = 8; }},
      {"rims", "certify",
       [](ExtractOptions& o) {
         o.rims = {{0, 1, 2}};
       }},
  };
  return all;
}

/// A component of its own, and several of which some go side by side.
std::vector<Shape> subjects() {
  return {shapes::tube_union("y", shapes::star(3, 8, 0.8), {0.25, 1.7}),
          shapes::linked_rings(3, 0.6, 12)};
}

ExtractOptions starting_options(bool fairing) {
  ExtractOptions options;
  options.resolution = 1000;
  options.least_resolution = 300;
  options.fairing = fairing;
  options.fair.iterations = 1;
  options.fair_if_outside = false;
  return options;
}

class Cached : public testing::TestWithParam<bool> {};

TEST_P(Cached, IsFreshWhateverChangesAndRunsTheStagesAfterTheChange) {
  const bool fairing = GetParam();
  for (const Shape& shape : subjects()) {
    SCOPED_TRACE(shape.name);
    ExtractionCache cache;
    const ExtractOptions start = starting_options(fairing);
    const Extraction first = extract(shape.surface, start, {}, cache);
    expect_run_from("normalise", fairing, first);
    expect_equal(first, extract(shape.surface, start, {}));
    for (const Change& change : changes()) {
      if (change.first == "fair" && !fairing) continue;
      SCOPED_TRACE(change.name);
      // Whatever the change before left, this is where it starts from.
      (void)extract(shape.surface, start, {}, cache);
      ExtractOptions changed = start;
      change.make(changed);
      const Extraction cached = extract(shape.surface, changed, {}, cache);
      // Below the change all is anew, unless a second contraction was tried in between.
      expect_run_from(change.first, fairing, cached, changed.embed.method == EmbedMethod::own);
      expect_equal(cached, extract(shape.surface, changed, {}));
    }
  }
}

TEST_P(Cached, IsUnharmedByARunThatWasCancelledAnywhere) {
  const bool fairing = GetParam();
  for (const Shape& shape : subjects()) {
    SCOPED_TRACE(shape.name);
    const ExtractOptions start = starting_options(fairing);
    ExtractOptions other = start;
    other.fair.smoothing = 0.5;
    other.resolution = 800;
    other.embed.detail = 0.9;
    const Extraction fresh_start = extract(shape.surface, start, {});
    const Extraction fresh_other = extract(shape.surface, other, {});
    for (const std::string& stage : stages()) {
      SCOPED_TRACE(stage);
      ExtractionCache cache;
      (void)extract(shape.surface, start, {}, cache);
      std::stop_source source;
      Monitor stopping;
      stopping.stop = source.get_token();
      stopping.progress = [&](std::string_view at, double) {
        if (at == stage) source.request_stop();
      };
      bool cancelled = false;
      try {
        (void)extract(shape.surface, other, stopping, cache);
      } catch (const Cancelled&) {
        cancelled = true;
      }
      const bool reports = stage == "coarsen" || stage == "contract" || stage == "embed" ||
                           stage == "certify" || (stage == "fair" && fairing);
      EXPECT_TRUE(cancelled || !reports);
      if (cancelled && stage == "embed" && shape.components == 1) {
        const Extraction resumed = extract(shape.surface, other, {}, cache);
        expect_run_from("embed", fairing, resumed);
        expect_equal(resumed, fresh_other);
      }
      expect_equal(extract(shape.surface, start, {}, cache), fresh_start);
      expect_equal(extract(shape.surface, other, {}, cache), fresh_other);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Faired, Cached, testing::Values(true));
INSTANTIATE_TEST_SUITE_P(ThoroughAsItIs, Cached, testing::Values(false));

TEST(CachedSurface, IsFreshThroughSecondContractionsAndLevelSets) {
  const Surface sieve = shapes::sieve(2).surface;
  const auto options_with = [](double weight, double collapse, double shape, double detail) {
    ExtractOptions options;
    options.resolution = 600;
    options.least_resolution = 200;
    options.fair_if_outside = false;
    options.contraction.contraction_weight = weight;
    options.contraction.collapse_length = collapse;
    options.surgery.shape_weight = shape;
    options.embed.detail = detail;
    return options;
  };
  ExtractionCache cache;
  std::set<std::string> met;
  const auto expect_from = [&](const std::string& first, const ExtractOptions& options) {
    const Extraction cached = extract(sieve, options, {}, cache);
    expect_run_from(first, false, cached);
    expect_equal(cached, extract(sieve, options, {}));
    for (const Try& one : cached.history) {
      if (one.component == 0 && one.outcome == Outcome::kept) met.insert(one.name);
    }
  };
  expect_from("normalise", options_with(3, 0.3, 1, 0.5));
  expect_from("contract", options_with(3, 2, 1, 0.5));
  expect_from("", options_with(3, 2, 1, 0.5));
  expect_from("level", options_with(3, 2, 1, 0.9));
  expect_from("contract", options_with(1000, 2, 1, 0.9));
  expect_from("", options_with(1000, 2, 1, 0.9));
  expect_from("level", options_with(1000, 2, 1, 0.5));
  expect_from("contract", options_with(3, 0.3, 1, 0.5));
  EXPECT_EQ(met, (std::set<std::string>{"as asked", "gentler contraction", "level-set graph"}));
}

// The finer try was made anew in each run.
TEST(CachedSurface, KeepsAComponentThatIsMadeFromAllItsVertices) {
  const Surface sieve = thin_walled(3, 0.03);
  ExtractOptions options;
  options.resolution = 1;
  options.least_resolution = 1;
  ExtractionCache cache;
  const Extraction first = extract(sieve, options, {}, cache);
  ASSERT_EQ(first.components[0].working_vertices, first.components[0].vertices);
  const Extraction again = extract(sieve, options, {}, cache);
  expect_equal(first, again);
  expect_run_from("", false, again);
}

TEST(CachedSurface, OfOtherContentStartsAnew) {
  ExtractionCache cache;
  const ExtractOptions options = starting_options(false);
  Surface surface = subjects().front().surface;
  (void)extract(surface, options, {}, cache);
  const Surface copy = surface;
  expect_run_from("", false, extract(copy, options, {}, cache));
  surface.positions(0, 0) += 1e-3;
  const Extraction moved = extract(surface, options, {}, cache);
  expect_run_from("normalise", false, moved);
  expect_equal(moved, extract(surface, options, {}));
  std::swap(surface.triangles(0, 0), surface.triangles(0, 1));
  std::swap(surface.triangles(0, 1), surface.triangles(0, 2));
  expect_run_from("normalise", false, extract(surface, options, {}, cache));
}

TEST(CachedSurface, MayBeMovedAlong) {
  ExtractionCache cache;
  const ExtractOptions options = starting_options(false);
  const Surface surface = subjects().front().surface;
  const Extraction first = extract(surface, options, {}, cache);
  ExtractionCache other = std::move(cache);
  const Extraction again = extract(surface, options, {}, other);
  expect_run_from("", false, again);
  expect_equal(first, again);
  cache = ExtractionCache();
  expect_run_from("normalise", false, extract(surface, options, {}, cache));
}

TEST(CachedSurface, IsSharedByACopyThatGoesItsOwnWay) {
  ExtractOptions options;
  options.resolution = 1;
  options.least_resolution = 1;
  const Surface sieve = thin_walled(3, 0.03);  // made from all its vertices
  const Surface other = subjects().front().surface;
  ExtractionCache cache;
  ASSERT_NO_THROW((void)cache.copy());
  const Extraction first = extract(sieve, options, {}, cache);
  ExtractionCache copy = cache.copy();
  const Extraction again = extract(sieve, options, {}, copy);
  expect_run_from("", false, again);
  expect_equal(first, again);
  ExtractOptions finer = options;
  finer.embed.detail = 0.9;
  finer.contraction.contraction_weight *= 2;
  expect_equal(extract(sieve, finer, {}, copy), extract(sieve, finer, {}));
  (void)extract(other, options, {}, copy);
  const Extraction kept = extract(sieve, options, {}, cache);
  expect_run_from("", false, kept);
  expect_equal(first, kept);
}

TEST(CachedSurface, ThatIsFairedAfterAllIsFreshToo) {
  // Asked for more than any curve has, so that the second run is always made.
  ExtractionCache cache;
  ExtractOptions options = starting_options(false);
  options.fair_if_outside = true;
  options.certificate.inside_needed = 2;
  const Surface surface = shapes::noisy(shapes::torus(3, 0.8, 16), 0.1, 7).surface;
  expect_equal(extract(surface, options, {}, cache), extract(surface, options, {}));
  expect_run_from("", true, extract(surface, options, {}, cache));
  options.embed.detail = 0.9;
  const Extraction cached = extract(surface, options, {}, cache);
  expect_run_from("level", true, cached);
  expect_equal(cached, extract(surface, options, {}));
}

}  // namespace
}  // namespace curveskel::extraction_cache_laws
