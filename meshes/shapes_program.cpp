// curveskel-shapes: writes the shapes of the catalogue as surface files.
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include "meshes/shapes.hpp"

namespace {

void print_usage(std::ostream& out) {
  out << "usage: curveskel-shapes NAME FILE [DIGITS]   one shape as .obj, .off or .ply\n"
         "       curveskel-shapes all FOLDER           every shape as FOLDER/NAME.off\n\nnames:\n";
  for (const auto& entry : curveskel::shapes::catalogue())
    out << "  " << entry.name << ": " << entry.meaning << '\n';
}

void print_line(const curveskel::shapes::Shape& shape, const std::filesystem::path& file) {
  std::cout << file.string() << ": " << shape.surface.positions.rows() << " vertices, "
            << shape.surface.triangles.rows() << " faces, genus " << shape.genus << ", "
            << shape.components << (shape.components == 1 ? " component\n" : " components\n");
}

int run(const std::vector<std::string>& arguments) {
  using namespace curveskel::shapes;
  if (arguments.size() < 2) {
    print_usage(arguments.empty() || arguments[0] != "--help" ? std::cerr : std::cout);
    return arguments.size() == 1 && arguments[0] == "--help" ? 0 : 2;
  }
  const int digits = arguments.size() > 2 ? std::atoi(arguments[2].c_str()) : 0;
  bool found = false;
  for (const auto& entry : catalogue()) {
    if (arguments[0] != "all" && arguments[0] != entry.name) continue;
    found = true;
    std::filesystem::path file = arguments[1];
    if (arguments[0] == "all") {
      std::filesystem::create_directories(file);
      file /= std::string(entry.name) + ".off";
    }
    const Shape shape = entry.make();
    write_surface(shape.surface, file, digits);
    print_line(shape, file);
  }
  if (found) return 0;
  std::cerr << "curveskel-shapes: no shape is called '" << arguments[0] << "'\n";
  print_usage(std::cerr);
  return 2;
}

}  // namespace

int main(int count, char** values) {
  try {
    return run(std::vector<std::string>(values + 1, values + count));
  } catch (const std::exception& error) {
    std::cerr << "curveskel-shapes: " << error.what() << '\n';
    return 6;
  }
}
