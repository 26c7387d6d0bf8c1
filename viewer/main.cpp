#include "app/arguments.hpp"
#include "app/command_line.hpp"
#include "viewer/view_verb.hpp"

int main(int argc, char** argv) {
  CLI::App program("The viewer of curveskel.", "curveskel");
  const std::vector<curveskel::Verb> verbs{curveskel::viewer::add_view(program)};
  std::vector<std::string> arguments{"view"};
  arguments.insert(arguments.end(), argv + 1, argv + argc);
  return curveskel::run_program(program, verbs, arguments);
}
