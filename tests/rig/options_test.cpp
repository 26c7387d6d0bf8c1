// Every option of every stage: what is out of its range is refused, by name, before anything runs.
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

#include <curveskel.hpp>
#include "meshes/shapes.hpp"

namespace curveskel::options_laws {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr int largest = std::numeric_limits<int>::max();

/// One option: the range that a message says, values at its ends and beyond them.
template <typename Options>
struct Option {
  std::string name;
  std::string range;
  std::function<void(Options&, double)> set;
  std::vector<double> good;
  std::vector<double> bad;
};

/// `good` are the ends of the range.
template <typename Options, typename Value>
Option<Options> option(const std::string& name, Value Options::*member, const std::string& range,
                       std::vector<double> good, std::vector<double> bad) {
  if constexpr (std::is_same_v<Value, double>) {
    bad.insert(bad.end(), {not_a_number, infinity, -infinity});
  }
  return {name, range,
          [member](Options& options, double value) { options.*member = static_cast<Value>(value); },
          std::move(good), std::move(bad)};
}

template <typename Options>
Option<Options> threads() {
  return option("threads", &Options::threads, "0..4096", {0, 4096}, {-1, 4097});
}

template <typename Options>
std::string refusal(const Options& options) {
  try {
    require_valid(options);
  } catch (const Error& error) {
    return error.fault() == Fault::usage ? error.what() : "another fault";
  }
  return "";
}

template <typename Options>
void expect_ranges(const std::string& owner, const std::vector<Option<Options>>& all) {
  EXPECT_EQ(refusal(Options{}), "") << "the defaults of " << owner;
  for (const Option<Options>& one : all) {
    for (const double value : one.good) {
      Options options;
      one.set(options, value);
      EXPECT_EQ(refusal(options), "") << owner << "::" << one.name << " = " << value;
    }
    for (const double value : one.bad) {
      Options options;
      one.set(options, value);
      const std::string message = refusal(options);
      EXPECT_TRUE(message.starts_with(owner + "::" + one.name + " is "))
          << value << ": " << message;
      EXPECT_TRUE(message.ends_with(", needed " + one.range)) << value << ": " << message;
    }
  }
}

// The bindings do not compile once a struct has another number of members: so no option is
// forgotten below.
TEST(Options, OutOfRangeAreRefusedByNameValueAndRange) {
  const double over_one = 1 + 1e-9;
  {
    using O = RepairOptions;
    [[maybe_unused]] const auto& [a, b, c, d, e, f, g, h, i, j] = O{};
    expect_ranges<O>(
        "RepairOptions",
        {option("join_distance", &O::join_distance, "0..0.1", {0, 0.1}, {-1e-9, 0.11}),
         option("least_area", &O::least_area, "0..1", {0, 1}, {-1e-9, over_one}),
         option("components", &O::components, "0 or more", {0, largest}, {-1}),
         option("most_added_area", &O::most_added_area, "0..1", {0, 1}, {-1e-9, over_one}),
         option("least_crumb", &O::least_crumb, "0..1", {0, 1}, {-1e-9, over_one}),
         option("wrap", &O::wrap, "one of never, needed, all", {0, 1, 2}, {3, 200}),
         option("wrap_gap", &O::wrap_gap, "0..0.5", {0, 0.5}, {-1e-9, 0.51}),
         option("least_sheet", &O::least_sheet, "0..1", {0, 1}, {-1e-9, over_one}),
         option("least_handle", &O::least_handle, "0..1", {0, 1}, {-1e-9, over_one})});
  }
  {
    using O = CoarsenOptions;
    [[maybe_unused]] const auto& [a, b] = O{};
    expect_ranges<O>("CoarsenOptions", {option("target_vertices", &O::target_vertices, "0 or more",
                                               {0, largest}, {-1}),
                                        threads<O>()});
  }
  const std::string solver_names = "one of " + names_in(solvers);
  {
    using O = SolverOptions;
    [[maybe_unused]] const auto& [a, b, c, d, e] = O{};
    expect_ranges<O>(
        "SolverOptions",
        {option("solver", &O::solver, solver_names, {0, 9}, {-1, 10}),
         option("tolerance", &O::tolerance, "above 0 and up to 1", {1e-300, 1}, {0, over_one}),
         option("most_iterations", &O::most_iterations, "0 or more", {0, largest}, {-1}),
         threads<O>()});
  }
  {
    using O = ContractionOptions;
    [[maybe_unused]] const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n] = O{};
    const std::string weight = "above 0 and up to 1000000";
    const std::string million = "0..1000000";
    expect_ranges<O>(
        "ContractionOptions",
        {option("flow", &O::flow, "one of medial, paper", {0, 1}, {-1, 2}),
         option("solver", &O::solver, solver_names, {0, 9}, {-1, 10}),
         option("max_iterations", &O::max_iterations, million, {0, 1e6}, {-1, 1e6 + 1}),
         option("contraction_weight", &O::contraction_weight, weight, {1e-9, 1e6}, {0, -1, 2e6}),
         option("contraction_growth", &O::contraction_growth, "above 0 and up to 1000", {1e-9, 1e3},
                {0, -1, 1001}),
         option("medial_weight", &O::medial_weight, weight, {1e-9, 1e6}, {0, -1, 2e6}),
         option("paper_weight", &O::paper_weight, weight, {1e-9, 1e6}, {0, -1, 2e6}),
         option("attraction_weight", &O::attraction_weight, weight, {1e-9, 1e6}, {0, -1, 2e6}),
         option("collapse_length", &O::collapse_length, "0..1000", {0, 1000}, {-1e-9, 1001}),
         option("stop_volume_ratio", &O::stop_volume_ratio, "0..1", {0, 1}, {-1e-9, over_one}),
         option("stop_area_ratio", &O::stop_area_ratio, "0..1", {0, 1}, {-1e-9, over_one}),
         option("small_area_ratio", &O::small_area_ratio, "0..1", {0, 1}, {-1e-9, over_one}),
         threads<O>()});
  }
  {
    using O = FairOptions;
    [[maybe_unused]] const auto& [a, b, c, d, e, f, g, h, i] = O{};
    expect_ranges<O>(
        "FairOptions",
        {option("method", &O::method, "one of " + names_in(fair_methods), {0, 5}, {-1, 6}),
         option("iterations", &O::iterations, "0..1000000", {0, 1e6}, {-1, 1e6 + 1}),
         option("rings", &O::rings, "1..1000000", {1, 1e6}, {0, -1, 1e6 + 1}),
         option("local_solver", &O::local_solver, "one of closed, qr", {0, 1}, {-1, 2}),
         option("smoothing", &O::smoothing, "0..1000000", {0, 1e6}, {-1e-9, 2e6}),
         option("volume", &O::volume, "one of offset, scale, keep", {0, 2}, {-1, 3}),
         threads<O>()});
  }
  {
    using O = CertificateOptions;
    [[maybe_unused]] const auto& [a, b, c, d] = O{};
    expect_ranges<O>(
        "CertificateOptions",
        {option("sample_spacing", &O::sample_spacing, "1e-06..1", {1e-6, 1}, {0, -1, over_one}),
         option("inside_needed", &O::inside_needed, "0 or more", {0, 2}, {-1e-9}),
         option("rays", &O::rays, "3..4096", {3, 4096}, {0, 2, 4097}), threads<O>()});
  }
  {
    using O = SurgeryOptions;
    [[maybe_unused]] const auto& [method, a, b] = O{};
    expect_ranges<O>(
        "SurgeryOptions",
        {option("method", &O::method, "one of own, cgal", {0, 1}, {-1, 2}),
         option("shape_weight", &O::shape_weight, "0..1000000", {0, 1e6}, {-1e-9, 2e6}),
         option("sampling_weight", &O::sampling_weight, "0..1000000", {0, 1e6}, {-1e-9, 2e6})});
  }
  {
    using O = EmbedOptions;
    [[maybe_unused]] const auto& [method, a, b, c, d, e, f, g, h, i, j, below] = O{};
    const std::string radii = "0..1000";
    const std::string rounds = "0..1000000";
    expect_ranges<O>(
        "EmbedOptions",
        {option("method", &O::method, "one of own, none", {0, 1}, {-1, 2}),
         option("detail", &O::detail, "0..1", {0, 1}, {-1e-9, over_one}),
         option("merge", &O::merge, radii, {0, 1000}, {-1e-9, 1001}),
         option("straight", &O::straight, radii, {0, 1000}, {-1e-9, 1001}),
         option("straight_at_last", &O::straight_at_last, radii, {0, 1000}, {-1e-9, 1001}),
         option("first_rounds", &O::first_rounds, rounds, {0, 1e6}, {-1, 1e6 + 1}),
         option("relax_rounds", &O::relax_rounds, rounds, {0, 1e6}, {-1, 1e6 + 1}),
         option("smooth_rounds", &O::smooth_rounds, rounds, {0, 1e6}, {-1, 1e6 + 1}),
         option("keep_radius", &O::keep_radius, "0..1", {0, 1}, {-1e-9, over_one}),
         option("tip_reach", &O::tip_reach, radii, {0, 1000}, {-1e-9, 1001}),
         option("tip_gap", &O::tip_gap, radii, {0, 1000}, {-1e-9, 1001})});
  }
  {
    using O = ExtractOptions;
    [[maybe_unused]] const auto& [a, b, c, d, e, f, g, h, i, j, k, l] = O{};
    expect_ranges<O>(
        "ExtractOptions",
        {option("resolution", &O::resolution, "0 or more", {0, largest}, {-1}),
         option("least_resolution", &O::least_resolution, "0..1000000", {0, 1e6}, {-1, 1e6 + 1}),
         threads<O>()});
  }
  {
    using O = JointOptions;
    [[maybe_unused]] const auto& [a, b, c, d, e] = O{};
    const std::string radii = "0.01..1000000";
    expect_ranges<O>("JointOptions",
                     {option("root", &O::root, "-1 or more", {-1, largest}, {-2}),
                      option("bone_length", &O::bone_length, radii, {0.01, 1e6}, {0, -1, 2e6}),
                      option("bend", &O::bend, radii, {0.01, 1e6}, {0, -1, 2e6}),
                      option("straight_bone", &O::straight_bone, "0..1", {0, 1}, {-1, 2}),
                      option("least_bone", &O::least_bone, "0..1", {0, 1}, {-1, 2})});
  }
  {
    using O = SkinOptions;
    [[maybe_unused]] const auto& [a, b, c, d] = O{};
    expect_ranges<O>(
        "SkinOptions",
        {option("softness", &O::softness, "0.001..1000", {0.001, 1000}, {0, -1, 1001}),
         option("most_joints", &O::most_joints, "1..8", {1, 8}, {0, -1, 9, 12, largest}),
         option("least_weight", &O::least_weight, "0..0.1", {0, 0.1}, {-1e-9, 0.11}),
         threads<O>()});
  }
  [[maybe_unused]] const auto& [joints, skin, faces_minus_z] = RigOptions{};
}

const shapes::Shape& bar() {
  static const shapes::Shape shape =
      shapes::tube("", shapes::straight(8), shapes::constant(0.7), 12);
  return shape;
}

/// Whether the call is refused for an option of this struct.
bool refuses(const std::string& owner, const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.fault() == Fault::usage && std::string(error.what()).starts_with(owner + "::");
  }
  return false;
}

TEST(Options, AreLookedAtByEveryFunctionThatTakesThem) {
  const Surface& surface = bar().surface;
  const CurveSkeleton& axis = bar().axis;
  const SurfaceTree tree(surface);
  const CertificateOptions no_rays{.rays = 0};
  const SkinOptions too_many{.most_joints = 12};
  RepairOptions no_repair;
  no_repair.components = -1;
  SolverOptions no_tolerance;
  no_tolerance.tolerance = 0;
  ContractionOptions no_weight;
  no_weight.contraction_weight = 0;
  FairOptions no_rings;
  no_rings.rings = 0;
  EXPECT_TRUE(refuses("RepairOptions", [&] { (void)repair(soup_of(surface), no_repair); }));
  EXPECT_TRUE(refuses("CoarsenOptions", [&] { (void)coarsen(surface, {.target_vertices = -1}); }));
  EXPECT_TRUE(refuses("SolverOptions", [&] { (void)LeastSquares(no_tolerance); }));
  EXPECT_TRUE(refuses("ContractionOptions", [&] { (void)contract(surface, {}, no_weight); }));
  EXPECT_TRUE(refuses("FairOptions", [&] { (void)fair(surface, no_rings); }));
  EXPECT_TRUE(refuses("CertificateOptions", [&] { (void)evaluate(surface, axis, no_rays); }));
  EXPECT_TRUE(refuses("CertificateOptions", [&] {
    (void)evaluate({surface, tree, 8, 1, 0}, axis, no_rays, {});
  }));
  EXPECT_TRUE(refuses("CertificateOptions", [&] { (void)findings(tree, 8, axis, no_rays, {}); }));
  EXPECT_TRUE(refuses("CertificateOptions",
                      [&] { (void)common_ground(tree, 8, axis, axis, no_rays, {}); }));
  EXPECT_TRUE(refuses("SurgeryOptions",
                      [&] { (void)surgery(surface, Contraction{}, {.shape_weight = -1}); }));
  EXPECT_TRUE(refuses("EmbedOptions", [&] {
    (void)embed({surface, tree, [&]() -> const SurfaceTree& { return tree; }, {}, {}},
                {.detail = 2}, 1, {});
  }));
  EXPECT_TRUE(refuses("JointOptions", [&] { (void)place_joints(axis, {.bend = 0}); }));
  EXPECT_TRUE(
      refuses("SkinOptions", [&] { (void)skin_weights(surface, axis, {}, {}, 1, too_many); }));
  EXPECT_TRUE(refuses("SkinOptions", [&] { (void)make_rig(surface, axis, {{}, too_many}); }));
  EXPECT_TRUE(refuses("JointOptions", [&] {
    (void)make_rig(surface, axis, {{.bone_length = 0}, {}});
  }));
  const RepairedSurface repaired = repair(soup_of(surface));
  EXPECT_TRUE(refuses("RepairOptions", [&] { (void)extract_repaired(repaired, no_repair); }));
  EXPECT_TRUE(
      refuses("RepairOptions", [&] { (void)evaluate_repaired(repaired, no_repair, axis); }));
  EXPECT_TRUE(
      refuses("CertificateOptions", [&] { (void)evaluate_repaired(repaired, {}, axis, no_rays); }));
}

TEST(Options, OfEveryStageAreLookedAtByExtract) {
  const std::vector<std::pair<std::string, std::function<void(ExtractOptions&)>>> spoilt = {
      {"ExtractOptions", [](ExtractOptions& o) { o.threads = -1; }},
      {"ExtractOptions",
       [](ExtractOptions& o) {
         o.rims = {{0, 1, 1 << 30}};
       }},
      {"ExtractOptions", [](ExtractOptions& o) { o.rims = {{-1}}; }},
      {"FairOptions", [](ExtractOptions& o) { o.fair.smoothing = -1; }},
      {"ContractionOptions", [](ExtractOptions& o) { o.contraction.contraction_weight = 0; }},
      {"SurgeryOptions", [](ExtractOptions& o) { o.surgery.sampling_weight = -1; }},
      {"EmbedOptions", [](ExtractOptions& o) { o.embed.keep_radius = 2; }},
      {"CertificateOptions", [](ExtractOptions& o) { o.certificate.rays = 0; }}};
  for (const auto& [owner, spoil] : spoilt) {
    ExtractOptions options;
    spoil(options);
    ExtractionCache cache;
    EXPECT_TRUE(refuses(owner, [&] { (void)extract(bar().surface, options); })) << owner;
    EXPECT_TRUE(refuses(owner, [&] { (void)extract(bar().surface, options, {}, cache); })) << owner;
    if (!options.rims.empty()) continue;  // has those of the repair instead
    EXPECT_TRUE(refuses(owner, [&] {
      (void)extract_repaired(repair(soup_of(bar().surface)), {}, options);
    })) << owner;
  }
}

TEST(Options, OfARepairAreEqualWhereAllOfThemAre) {
  const std::vector<std::function<void(RepairOptions&)>> changes = {
      [](RepairOptions& o) { o.join_distance = 0; },   [](RepairOptions& o) { o.least_area = 0; },
      [](RepairOptions& o) { o.components = 1; },      [](RepairOptions& o) { o.least_crumb = 0; },
      [](RepairOptions& o) { o.most_added_area = 0; }, [](RepairOptions& o) { o.wrap_gap = 0.1; },
      [](RepairOptions& o) { o.wrap = Wrapping::all; }};
  EXPECT_EQ(RepairOptions{}, RepairOptions{});
  for (const auto& change : changes) {
    RepairOptions options;
    change(options);
    EXPECT_NE(options, RepairOptions{});
  }
}

}  // namespace
}  // namespace curveskel::options_laws
