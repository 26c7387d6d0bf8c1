#include "app/arguments.hpp"

#include <curveskel/read.hpp>
#include <curveskel/threads.hpp>

namespace curveskel {

void add_repair(CLI::App& parser, RepairOptions& options) {
  const auto set_components = [&options](const std::string& text) {
    if (text == "all") {
      options.components = 0;
    } else if (text == "largest") {
      options.components = 1;
    } else if (!CLI::detail::lexical_cast(text, options.components) || options.components < 1) {
      throw CLI::ValidationError("--components",
                                 "needs all, largest or a number from 1 up, not " + text);
    }
  };
  parser
      .add_option_function<std::string>("--components", set_components,
                                        "how many components, the largest by area first")
      ->type_name("all|largest|N")
      ->default_str("all");
  add_number(parser, "--min-size", options.least_area, 0.0, 1.0,
             "components with less than this share of the largest one's area are left out");
  add_choice(parser, "--wrap", options.wrap, wrappings,
             "what is wrapped (closed by shrinking a surface onto it): never, needed or all");
  add_number(parser, "--wrap-gap", options.wrap_gap, 0.0, 0.5,
             "gaps up to this are spanned by a wrap, of the diagonal of what is wrapped; 0 = "
             "chosen; below "
             "about 0.001 the wrap is too large to be made");
  add_number(parser, "--wrap-opening", options.wrap_gap, 0.0, 0.5, "its former name")->group("");
  add_number(parser, "--least-sheet", options.least_sheet, 0.0, 1.0,
             "sheets that no wrap makes a body of become thin bodies, if their extent is at least "
             "this, of the diagonal of the whole; 0 = none");
  add_number(parser, "--least-handle", options.least_handle, 0.0, 1.0,
             "small handles are cut, as noise leaves them in scans and volumes: short ones with a "
             "loop round them or through them up to this long, of the diagonal of the whole; 0 = "
             "none, unless a certificate fails; 0.03 is a good first try");
  parser.add_flag("--merge-overlapping", options.merge_overlapping,
                  "components that cross or touch become one body, those inside another are left "
                  "out; what merely comes near stays apart");
  parser.parse_complete_callback([&options] {
    if (options.wrap == Wrapping::never && options.wrap_gap > 0) {
      throw CLI::ValidationError("--wrap-gap", "needs a wrap, so not --wrap never");
    }
  });
}

void add_preset(CLI::App& parser, Preset& preset, RepairOptions& repair, ExtractOptions& options) {
  const auto set = [&preset, &repair, &options](const std::string& name) {
    const auto found = choice_of(presets, name);
    if (!found) throw CLI::ValidationError("--preset", name + " is none of: " + names_in(presets));
    preset = *found;
    use_preset(preset, repair, options);
  };
  parser
      .add_option_function<std::string>("--preset", set,
                                        "options that belong together; others override it")
      ->type_name("NAME")
      ->default_str(std::string(name_of(presets, preset)));
}

void add_surgery(CLI::App& parser, ExtractOptions& options) {
  add_choice(parser, "--surgery", options.surgery.method, surgery_methods,
             "how the contracted surface becomes a graph");
  add_choice(parser, "--embed", options.embed.method, embed_methods,
             "where the graph's nodes go then");
}

void add_mesh(CLI::App& parser, std::filesystem::path& mesh) {
  parser
      .add_option("MESH", mesh,
                  "surface file: " + names_in(surface_formats) +
                      ", vrm, or one of these gzipped; - is standard input")
      ->required()
      ->type_name("");
}

void add_threads(CLI::App& parser, int& threads) {
  add_number(parser, "--threads", threads, 0, most_threads,
             "at most; 0 = one per core; the result does not depend on it");
}

void add_time_limit(CLI::App& parser, double& seconds) {
  add_number(parser, "--time-limit", seconds, 0.0, 1e9,
             "seconds, then it ends with exit 5 and writes nothing more; 0 = none");
}

void add_vrm_meta(CLI::App& parser, VrmMeta& meta) {
  parser.add_option("--vrm-name", meta.name, "of the figure, for .vrm")->type_name("TEXT");
  parser.add_option("--vrm-author", meta.author, "of the figure, for .vrm")->type_name("TEXT");
  parser
      .add_option("--vrm-licence", meta.licence_url,
                  "address of its licence, for .vrm, as https://vrm.dev/licenses/1.0/")
      ->type_name("URL");
}

}  // namespace curveskel
