// One verb of the command line per file NAME_verb.cpp; this is their common part.
#pragma once

#include <functional>
#include <stdexcept>
#include <string>

#include <curveskel/monitor.hpp>
#include "app/interruption.hpp"
#include "app/terminal.hpp"

namespace CLI {
class App;
}

namespace curveskel {

/// The things that a verb works with.
struct Session {
  Terminal& terminal;
  Interruption& interruption;

  /// Progress to the terminal, Ctrl-C to the stages.
  [[nodiscard]] Monitor monitor() const;
};

/// A verb as it was added to the program; `run` returns the exit code.
struct Verb {
  CLI::App* parser = nullptr;
  std::function<int(Session&)> run;
};

/// Arguments that are each well formed but make no sense together.
class UsageError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

[[nodiscard]] Verb add_extract(CLI::App& program);
[[nodiscard]] Verb add_contract(CLI::App& program);
[[nodiscard]] Verb add_fair(CLI::App& program);
[[nodiscard]] Verb add_rig(CLI::App& program);
[[nodiscard]] Verb add_evaluate(CLI::App& program);
[[nodiscard]] Verb add_match(CLI::App& program);
/// Starts the viewer, a program of its own: this one links no OpenGL.
[[nodiscard]] Verb add_view(CLI::App& program);
[[nodiscard]] Verb add_devices(CLI::App& program);

}  // namespace curveskel
