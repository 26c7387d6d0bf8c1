#include "python/surfaces.hpp"

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <string>
#include <vector>

#include <curveskel/contract_repaired.hpp>
#include <curveskel/fair_polygons.hpp>
#include <curveskel/repair.hpp>
#include "app/fair_rules.hpp"
#include "app/kernel_cache.hpp"
#include "python/background_work.hpp"
#include "python/options.hpp"

namespace curveskel {
namespace {

namespace py = pybind11;

py::dict table_of(const RepairedContraction& contraction) {
  std::vector<int> component;
  std::vector<int> iteration;
  std::vector<double> area_ratio;
  std::vector<double> volume_ratio;
  std::vector<double> residual;
  std::vector<int> vertices;
  for (std::size_t k = 0; k < contraction.components.size(); ++k) {
    int number = 0;
    for (const Step& step : contraction.components[k].steps) {
      component.push_back(static_cast<int>(k));
      iteration.push_back(++number);
      area_ratio.push_back(step.area_ratio);
      volume_ratio.push_back(step.volume_ratio);
      residual.push_back(step.residual);
      vertices.push_back(step.vertices);
    }
  }
  py::dict table;
  table["component"] = component;
  table["iteration"] = iteration;
  table["area_ratio"] = area_ratio;
  table["volume_ratio"] = volume_ratio;
  table["residual"] = residual;
  table["vertices"] = vertices;
  return table;
}

}  // namespace

py::tuple fair_soup(const PolygonSoup& soup, const py::dict& options, const py::object& listener) {
  FairOptions fairing;
  fairing.program_cache = kernel_cache();
  set_options(options, {{"iterations", sets(fairing.iterations)},
                        {"local_solver", sets(fairing.local_solver, "local_solver", local_solvers)},
                        {"method", sets(fairing.method, "method", fair_methods)},
                        {"precision", sets(fairing.double_precision, "precision", precisions)},
                        {"rings", sets(fairing.rings)},
                        {"smoothing", sets(fairing.smoothing)},
                        {"threads", sets(fairing.threads)},
                        {"volume", sets(fairing.volume, "volume", volume_rules)}});
  require_valid(fairing);
  require_closed_form(fairing, options.contains("local_solver"));
  require_single_on_device(fairing, options.contains("precision"));
  Surface result;
  run_beside_interpreter(
      listener, [&](const Monitor& monitor) { result = fair_polygons(soup, fairing, monitor); });
  return py::make_tuple(std::move(result.positions), std::move(result.triangles));
}

py::tuple contract_soup(const PolygonSoup& soup, const py::dict& options,
                        const py::object& listener) {
  ContractionOptions contraction;
  contraction.program_cache = kernel_cache();
  RepairOptions as_repaired;
  OptionSetters setters = repair_setters(as_repaired);
  setters["flow"] = sets(contraction.flow, "flow", flows);
  setters["iterations"] = sets(contraction.max_iterations);
  setters["solver"] = sets(contraction.solver, "solver", solvers);
  setters["threads"] = sets(contraction.threads);
  set_options(options, setters);
  require_program_range("iterations", contraction.max_iterations, 1, 1e6);
  require_valid(contraction);
  require_together(as_repaired);
  Surface moved;
  RepairedContraction result;
  run_beside_interpreter(listener, [&](const Monitor& monitor) {
    const RepairedSurface repaired = repair(soup, as_repaired, monitor, contraction.threads);
    result = contract_repaired(repaired, contraction, monitor);
    moved = moved_vertices(soup, repaired, result.positions);
  });
  return py::make_tuple(std::move(moved.positions), std::move(moved.triangles), table_of(result));
}

}  // namespace curveskel
