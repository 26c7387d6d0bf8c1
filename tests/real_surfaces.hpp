// The real surfaces that laws run over: always those of meshes/free; and a collection's where the
// variable CURVESKEL_COLLECTION names its folder. Both have an INDEX.csv of the same columns.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace curveskel {

/// The collection's folder; nothing where the laws have meshes/free alone.
inline std::optional<std::filesystem::path> collection_folder() {
  const char* folder = std::getenv("CURVESKEL_COLLECTION");
  if (folder == nullptr || *folder == '\0') return std::nullopt;
  if (!std::filesystem::exists(std::filesystem::path(folder) / "INDEX.csv")) {
    throw std::runtime_error("CURVESKEL_COLLECTION is " + std::string(folder) +
                             ", where no INDEX.csv is; name a folder with one, or unset it");
  }
  return folder;
}

inline std::vector<std::filesystem::path> real_surface_folders() {
  std::vector<std::filesystem::path> folders{std::filesystem::path(CURVESKEL_SOURCE_DIR) /
                                             "meshes/free"};
  if (const auto collection = collection_folder()) folders.push_back(*collection);
  return folders;
}

/// `file` as the index has it, with .gz at its end where it is stored gzipped.
inline std::optional<std::filesystem::path> real_surface(const std::string& file) {
  for (const auto& folder : real_surface_folders()) {
    for (const char* end : {"", ".gz"}) {
      if (const auto path = folder / (file + end); std::filesystem::exists(path)) return path;
    }
  }
  return std::nullopt;
}

/// Those of `files` that are there: with a collection all of them, else those of meshes/free,
/// of which there must be one.
inline std::vector<std::string> present_among(std::initializer_list<const char*> files) {
  std::vector<std::string> found;
  for (const char* file : files) {
    if (real_surface(file)) {
      found.emplace_back(file);
    } else if (collection_folder()) {
      throw std::runtime_error("the collection lacks " + std::string(file));
    }
  }
  if (found.empty()) throw std::runtime_error("none of a law's surfaces is in meshes/free");
  return found;
}

/// The fields of a line of comma-separated values, in which quoted ones may have commas.
inline std::vector<std::string> fields(const std::string& line) {
  std::vector<std::string> result(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      result.emplace_back();
    } else if (c != '\r') {
      result.back() += c;
    }
  }
  return result;
}

/// The index's lines, each surface once: header first, then the fields of each.
inline std::vector<std::vector<std::string>> real_surface_index() {
  std::vector<std::vector<std::string>> lines;
  for (const auto& folder : real_surface_folders()) {
    std::ifstream index(folder / "INDEX.csv");
    for (std::string line; std::getline(index, line);) {
      auto cells = fields(line);
      const auto is_same = [&](const auto& known) { return known[0] == cells[0]; };
      if (std::none_of(lines.begin(), lines.end(), is_same)) lines.push_back(std::move(cells));
    }
  }
  return lines;
}

/// The closed, manifold, orientable surfaces that the index lists outside defects/.
inline std::vector<std::string> closed_real_surfaces() {
  std::vector<std::string> files;
  for (const auto& cells : real_surface_index()) {
    if (cells.size() < 9 || cells[0].starts_with("defects/")) continue;
    if (cells[6] == "y" && cells[7] == "y" && cells[8] == "y") files.push_back(cells[0]);
  }
  return files;
}

}  // namespace curveskel
