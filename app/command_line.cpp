#include "app/command_line.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <new>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include <curveskel/error.hpp>
#include "app/arguments.hpp"
#include "app/certificate_table.hpp"
#include "app/report.hpp"
#include "app/verbs/verbs.hpp"

namespace curveskel {
namespace {

constexpr const char* exit_codes =
    "Exit codes: 0 done, 1 defect of the program, 2 usage, 3 input, 4 device, 5 solver, time "
    "limit\n"
    "or failed certificate (see --strict of extract and evaluate), 6 output, 130 interrupted.";

int exit_code(Fault fault) {
  switch (fault) {
    case Fault::usage:
      return ExitCode::usage;
    case Fault::input:
      return ExitCode::input;
    case Fault::device:
      return ExitCode::device;
    case Fault::solver:
      return ExitCode::solver;
    case Fault::output:
      return ExitCode::output;
  }
  return ExitCode::internal;
}

/// A remedy, by the verb's own options, for a surface that is too much for the verb.
std::string remedy_of(const CLI::App& parser) {
  std::string remedy;
  const CLI::Option* const gap = parser.get_option_no_throw("--wrap-gap");
  if (gap != nullptr && gap->count() > 0) remedy = "choose a wider --wrap-gap, or ";
  const bool has_resolution = parser.get_option_no_throw("--resolution") != nullptr;
  if (has_resolution) remedy += "choose a coarser --resolution, or ";
  return remedy + "decimate the surface first";
}

/// Runs the verb; every exception ends here.
int run(const Verb& verb, Terminal& terminal) {
  const std::string remedy = remedy_of(*verb.parser);
  Interruption interruption(remedy);
  Session session{terminal, interruption};
  try {
    return verb.run(session);
  } catch (const Error& error) {
    terminal.error(error.what());
    return exit_code(error.fault());
  } catch (const UsageError& error) {
    terminal.error(error.what());
    return ExitCode::usage;
  } catch (const Cancelled&) {
    terminal.error(interruption.message());
    return interruption.reached_limit() > 0 ? ExitCode::solver : interruption.exit_code();
  } catch (const std::bad_alloc&) {
    terminal.error("out of memory; " + remedy);
    return ExitCode::solver;
  } catch (const std::exception& error) {
    terminal.error(fmt::format("a defect of the program: {}", error.what()));
    return ExitCode::internal;
  }
}

std::string options_of(const CLI::App& parser) {
  std::string names;
  for (const CLI::Option* option : parser.get_options()) {
    const bool is_shown = !option->get_positional() && !option->get_group().empty();
    if (is_shown) names += (names.empty() ? "" : ", ") + option->get_name();
  }
  return names;
}

std::string verbs_of(const CLI::App& program) {
  std::string names;
  for (const CLI::App* verb : program.get_subcommands({})) {
    names += (names.empty() ? "" : ", ") + verb->get_name();
  }
  return names;
}

/// The least number of letters put in, left out or changed (Levenshtein 1965).
std::size_t letters_apart(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t changed = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({changed, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

/// The option that was meant, or nothing.
std::string nearest_option(const CLI::App& verb, const std::string& given) {
  constexpr std::size_t most = 2;
  std::size_t least = most + 1;
  std::string nearest;
  for (const CLI::Option* option : verb.get_options()) {
    if (option->get_positional() || option->get_group().empty()) continue;
    const std::size_t apart = letters_apart(option->get_name(), given);
    if (apart >= least) continue;
    least = apart;
    nearest = option->get_name();
  }
  return nearest;
}

/// Of an option that there is not, or of a second surface.
std::string what_is_too_much(const CLI::App& verb) {
  const std::vector<std::string> rest = verb.remaining();
  const auto option = std::find_if(rest.begin(), rest.end(),
                                   [](const std::string& text) { return text.starts_with("-"); });
  if (option == rest.end()) {
    const bool takes_surface = verb.get_option_no_throw("MESH") != nullptr;
    return fmt::format("{} is one too many{}", rest.empty() ? "an argument" : rest.front(),
                       takes_surface ? "; one call is for one surface, ./run batch for many" : "");
  }
  const std::string name = option->substr(0, option->find('='));
  const std::string nearest = nearest_option(verb, name);
  if (!nearest.empty()) return name + " is no option; " + nearest + " is";
  return name + " is no option; the options are: " + options_of(verb);
}

/// Of a file whose name begins with a dash; empty if none is given.
std::string what_looks_like_an_option(const CLI::App& verb) {
  for (const std::string& text : verb.remaining()) {
    std::error_code none;
    if (!text.starts_with("-") || !std::filesystem::exists(text, none)) continue;
    return fmt::format("{0} begins as options do; for the file write ./{0}", text);
  }
  return "";
}

/// CLI11's words for options that are given too often or without a value, in plain ones.
std::string in_plain_words(std::string message) {
  const std::string often = "At Most 1 required but received ";
  if (const std::size_t at = message.find(often); at != std::string::npos) {
    return message.substr(0, at) + "needed once, given " + message.substr(at + often.size()) +
           " times";
  }
  const std::string lacks = ": 1 required ";
  const std::size_t at = message.find(lacks);
  if (at == std::string::npos || !message.ends_with(" missing")) return message;
  message.resize(message.size() - std::string(" missing").size());
  return message.substr(0, at) + ": needs a value, " + message.substr(at + lacks.size());
}

/// The fault in the arguments, and the right form.
std::string usage_message(const CLI::App& program, const CLI::ParseError& error) {
  const auto chosen = program.get_subcommands();
  if (chosen.empty()) {
    const auto rest = program.remaining();
    const std::string found = rest.empty() ? "a verb is missing" : rest.front() + " is no verb";
    return found + "; the verbs are: " + verbs_of(program);
  }
  const CLI::App& verb = *chosen.front();
  const bool has_extras = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr;
  const std::string file = what_looks_like_an_option(verb);
  const std::string fault = !file.empty() ? file
                            : has_extras  ? what_is_too_much(verb)
                                          : in_plain_words(error.what());
  const std::string message = verb.get_name() + ": " + fault;
  return message + "\nsee curveskel " + verb.get_name() + " --help";
}

}  // namespace

Monitor Session::monitor() const {
  Monitor monitor;
  monitor.progress = [this](std::string_view stage, double fraction) {
    terminal.progress(stage, fraction);
  };
  monitor.note = [this](std::string_view line) { terminal.note(line); };
  monitor.stop = interruption.token();
  return monitor;
}

int exit_code_of(const Certificate& certificate, const CertificateOptions& options, bool strict,
                 Session& session) {
  const std::string failed = all_failures(certificate, options);
  if (certificate.topology_correct() && (certificate.holds() || !strict)) {
    if (!failed.empty()) session.terminal.warn(failed);
    return ExitCode::done;
  }
  session.terminal.error("the certificate failed: " + failed);
  return ExitCode::solver;
}

int run_program(CLI::App& program, const std::vector<Verb>& verbs,
                const std::vector<std::string>& arguments) {
  Terminal terminal;
  program.require_subcommand(1);
  program.set_version_flag("--version", program_and_version());
  if (verbs.size() == 1) {  // whose name the user does not type
    verbs.front().parser->set_version_flag("--version", program_and_version());
  }
  program.footer(exit_codes);
  try {
    program.parse(std::vector(arguments.rbegin(), arguments.rend()));  // CLI11 starts at the back
  } catch (const CLI::Success& success) {
    return program.exit(success);
  } catch (const CLI::ParseError& error) {
    terminal.error(usage_message(program, error));
    return ExitCode::usage;
  }
  for (const Verb& verb : verbs) {
    if (verb.parser->parsed()) return run(verb, terminal);
  }
  return ExitCode::usage;
}

}  // namespace curveskel
