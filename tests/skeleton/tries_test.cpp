// Laws of the tries of an extraction: what a failed one means, and what is written down of each.
#include <curveskel/tries.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include <curveskel/extract_repaired.hpp>
#include "meshes/shapes.hpp"
#include "skeleton/pipeline/try_loop.hpp"
#include "tests/skeleton/thin_walled.hpp"
#include "tests/soups.hpp"

namespace curveskel::tries_laws {
namespace {

using shapes::Shape;
using NumberPlan = Plan<int>;

/// A plan that is always made and does this.
NumberPlan plan(std::string_view name, const std::function<int()>& work) {
  return {name, [](const NumberPlan::SoFar&) { return std::string("a test"); },
          [work](const NumberPlan::Room&) { return work(); }};
}

NumberPlan::SoFar carried_out(const std::vector<NumberPlan>& plans, TryLog& log) {
  return carry_out(
      plans, {}, [](int a, const int* b) { return b == nullptr || a > *b; },
      [](int) { return std::nullopt; }, Monitor{}, log);
}

TEST(Tries, TheBestIsKeptAndEachIsWrittenDown) {
  TryLog log;
  const auto found = carried_out({plan("one", [] { return 1; }), plan("three", [] { return 3; }),
                                  plan("two", [] { return 2; })},
                                 log);
  EXPECT_EQ(found.best, 3);
  ASSERT_EQ(log.tries.size(), 3U);
  EXPECT_EQ(log.tries[0].outcome, Outcome::not_better);
  EXPECT_EQ(log.tries[1].outcome, Outcome::kept);
  EXPECT_EQ(log.tries[2].outcome, Outcome::not_better);
  EXPECT_EQ(log.tries[1].why, "a test");
}

TEST(Tries, AnErrorAndALackOfMemoryAreFailuresThatLeaveWhatThereIs) {
  for (const Fault fault : {Fault::input, Fault::device, Fault::solver, Fault::output}) {
    TryLog log;
    const auto found = carried_out(
        {plan("one", [] { return 1; }), plan("error", [&]() -> int { throw Error(fault, "why"); }),
         plan("memory", []() -> int { throw std::bad_alloc(); })},
        log);
    EXPECT_EQ(found.best, 1);
    EXPECT_EQ(log.tries[0].outcome, Outcome::kept);
    EXPECT_EQ(log.tries[1].outcome, Outcome::failed);
    EXPECT_EQ(log.tries[1].message, "why");
    EXPECT_EQ(log.tries[2].outcome, Outcome::failed);
    EXPECT_EQ(log.tries[2].message, "out of memory");
  }
}

TEST(Tries, WhatNoOtherTryMendsPassesThrough) {
  TryLog log;
  const auto with = [&](const std::function<int()>& work) {
    return carried_out({plan("one", [] { return 1; }), plan("other", work)}, log);
  };
  EXPECT_THROW((void)with([]() -> int { throw Cancelled(); }), Cancelled);
  EXPECT_THROW((void)with([]() -> int { throw Error(Fault::usage, "an option"); }), Error);
  EXPECT_THROW((void)with([]() -> int { throw std::logic_error("a defect"); }), std::logic_error);
}

TEST(Tries, WithoutAnyResultTheLastFailureIsThrown) {
  TryLog log;
  const auto found = carried_out({plan("one", []() -> int { throw Error(Fault::input, "first"); }),
                                  plan("two", []() -> int { throw Error(Fault::solver, "last"); })},
                                 log);
  try {
    (void)best_of(found);
    FAIL() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "last");
    EXPECT_EQ(error.fault(), Fault::solver);
  }
}

TEST(Tries, WhatIsPartOfADroppedTryIsDroppedWithIt) {
  TryLog log;
  log.first = 5;
  for (const int part_of : {-1, 5, 6, -1, 8}) {
    Try one;
    one.part_of = part_of;
    one.outcome = Outcome::kept;
    log.tries.push_back(std::move(one));
  }
  log.tries[1].outcome = Outcome::failed;
  log.drop(5);
  std::vector<Outcome> found;
  for (const Try& one : log.tries) found.push_back(one.outcome);
  EXPECT_EQ(found, (std::vector{Outcome::not_better, Outcome::failed, Outcome::not_better,
                                Outcome::kept, Outcome::kept}));
}

// ---- Of an extraction ---------------------------------------------------------------------------

/// A limb whose vertices were moved by nearly its radius.
Shape ragged() {
  const Shape tube = shapes::tube("ragged", shapes::straight(4), shapes::constant(0.06), 12);
  return shapes::noisy(tube, 0.05, 1);
}

/// Every frame and curve is of a try that the history has under its number, and says its name.
class ShownWatch {
 public:
  Monitor monitor() {
    Monitor watching;
    watching.frame = [this](const Frame& frame) { note(frame.made_in, frame.stage); };
    watching.curve = [this](const CurveFrame& curve) { note(curve.made_in, curve.stage); };
    return watching;
  }
  void expect_all_in(const std::vector<Try>& history) const {
    for (const auto& [number, name, stage] : shown_) {
      ASSERT_GE(number, 0);
      ASSERT_LT(number, static_cast<int>(history.size()));
      std::string path;
      for (int at = number; at >= 0; at = history[static_cast<std::size_t>(at)].part_of) {
        const std::string& own = history[static_cast<std::size_t>(at)].name;
        if (own == try_as_asked || path.starts_with(own)) continue;
        path.insert(0, path.empty() ? "" : ", ");
        path.insert(0, own);
      }
      EXPECT_EQ(name, path.empty() ? "as asked" : path);
      const bool of_component = history[static_cast<std::size_t>(number)].component >= 0;
      EXPECT_EQ(of_component, stage != "fair");
    }
  }
  [[nodiscard]] std::set<int> numbers() const {
    std::set<int> all;
    for (const Shown& one : shown_) all.insert(one.number);
    return all;
  }

 private:
  struct Shown {
    int number;
    std::string name;
    std::string stage;
  };
  void note(const ShownTry& made_in, std::string_view stage) {
    shown_.push_back({made_in.number, std::string(made_in.name), std::string(stage)});
  }
  std::vector<Shown> shown_;
};

TEST(History, HasOneTryForWhatNeedsNoOther) {
  const Extraction found = extract(shapes::torus(3, 1, 20).surface, {}, {});
  ASSERT_EQ(found.history.size(), 2U);
  EXPECT_EQ(found.history[0].name, "as asked");
  EXPECT_EQ(found.history[0].component, -1);
  EXPECT_EQ(found.history[0].part_of, -1);
  EXPECT_EQ(found.history[0].why, "");
  EXPECT_EQ(found.history[0].outcome, Outcome::kept);
  ASSERT_TRUE(found.history[0].certificate);
  EXPECT_EQ(found.history[0].certificate->inside_fraction, found.certificate.inside_fraction);
  EXPECT_GT(found.history[0].seconds, 0);
  EXPECT_EQ(found.history[1].component, 0);
  EXPECT_EQ(found.history[1].part_of, 0);
  EXPECT_LE(found.history[1].seconds, found.history[0].seconds);
}

TEST(History, TellsWhySecondContractionsAndLevelSetsWereMade) {
  const Shape sieve = shapes::sieve(2);
  for (const double weight : {3.0, 1000.0}) {  // the second fails, too
    ExtractOptions options;
    options.resolution = 600;
    options.least_resolution = 200;
    options.fair_if_outside = options.all_vertices_if_failed = false;
    options.contraction.collapse_length = 2;
    options.contraction.contraction_weight = weight;
    ShownWatch watch;
    const Extraction found = extract(sieve.surface, options, watch.monitor());
    const bool level_sets = weight > 3;
    ASSERT_EQ(found.history.size(), level_sets ? 4U : 3U);
    for (std::size_t t = 2; t < found.history.size(); ++t) {
      EXPECT_EQ(found.history[t].name, t == 2 ? try_gentler : try_level_sets);
      EXPECT_EQ(found.history[t].why, found.history[t - 1].message);
      EXPECT_EQ(found.history[t - 1].outcome, Outcome::failed);
      EXPECT_EQ(found.history[t].part_of, 0);
      EXPECT_EQ(found.history[t].component, 0);
    }
    EXPECT_EQ(found.history.back().outcome, Outcome::kept);
    watch.expect_all_in(found.history);
    EXPECT_EQ(watch.numbers().size(), found.history.size() - 1);
  }
}

// Walls that the coarsened triangles cannot tell apart have other handles there. That was found
// when all was done, which then was all for nothing.
TEST(History, OfAComponentThatCoarseningCostsItsHandlesGoesOnFromAllVertices) {
  for (const int holes : {2, 3, 4}) {
    const Surface surface = thin_walled(holes, 0.02);
    shapes::Shape sieve = shapes::sieve(holes);
    sieve.surface = surface;
    const Surface two =
        shapes::together("two", {sieve, shapes::translated(sieve, {0, 0, 9})}).surface;
    for (const Surface& one : {surface, two}) {
      ExtractOptions options;
      options.resolution = 1;
      options.least_resolution = 1;
      ShownWatch watch;
      const Extraction found = extract(one, options, watch.monitor());
      EXPECT_TRUE(found.certificate.topology_correct()) << holes;
      watch.expect_all_in(found.history);
      const Extraction unwatched = extract(one, options);  // small ones side by side
      ASSERT_EQ(unwatched.history.size(), found.history.size());
      for (std::size_t t = 0; t < found.history.size(); ++t) {
        const Try& tried = found.history[t];
        EXPECT_EQ(unwatched.history[t].part_of, tried.part_of);
        EXPECT_EQ(unwatched.history[t].component, tried.component);
        if (tried.part_of < 0) {
          EXPECT_EQ(tried.name, try_as_asked);
        } else if (tried.name == try_all_vertices) {
          EXPECT_EQ(tried.part_of, 0);
          EXPECT_EQ(tried.outcome, Outcome::kept);
        } else if (tried.part_of > 0) {
          const Try& around = found.history[static_cast<std::size_t>(tried.part_of)];
          EXPECT_EQ(around.name, try_all_vertices);
          EXPECT_EQ(around.component, tried.component);
        }
      }
      for (const ComponentRecord& component : found.components) {
        EXPECT_EQ(component.working_vertices, component.vertices);
        EXPECT_TRUE(is_kept(found.history, try_all_vertices,
                            static_cast<int>(&component - found.components.data())));
      }
    }
  }
}

TEST(History, OfAComponentWhoseFinerTryFailsHasTheCoarsenedOne) {
  ExtractOptions options;
  options.resolution = 1;
  options.least_resolution = 1;
  Monitor monitor;
  monitor.frame = [](const Frame& frame) {
    if (frame.made_in.name.starts_with(try_all_vertices)) throw Error(Fault::input, "too fine");
  };
  const Extraction found = extract(thin_walled(3, 0.03), options, monitor);
  EXPECT_GT(found.skeleton.nodes.rows(), 0);
  EXPECT_LT(found.components[0].working_vertices, found.components[0].vertices);
  EXPECT_FALSE(is_kept(found.history, try_all_vertices));
  EXPECT_TRUE(is_kept(found.history, try_as_asked));
  int finer = 0;
  for (const Try& one : found.history) {
    if (one.name != try_all_vertices) continue;
    EXPECT_EQ(one.message, "too fine");
    ++finer;
  }
  EXPECT_GE(finer, 2) << "of the component, and of the whole";
}

// A second try's frames were those of the first, on top of them.
TEST(ThoroughHistory, TellsTheTriesApartInFramesAndCurves) {
  const RepairedSurface repaired = repair(soup_of(ragged().surface), {}, {});
  ShownWatch watch;
  const RepairedExtraction found = extract_repaired(repaired, {}, {}, watch.monitor());
  ASSERT_TRUE(found.repaired_again);
  const std::vector<Try>& history = found.extraction.history;
  watch.expect_all_in(history);
  EXPECT_GE(watch.numbers().size(), 3U);
  EXPECT_TRUE(is_kept(history, try_wrapped));
  EXPECT_FALSE(is_kept(history, try_faired));
  const auto whole = std::count_if(history.begin(), history.end(), [](const Try& one) {
    return one.part_of < 0 && one.outcome == Outcome::kept;
  });
  EXPECT_EQ(whole, 1);
}

/// Throws while the surface is faired for a second try.
template <typename Thrown>
Monitor failing_in_second_try(const Thrown& thrown) {
  Monitor monitor;
  monitor.frame = [thrown](const Frame& frame) {
    if (frame.stage == "fair") throw thrown;
  };
  return monitor;
}

TEST(History, OfASecondTryThatRunsOutOfMemoryKeepsTheFirst) {
  ExtractOptions options;
  options.certificate.inside_needed = 2;  // more than any curve has, so that it is always made
  const Surface surface = shapes::noisy(shapes::torus(3, 1, 20), 1e-3, 1).surface;
  ExtractOptions once = options;
  once.fair_if_outside = false;
  const Extraction first = extract(surface, once, {});
  const auto expect_first = [&](const Monitor& monitor, const std::string& message) {
    const Extraction found = extract(surface, options, monitor);
    EXPECT_EQ(found.skeleton.nodes, first.skeleton.nodes);
    EXPECT_TRUE(is_kept(found.history, try_as_asked));
    const auto faired = std::find_if(found.history.begin(), found.history.end(),
                                     [](const Try& one) { return one.name == try_faired; });
    ASSERT_NE(faired, found.history.end());
    EXPECT_EQ(faired->outcome, Outcome::failed);
    EXPECT_EQ(faired->message, message);
    EXPECT_FALSE(faired->certificate);
  };
  expect_first(failing_in_second_try(std::bad_alloc()), "out of memory");
  expect_first(failing_in_second_try(Error(Fault::input, "too thin")), "too thin");
  EXPECT_THROW((void)extract(surface, options, failing_in_second_try(Cancelled())), Cancelled);
  EXPECT_THROW(
      (void)extract(surface, options, failing_in_second_try(Error(Fault::usage, "option"))), Error);
}

/// Components of which a faired try was made, as no curve has enough of its length inside.
std::set<int> faired_components(const Surface& surface) {
  ExtractOptions options;
  options.resolution = 500;
  options.certificate.inside_needed = 2;
  options.all_vertices_if_failed = false;
  const Extraction found = extract(surface, options);
  std::set<int> components;
  for (const Try& one : found.history) {
    if (one.part_of >= 0 && found.history[static_cast<std::size_t>(one.part_of)].name == try_faired)
      components.insert(one.component);
  }
  return components;
}

// Plates of printers spent half of their time on fairing that had nothing to take away.
TEST(History, WithPlaneSidesHasNoFairedTry) {
  const Shape box = shapes::box({4, 1, 1}, 6);
  const Shape sieve = shapes::sieve(2);
  EXPECT_EQ(faired_components(box.surface), std::set<int>{});
  EXPECT_EQ(faired_components(sieve.surface), std::set<int>{});
  EXPECT_EQ(faired_components(shapes::noisy(box, 0.01, 1).surface), std::set{0});
  EXPECT_EQ(faired_components(shapes::noisy(sieve, 0.01, 1).surface), std::set{0});
  const Shape ring = shapes::translated(shapes::noisy(shapes::torus(3, 1, 20), 1e-3, 1), {0, 0, 9});
  EXPECT_EQ(faired_components(shapes::together("two", {box, ring}).surface), std::set{1});
}

}  // namespace
}  // namespace curveskel::tries_laws
