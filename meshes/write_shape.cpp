#include <array>
#include <charconv>
#include <fstream>
#include <string>
#include <system_error>

#include <curveskel/error.hpp>
#include "meshes/shapes.hpp"

namespace curveskel::shapes {
namespace {

void append(std::string& text, double value, int digits) {
  std::array<char, 32> buffer{};
  char* const end = buffer.data() + buffer.size();
  const auto result =
      digits > 0 ? std::to_chars(buffer.data(), end, value, std::chars_format::general, digits)
                 : std::to_chars(buffer.data(), end, value);
  text.append(buffer.data(), result.ptr);
}

void append_positions(std::string& text, const Positions& positions, const char* prefix,
                      int digits) {
  for (Eigen::Index i = 0; i < positions.rows(); ++i) {
    text += prefix;
    for (int k = 0; k < 3; ++k) {
      if (k > 0) text += ' ';
      append(text, positions(i, k), digits);
    }
    text += '\n';
  }
}

void append_triangles(std::string& text, const Triangles& triangles, const char* prefix,
                      int first_index) {
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
    text += prefix;
    for (int k = 0; k < 3; ++k) {
      text += ' ';
      text += std::to_string(triangles(f, k) + first_index);
    }
    text += '\n';
  }
}

}  // namespace

void write_surface(const Surface& surface, const std::filesystem::path& file, int digits) {
  const std::string extension = file.extension().string();
  const std::string vertices = std::to_string(surface.positions.rows());
  const std::string faces = std::to_string(surface.triangles.rows());
  std::string text;
  if (extension == ".obj") {
    append_positions(text, surface.positions, "v ", digits);
    append_triangles(text, surface.triangles, "f", 1);
  } else if (extension == ".off" || extension == ".ply") {
    text = extension == ".off" ? "OFF\n" + vertices + ' ' + faces + " 0\n"
                               : "ply\nformat ascii 1.0\nelement vertex " + vertices +
                                     "\nproperty double x\nproperty double y\nproperty double z\n"
                                     "element face " +
                                     faces +
                                     "\nproperty list uchar int vertex_indices\n"
                                     "end_header\n";
    append_positions(text, surface.positions, "", digits);
    append_triangles(text, surface.triangles, "3", 0);
  } else {
    throw Error(Fault::output, file.string() + ": extension '" + extension +
                                   "' is none of .obj, .off, .ply; use one of these");
  }
  const std::filesystem::path partial = file.string() + ".partial";
  std::ofstream out(partial, std::ios::binary);
  out << text;
  out.close();
  std::error_code failure;
  if (out) std::filesystem::rename(partial, file, failure);
  if (!out || failure) {
    std::error_code ignored;
    std::filesystem::remove(partial, ignored);
    throw Error(Fault::output, file.string() + ": cannot be written; check folder and free space");
  }
}

}  // namespace curveskel::shapes
