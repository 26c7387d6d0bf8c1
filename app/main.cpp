#include "app/arguments.hpp"
#include "app/command_line.hpp"
#include "app/heap.hpp"
#include "app/verbs/verbs.hpp"

int main(int argc, char** argv) {
  using namespace curveskel;
  use_large_pages();
  CLI::App program("Curve skeletons of triangle surfaces.", "curveskel");
  const std::vector<Verb> verbs{add_extract(program), add_rig(program),      add_contract(program),
                                add_fair(program),    add_evaluate(program), add_match(program),
                                add_view(program),    add_devices(program)};
  return run_program(program, verbs, {argv + 1, argv + argc});
}
