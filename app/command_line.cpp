#include "app/command_line.hpp"

#include <fmt/core.h>

#include <exception>
#include <new>
#include <string>
#include <vector>

#include <curveskel/error.hpp>
#include "app/arguments.hpp"
#include "app/report.hpp"
#include "app/verbs/verbs.hpp"

namespace curveskel {
namespace {

constexpr const char* exit_codes =
    "Exit codes: 0 done, 1 defect of the program, 2 usage, 3 input, 4 device, 5 solver or "
    "failed\n"
    "certificate, 6 output, 130 interrupted.";

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
    if (!option->get_positional()) names += (names.empty() ? "" : ", ") + option->get_name();
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

/// The fault in the arguments, and the right form.
std::string usage_message(const CLI::App& program, const CLI::ParseError& error) {
  const auto chosen = program.get_subcommands();
  if (chosen.empty()) {
    const auto rest = program.remaining();
    const std::string found = rest.empty() ? "a verb is missing" : rest.front() + " is no verb";
    return found + "; the verbs are: " + verbs_of(program);
  }
  const CLI::App& verb = *chosen.front();
  std::string message = verb.get_name() + ": " + error.what();
  if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) {
    message += "; the options are: " + options_of(verb);
  }
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

int run_program(CLI::App& program, const std::vector<Verb>& verbs,
                const std::vector<std::string>& arguments) {
  Terminal terminal;
  program.require_subcommand(1);
  program.set_version_flag("--version", program_and_version());
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
