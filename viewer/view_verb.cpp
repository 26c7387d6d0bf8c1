// curveskel-view, the program behind `curveskel view`.
#include "viewer/view_verb.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <string>

#include <curveskel/rig_polygons.hpp>
#include "app/arguments.hpp"
#include "app/command_line.hpp"
#include "app/kernel_cache.hpp"
#include "app/output_files.hpp"
#include "viewer/headless/screenshot.hpp"
#include "viewer/view_options.hpp"
#include "viewer/window/window.hpp"

namespace curveskel::viewer {
namespace {

constexpr int largest_picture = 16384;

constexpr NameTable<SkeletonFormat, 1> picture_formats{{
    {SkeletonFormat::png, "png", "Portable Network Graphics"},
}};

std::string set_size(ViewOptions& options, const std::string& text) {
  const auto cross = text.find('x');
  int width = 0;
  int height = 0;
  const bool read = cross != std::string::npos &&
                    CLI::detail::lexical_cast(text.substr(0, cross), width) &&
                    CLI::detail::lexical_cast(text.substr(cross + 1), height);
  if (!read || width < 1 || height < 1 || width > largest_picture || height > largest_picture) {
    return "needs WIDTHxHEIGHT in pixels, each from 1 to " + std::to_string(largest_picture) +
           ", not " + text;
  }
  options.width = width;
  options.height = height;
  return {};
}

std::string set_camera(ViewOptions& options, const std::string& text) {
  const auto wish = camera_wish(text);
  if (!wish) {
    return "needs one of " + names_in(sides) + ", or AZIMUTH,ELEVATION[,ZOOM] in degrees, not " +
           text;
  }
  options.camera = *wish;
  return {};
}

std::string set_stage(ViewOptions& options, const std::string& text) {
  const auto colon = text.find(':');
  const std::string name = text.substr(0, colon);
  StageWish wish;
  wish.stage = name == "fairing" ? "fair" : name == "contraction" ? "contract" : name;
  const bool counted = name == "fairing" || name == "contraction";
  const bool known =
      counted || name == "input" || name == "surgery" || name == "skeleton" || name == "rig";
  const bool read = colon == std::string::npos ||
                    (counted && CLI::detail::lexical_cast(text.substr(colon + 1), wish.iteration) &&
                     wish.iteration >= 0);
  if (!known || !read) {
    return "needs input, fairing[:K], contraction[:K], surgery, skeleton or rig, not " + text;
  }
  options.stage = wish;
  options.stage_given = true;
  // As `rig` repairs; `--least-sheet` is read later and has the last word.
  if (wish.stage == "rig") options.pipeline.repair.least_sheet = repair_for_rigs().least_sheet;
  return {};
}

std::string add_turn(ViewOptions& options, const std::string& text) {
  const auto colon = text.rfind(':');
  JointTurn turn;
  turn.joint = text.substr(0, colon);
  std::vector<double> degrees;
  const bool read = colon != std::string::npos &&
                    CLI::detail::lexical_conversion<std::vector<double>, std::vector<double>>(
                        CLI::detail::split(text.substr(colon + 1), ','), degrees);
  if (!read || degrees.size() != turn.degrees.size()) {
    return "needs JOINT:X,Y,Z in degrees, not " + text;
  }
  std::copy(degrees.begin(), degrees.end(), turn.degrees.begin());
  options.turns.push_back(turn);
  return {};
}

/// An option whose text `set` understands; its answer names the fault.
template <typename Set>
CLI::Option* add_text(CLI::App& parser, ViewOptions& options, const std::string& flag,
                      const std::string& type, const std::string& meaning, const Set& set) {
  return parser
      .add_option_function<std::string>(
          flag,
          [flag, set, &options](const std::string& text) {
            const std::string wrong = set(options, text);
            if (!wrong.empty()) throw CLI::ValidationError(flag, wrong);
          },
          meaning)
      ->type_name(type);
}

void add_look(CLI::App& parser, Look& look) {
  add_choice(parser, "--surface", look.surface, surface_styles, "how the surface is drawn");
  add_choice(parser, "--skeleton", look.skeleton, skeleton_styles, "how the skeleton is drawn");
  add_choice(parser, "--colour,--color", look.surface_colour, colourings, "the surface's colours");
  add_choice(parser, "--skeleton-colour,--skeleton-color", look.skeleton_colour, colourings,
             "the skeleton's colours");
  add_choice(parser, "--map", look.map, colour_maps, "colours of numbers");
  add_choice(parser, "--theme", look.theme, themes, "light or dark");
  add_number(parser, "--opacity", look.opacity, 0.0F, 1.0F, "of the transparent surface");
  add_number(parser, "--thickness", look.thickness, 0.05F, 20.0F, "of the skeleton's tubes");
  parser.add_flag_callback(
      "--no-bones", [&look] { look.bones = false; }, "leave out a rig's joints and bones");
  parser.add_flag("--edges", look.edges, "draw the surface's edges, too");
  parser.add_flag("--transparent", look.transparent_background, "pictures without a background");
}

int run_view(ViewOptions options, Session& session) {
  options.pipeline.extract.fairing = options.pipeline.extract.fair.iterations > 0;
  if (std::find(options.files.begin(), options.files.end(), "-") != options.files.end()) {
    throw UsageError("view reads no standard input, found -; name a file");
  }
  const bool pictures = !options.screenshot.empty() || !options.turntable.empty();
  if (options.two_sides && options.screenshot.empty()) {
    throw UsageError("--two-sides is for --screenshot");
  }
  if (!options.screenshot.empty()) (void)format_of(options.screenshot, picture_formats);
  if (!pictures && !options.turns.empty()) throw UsageError("--turn is for pictures");
  if (pictures && !options.may_be_coarse) throw UsageError("--never-coarse is for the window");
  if (!pictures) return run_window(options, session);
  if (!(options.vrm.name + options.vrm.author + options.vrm.licence_url).empty()) {
    throw UsageError("--vrm-name, --vrm-author and --vrm-licence are for the window");
  }
  if (options.files.empty()) throw UsageError("a picture of what? name a surface or a skeleton");
  if (!options.frame_times.empty()) throw UsageError("--frame-times is for the window");
  session.interruption.limit(options.time_limit_seconds);  // of a window: its runs
  if (!options.screenshot.empty()) check_outputs({options.screenshot}, options.files);
  const std::string written = write_pictures(options, session);
  session.terminal.end_progress();
  session.terminal.result(written);
  return ExitCode::done;
}

void add_pictures(CLI::App& parser, ViewOptions& options) {
  parser.add_option("--screenshot", options.screenshot, "write a picture and open no window")
      ->type_name("OUT.png");
  parser.add_flag("--two-sides", options.two_sides,
                  "the screenshot shows the surface from its best side and at a right angle to it");
  CLI::Option* const turntable =
      parser.add_option("--turntable", options.turntable, "folder for pictures from all around")
          ->type_name("DIR");
  add_number(parser, "--frames", options.frames, 1, 10000, "of the turntable")->needs(turntable);
  add_text(parser, options, "--size", "WxH", "of the window or the picture, in pixels", set_size)
      ->default_str("1600x1000");
  add_text(parser, options, "--camera", "VIEW",
           names_in(sides) + ", or AZIMUTH,ELEVATION[,ZOOM] in degrees from best", set_camera);
  add_text(parser, options, "--stage", "STAGE",
           "the moment to show: input, fairing[:K], contraction[:K], surgery, skeleton, rig",
           set_stage);
}

void add_appearance(CLI::App& parser, const std::shared_ptr<ViewOptions>& options) {
  parser.add_flag_callback(
      "--orthographic", [options] { options->perspective = false; }, "no perspective");
  parser.add_flag_callback(
      "--no-run", [options] { options->run = false; }, "do not extract the skeleton at once");
  parser.add_flag_callback(
      "--never-coarse", [options] { options->may_be_coarse = false; },
      "draw all of the surface while it moves, too, however long that takes");
  add_look(parser, options->look);
  parser.add_option("--joint", options->joint, "of a rig: the one whose weights are shown")
      ->type_name("NAME");
  parser
      .add_option_function<std::vector<std::string>>(
          "--turn",
          [options](const std::vector<std::string>& all) {
            for (const std::string& text : all) {
              const std::string wrong = add_turn(*options, text);
              if (!wrong.empty()) throw CLI::ValidationError("--turn", wrong);
            }
          },
          "of a rig, in pictures: turn a joint about x, y and z by so many degrees; may be "
          "repeated")
      ->type_name("JOINT:X,Y,Z");
  parser
      .add_option("--frame-times", options->frame_times,
                  "milliseconds of each picture in the window, written when it is closed")
      ->type_name("FILE.csv");
}

void add_extraction(CLI::App& parser, ViewOptions& options) {
  ExtractOptions& extract_options = options.pipeline.extract;
  add_surgery(parser, extract_options);
  extract_options.contraction.program_cache = kernel_cache();
  extract_options.fair.program_cache = kernel_cache();
  add_number(parser, "--detail", extract_options.embed.detail, 0.0, 1.0,
             "0..1: how small a branch may be");
  add_number(parser, "--fair", extract_options.fair.iterations, 0, 1000000,
             "iterations of fairing before the contraction, for noisy surfaces");
  add_threads(parser, extract_options.threads);
  add_repair(parser, options.pipeline.repair);
  add_number(parser, "--time-limit", options.time_limit_seconds, 0.0, 1e9,
             "seconds; then a picture ends with exit 5, and the window cancels the run and stays "
             "open; 0 = none");
}

}  // namespace

Verb add_view(CLI::App& program) {
  const auto options = std::make_shared<ViewOptions>();
  CLI::App* parser =
      program.add_subcommand("view", "Watch a surface become its skeleton, or look at one");
  ExtractOptions& extract_options = options->pipeline.extract;
  extract_options.fair.iterations = 0;
  add_preset(*parser, options->preset, options->pipeline.repair, extract_options);
  parser->add_option("FILE", options->files, "a surface, a skeleton, or one of each; a rig (glTF)")
      ->type_name("");
  add_pictures(*parser, *options);
  add_appearance(*parser, options);
  add_extraction(*parser, *options);
  add_vrm_meta(*parser, options->vrm);
  parser->footer(meanings("Presets", presets) + meanings("Surgeries", surgery_methods) +
                 meanings("Embeddings", embed_methods) + meanings("Surface", surface_styles) +
                 meanings("Skeleton", skeleton_styles) + meanings("Colours", colourings) +
                 meanings("Views", sides));
  return {parser, [options](Session& session) { return run_view(*options, session); }};
}

}  // namespace curveskel::viewer
