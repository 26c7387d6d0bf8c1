// The real surfaces, cleaned: as their index says that they are.
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include <curveskel/advanced/measures.hpp>
#include <curveskel/clean.hpp>
#include <curveskel/topology.hpp>
#include "tests/real_surfaces.hpp"
#include "tests/soups.hpp"

namespace curveskel::shared_meshes_laws {
namespace {

struct IndexRow {
  std::string file;
  long vertices = -1;
  long faces = -1;
  std::size_t components = 0;
  bool closed_orientable_manifold = false;
  bool consistently_oriented = false;
  double signed_volume = 0;
  std::vector<int> genus;  ///< per component, ascending
};

std::vector<IndexRow> index_rows() {
  const auto lines = real_surface_index();
  const std::vector<std::string>& names = lines.at(0);
  std::vector<IndexRow> rows;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const std::vector<std::string>& values = lines[i];
    const auto value = [&](const std::string& name) {
      const auto column = std::find(names.begin(), names.end(), name) - names.begin();
      return values.at(static_cast<std::size_t>(column));
    };
    IndexRow row;
    row.file = value("file");
    if (!value("vertices").empty()) {
      row.vertices = std::stol(value("vertices"));
      row.faces = std::stol(value("faces"));
      row.components = std::stoul(value("components"));
    }
    row.closed_orientable_manifold =
        value("closed") == "y" && value("manifold") == "y" && value("orientable") == "y";
    if (row.closed_orientable_manifold) {
      std::istringstream list(value("genus"));
      for (int g = 0; list >> g;) row.genus.push_back(g);
      std::sort(row.genus.begin(), row.genus.end());
      row.consistently_oriented = value("consistently_oriented") == "y";
      if (row.consistently_oriented) row.signed_volume = std::stod(value("signed_volume"));
    }
    rows.push_back(row);
  }
  return rows;
}

CleanSurface cleaned(const std::string& file) {
  return clean(read_polygons(real_surface(file).value(), {}), {});
}

TEST(RealSurfacesCleaned, AreReadWithTheVerticesAndFacesOfTheIndex) {
  int checked = 0;
  for (const IndexRow& row : index_rows()) {
    // Without counts, without faces, or with numbers that are none: refused, see the read test.
    if (row.faces <= 0 || row.file.find("nan-") != std::string::npos ||
        row.file.find("inf-") != std::string::npos) {
      continue;
    }
    const PolygonSoup soup = read_polygons(real_surface(row.file).value(), {});
    EXPECT_EQ(soup.positions.rows(), row.vertices) << row.file;
    EXPECT_EQ(soup.offsets.size() - 1, static_cast<std::size_t>(row.faces)) << row.file;
    ++checked;
  }
  EXPECT_GT(checked, collection_folder() ? 80 : 10);
}

TEST(RealSurfacesCleaned, ThatAreClosedKeepTheirComponentsAndGenus) {
  int checked = 0;
  for (const IndexRow& row : index_rows()) {
    const bool flat = row.file.find("collinear") != std::string::npos ||
                      row.file.find("coincident") != std::string::npos ||
                      row.file.find("flattened") != std::string::npos;
    if (!row.closed_orientable_manifold || flat || row.file.find("nan-") != std::string::npos ||
        row.file.find("inf-") != std::string::npos) {
      continue;
    }
    SCOPED_TRACE(row.file);
    const CleanSurface result = cleaned(row.file);
    EXPECT_EQ(result.surface.positions.rows() + result.changes.isolated_vertices_dropped,
              row.vertices);
    EXPECT_EQ(result.changes.vertices_merged, 0);
    const Topology counts = topology(result.surface);
    std::vector<int> genus = counts.genus;
    std::sort(genus.begin(), genus.end());
    EXPECT_EQ(genus.size(), row.components);
    EXPECT_EQ(genus, row.genus);
    if (row.consistently_oriented) {
      EXPECT_EQ(result.changes.faces_flipped, 0);
      if (row.components == 1) {
        EXPECT_EQ(result.changes.components_turned, row.signed_volume < 0 ? 1 : 0);
      }
      // The volume inside a bent polygon depends on its diagonals, which are not the index's.
      if (row.components == 1 && result.changes.polygons_triangulated == 0) {
        EXPECT_NEAR(volume(result.surface), std::abs(row.signed_volume),
                    1e-5 * std::abs(row.signed_volume));
      }
    }
    ++checked;
  }
  EXPECT_GT(checked, collection_folder() ? 50 : 4);
}

struct Mended {
  const char* file;
  Eigen::Index vertices;
  int components;
};

TEST(RealSurfacesCleaned, ThatAreSoupsOrDoubledAreMended) {
  for (const Mended& mended :
       {Mended{"format-binary-starts-with-solid.stl", 620, 1},
        Mended{"format-two-solids-ascii.stl", 1240, 2}, Mended{"soup-gears-19k.stl", 9723, 7},
        Mended{"unwelded-spot.obj", 829, 1}, Mended{"doublesided.ply", 829, 1},
        Mended{"duplicate-faces.ply", 829, 1}, Mended{"degenerate-repeated-index.off", 829, 1},
        Mended{"nonmanifold-vertex-cow-3k.obj", 2904, 1},
        Mended{"nonmanifold-hourglass.obj", 24, 2}, Mended{"uvseam-cut-camel-2k.obj", 1790, 1}}) {
    SCOPED_TRACE(mended.file);
    const std::string file = std::string("defects/") + mended.file;
    if (!collection_folder() && !real_surface(file)) continue;
    const CleanSurface result = cleaned(file);
    EXPECT_EQ(result.surface.positions.rows(), mended.vertices);
    EXPECT_EQ(topology(result.surface).components(), mended.components);
    EXPECT_FALSE(result.changes.lines.empty());
    expect_closed_outward_manifold(result.surface);
  }
}

TEST(RealSurfacesCleaned, ThatEncloseNothingAreRefused) {
  for (const auto& file : present_among({"defects/all-vertices-coincident.off",
                                         "defects/collinear.off",
                                         "defects/concave-ngon.obj",
                                         "defects/flattened.ply",
                                         "defects/messy-office-chair.obj",
                                         "defects/nonmanifold-dragon-23k.ply",
                                         "defects/nonmanifold-fan3.obj",
                                         "defects/nonmanifold-hole.ply",
                                         "defects/nonorientable-klein.off",
                                         "defects/nonorientable-moebius-quads.obj",
                                         "defects/nonorientable-shark-15parts.ply",
                                         "defects/one-quad.obj",
                                         "defects/one-triangle.off",
                                         "defects/open-bunny-scan-36k.ply",
                                         "defects/open-elephant-106-holes.off",
                                         "defects/open-rangescan-44k.ply",
                                         "defects/polygons-suzanne-open.obj",
                                         "defects/sheet-plane.off",
                                         "defects/soup-spider-ascii.stl",
                                         "defects/tjunctions.ply",
                                         "defects/tristrips-hippo-23k.ply",
                                         "defects/two-triangles.off",
                                         "defects/unwelded-jittered.ply"})) {
    const auto path = real_surface(file).value();
    expect_said(refusal(read_polygons(path, {})), {path.filename().string(), "needed"});
  }
}

}  // namespace
}  // namespace curveskel::shared_meshes_laws
