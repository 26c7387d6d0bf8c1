// The whole library in one include: a triangle surface in, its curve skeleton out.
//
//   using namespace curveskel;
//   const RepairedSurface repaired = repair(read_polygons("model.obj"));
//   const RepairedExtraction found = extract_repaired(repaired);
//   found.extraction.skeleton.nodes;   // #N by 3
#pragma once

#include <curveskel/advanced/closed_manifold.hpp>
#include <curveskel/advanced/coarsen.hpp>
#include <curveskel/advanced/device.hpp>
#include <curveskel/advanced/embed.hpp>
#include <curveskel/advanced/extraction_cache.hpp>
#include <curveskel/advanced/file_names.hpp>
#include <curveskel/advanced/graph.hpp>
#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/inscribed_balls.hpp>
#include <curveskel/advanced/joints.hpp>
#include <curveskel/advanced/laplacian.hpp>
#include <curveskel/advanced/least_squares.hpp>
#include <curveskel/advanced/measures.hpp>
#include <curveskel/advanced/names.hpp>
#include <curveskel/advanced/skin_weights.hpp>
#include <curveskel/advanced/step_clock.hpp>
#include <curveskel/advanced/surface_partition.hpp>
#include <curveskel/advanced/surgery.hpp>
#include <curveskel/advanced/tree.hpp>
#include <curveskel/advanced/union_find.hpp>
#include <curveskel/advanced/write_file.hpp>
#include <curveskel/body_plan.hpp>
#include <curveskel/branch_measures.hpp>
#include <curveskel/branch_profiles.hpp>
#include <curveskel/branch_territories.hpp>
#include <curveskel/certificate.hpp>
#include <curveskel/check_weights.hpp>
#include <curveskel/clean.hpp>
#include <curveskel/compare_rigs.hpp>
#include <curveskel/contract.hpp>
#include <curveskel/contract_repaired.hpp>
#include <curveskel/curve_skeleton.hpp>
#include <curveskel/edit.hpp>
#include <curveskel/error.hpp>
#include <curveskel/evaluate_repaired.hpp>
#include <curveskel/extract.hpp>
#include <curveskel/extract_repaired.hpp>
#include <curveskel/fair.hpp>
#include <curveskel/fair_polygons.hpp>
#include <curveskel/findings.hpp>
#include <curveskel/html_page.hpp>
#include <curveskel/labelled_surface.hpp>
#include <curveskel/levels.hpp>
#include <curveskel/lives.hpp>
#include <curveskel/make_rig.hpp>
#include <curveskel/match.hpp>
#include <curveskel/monitor.hpp>
#include <curveskel/pose.hpp>
#include <curveskel/preset.hpp>
#include <curveskel/read.hpp>
#include <curveskel/read_materials.hpp>
#include <curveskel/read_rig.hpp>
#include <curveskel/repair.hpp>
#include <curveskel/rest_pose.hpp>
#include <curveskel/rig.hpp>
#include <curveskel/rig_character.hpp>
#include <curveskel/rig_files.hpp>
#include <curveskel/rig_parts.hpp>
#include <curveskel/rig_polygons.hpp>
#include <curveskel/role_names.hpp>
#include <curveskel/skeleton_files.hpp>
#include <curveskel/surface.hpp>
#include <curveskel/threads.hpp>
#include <curveskel/topology.hpp>
#include <curveskel/tries.hpp>
#include <curveskel/view.hpp>
#include <curveskel/write_surface.hpp>
