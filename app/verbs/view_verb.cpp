// curveskel view: hands over to curveskel-view, which stands beside this program.
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include <curveskel/error.hpp>
#include "app/arguments.hpp"
#include "app/command_line.hpp"
#include "app/verbs/verbs.hpp"

namespace curveskel {
namespace {

/// Path of the viewer if it is installed: beside this program.
std::filesystem::path viewer_program() {
  std::error_code error;
  return std::filesystem::read_symlink("/proc/self/exe", error).parent_path() / "curveskel-view";
}

/// Returns only by an exception: the process becomes the viewer.
int become_viewer(const std::vector<std::string>& arguments) {
  const std::string program = viewer_program().string();
  std::vector<std::string> words{program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  pointers.reserve(words.size() + 1);
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  execv(program.c_str(), pointers.data());
  throw Error(Fault::device, program + " cannot be started (" + std::strerror(errno) +
                                 "); `./run view` builds it in a checkout, the package "
                                 "curveskel-view has it");
}

}  // namespace

Verb add_view(CLI::App& program) {
  CLI::App* parser = program.add_subcommand(
      "view", "Watch a surface become its skeleton, or look at one (see view --help)");
  parser->prefix_command();  // all that follows is for the viewer to understand
  parser->set_help_flag();
  return {parser, [parser](Session&) { return become_viewer(parser->remaining()); }};
}

}  // namespace curveskel
