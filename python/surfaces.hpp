// Surfaces from surfaces: fairing and contraction as the program does them.
#pragma once

#include <pybind11/pybind11.h>

#include <curveskel/read.hpp>

namespace curveskel {

/// (vertices, faces): those given, moved. See `fair_polygons`.
[[nodiscard]] pybind11::tuple fair_soup(const PolygonSoup& soup, const pybind11::dict& options,
                                        const pybind11::object& listener);

/// (vertices, faces, steps): those given where they end up, and a dictionary of columns with a row
/// for each accepted iteration of each component. See `contract_repaired`.
[[nodiscard]] pybind11::tuple contract_soup(const PolygonSoup& soup, const pybind11::dict& options,
                                            const pybind11::object& listener);

}  // namespace curveskel
