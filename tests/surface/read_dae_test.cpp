// Laws of reading COLLADA: placing, instances, skins, and documents that lie.
#include <curveskel/read.hpp>

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "tests/own_folder.hpp"
#include "tests/surface/reading.hpp"
#include "tests/surface/scene_encodings.hpp"

namespace curveskel::read_dae_laws {
namespace {

using namespace encodings;

const std::string box = dae_geometry(dae_quads());
const std::string shown = "<instance_geometry url=\"#box\"/>";

PolygonSoup read(const std::string& document) {
  const OwnFolder folder;
  return read_polygons(folder.write("box.dae", document));
}

PolygonSoup read_nodes(const std::string& nodes, const std::string& libraries = {}) {
  return read(dae(box, nodes, libraries));
}

/// The places to which `moved` takes the corners of the box.
template <typename Moved>
void expect_corners(const PolygonSoup& soup, Eigen::Index first, const Moved& moved) {
  ASSERT_GE(soup.positions.rows(), first + 8);
  for (int v = 0; v < 8; ++v) {
    const auto& p = corners[static_cast<std::size_t>(v)];
    const Eigen::RowVector3d wanted = moved(Eigen::RowVector3d(p[0], p[1], p[2]));
    EXPECT_LT((soup.positions.row(first + v) - wanted).norm(), 1e-12) << v;
  }
}

TEST(ReadDae, TransformsOfANodeApplyFromTheLastToTheFirst) {
  const PolygonSoup soup =
      read_nodes("<node><translate>1 2 3</translate><rotate>0 0 2 90</rotate><scale>2 3 4</scale>" +
                 shown + "</node>");
  expect_corners(soup, 0, [](const auto& p) {
    return Eigen::RowVector3d(1 - 3 * p.y(), 2 + 2 * p.x(), 3 + 4 * p.z());
  });
}

TEST(ReadDae, NumbersMayHaveTheDecimalCommaOfTheExportersCountry) {
  const PolygonSoup soup =
      read_nodes("<node><translate>1,5 -2,25e1 +3</translate>" + shown + "</node>");
  expect_corners(soup, 0, [](const auto& p) {
    return Eigen::RowVector3d(p.x() + 1.5, p.y() - 22.5, p.z() + 3);
  });
  EXPECT_THROW(read_nodes("<node><translate>1,5,2 0 0</translate>" + shown + "</node>"), Error);
}

TEST(ReadDae, SaysWhichAxisIsUp) {
  std::string document = dae(box, dae_box_node);
  EXPECT_TRUE(read(document).z_is_up);
  document.replace(document.find("Z_UP"), 4, "Y_UP");
  EXPECT_FALSE(read(document).z_is_up);
}

TEST(ReadDae, NodesNestAndMatricesAreByRows) {
  const PolygonSoup soup = read_nodes(
      "<node><matrix>0 0 1 5  1 0 0 6  0 1 0 7  0 0 0 1</matrix><node><translate>10 20 "
      "30</translate>" +
      shown + "</node></node>");
  expect_corners(soup, 0, [](const auto& p) {
    return Eigen::RowVector3d(p.z() + 35, p.x() + 16, p.y() + 27);
  });
}

TEST(ReadDae, AMeshIsReadOnceForEachPlaceInWhichItStands) {
  const PolygonSoup soup =
      read_nodes("<node>" + shown +
                     "</node><node><translate>0 0 9</translate><instance_node "
                     "url=\"#twice\"/></node>",
                 "<library_nodes><node id=\"twice\">" + shown + "<node><scale>1 1 2</scale>" +
                     shown + "</node></node></library_nodes>");
  ASSERT_EQ(soup.positions.rows(), 24);
  expect_corners(soup, 8,
                 [](const auto& p) { return Eigen::RowVector3d(p + Eigen::RowVector3d(0, 0, 9)); });
  expect_corners(soup, 16,
                 [](const auto& p) { return Eigen::RowVector3d(p.x(), p.y(), 2 * p.z() + 9); });
  EXPECT_EQ(soup.corners[24], soup.corners[0] + 8);
}

TEST(ReadDae, MirrorsTurnFacesOver) {
  const PolygonSoup soup = read_nodes("<node><scale>-1 1 1</scale>" + shown + "</node>");
  for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(soup.corners[k], quads[0][3 - k]);
}

TEST(ReadDae, WithoutASceneShowsAllMeshes) {
  const PolygonSoup soup =
      read("<COLLADA><library_geometries>" + box + "</library_geometries></COLLADA>");
  EXPECT_EQ(outlines(soup), outlines_of_the_box(true));
}

TEST(ReadDae, LinesArePassedOverAndOtherPointsToo) {
  const PolygonSoup soup = read(dae(
      dae_geometry("<lines count=\"1\">" + dae_inputs + "<p>0 0 0 1</p></lines>" + dae_quads()) +
          "<geometry id=\"curve\"><spline/></geometry>",
      "<node>" + shown + "<instance_geometry url=\"#curve\"/></node>"));
  EXPECT_EQ(outlines(soup), outlines_of_the_box(true));
}

// ---- Skins --------------------------------------------------------------------------------------

/// The lower corners (0 to 3) belong to "low", the upper ones to "low" and "high" by halves; the
/// bind shape moves by 100 along x, the inverse binds take that back.
std::string skin() {
  const std::string back = "1 0 0 -100  0 1 0 0  0 0 1 0  0 0 0 1 ";
  return "<library_controllers><controller id=\"skin\"><skin source=\"#box\">"
         "<bind_shape_matrix>1 0 0 100  0 1 0 0  0 0 1 0  0 0 0 1</bind_shape_matrix>"
         "<source id=\"joints\"><Name_array count=\"2\">low high</Name_array></source>"
         "<source id=\"binds\"><float_array count=\"32\">" +
         back + back +
         "</float_array></source>"
         "<source id=\"weights\"><float_array count=\"2\">1 0.5</float_array></source>"
         "<joints><input semantic=\"JOINT\" source=\"#joints\"/>"
         "<input semantic=\"INV_BIND_MATRIX\" source=\"#binds\"/></joints>"
         "<vertex_weights count=\"8\"><input semantic=\"JOINT\" source=\"#joints\" offset=\"0\"/>"
         "<input semantic=\"WEIGHT\" source=\"#weights\" offset=\"1\"/>"
         "<vcount>1 1 1 1 2 2 2 2</vcount>"
         "<v>0 0 0 0 0 0 0 0  0 1 1 1 0 1 1 1 0 1 1 1 0 1 1 1</v>"
         "</vertex_weights></skin></controller></library_controllers>";
}

TEST(ReadDae, ASkinFollowsItsJointsAndNotItsNode) {
  const PolygonSoup soup = read_nodes(
      "<node id=\"root\" sid=\"low\"><translate>0 0 1</translate><node sid=\"high\"><translate>4 0 "
      "0</translate></node></node><node><translate>77 77 77</translate><instance_controller "
      "url=\"#skin\"><skeleton>#root</skeleton></instance_controller></node>",
      skin());
  expect_corners(soup, 0, [](const auto& p) {
    return Eigen::RowVector3d(p.x() + (p.z() > 0 ? 2 : 0), p.y(), p.z() + 1);
  });
  EXPECT_EQ(soup.offsets.size(), 7);
}

/// A box hangs from the upper joint.
TEST(ReadDae, APosedSkinIsReadAsItWasBoundIfOneAsks) {
  const OwnFolder folder;
  const auto read_as = [&](const std::string& high, bool as_bound) {
    const std::string nodes =
        "<node id=\"root\" sid=\"low\"><translate>0 0 1</translate><node sid=\"high\"><translate>" +
        high + "</translate><node><translate>0 0 2</translate>" + shown +
        "</node></node></node><node><instance_controller url=\"#skin\"><skeleton>#root</skeleton>"
        "</instance_controller></node>";
    return read_polygons(folder.write("posed.dae", dae(box, nodes, skin())), {}, {as_bound});
  };
  const PolygonSoup bent = read_as("4 0 0", false);
  EXPECT_TRUE(bent.posed);
  expect_corners(bent, 0,
                 [](const auto& p) { return Eigen::RowVector3d(p.x() + 4, p.y(), p.z() + 3); });
  const PolygonSoup bound = read_as("4 0 0", true);
  EXPECT_TRUE(bound.posed);
  expect_corners(bound, 0,
                 [](const auto& p) { return Eigen::RowVector3d(p.x(), p.y(), p.z() + 3); });
  expect_corners(bound, 8,
                 [](const auto& p) { return Eigen::RowVector3d(p.x(), p.y(), p.z() + 1); });
  const PolygonSoup whole = read_as("0 0 0", true);  // the joints move alike
  EXPECT_FALSE(whole.posed);
  expect_corners(whole, 8,
                 [](const auto& p) { return Eigen::RowVector3d(p.x(), p.y(), p.z() + 1); });
}

/// They were bound in one place, and stand on nodes that are moved and turned; with a hat each.
TEST(ReadDae, FiguresStandWhereTheirTopmostJointsAreShown) {
  const OwnFolder folder;
  const auto figure = [](const std::string& id, const std::string& place, const std::string& high) {
    return "<node><translate>" + place + "</translate><rotate>0 0 1 90</rotate><node>" + shown +
           "</node><node id=\"" + id +
           "\" sid=\"low\"><translate>100 0 0</translate><node "
           "sid=\"high\"><translate>" +
           high +
           "</translate></node></node>"
           "<node><instance_controller url=\"#skin\"><skeleton>#" +
           id + "</skeleton></instance_controller></node></node>";
  };
  for (const std::string high : {"4 0 0", "0 0 0"}) {
    const std::string nodes = figure("one", "10 0 0", high) + figure("two", "60 0 0", "0 0 0");
    const PolygonSoup bound =
        read_polygons(folder.write("crowd.dae", dae(box, nodes, skin())), {}, {true});
    EXPECT_EQ(bound.posed, high != "0 0 0");
    ASSERT_EQ(bound.positions.rows(), 32);
    for (const Eigen::Index first : {0, 8, 16, 24}) {
      expect_corners(bound, first, [first](const auto& p) {
        return Eigen::RowVector3d((first < 16 ? 10 : 60) - p.y(),
                                  p.x() + (first % 16 < 8 ? 0 : 100), p.z());
      });
    }
  }
}

TEST(ReadDae, AJointThatIsNowhereIsNamed) {
  EXPECT_NE(refusal_of([] {
              return read_nodes("<node><instance_controller url=\"#skin\"/></node>", skin());
            }).find("the joint \"low\""),
            std::string::npos);
}

// ---- What is refused ----------------------------------------------------------------------------

void expect_refusal(const std::string& document, const std::string& said) {
  const std::string message = refusal_of([&] { return read(document); });
  EXPECT_NE(message.find(said), std::string::npos) << message;
}

TEST(ReadDae, RefusesWhatIsBrokenByItsPlace) {
  const auto polygons = [](const std::string& list) {
    return dae(dae_geometry("<polylist>" + dae_inputs + list + "</polylist>"), dae_box_node);
  };
  expect_refusal(polygons("<vcount>3</vcount><p>0 0 0 1 0 8</p>"), "vertex index 8");
  expect_refusal(polygons("<vcount>3</vcount><p>0 0 0 1 0 -1</p>"), "\"-1\" in <p>");
  expect_refusal(polygons("<vcount>3</vcount><p>0 0 0 1 0</p>"), "5 indices");
  expect_refusal(polygons("<vcount>3 3</vcount><p>0 0 0 1 0 2</p>"), "more corners");
  expect_refusal(dae(dae_geometry("<polygons>" + dae_inputs + "<ph/></polygons>"), dae_box_node),
                 "a polygon with holes");
  expect_refusal(dae(box, "<node><instance_geometry url=\"other.dae#box\"/></node>"),
                 "other.dae#box");
  expect_refusal(dae(box, "<node><instance_geometry url=\"#ball\"/></node>"),
                 "no element with the id \"ball\"");
  expect_refusal(dae(box, "<node><translate>1 2</translate>" + shown + "</node>"), "2 numbers");
  expect_refusal(
      dae(box, "<node><matrix>1 0 0 0 0 1 0 0 0 0 1 0 1 0 0 1</matrix>" + shown + "</node>"),
      "not affine");
  expect_refusal("<COLLADA/>", "no faces");
}

TEST(ReadDae, RefusesNodesThatHoldThemselves) {
  expect_refusal(dae(box, "<node id=\"a\"><instance_node url=\"#a\"/></node>"),
                 "nodes in the scene");
}

}  // namespace
}  // namespace curveskel::read_dae_laws
