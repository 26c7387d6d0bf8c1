// Laws of reading FBX in its three forms: placing, instances, morphs, skins, and files that lie.
#include <curveskel/read.hpp>

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/own_folder.hpp"
#include "tests/surface/reading.hpp"
#include "tests/surface/scene_encodings.hpp"

namespace curveskel::read_fbx_laws {
namespace {

using namespace encodings;
using Row = Eigen::RowVector3d;

class EveryForm : public testing::TestWithParam<FbxForm> {
 protected:
  [[nodiscard]] static PolygonSoup read(const FbxItems& records) {
    const OwnFolder folder;
    return read_polygons(folder.write("box.fbx", fbx(records, GetParam())));
  }
  /// Of the box in a model with these properties.
  [[nodiscard]] static PolygonSoup read_model(const std::vector<FbxProperty>& properties) {
    return read(fbx_scene({fbx_box(), fbx_model(2, properties)}, {{2, 0}, {1, 2}}));
  }
};

template <typename Moved>
void expect_corners(const PolygonSoup& soup, Eigen::Index first, const Moved& moved) {
  ASSERT_GE(soup.positions.rows(), first + 8);
  for (int v = 0; v < 8; ++v) {
    const auto& p = corners[static_cast<std::size_t>(v)];
    const Row wanted = moved(Row(p[0], p[1], p[2]));
    EXPECT_LT((soup.positions.row(first + v) - wanted).norm(), 1e-12) << v;
  }
}

FbxProperty three(const std::string& name, double x, double y, double z) {
  return {name, {x, y, z}};
}

TEST_P(EveryForm, ScalesTurnsAndMovesInThisOrder) {
  const PolygonSoup soup =
      read_model({three("Lcl Translation", 1, 2, 3), three("Lcl Rotation", 0, 0, 90),
                  three("Lcl Scaling", 2, 3, 4)});
  expect_corners(soup, 0,
                 [](const Row& p) { return Row(1 - 3 * p.y(), 2 + 2 * p.x(), 3 + 4 * p.z()); });
}

TEST_P(EveryForm, TurnsAboutXFirstUnlessAnotherOrderIsActive) {
  const auto of = [](int active, int order) {
    return read_model({three("Lcl Rotation", 90, 90, 0),
                       {"RotationActive", {active}},
                       {"RotationOrder", {order}}});
  };
  // About x: (x, -z, y). About y: (z, y, -x).
  const auto x_first = [](const Row& p) { return Row(p.y(), -p.z(), -p.x()); };
  const auto y_first = [](const Row& p) { return Row(p.z(), p.x(), p.y()); };
  expect_corners(of(0, 5), 0, x_first);
  expect_corners(of(1, 0), 0, x_first);
  expect_corners(of(1, 5), 0, y_first);
}

TEST_P(EveryForm, TurnsBeforeAndAfterCountWhereTheyAreActive) {
  for (const int active : {0, 1}) {
    const PolygonSoup soup = read_model({three("PreRotation", 90, 0, 0),
                                         three("PostRotation", 0, 90, 0),
                                         {"RotationActive", {active}}});
    // The inverse about y, (-z, y, x), then about x.
    expect_corners(soup, 0,
                   [&](const Row& p) { return active == 0 ? p : Row(-p.z(), -p.x(), p.y()); });
  }
}

TEST_P(EveryForm, TurnsAndScalesAboutPivots) {
  const PolygonSoup soup =
      read_model({three("Lcl Rotation", 0, 0, 180), three("RotationPivot", 1, 0, 0),
                  three("RotationOffset", 0, 5, 0), three("Lcl Scaling", 1, 1, 2),
                  three("ScalingPivot", 0, 0, 1), three("ScalingOffset", 0, 0, 7)});
  expect_corners(soup, 0, [](const Row& p) { return Row(2 - p.x(), 5 - p.y(), 2 * p.z() + 6); });
}

TEST_P(EveryForm, ModelsNestAndGeometricTransformsStayWithTheMesh) {
  const PolygonSoup soup = read(fbx_scene(
      {fbx_box(), fbx_model(3, {three("Lcl Scaling", 2, 2, 2)}),
       fbx_model(2, {three("Lcl Translation", 1, 0, 0), three("GeometricTranslation", 0, 1, 0)}),
       fbx_model(4)},
      {{2, 0}, {3, 2}, {4, 2}, {1, 2}, {1, 3}, {1, 4}}));
  ASSERT_EQ(soup.positions.rows(), 24);
  expect_corners(soup, 0, [](const Row& p) { return Row(2 * p + Row(1, 0, 0)); });  // model 3
  expect_corners(soup, 8, [](const Row& p) { return Row(p + Row(1, 1, 0)); });      // model 2
  expect_corners(soup, 16, [](const Row& p) { return Row(p + Row(1, 0, 0)); });     // model 4
}

TEST_P(EveryForm, TakesDefaultsFromTheTemplateOfModels) {
  FbxItem defaults = fbx_model(0, {three("Lcl Scaling", 3, 3, 3)}).children[0];
  FbxItems records = fbx_box_scene();
  records.push_back({"Definitions",
                     {},
                     {{"ObjectType", {"Model"}, {{"PropertyTemplate", {"FbxNode"}, {defaults}}}}}});
  expect_corners(read(records), 0, [](const Row& p) { return Row(3 * p); });
}

TEST_P(EveryForm, MirrorsTurnFacesOver) {
  const PolygonSoup soup = read_model({three("Lcl Scaling", 1, 1, -1)});
  for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(soup.corners[k], quads[0][3 - k]);
}

TEST_P(EveryForm, MorphsByTheWeightsOfTheFile) {
  const auto morphed = [](double percent) {
    return read(fbx_scene(
        {fbx_box(),
         fbx_model(2),
         {"Deformer", {std::int64_t{5}, "m", "BlendShape"}},
         {"Deformer", {std::int64_t{6}, "c", "BlendShapeChannel"}, {{"DeformPercent", {percent}}}},
         {"Geometry",
          {std::int64_t{7}, "s", "Shape"},
          {{"Indexes", {std::vector<int>{4, 6}}},
           {"Vertices", {std::vector<double>{0, 0, 8, 4, 0, 0}}}}}},
        {{2, 0}, {1, 2}, {5, 1}, {6, 5}, {7, 6}}));
  };
  EXPECT_EQ(outlines(morphed(0)), outlines_of_the_box(true));
  const PolygonSoup half = morphed(50);
  EXPECT_EQ(half.positions.row(4), Row(0, 0, 7));
  EXPECT_EQ(half.positions.row(6), Row(3, 2, 3));
  EXPECT_EQ(half.positions.row(5), Row(1, 0, 3));
}

/// The upper corners follow joint 8; the mesh stood 10 further along x when it was bound.
FbxItems skinned(double weight) {
  const std::vector<double> transform{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 10, 0, 0, 1};
  return fbx_scene({fbx_box(),
                    fbx_model(2, {three("Lcl Translation", 0, 0, -5)}),
                    fbx_model(8, {three("Lcl Translation", -10, 0, 2)}, "LimbNode"),
                    {"Deformer", {std::int64_t{5}, "skin", "Skin"}},
                    {"Deformer",
                     {std::int64_t{6}, "cluster", "Cluster"},
                     {{"Indexes", {std::vector<int>{4, 5, 6, 7}}},
                      {"Weights", {std::vector<double>(4, weight)}},
                      {"Transform", {transform}}}}},
                   {{2, 0}, {8, 0}, {1, 2}, {5, 1}, {6, 5}, {8, 6}});
}

TEST_P(EveryForm, ASkinFollowsItsJointsAndTheRestItsModel) {
  for (const double weight : {1.0, 0.25}) {  // weights of a vertex are made to sum to 1
    expect_corners(read(skinned(weight)), 0,
                   [](const Row& p) { return Row(p.x(), p.y(), p.z() + (p.z() > 0 ? 2 : -5)); });
  }
}

std::vector<double> shifted(double x, double y, double z) {
  return {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, y, z, 1};
}

/// The lower corners follow joint 8, the upper ones joint 18, which hangs from it; another box
/// hangs from the latter by model 12. They were bound at (0, 0, 1) and (0, 0, 3). `lower` and
/// `upper` are where they stand. `told`: where the second cluster says that the mesh was.
FbxItems posed(const FbxProperty& lower, const FbxProperty& upper, double told = 0) {
  const auto cluster = [](std::int64_t number, const std::vector<int>& moved, double height,
                          double mesh) {
    return FbxItem{"Deformer",
                   {number, "cluster", "Cluster"},
                   {{"Indexes", {moved}},
                    {"Weights", {std::vector<double>(4, 1.0)}},
                    {"Transform", {shifted(0, 0, mesh - height)}},
                    {"TransformLink", {shifted(0, 0, height)}}}};
  };
  return fbx_scene({fbx_box(),
                    fbx_model(2),
                    fbx_model(8, {lower}, "LimbNode"),
                    fbx_model(18, {upper}, "LimbNode"),
                    fbx_model(12, {three("Lcl Translation", 5, 0, 0)}),
                    {"Deformer", {std::int64_t{5}, "skin", "Skin"}},
                    cluster(6, {0, 1, 2, 3}, 1, 0),
                    cluster(7, {4, 5, 6, 7}, 3, told)},
                   {{2, 0},
                    {8, 0},
                    {18, 8},
                    {12, 18},
                    {1, 2},
                    {1, 12},
                    {5, 1},
                    {6, 5},
                    {7, 5},
                    {8, 6},
                    {18, 7}});
}

PolygonSoup read_bound(const FbxItems& records, FbxForm form) {
  const OwnFolder folder;
  return read_polygons(folder.write("box.fbx", fbx(records, form)), {}, {true});
}

TEST_P(EveryForm, APosedSkinIsReadAsItWasBoundIfOneAsks) {
  const FbxItems records =
      posed(three("Lcl Translation", 0, 7, 1), three("Lcl Translation", 3, 0, 2));
  const PolygonSoup shown = read(records);
  EXPECT_TRUE(shown.posed);
  // The skin of the geometry moves it wherever a model shows it.
  expect_corners(shown, 0, [](const Row& p) { return Row(p + Row(p.z() > 0 ? 3 : 0, 7, 0)); });
  const PolygonSoup bound = read_bound(records, GetParam());
  EXPECT_TRUE(bound.posed);
  expect_corners(bound, 0, [](const Row& p) { return Row(p + Row(0, 7, 0)); });
}

/// Another file's objects beside those, their numbers 1000 larger.
FbxItems beside(FbxItems one, const FbxItems& other) {
  const auto larger = [](FbxContent& number) {
    if (auto* value = std::get_if<std::int64_t>(&number); *value > 0) *value += 1000;
  };
  for (FbxItem object : other[0].children) {
    larger(object.values[0]);
    one[0].children.push_back(object);
  }
  for (FbxItem link : other[1].children) {
    for (const std::size_t k : {1U, 2U}) larger(link.values[k]);
    one[1].children.push_back(link);
  }
  return one;
}

/// They were bound in one place; each is bent for itself, or not.
TEST_P(EveryForm, FiguresStandWhereTheirTopmostJointsAreShown) {
  const FbxProperty here = three("Lcl Translation", 0, 7, 1);
  const FbxProperty there = three("Lcl Translation", 60, 7, 1);
  const FbxProperty straight = three("Lcl Translation", 0, 0, 2);
  for (const FbxProperty& upper : {three("Lcl Translation", 3, 0, 2), straight}) {
    const FbxItems crowd = beside(posed(here, upper), posed(there, straight));
    const PolygonSoup bound = read_bound(crowd, GetParam());
    EXPECT_EQ(bound.posed, upper.values != straight.values);
    expect_corners(bound, 0, [](const Row& p) { return Row(p + Row(0, 7, 0)); });
    expect_corners(bound, 16, [](const Row& p) { return Row(p + Row(60, 7, 0)); });
    EXPECT_EQ(bound.positions.bottomRows(16), read(crowd).positions.bottomRows(16));
  }
}

/// The node that holds the joints is turned about z, and a hat hangs from it.
TEST_P(EveryForm, AFigureKeepsThePlaceOfWhatHoldsItsJoints) {
  FbxItems records = posed(three("Lcl Translation", 0, 0, 1), three("Lcl Translation", 3, 0, 2));
  records[0].children.push_back(
      fbx_model(40, {three("Lcl Translation", 10, 0, 0), three("Lcl Rotation", 0, 0, 90)}, "Null"));
  records[0].children.push_back(fbx_model(41));
  FbxItems& links = records[1].children;
  for (FbxItem& link : links) {
    if (std::get<std::int64_t>(link.values[1]) == 8 &&
        std::get<std::int64_t>(link.values[2]) == 0) {
      link.values[2] = std::int64_t{40};
    }
  }
  for (const auto& [child, parent] : FbxLinks{{40, 0}, {41, 40}, {31, 41}}) {
    links.push_back({"C", {"OO", child, parent}});
  }
  FbxItem hat = fbx_box();
  hat.values[0] = std::int64_t{31};
  records[0].children.push_back(hat);
  const PolygonSoup bound = read_bound(records, GetParam());
  ASSERT_EQ(bound.positions.rows(), 24);
  for (const Eigen::Index first : {0, 8, 16}) {
    expect_corners(bound, first, [](const Row& p) { return Row(10 - p.y(), p.x(), p.z()); });
  }
}

/// It is bound to the upper joint alone, or to one that hangs from it.
TEST_P(EveryForm, ABootGoesWithTheBodyThatHasItsJoint) {
  for (const bool is_below : {false, true}) {
    FbxItems records = posed(three("Lcl Translation", 0, 7, 1), three("Lcl Translation", 3, 0, 2));
    FbxItem boot = fbx_box();
    boot.values[0] = std::int64_t{31};
    FbxItem cluster = records[0].children.back();
    cluster.values[0] = std::int64_t{34};
    FbxItems& objects = records[0].children;
    objects.push_back(fbx_model(35, {}, "LimbNode"));
    objects.push_back(boot);
    objects.push_back(fbx_model(32));
    objects.push_back({"Deformer", {std::int64_t{33}, "skin", "Skin"}});
    objects.push_back(cluster);
    for (const auto& [child, parent] :
         FbxLinks{{31, 32}, {32, 0}, {33, 31}, {34, 33}, {35, 18}, {is_below ? 35 : 18, 34}}) {
      records[1].children.push_back({"C", {"OO", child, parent}});
    }
    const PolygonSoup bound = read_bound(records, GetParam());
    ASSERT_EQ(bound.positions.rows(), 24);
    for (const Eigen::Index first : {0, 16}) {
      expect_corners(bound, first, [](const Row& p) { return Row(p + Row(0, 7, 0)); });
    }
  }
}

TEST_P(EveryForm, BrokenMatricesOfBindingTellNothing) {
  FbxItems records = posed(three("Lcl Translation", 0, 7, 1), three("Lcl Translation", 3, 0, 2));
  const PolygonSoup wanted = read(records);
  const std::vector<double> flat(16, 0.0);
  for (const std::vector<double>& numbers : {std::vector<double>{1, 2, 3}, flat}) {
    records[0].children[6].children[3].values = {numbers};
    EXPECT_EQ(read(records).positions, wanted.positions);
    const PolygonSoup bound = read_bound(records, GetParam());
    EXPECT_FALSE(bound.posed);
    EXPECT_EQ(bound.positions, wanted.positions);
  }
}

TEST_P(EveryForm, MeshesThatHangFromJointsGoWithThem) {
  FbxItems records = posed(three("Lcl Translation", 0, 7, 1), three("Lcl Translation", 3, 0, 2));
  FbxItem sword = fbx_box();
  sword.values[0] = std::int64_t{31};
  records[0].children.push_back(sword);
  records[0].children.push_back(fbx_model(32, {three("Lcl Translation", 5, 0, 0)}));
  records[0].children.push_back(fbx_model(33, {three("Lcl Translation", 0, 0, 4)}));
  for (const auto& [child, parent] : FbxLinks{{31, 32}, {32, 18}, {31, 33}, {33, 0}}) {
    records[1].children.push_back({"C", {"OO", child, parent}});
  }
  const auto swords = [&](const PolygonSoup& soup, double x, double y) {
    expect_corners(soup, 16, [&](const Row& p) { return Row(p + Row(5 + x, y, 3)); });
    expect_corners(soup, 24, [](const Row& p) { return Row(p + Row(0, 0, 4)); });
  };
  swords(read(records), 3, 7);
  swords(read_bound(records, GetParam()), 0, 7);
}

/// Moved as a whole, or said to be bound in two places: then it is read as shown.
TEST_P(EveryForm, ASkinThatIsMovedAsAWholeIsNotPosed) {
  const FbxProperty up = three("Lcl Translation", 0, 0, 2);
  const FbxItems whole = posed(three("Lcl Translation", 0, 7, 1), up);
  const FbxItems torn =
      posed(three("Lcl Translation", 0, 7, 1), three("Lcl Translation", 3, 0, 2), 1);
  for (const FbxItems& records : {whole, torn}) {
    const PolygonSoup bound = read_bound(records, GetParam());
    EXPECT_FALSE(bound.posed);
    EXPECT_EQ(bound.positions, read(records).positions);
  }
}

TEST_P(EveryForm, ArraysOfBytesArePassedOver) {
  FbxItem box = fbx_box();
  box.children.push_back({"Smoothness", {std::vector<signed char>{1, 0, -1}}});
  expect_corners(read(fbx_scene({box, fbx_model(2)}, {{2, 0}, {1, 2}})), 0,
                 [](const auto& p) { return p; });
}

TEST_P(EveryForm, RefusesWhatIsBroken) {
  const auto message = [](const FbxItems& records) {
    return refusal_of([&] { return read(records); });
  };
  FbxItem beyond = fbx_box();
  beyond.children[1].values = {std::vector<int>{0, 1, -9}};
  EXPECT_NE(message(fbx_scene({beyond, fbx_model(2)}, {{1, 2}})).find("vertex index 8"),
            std::string::npos);
  FbxItem crooked = fbx_box();
  crooked.children[0].values = {std::vector<double>{0, 1, 2, 3}};
  EXPECT_NE(message(fbx_scene({crooked, fbx_model(2)}, {{1, 2}})).find("4 coordinates"),
            std::string::npos);
  EXPECT_NE(message(fbx_scene({fbx_box(), fbx_model(2), fbx_model(3)}, {{1, 2}, {2, 3}, {3, 2}}))
                .find("parts of each other"),
            std::string::npos);
  EXPECT_NE(message({}).find("\"Objects\""), std::string::npos);
  EXPECT_NE(message(fbx_scene({fbx_model(2)}, {})).find("no faces"), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(Fbx, EveryForm,
                         testing::Values(FbxForm::text, FbxForm::binary,
                                         FbxForm::binary_wide_and_zipped));

TEST(ReadFbx, OlderVersionsAreNamed) {
  const OwnFolder folder;
  for (const FbxForm form : {FbxForm::text, FbxForm::binary}) {
    const std::string message = refusal(folder.write("old.fbx", fbx(fbx_box_scene(), form, 6100)));
    EXPECT_NE(message.find("version 6100"), std::string::npos) << message;
  }
}

TEST(ReadFbx, AnArrayThatDoesNotUnpackIsRefusedBeforeMemoryIsTaken) {
  std::string bytes = fbx(fbx_box_scene(), FbxForm::binary_wide_and_zipped);
  const std::size_t array = bytes.find("Vertices") + 8;
  ASSERT_EQ(bytes[array], 'd');
  bytes.replace(array + 1, 4, std::string(4, '\x7f'));
  const OwnFolder folder;
  EXPECT_NE(refusal(folder.write("box.fbx", bytes)).find("does not unpack"), std::string::npos);
}

}  // namespace
}  // namespace curveskel::read_fbx_laws
