// The arrays of VTK's XML files, in every way in which VTK writes them.
#pragma once

#include <limits>
#include <vector>

#include "surface/read/xml.hpp"

namespace curveskel {

/// Values of a DataArray: as text ("ascii"), base64 ("binary") or in the file's AppendedData (raw
/// or base64); compressed with zlib or not; either byte order; integers as well as floating point
/// (integers past 2^53 lose digits). Throws Error(Fault::input) with the line, also where
/// compressed data announce more values than `most_values` or more than there is memory for, before
/// any of it is taken. O(bytes).
[[nodiscard]] std::vector<double> vtk_values(
    const FileBytes& file, const XmlElement& vtk_file, const XmlElement& data_array,
    double most_values = std::numeric_limits<double>::infinity());

}  // namespace curveskel
