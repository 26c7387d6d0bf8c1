// Laws of reading 3MF: placing, units, extensions, and archives that lie.
#include <curveskel/read.hpp>

#include <gtest/gtest.h>

#include <string>

#include "tests/own_folder.hpp"
#include "tests/surface/reading.hpp"
#include "tests/surface/zip_encodings.hpp"

namespace curveskel::read_3mf_laws {
namespace {

using namespace encodings;

PolygonSoup read(const std::string& model) {
  const OwnFolder folder;
  return read_polygons(folder.write("box.3mf", archive_3mf(model)));
}

std::string refusal_of_model(const std::string& model) {
  return refusal_of([&] { return read(model); });
}

const std::string box_7 = "<object id=\"7\" type=\"model\">" + mesh_3mf() + "</object>\n";

TEST(Read3mf, UnitsAreMillimetres) {
  for (const auto& [unit, millimetres] :
       {std::pair{"micron", 0.001}, std::pair{"millimeter", 1.0}, std::pair{"centimeter", 10.0},
        std::pair{"inch", 25.4}, std::pair{"foot", 304.8}, std::pair{"meter", 1000.0}}) {
    const PolygonSoup soup =
        read(model_3mf("unit=\"" + std::string(unit) + "\"", box_7, "<item objectid=\"7\"/>"));
    EXPECT_DOUBLE_EQ(soup.positions.col(2).maxCoeff(), 3 * millimetres) << unit;
  }
}

TEST(Read3mf, TransformsMoveRowsAndNestFromInsideOut) {
  // x -> y -> z -> x, then a shift by 1, 2, 3; placed twice, the second time 100 further along x.
  const PolygonSoup soup =
      read(model_3mf("",
                     box_7 + "<object id=\"a\"><components><component objectid=\"7\" "
                             "transform=\"0 1 0 0 0 1 1 0 0 1 2 3\"/></components></object>",
                     "<item objectid=\"a\"/><item objectid=\"a\" "
                     "transform=\"1 0 0 0 1 0 0 0 1 100 0 0\"/>"));
  ASSERT_EQ(soup.positions.rows(), 16);
  for (int v = 0; v < 8; ++v) {
    const auto& p = corners[static_cast<std::size_t>(v)];
    EXPECT_EQ(soup.positions.row(v), Eigen::RowVector3d(p[2] + 1, p[0] + 2, p[1] + 3));
    EXPECT_EQ(soup.positions.row(v + 8), Eigen::RowVector3d(p[2] + 101, p[0] + 2, p[1] + 3));
  }
  EXPECT_EQ(soup.corners[36], soup.corners[0] + 8);
}

TEST(Read3mf, MirrorsTurnFacesOver) {
  const PolygonSoup soup =
      read(model_3mf("", box_7, "<item objectid=\"7\" transform=\"-1 0 0 0 1 0 0 0 1 0 0 0\"/>"));
  const auto first = triangles()[0];
  EXPECT_EQ(soup.corners[0], first[0]);
  EXPECT_EQ(soup.corners[1], first[2]);
  EXPECT_EQ(soup.corners[2], first[1]);
}

TEST(Read3mf, AVertexWithoutAPlaceLosesItsFaces) {
  std::string model = model_3mf("", box_7, "<item objectid=\"7\"/>");
  const std::string corner = "x=\"1\" y=\"2\" z=\"3\"";
  model.replace(model.find(corner), corner.size(), "x=\"1\" y=\"NaN\" z=\"3\"");
  const PolygonSoup soup = read(model);
  EXPECT_EQ(soup.unplaced_vertices, 1);
  EXPECT_EQ(soup.unplaced_polygons, 5);
}

TEST(Read3mf, AnObjectThatIsNotBuiltIsNotRead) {
  const PolygonSoup soup = read(model_3mf(
      "", "<object id=\"1\">" + mesh_3mf(50) + "</object>" + box_7, "<item objectid=\"7\"/>"));
  EXPECT_EQ(outlines(soup), outlines_of_the_box(false));
}

TEST(Read3mf, ExtensionsOfColourArePassedOver) {
  const PolygonSoup soup =
      read(model_3mf("xmlns:m=\"http://schemas.microsoft.com/3dmanufacturing/material/2015/02\" "
                     "xmlns:p=\"http://schemas.microsoft.com/3dmanufacturing/production/2015/06\" "
                     "requiredextensions=\"m p\"",
                     "<m:colorgroup id=\"3\"><m:vertex x=\"nonsense\"/></m:colorgroup>" + box_7,
                     "<item objectid=\"7\" p:UUID=\"x\"/>"));
  EXPECT_EQ(outlines(soup), outlines_of_the_box(false));
}

TEST(Read3mf, ExtensionsOfShapeAreNamed) {
  EXPECT_NE(refusal_of_model(
                model_3mf("xmlns:p=\"http://schemas.microsoft.com/3dmanufacturing/production/"
                          "2015/06\"",
                          box_7, "\n<item p:path=\"/3D/other.model\" objectid=\"7\"/>"))
                .find("production extension: a part in another file (\"/3D/other.model\")"),
            std::string::npos);
  EXPECT_NE(
      refusal_of_model(model_3mf("requiredextensions=\"b\" xmlns:b=\"http://schemas.microsoft.com/"
                                 "3dmanufacturing/beamlattice/2017/02\"",
                                 box_7, "<item objectid=\"7\"/>"))
          .find("beam lattice extension"),
      std::string::npos);
}

TEST(Read3mf, WrongModelsAreRefusedWithLineAndCause) {
  const auto expect = [](const std::string& resources, const std::string& build,
                         const std::string& said) {
    const std::string message = refusal_of_model(model_3mf("", resources, build));
    EXPECT_NE(message.find(said), std::string::npos) << said << " is not in: " << message;
    EXPECT_NE(message.find("box.3mf, 3D/box.model"), std::string::npos) << message;
  };
  expect(box_7, "\n<item objectid=\"9\"/>", "the object id \"9\"");
  expect(box_7 + box_7, "", "a second object \"7\"");
  expect("<object id=\"1\"><mesh><vertices><vertex x=\"1,5\"/>", "", "line 3: found \"1,5\" as x");
  expect("<object id=\"1\"><mesh><triangle v1=\"-1\"/>", "", "\"-1\" as v1");
  expect("<object id=\"1\"><mesh><triangle v1=\"0\" v2=\"1\" v3=\"2\"/></mesh></object>", "",
         "indices from 0 to 0 - 1");
  expect("<object id=\"1\"><components><component objectid=\"1\"/>", "", "component of itself");
  expect(box_7, "<item objectid=\"7\" transform=\"1 0 0\"/>", "twelve finite numbers");
  expect(box_7, "<item objectid=\"7\">", "mismatched tag");
  EXPECT_NE(refusal_of_model("<!DOCTYPE m [<!ENTITY a \"b\">]><model/>").find("a DOCTYPE"),
            std::string::npos);
  EXPECT_NE(refusal_of_model("<model/>").find("no <model>"), std::string::npos);
  EXPECT_NE(refusal_of_model(model_3mf("unit=\"cubit\"", box_7, "")).find("the unit \"cubit\""),
            std::string::npos);
}

TEST(Read3mf, ObjectsThatMultiplyAreRefusedBeforeTheyDo) {
  for (const std::string& seed : {box_7, std::string("<object id=\"7\"></object>")}) {
    std::string resources = seed;
    std::string id = "7";
    for (int level = 0; level < 40; ++level) {
      const std::string next = "l" + std::to_string(level);
      resources += "<object id=\"" + next + "\"><components>";
      for (int k = 0; k < 4; ++k) resources += "<component objectid=\"" + id + "\"/>";
      resources += "</components></object>\n";
      id = next;
    }
    const std::string message =
        refusal_of_model(model_3mf("", resources, "<item objectid=\"" + id + "\"/>"));
    EXPECT_NE(message.find("in what is to be built"), std::string::npos) << message;
  }
}

TEST(Read3mf, OtherArchivesAreSaidToBeSo) {
  const auto message = [](const std::string& bytes) {
    const OwnFolder folder;
    return refusal(folder.write("box.3mf", bytes));
  };
  EXPECT_NE(message(zip({{"cow.obj", "v 0 0 0\n"}})).find("unpack it"), std::string::npos);
  EXPECT_NE(message(zip({{"cow.obj", "v 0 0 0\n"}})).find("\"cow.obj\""), std::string::npos);
  EXPECT_NE(message("PK\3\4 and no more").find("cannot be opened"), std::string::npos);
}

/// A megabyte of blanks takes a thousandth of that packed.
TEST(Read3mf, AnArchiveWhoseSizesLieIsReadAsItIsOrRefused) {
  std::string bytes = archive_3mf(simple_3mf() + std::string(1 << 20, ' '));
  ASSERT_LT(bytes.size(), std::size_t{20000});
  const auto read = [](const std::string& archive) {
    const OwnFolder folder;
    return outlines(read_polygons(folder.write("box.3mf", archive)));
  };
  EXPECT_EQ(read(bytes), outlines_of_the_box(false));
  const std::size_t central = bytes.rfind("PK\1\2");
  for (std::size_t k = 0; k < 4; ++k) bytes[central + 24 + k] = '\1';  // unpacked size: 16 MB
  try {
    EXPECT_EQ(read(bytes), outlines_of_the_box(false));
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()), "");
  }
}

}  // namespace
}  // namespace curveskel::read_3mf_laws
