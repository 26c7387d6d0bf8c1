#include "python/tables.hpp"

#include <pybind11/stl.h>

#include <limits>

#include <curveskel/branch_measures.hpp>
#include <curveskel/branch_profiles.hpp>
#include <curveskel/branch_territories.hpp>
#include <curveskel/levels.hpp>
#include "python/background_work.hpp"

namespace curveskel {
namespace {

namespace py = pybind11;

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// Infinity where it is for ever.
double life_of(double life) {
  return life < lives_for_ever ? life : std::numeric_limits<double>::infinity();
}

template <typename Get>
py::list column(std::size_t rows, const Get& get) {
  py::list values;
  for (std::size_t row = 0; row < rows; ++row) values.append(get(row));
  return values;
}

/// A whole number that may be missing.
py::object number_or_none(int number, bool is_there) {
  return is_there ? py::object(py::int_(number)) : py::object(py::none());
}

void add_ends(py::dict& table, const CurveSkeleton& skeleton, const std::vector<Branch>& all) {
  const auto of = [&](const auto& get) { return column(all.size(), get); };
  table["start"] = of([&](std::size_t row) { return all[row].nodes.front(); });
  table["end"] = of([&](std::size_t row) { return all[row].nodes.back(); });
  for (const std::string end : {"start", "end"}) {
    for (int axis = 0; axis < 3; ++axis) {
      table[(end + "_" + "xyz"[axis]).c_str()] = of([&](std::size_t row) {
        const std::vector<int>& nodes = all[row].nodes;
        return skeleton.nodes(end == "start" ? nodes.front() : nodes.back(), axis);
      });
    }
  }
  table["nodes"] = of([&](std::size_t row) { return all[row].nodes.size(); });
}

}  // namespace

py::dict branch_table(const CurveSkeleton& skeleton, const PythonExtraction* extraction, int root) {
  if (root < -1 || root >= skeleton.nodes.rows()) {
    throw Error(Fault::usage, "root: found " + std::to_string(root) + ", needed a node, 0 to " +
                                  std::to_string(skeleton.nodes.rows() - 1));
  }
  const std::vector<Branch> all = branches(skeleton);
  const std::vector<BranchLevel> levels = branch_levels(skeleton);
  const std::vector<BranchMeasures> measures = branch_measures(skeleton, root);
  const auto of = [&](const auto& get) { return column(all.size(), get); };
  const auto number = [&](double BranchMeasures::*member) {
    return of([&measures, member](std::size_t row) { return measures[row].*member; });
  };
  py::dict table;
  add_ends(table, skeleton, all);
  table["length"] = number(&BranchMeasures::length);
  table["mean_radius"] = number(&BranchMeasures::mean_radius);
  table["life"] =
      of([&](std::size_t row) { return has_lives(skeleton) ? life_of(levels[row].life) : none; });
  table["parent"] = of(
      [&](std::size_t row) { return number_or_none(levels[row].parent, levels[row].parent >= 0); });
  table["merge"] = of(
      [&](std::size_t row) { return levels[row].merge < 0 ? none : life_of(levels[row].merge); });
  table["kind"] =
      of([&](std::size_t row) { return std::string(name_of(branch_kinds, measures[row].kind)); });
  table["chord"] = number(&BranchMeasures::chord);
  table["tortuosity"] = number(&BranchMeasures::tortuosity);
  table["radius_min"] = number(&BranchMeasures::least_radius);
  table["radius_max"] = number(&BranchMeasures::largest_radius);
  table["curvature"] = number(&BranchMeasures::curvature);
  table["torsion"] = number(&BranchMeasures::torsion);
  table["parent_angle"] = number(&BranchMeasures::parent_angle);
  table["centrifugal_order"] = of([&](std::size_t row) { return measures[row].centrifugal_order; });
  table["strahler_order"] = of([&](std::size_t row) {
    return number_or_none(measures[row].strahler_order, measures[row].strahler_order > 0);
  });
  BranchTerritories parts;
  parts.areas.assign(all.size(), none);
  parts.volumes.assign(all.size(), none);
  if (extraction != nullptr) {
    parts = branch_territories(extraction->repaired.surface, extraction->extraction.skeleton);
  }
  table["area"] = parts.areas;
  table["volume"] = parts.volumes;
  const std::vector<int> components = component_of_node(skeleton);
  table["component"] = of([&](std::size_t row) {
    return components[static_cast<std::size_t>(all[row].nodes.front())];
  });
  return table;
}

py::dict junction_table(const CurveSkeleton& skeleton) {
  const std::vector<JunctionMeasures> all = junction_measures(skeleton);
  const auto of = [&](const auto& get) { return column(all.size(), get); };
  py::dict table;
  table["node"] = of([&](std::size_t row) { return all[row].node; });
  for (int axis = 0; axis < 3; ++axis) {
    table[std::string(1, "xyz"[axis]).c_str()] =
        of([&](std::size_t row) { return skeleton.nodes(all[row].node, axis); });
  }
  table["degree"] = of([&](std::size_t row) { return all[row].branches.size(); });
  table["branches"] = of([&](std::size_t row) { return all[row].branches; });
  table["angles"] = of([&](std::size_t row) { return all[row].angles; });
  table["planarity"] = of([&](std::size_t row) { return all[row].planarity; });
  return table;
}

py::dict profile_table(const PythonExtraction& extraction, double spacing, int threads,
                       const py::object& listener) {
  std::vector<BranchSection> all;
  run_beside_interpreter(listener, [&](const Monitor& monitor) {
    all = branch_profiles(extraction.repaired.surface, extraction.extraction.skeleton,
                          {spacing, threads, extraction.repaired.rims}, monitor);
  });
  const auto of = [&](const auto& get) { return column(all.size(), get); };
  py::dict table;
  table["branch"] = of([&](std::size_t row) { return all[row].branch; });
  table["s"] = of([&](std::size_t row) { return all[row].s; });
  for (int axis = 0; axis < 3; ++axis) {
    table[std::string(1, "xyz"[axis]).c_str()] =
        of([&](std::size_t row) { return all[row].position[axis]; });
  }
  for (int axis = 0; axis < 3; ++axis) {
    table[(std::string("tangent_") + "xyz"[axis]).c_str()] =
        of([&](std::size_t row) { return all[row].tangent[axis]; });
  }
  const auto number = [&](double BranchSection::*member) {
    return of([&all, member](std::size_t row) { return all[row].*member; });
  };
  table["inscribed_radius"] = number(&BranchSection::inscribed_radius);
  table["area"] = number(&BranchSection::area);
  table["perimeter"] = number(&BranchSection::perimeter);
  table["equivalent_diameter"] = number(&BranchSection::equivalent_diameter);
  table["ellipticity"] = number(&BranchSection::ellipticity);
  table["near_junction"] = of([&](std::size_t row) { return all[row].near_junction; });
  return table;
}

}  // namespace curveskel
