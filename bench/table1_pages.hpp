// The paper's table beside ours: cells from and to CSV, Markdown, plots.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace curveskel::bench {

/// Vertices of the table's surfaces.
inline constexpr std::array<int, 4> table_sizes{648, 1416, 5664, 14952};

struct Cell {
  double preprocessing = 0;  ///< seconds
  double iteration = 0;
  double overall = 0;
  double residual = 0;  ///< the largest; global only
  bool predicted = false;
  std::string failure;  ///< empty = none
};

struct Row {
  std::string name;         ///< of the method
  std::string paper;        ///< its name in our table, empty for those beyond the paper
  std::vector<Cell> cells;  ///< one for each of table_sizes
};

/// Reads what `csv` wrote. Throws Error(Fault::input) where a line is not one of its, or a cell is
/// missing.
[[nodiscard]] std::vector<Row> read_rows(const std::filesystem::path& file);

/// The paper's own figures, by our names of its methods. Throws as read_rows does.
[[nodiscard]] std::vector<Row> read_paper_rows(const std::filesystem::path& file);

/// A line for each cell, the paper's seconds beside ours and how many times as fast ours is.
[[nodiscard]] std::string csv(const std::vector<Row>& rows, const std::vector<Row>& paper);

/// All rows, then those of the paper beside its own figures, cell by cell.
[[nodiscard]] std::string markdown(const std::vector<Row>& rows, const std::vector<Row>& paper);

/// The paper's figures dashed, with hollow squares, in the colour of ours.
[[nodiscard]] std::string plot(const std::vector<Row>& rows, const std::vector<Row>& paper,
                               const std::string& title, double Cell::*value);

}  // namespace curveskel::bench
