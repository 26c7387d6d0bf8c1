// One function per skeleton file format and direction; skeleton_files.hpp is the way in.
#pragma once

#include <string>

#include <curveskel/curve_skeleton.hpp>
#include <curveskel/skeleton_files.hpp>
#include "surface/read/file_bytes.hpp"

namespace curveskel {

[[nodiscard]] std::string obj_from(const CurveSkeleton& skeleton, const SkeletonContext& context);
[[nodiscard]] std::string ply_from(const CurveSkeleton& skeleton, const SkeletonContext& context);
[[nodiscard]] std::string polylines_from(const CurveSkeleton& skeleton);
[[nodiscard]] std::string swc_from(const CurveSkeleton& skeleton, const SkeletonContext& context);
[[nodiscard]] std::string vtp_from(const CurveSkeleton& skeleton, const SkeletonContext& context);
[[nodiscard]] std::string csv_from(const CurveSkeleton& skeleton, const SkeletonContext& context);
[[nodiscard]] std::string graphml_from(const CurveSkeleton& skeleton,
                                       const SkeletonContext& context);
[[nodiscard]] std::string json_from(const CurveSkeleton& skeleton, const SkeletonContext& context);

/// The nodes that no edge touches, ascending.
[[nodiscard]] std::vector<int> isolated_nodes(const CurveSkeleton& skeleton);

}  // namespace curveskel
