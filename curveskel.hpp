// The whole library in one include: a triangle surface in, its curve skeleton out.
//
//   using namespace curveskel;
//   const RepairedSurface repaired = repair(read_polygons("model.obj", {}), {}, {});
//   const RepairedExtraction found = extract_repaired(repaired, {}, ExtractOptions{}, Monitor{});
//   found.extraction.skeleton.nodes;   // #N by 3
#pragma once

#include "contraction/contract.hpp"
#include "contraction/device.hpp"
#include "contraction/fair.hpp"
#include "contraction/laplacian.hpp"
#include "contraction/least_squares.hpp"
#include "rig/joints.hpp"
#include "rig/make_rig.hpp"
#include "rig/read_rig.hpp"
#include "rig/rig.hpp"
#include "rig/rig_files.hpp"
#include "rig/skin_weights.hpp"
#include "skeleton/certificate.hpp"
#include "skeleton/curve_skeleton.hpp"
#include "skeleton/edit.hpp"
#include "skeleton/evaluate_repaired.hpp"
#include "skeleton/extract.hpp"
#include "skeleton/extract_repaired.hpp"
#include "skeleton/extraction_cache.hpp"
#include "skeleton/findings.hpp"
#include "skeleton/skeleton_files.hpp"
#include "skeleton/view.hpp"
#include "surface/clean.hpp"
#include "surface/coarsen.hpp"
#include "surface/error.hpp"
#include "surface/inscribed_balls.hpp"
#include "surface/measures.hpp"
#include "surface/monitor.hpp"
#include "surface/names.hpp"
#include "surface/read.hpp"
#include "surface/repair.hpp"
#include "surface/surface.hpp"
#include "surface/topology.hpp"
#include "surface/tree.hpp"
#include "surface/write_file.hpp"
#include "surface/write_surface.hpp"
