// The command line: verbs, exit codes, and messages about faults.
#pragma once

#include <string>
#include <vector>

#include <curveskel/certificate.hpp>
#include "app/verbs/verbs.hpp"

namespace curveskel {

/// Scripts rely on these; they never change.
struct ExitCode {
  static constexpr int done = 0;
  static constexpr int internal = 1;  ///< a defect of the program
  static constexpr int usage = 2;
  static constexpr int input = 3;
  static constexpr int device = 4;
  static constexpr int solver = 5;  ///< or a certificate that failed
  static constexpr int output = 6;
  static constexpr int interrupted = 130;  ///< by Ctrl-C
};

/// Of a skeleton that was made or judged; says how its certificate failed, if it did. A wrong
/// topology is an error, the rest a warning unless `strict`.
[[nodiscard]] int exit_code_of(const Certificate& certificate, const CertificateOptions& options,
                               bool strict, Session& session);

/// Parses the arguments (without the program's name), runs the verb and returns the exit code.
/// Nothing is thrown.
[[nodiscard]] int run_program(CLI::App& program, const std::vector<Verb>& verbs,
                              const std::vector<std::string>& arguments);

}  // namespace curveskel
