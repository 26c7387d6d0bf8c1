#include "bench/table1_pages.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <string_view>
#include <utility>

#include <curveskel/error.hpp>
#include "bench/log_plot.hpp"

namespace curveskel::bench {
namespace {

namespace fs = std::filesystem;

/// Our name of a method and the paper's.
constexpr std::array<std::pair<std::string_view, std::string_view>, 6> methods_of_paper{{
    {"dense-qr", "Global CPU (Jama QR)"},
    {"vcl-qr", "VCL-QR"},
    {"vcl-lsm", "VCL-LSM"},
    {"fair cpu", "Local CPU (Jama QR)"},
    {"fair opencl-transfer", "OpenCL transfer"},
    {"fair opencl-interop", "OpenCL interop"},
}};

/// A CSV file without its comments: the last field of a line may have commas.
struct Lines {
  fs::path file;
  std::vector<std::string> head;
  std::vector<std::vector<std::string>> lines;

  [[nodiscard]] const std::string& field(const std::vector<std::string>& line,
                                         std::string_view name) const {
    const auto column = std::find(head.begin(), head.end(), name);
    if (column == head.end()) {
      throw Error(Fault::input, fmt::format("{}: no column {}", file.string(), name));
    }
    return line[static_cast<std::size_t>(column - head.begin())];
  }
};

std::vector<std::string> fields_of(const std::string& line, std::size_t most) {
  std::vector<std::string> fields;
  std::size_t from = 0;
  for (std::size_t comma = 0; fields.size() + 1 < most; from = comma + 1) {
    comma = line.find(',', from);
    if (comma == std::string::npos) break;
    fields.push_back(line.substr(from, comma - from));
  }
  fields.push_back(line.substr(from));
  return fields;
}

Lines lines_of(const fs::path& file) {
  std::ifstream in(file);
  if (!in) {
    throw Error(Fault::input, file.string() + ": cannot be read; name a table of this program");
  }
  Lines found;
  found.file = file;
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#') continue;
    if (found.head.empty()) {
      found.head = fields_of(line, line.size() + 1);
      continue;
    }
    found.lines.push_back(fields_of(line, found.head.size()));
    if (found.lines.back().size() != found.head.size()) {
      throw Error(Fault::input,
                  fmt::format("{}: found {} fields in \"{}\", needed {}", file.string(),
                              found.lines.back().size(), line, found.head.size()));
    }
  }
  return found;
}

double number_in(const std::string& text, const fs::path& file) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) {
    throw Error(Fault::input, fmt::format("{}: \"{}\" is no number", file.string(), text));
  }
  return number;
}

/// The cell of `name` and `vertices`, of a row that is made if there is none yet.
Cell& cell_at(std::vector<Row>& rows, const std::string& name, const std::string& paper,
              const std::string& vertices, const fs::path& file) {
  const auto size = static_cast<int>(number_in(vertices, file));
  const auto column = std::find(table_sizes.begin(), table_sizes.end(), size);
  if (column == table_sizes.end()) {
    throw Error(Fault::input, fmt::format("{}: the table has no surface of {} vertices",
                                          file.string(), vertices));
  }
  auto row = std::find_if(rows.begin(), rows.end(), [&](const Row& r) { return r.name == name; });
  if (row == rows.end()) {
    Cell missing;
    missing.failure = "not run";
    rows.push_back({name, paper, std::vector<Cell>(table_sizes.size(), missing)});
    row = rows.end() - 1;
  }
  Cell& cell = row->cells[static_cast<std::size_t>(column - table_sizes.begin())];
  cell.failure.clear();
  return cell;
}

std::string unquoted(const std::string& text) {
  return text.size() < 2 ? text : text.substr(1, text.size() - 2);
}

const Row* row_of(const std::vector<Row>& rows, const std::string& name) {
  const auto found =
      std::find_if(rows.begin(), rows.end(), [&](const Row& row) { return row.name == name; });
  return found == rows.end() ? nullptr : &*found;
}

/// The paper's value over ours, so above 1 where ours is faster; 0 where there is no figure.
double times_as_fast(const Cell& ours, const Cell& theirs, double Cell::*value) {
  if (!ours.failure.empty() || !(ours.*value > 0)) return 0;
  return theirs.*value / (ours.*value);
}

std::string cell_words(const Cell& cell, double value) {
  if (!cell.failure.empty()) return "no";
  return cell.predicted ? fmt::format("*{:.3g}*", value) : fmt::format("{:.3g}", value);
}

std::string ratio_words(const Cell& cell, double ratio) {
  return ratio > 0 ? cell_words(cell, ratio) : "";
}

std::string all_methods(const std::vector<Row>& rows) {
  std::string text =
      "Seconds: preprocessing / one iteration / overall. *Slanted*: predicted from the size "
      "before, "
      "not run. no: refused or failed, see below.\n\n| method | in the paper |";
  for (const int size : table_sizes) text += fmt::format(" {} |", size);
  text += "\n|---|---|---|---|---|---|\n";
  std::string reasons;
  for (const Row& row : rows) {
    text += fmt::format("| `{}` | {} |", row.name, row.paper);
    for (const Cell& cell : row.cells) {
      text += cell.failure.empty()
                  ? fmt::format(" {} / {} / {} |", cell_words(cell, cell.preprocessing),
                                cell_words(cell, cell.iteration), cell_words(cell, cell.overall))
                  : " no |";
    }
    text += "\n";
    const auto failed = std::find_if(row.cells.begin(), row.cells.end(),
                                     [](const Cell& c) { return !c.failure.empty(); });
    if (failed != row.cells.end()) reasons += fmt::format("- {}\n", failed->failure);
  }
  return text + "\n" + reasons;
}

std::string beside_the_paper(const std::vector<Row>& rows, const std::vector<Row>& paper) {
  std::string text =
      "Seconds in the paper, here, and how many times as fast it is here (below 1: slower).\n\n"
      "| method | vertices | preprocessing, paper | here | times | iteration, paper | here | times "
      "| overall, paper | here | times |\n|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const Row& row : rows) {
    const Row* const theirs = row_of(paper, row.name);
    if (theirs == nullptr) continue;
    for (std::size_t i = 0; i < table_sizes.size(); ++i) {
      const Cell& cell = row.cells[i];
      text += fmt::format("| `{}` | {} |", row.name, table_sizes[i]);
      for (const auto value : {&Cell::preprocessing, &Cell::iteration, &Cell::overall}) {
        text +=
            fmt::format(" {} | {} | {} |", theirs->cells[i].*value, cell_words(cell, cell.*value),
                        ratio_words(cell, times_as_fast(cell, theirs->cells[i], value)));
      }
      text += "\n";
    }
  }
  return text;
}

/// Of the cells that have a value.
Series series_of(const Row& row, double Cell::*value) {
  Series series;
  series.name = row.name;
  for (std::size_t i = 0; i < table_sizes.size(); ++i) {
    if (!row.cells[i].failure.empty() || !(row.cells[i].*value > 0)) continue;
    series.x.push_back(table_sizes[i]);
    series.y.push_back(row.cells[i].*value);
    series.predicted.push_back(row.cells[i].predicted);
  }
  return series;
}

}  // namespace

std::vector<Row> read_rows(const fs::path& file) {
  const Lines found = lines_of(file);
  std::vector<Row> rows;
  for (const auto& line : found.lines) {
    const auto number = [&](std::string_view name) {
      return number_in(found.field(line, name), file);
    };
    Cell& cell = cell_at(rows, found.field(line, "method"), found.field(line, "paper"),
                         found.field(line, "vertices"), file);
    cell.preprocessing = number("preprocessing_s");
    cell.iteration = number("iteration_s");
    cell.overall = number("overall_s");
    cell.residual = number("residual");
    cell.predicted = found.field(line, "predicted") == "1";
    cell.failure = unquoted(found.field(line, "failure"));
  }
  return rows;
}

std::vector<Row> read_paper_rows(const fs::path& file) {
  const Lines found = lines_of(file);
  std::vector<Row> rows;
  for (const auto& line : found.lines) {
    const auto number = [&](std::string_view name) {
      return number_in(found.field(line, name), file);
    };
    const std::string& name = found.field(line, "method");
    const auto method = std::find_if(methods_of_paper.begin(), methods_of_paper.end(),
                                     [&](const auto& names) { return names.second == name; });
    if (method == methods_of_paper.end()) {
      throw Error(Fault::input, file.string() + ": unknown method \"" + name + "\"");
    }
    Cell& cell =
        cell_at(rows, std::string(method->first), name, found.field(line, "vertices"), file);
    cell.preprocessing = number("preprocess_s");
    cell.iteration = number("iteration_s");
    cell.overall = number("overall_s");
  }
  return rows;
}

std::string csv(const std::vector<Row>& rows, const std::vector<Row>& paper) {
  std::string text =
      "method,paper,vertices,preprocessing_s,iteration_s,overall_s,residual,predicted,"
      "paper_preprocessing_s,paper_iteration_s,paper_overall_s,times_as_fast_preprocessing,"
      "times_as_fast_iteration,times_as_fast_overall,failure\n";
  for (const Row& row : rows) {
    const Row* const theirs = row_of(paper, row.name);
    for (std::size_t i = 0; i < table_sizes.size(); ++i) {
      const Cell& c = row.cells[i];
      text += fmt::format("{},{},{},{:.6g},{:.6g},{:.6g},{:.3g},{},", row.name, row.paper,
                          table_sizes[i], c.preprocessing, c.iteration, c.overall, c.residual,
                          c.predicted ? 1 : 0);
      std::string ratios;
      for (const auto value : {&Cell::preprocessing, &Cell::iteration, &Cell::overall}) {
        text += theirs == nullptr ? "," : fmt::format("{},", theirs->cells[i].*value);
        const double ratio = theirs == nullptr ? 0 : times_as_fast(c, theirs->cells[i], value);
        ratios += ratio > 0 ? fmt::format("{:.3g},", ratio) : ",";
      }
      text += fmt::format("{}\"{}\"\n", ratios, c.failure);
    }
  }
  return text;
}

std::string markdown(const std::vector<Row>& rows, const std::vector<Row>& paper) {
  return all_methods(rows) + "\n" + beside_the_paper(rows, paper);
}

std::string plot(const std::vector<Row>& rows, const std::vector<Row>& paper,
                 const std::string& title, double Cell::*value) {
  std::vector<Series> all;
  for (const Row& row : rows) {
    Series ours = series_of(row, value);
    if (!ours.x.empty()) all.push_back(std::move(ours));
  }
  const std::size_t own = all.size();
  for (const Row& row : paper) {
    Series theirs = series_of(row, value);
    const auto same = std::find_if(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(own),
                                   [&](const Series& s) { return s.name == row.name; });
    theirs.name = "paper: " + row.paper.substr(0, row.paper.find(" ("));
    if (same != all.begin() + static_cast<std::ptrdiff_t>(own)) {
      theirs.beside = static_cast<int>(same - all.begin());
    }
    theirs.other = true;
    all.push_back(std::move(theirs));
  }
  return log_log_plot(title, "vertices", "seconds", all);
}

}  // namespace curveskel::bench
