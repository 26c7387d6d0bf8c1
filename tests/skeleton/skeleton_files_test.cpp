// Laws of the skeleton files: what is written is read back to the last bit, and what is wrong is
// said. tests/readers has the same with other people's readers.
#include <curveskel/levels.hpp>
#include <curveskel/skeleton_files.hpp>

#include <gtest/gtest.h>
#include <zlib.h>

#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <tuple>

#include <curveskel/advanced/write_file.hpp>
#include <curveskel/error.hpp>
#include "tests/own_folder.hpp"
#include "tests/skeleton/skeleton_samples.hpp"

namespace curveskel::skeleton_files_laws {
namespace {

namespace fs = std::filesystem;

CurveSkeleton read_text(const std::string& name, std::string_view bytes) {
  const OwnFolder folder;
  return read_skeleton(folder.write(name, bytes));
}

std::string failure_of(const std::string& name, std::string_view bytes) {
  try {
    const CurveSkeleton skeleton = read_text(name, bytes);
    return "read " + std::to_string(skeleton.nodes.rows()) + " nodes";
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::input);
    return error.what();
  }
}

std::string repeated(std::string_view text, int times) {
  std::string all;
  for (int k = 0; k < times; ++k) all += text;
  return all;
}

CurveSkeleton round_trip(const CurveSkeleton& skeleton, const std::string& format,
                         const SkeletonContext& context = {nullptr, "made by a test", {}}) {
  return read_text("skeleton." + format,
                   format_skeleton(skeleton, *choice_of(skeleton_formats, format), context));
}

template <typename Values>
bool same(const Values& a, const Values& b) {
  return a.rows() == b.rows() && (a.array() == b.array()).all();
}

using Point = std::array<double, 3>;
/// Nodes with their radii and edges by coordinates: equal for graphs that differ in numbering only.
using Shape = std::pair<std::map<Point, double>, std::set<std::pair<Point, Point>>>;

Shape shape_of(const CurveSkeleton& skeleton, bool with_radii) {
  const auto point = [&](int node) {
    return Point{skeleton.nodes(node, 0), skeleton.nodes(node, 1), skeleton.nodes(node, 2)};
  };
  Shape shape;
  for (int node = 0; node < skeleton.nodes.rows(); ++node) {
    shape.first[point(node)] = with_radii && skeleton.radii.size() > 0 ? skeleton.radii(node) : -1;
  }
  for (const auto& edge : skeleton.edges.rowwise()) {
    shape.second.insert(std::minmax({point(edge(0)), point(edge(1))}));
  }
  return shape;
}

class EveryFormat : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(SkeletonFiles, EveryFormat,
                         testing::Values("obj", "ply", "cgal", "swc", "vtp", "graphml", "json"),
                         [](const auto& format) { return format.param; });

TEST_P(EveryFormat, GivesTheSameGraphBack) {
  const bool with_radii = GetParam() != "obj" && GetParam() != "cgal";
  for (const auto& [name, skeleton] : skeleton_samples()) {
    const CurveSkeleton back = round_trip(skeleton, GetParam());
    EXPECT_EQ(back.nodes.rows(), skeleton.nodes.rows()) << name;
    EXPECT_EQ(back.edges.rows(), skeleton.edges.rows()) << name;
    EXPECT_EQ(back.radii.size(), with_radii ? skeleton.radii.size() : 0) << name;
    EXPECT_EQ(shape_of(back, with_radii), shape_of(skeleton, with_radii)) << name;
  }
}

/// The others are ordered by branches.
class NumberedFormat : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(SkeletonFiles, NumberedFormat,
                         testing::Values("obj", "ply", "vtp", "graphml", "json"),
                         [](const auto& format) { return format.param; });

TEST_P(NumberedFormat, KeepsTheNumbering) {
  for (const auto& [name, skeleton] : skeleton_samples()) {
    const CurveSkeleton back = round_trip(skeleton, GetParam());
    EXPECT_TRUE(same(back.nodes, skeleton.nodes)) << name;
    EXPECT_TRUE(same(back.edges, skeleton.edges)) << name;
  }
}

TEST_P(EveryFormat, ReadsWhatIsGzippedToo) {
  const OwnFolder folder;
  const CurveSkeleton skeleton = skeleton_samples()[4].skeleton;
  const std::string bytes = format_skeleton(skeleton, *choice_of(skeleton_formats, GetParam()), {});
  const fs::path file = folder.path() / ("s." + GetParam() + ".gz");
  const gzFile zipped = gzopen(file.c_str(), "wb");
  ASSERT_EQ(gzwrite(zipped, bytes.data(), static_cast<unsigned>(bytes.size())),
            static_cast<int>(bytes.size()));
  gzclose(zipped);
  EXPECT_EQ(shape_of(read_skeleton(file), false), shape_of(skeleton, false));
}

TEST_P(EveryFormat, FailsOnEveryTruncationOrReadsAnotherGraphButNeverCrashes) {
  const CurveSkeleton skeleton = skeleton_samples()[5].skeleton;
  const std::string bytes = format_skeleton(skeleton, *choice_of(skeleton_formats, GetParam()), {});
  int failures = 0;
  for (std::size_t length = 0; length < bytes.size(); length += 1 + length / 40) {
    const std::string message = failure_of("s." + GetParam(), bytes.substr(0, length));
    failures += message.starts_with("read ") ? 0 : 1;
  }
  EXPECT_GT(failures, 5);
}

TEST_P(EveryFormat, WritesTheSameBytesTwice) {
  for (const auto& [name, skeleton] : skeleton_samples()) {
    const auto format = *choice_of(skeleton_formats, GetParam());
    EXPECT_EQ(format_skeleton(skeleton, format, {}), format_skeleton(skeleton, format, {})) << name;
  }
}

TEST_P(EveryFormat, StaysSoundWhateverTheProvenanceSays) {
  const SkeletonContext context{nullptr, "a <b> & \"c\" -- --> ]]>\nv 9 9 9\r\nl 1 2 \\", {}};
  const CurveSkeleton skeleton = skeleton_samples()[2].skeleton;
  EXPECT_EQ(shape_of(round_trip(skeleton, GetParam(), context), false), shape_of(skeleton, false));
}

TEST(SkeletonJson, HoldsTheMapTheReportAndTheProvenance) {
  const CurveSkeleton skeleton = skeleton_samples()[4].skeleton;
  const SkeletonContext context{
      nullptr, "curveskel, \"model\".obj",
      R"({"parameters": {"resolution": 8000}, "certificate": {"genus": 2}})"};
  const auto json = nlohmann::json::parse(format_skeleton(skeleton, SkeletonFormat::json, context));
  EXPECT_EQ(json["provenance"], context.provenance);
  EXPECT_EQ(json["parameters"]["resolution"], 8000);
  EXPECT_EQ(json["certificate"]["genus"], 2);
  EXPECT_TRUE(same(round_trip(skeleton, "json", context).node_of_vertex, skeleton.node_of_vertex));
}

TEST(SkeletonJson, RefusesAReportThatWouldHideTheGraph) {
  for (const std::string report : {R"({"nodes": []})", "[1]", "{", "3"}) {
    EXPECT_THROW(
        (void)format_skeleton(CurveSkeleton{}, SkeletonFormat::json, {nullptr, "", report}), Error)
        << report;
  }
}

TEST(SkeletonSwc, IsATreeWithPositiveRadiiAndOneCutPerLoop) {
  for (const auto& [name, skeleton] : skeleton_samples()) {
    std::istringstream text(format_skeleton(skeleton, SkeletonFormat::swc, {}));
    int samples = 0;
    int cuts = 0;
    int roots = 0;
    for (std::string line; std::getline(text, line);) {
      if (line.starts_with("# cut ")) ++cuts;
      if (line.starts_with('#')) continue;
      int id = 0, type = 0, parent = 0;
      double x = 0, y = 0, z = 0, radius = 0;
      ASSERT_EQ(std::sscanf(line.c_str(), "%d %d %lf %lf %lf %lf %d", &id, &type, &x, &y, &z,
                            &radius, &parent),
                7);
      EXPECT_EQ(id, ++samples);
      EXPECT_LT(parent, id);
      EXPECT_GT(radius, 0) << name;
      roots += parent == -1 ? 1 : 0;
    }
    EXPECT_EQ(samples, skeleton.nodes.rows()) << name;
    EXPECT_EQ(roots, graph_topology(skeleton).components) << name;
    EXPECT_EQ(cuts, graph_topology(skeleton).cycle_rank) << name;
  }
}

/// 400,000 nodes, each without a radius: 10^11 comparisons if each asked for the whole extent.
TEST(SkeletonSwc, AsksOnceWhatStandsForUnknownRadii) {
  constexpr int nodes = 400000;
  CurveSkeleton line;
  line.nodes.setZero(nodes, 3);
  line.edges.resize(nodes - 1, 2);
  for (int node = 0; node < nodes; ++node) line.nodes(node, 0) = node;
  for (int edge = 0; edge + 1 < nodes; ++edge) line.edges.row(edge) << edge, edge + 1;
  const CurveSkeleton back = round_trip(line, "swc");
  EXPECT_EQ(back.radii.size(), 0);
  EXPECT_TRUE(same(back.nodes, line.nodes));
  EXPECT_TRUE(same(back.edges, line.edges));
}

TEST(SkeletonRoot, IsTheFirstSampleOfSwcAndChangesNothingElse) {
  for (const auto& [name, skeleton] : skeleton_samples()) {
    const auto with_root = [&skeleton = skeleton](int root, SkeletonFormat format) {
      return format_skeleton(skeleton, format, {nullptr, "", {}, root});
    };
    const auto nodes = static_cast<int>(skeleton.nodes.rows());
    for (int root = 0; root < nodes; ++root) {
      SCOPED_TRACE(name + ", root " + std::to_string(root));
      const CurveSkeleton back = read_text("a.swc", with_root(root, SkeletonFormat::swc));
      EXPECT_EQ(back.nodes.row(0), skeleton.nodes.row(root));
      EXPECT_EQ(shape_of(back, true), shape_of(skeleton, true));
      const std::string text = with_root(root, SkeletonFormat::json);
      EXPECT_EQ(nlohmann::json::parse(text)["root"], root);
      EXPECT_TRUE(same(read_text("a.json", text).nodes, skeleton.nodes));
    }
    for (const SkeletonFormat format : {SkeletonFormat::swc, SkeletonFormat::json}) {
      EXPECT_EQ(with_root(-1, format), format_skeleton(skeleton, format, {}));
      EXPECT_THROW((void)with_root(nodes, format), Error);
      EXPECT_THROW((void)with_root(-2, format), Error);
    }
    EXPECT_FALSE(nlohmann::json::parse(with_root(-1, SkeletonFormat::json)).contains("root"));
  }
}

TEST(SkeletonCsv, HasOneRowPerBranchAndTheWholeLength) {
  for (const auto& [name, skeleton] : skeleton_samples()) {
    std::istringstream text(format_skeleton(skeleton, SkeletonFormat::csv, {}));
    std::string line;
    std::getline(text, line);
    const auto columns = std::count(line.begin(), line.end(), ',');
    std::size_t rows = 0;
    double length = 0;
    for (; std::getline(text, line); ++rows) {
      ASSERT_EQ(std::count(line.begin(), line.end(), ','), columns);
      std::istringstream fields(line);
      std::string field;
      for (int column = 0; column <= 10; ++column) std::getline(fields, field, ',');
      length += std::stod(field);
    }
    double expected = 0;
    for (const auto& e : skeleton.edges.rowwise()) {
      expected += (skeleton.nodes.row(e(0)) - skeleton.nodes.row(e(1))).norm();
    }
    EXPECT_EQ(rows, branches(skeleton).size()) << name;
    EXPECT_NEAR(length, expected, 1e-12 * expected) << name;
  }
}

TEST(SkeletonLives, AreInFilesAsTheyAreInTheSkeleton) {
  for (const auto& [name, sample] : skeleton_samples()) {
    if (sample.nodes.rows() == 0) continue;
    SCOPED_TRACE(name);
    CurveSkeleton skeleton = sample;
    skeleton.lives = Eigen::VectorXd::LinSpaced(skeleton.nodes.rows(), 0.25, 7);
    const std::string json = format_skeleton(skeleton, SkeletonFormat::json, {});
    const CurveSkeleton read = read_text("lives.json", json);
    EXPECT_EQ(read.lives, skeleton.lives);
    const auto parsed = nlohmann::json::parse(json);
    const auto levels = branch_levels(skeleton);
    ASSERT_EQ(parsed["branches"].size(), levels.size());
    for (std::size_t b = 0; b < levels.size(); ++b) {
      const bool for_ever = levels[b].life >= lives_for_ever;
      EXPECT_EQ(parsed["branches"][b]["life"].is_null(), for_ever);
      if (!for_ever) {
        EXPECT_EQ(parsed["branches"][b]["life"], levels[b].life);
      }
    }
    // Edges have what their branches have: the last lines of a PLY file are its edges.
    const auto of_edge = branch_of_edges(skeleton);
    std::istringstream ply(format_skeleton(skeleton, SkeletonFormat::ply, {}));
    std::string line;
    while (std::getline(ply, line) && line != "end_header") {
    }
    for (Eigen::Index node = 0; node < skeleton.nodes.rows(); ++node) std::getline(ply, line);
    for (std::size_t edge = 0; edge < of_edge.size(); ++edge) {
      const int branch = of_edge[edge];
      int from = 0;
      int to = 0;
      double life = 0;
      int number = 0;
      int parent = 0;
      double merge = 0;
      ply >> from >> to >> life >> number >> parent >> merge;
      ASSERT_TRUE(ply);
      EXPECT_EQ(edge_between(skeleton, from, to), static_cast<int>(edge));
      EXPECT_EQ(number, branch);
      EXPECT_EQ(life, levels[static_cast<std::size_t>(branch)].life);
      EXPECT_EQ(parent, levels[static_cast<std::size_t>(branch)].parent);
      EXPECT_EQ(merge, levels[static_cast<std::size_t>(branch)].merge);
    }
    const std::string graphml = format_skeleton(skeleton, SkeletonFormat::graphml, {});
    for (const char* key : {"life", "branch"}) {
      const std::string data = std::string("<data key=\"") + key + "\"";
      int count = 0;
      for (std::size_t at = 0; (at = graphml.find(data, at)) != std::string::npos; ++at) ++count;
      EXPECT_EQ(count, skeleton.edges.rows());
    }
    // Other readers pass over what they do not know.
    for (const char* file : {"lives.ply", "lives.vtp", "lives.graphml"}) {
      const auto format = choice_of(skeleton_formats, std::string(file).substr(6));
      ASSERT_TRUE(format);
      EXPECT_EQ(read_text(file, format_skeleton(skeleton, *format, {})).edges, skeleton.edges)
          << file;
    }
  }
}

class FormatWithLives : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(SkeletonFiles, FormatWithLives,
                         testing::Values("ply", "vtp", "graphml", "json"),
                         [](const auto& format) { return format.param; });

/// Life, branch, parent and merge, too.
TEST_P(FormatWithLives, GivesTheSameBytesWhenItIsReadAndWrittenAgain) {
  for (const auto& [name, sample] : skeleton_samples()) {
    for (const bool with_lives : {true, false}) {
      CurveSkeleton skeleton = sample;
      if (with_lives) skeleton.lives.setLinSpaced(skeleton.nodes.rows(), 0.25, 7);
      if (skeleton.nodes.rows() == 0) continue;
      const auto format = *choice_of(skeleton_formats, GetParam());
      const std::string bytes = format_skeleton(skeleton, format, {});
      const CurveSkeleton back = read_text("a." + GetParam(), bytes);
      EXPECT_EQ(back.lives.size(), with_lives ? skeleton.nodes.rows() : 0) << name;
      EXPECT_EQ(format_skeleton(back, format, {}), bytes) << name;
    }
  }
}

TEST(ForeignSkeletons, ChainsThatMeetInAPointAreJoined) {
  const auto expect_plus = [](const CurveSkeleton& skeleton, const std::string& what) {
    EXPECT_EQ(skeleton.nodes.rows(), 5) << what;
    EXPECT_EQ(skeleton.edges.rows(), 4) << what;
    EXPECT_EQ(graph_topology(skeleton).components, 1) << what;
    EXPECT_EQ(graph_topology(skeleton).junctions, 1) << what;
  };
  expect_plus(read_text("a.cgal", "3 -1 0 0 0 0 0 1 0 0\n2 0 0 0 0 1 0\n2 0 -1 0 0 0 0\n"), "cgal");
  expect_plus(read_text("a.polylines.txt", "3 -1 0 0 0 0 0 1 0 0 2 0 0 0 0 1 0 2 0 -1 0 -0 0 0"),
              "polylines.txt");
  expect_plus(read_text("a.obj",
                        "# points of each line on their own\r\nv -1 0 0\r\nv 0 0 0\r\nv 1 0 0\r\n"
                        "l 1 2 3\r\nv 0 0 0\r\nv 0 1 0\r\nl -2 -1\r\nv 0 -1 0\r\nl 6/1 4/2\r\n"
                        "v 7 7 7\r\nvn 0 0 1\r\n"),
              "obj");
  expect_plus(read_text("a.swc",
                        "# made elsewhere\n7 3 0 0 0 .5 -1\n9 3 1 0 0 .5 7\n1 3 -1 0 0 .5 7 # x\n"
                        "2 3 0 0 0 .5 -1\n3 3 0 1 0 1e-1 2\n\n 4 3 0 -1 0 1 2\n"),
              "swc");
}

TEST(ForeignSkeletons, PlyInAnyEncoding) {
  const auto bytes_of = [](auto value, bool swapped) {
    std::string bytes(sizeof(value), '\0');
    std::memcpy(bytes.data(), &value, sizeof(value));
    if (swapped) std::reverse(bytes.begin(), bytes.end());
    return bytes;
  };
  for (const bool swapped : {false, true}) {
    std::string bytes = std::string("ply\nformat binary_") + (swapped ? "big" : "little") +
                        "_endian 1.0\nelement edge 2\nproperty uchar red\nproperty uint vertex2\n"
                        "property uint vertex1\nelement vertex 3\nproperty float x\n"
                        "property float y\nproperty list uchar short spare\nproperty double z\n"
                        "property float radius\nend_header\n";
    for (const unsigned i : {0U, 1U}) {
      bytes += '\7' + bytes_of(i + 1, swapped) + bytes_of(i, swapped);
    }
    for (const float v : {0.5F, 1.5F, 2.5F}) {
      bytes += bytes_of(v, swapped) + bytes_of(-v, swapped) + '\2' + std::string(4, '\1') +
               bytes_of(static_cast<double>(v) / 3, swapped) + bytes_of(2 * v, swapped);
    }
    const CurveSkeleton skeleton = read_text("a.ply", bytes);
    ASSERT_EQ(skeleton.nodes.rows(), 3);
    EXPECT_EQ(skeleton.edges, (Edges(2, 2) << 0, 1, 1, 2).finished());
    EXPECT_EQ(skeleton.nodes.row(1), Eigen::RowVector3d(1.5, -1.5, 0.5));
    EXPECT_EQ(skeleton.radii, Eigen::Vector3d(1, 3, 5));
  }
}

TEST(ForeignSkeletons, NodeLinkJson) {
  const CurveSkeleton skeleton = read_text("a.json", R"({"directed": false, "nodes": [
      {"id": "hip", "x": 1, "y": 2, "z": 3}, {"id": "knee", "x": 1, "y": 2.5, "z": 3}],
      "links": [{"source": "knee", "target": "hip"}]})");
  EXPECT_EQ(skeleton.edges, (Edges(1, 2) << 0, 1).finished());
  EXPECT_EQ(skeleton.nodes(1, 1), 2.5);
  EXPECT_EQ(skeleton.radii.size(), 0);
}

TEST(BadSkeletonFiles, AreNamedWithTheLineTheValueAndTheNeed) {
  struct Case {
    std::string file, content;
    std::vector<std::string> said;
  };
  const std::vector<Case> cases{
      {"a.obj", "v 0 0 0\nv 1 0 0\nl 1 3\n", {"a.obj, line 3", "\"3\"", "2 vertices"}},
      {"a.obj", "v 0 0 0\nv 1 0 zero\nl 1 2\n", {"line 2", "\"zero\"", "z coordinate"}},
      {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", {"faces", "surface"}},
      {"a.obj", "v 0 0 0\nv 1 nan 0\nl 1 2\n", {"line 2", "nan"}},
      {"a.cgal", "2 0 0 0 1 0\n", {"line 2", "end of the file", "coordinate of point 2"}},
      {"a.cgal", "2 0 0 0 1 0 0\n0\n", {"line 2", "\"0\"", "1 or more"}},
      {"a.cgal", "99999999999 0 0 0\n", {"line 1", "99999999999"}},
      {"a.swc", "1 0 0 0 0 1 -1\n2 0 1 0 0 1 5\n", {"line 2", "\"5\"", "number of a sample"}},
      {"a.swc", "1 0 0 0 0 1 -1\n1 0 1 0 0 1 1\n", {"line 2", "\"1\"", "not used above"}},
      {"a.swc", "1 0 0 0 0 1\n", {"line 1", "end of the line", "parent"}},
      {"a.swc", "1 0 0 0 0 1 -1\n# cut 1 8\n", {"# cut 1 8", "two samples"}},
      {"a.ply",
       "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n1\n",
       {"\"edge\"", "\"vertex\""}},
      {"a.ply",
       "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\n"
       "property float z\nelement edge 0\nproperty int vertex1\nproperty int vertex2\n"
       "element edge 1\nproperty int colour\nend_header\n7\n",
       {"2 elements \"edge\""}},
      {"a.json",
       R"({"nodes": [)" + std::string(100000, '[') + std::string(100000, ']') + "], \"edges\": []}",
       {"nested 100002 deep"}},
      {"a.json", "{\"nodes\": [[0, 0, 0]],\n \"edges\": [[0, 1]]}", {"edge 0", "0 to 0"}},
      {"a.json", "{\"nodes\": [[0, 0]], \"edges\": []}", {"[0,0]", "node 0", "[x, y, z]"}},
      {"a.json", "{\"nodes\": [\n}", {"line 2", "JSON"}},
      {"a.json", R"({"nodes": [[0,0,1e999]], "edges": []})", {"number overflow", "1e999"}},
      {"a.json", R"({"nodes": [[0,0,0]], "edges": [], "radii": [1, 2]})", {"2 radii", "(1)"}},
      {"a.vtp", "<VTKFile type=\"UnstructuredGrid\"></VTKFile>", {"line 1", "UnstructuredGrid"}},
      {"a.vtp", "<VTKFile type=\"PolyData\">\n<PolyData></Poly>", {"line 2", "</Poly>"}},
      {"a.graphml",
       "<graphml>\n<graph>\n<node id=\"a\"/>\n</graph></graphml>",
       {"line 3", "\"a\"", "x, y or z"}},
      {"a.vtp",
       "<VTKFile type=\"PolyData\"><PolyData/>\n<AppendedData encoding=\"raw\">_aaaa",
       {"line 2", "</AppendedData>"}},
      {"a.graphml", "<graphml>\n<graph id=x></graph></graphml>", {"line 2", "id=x"}},
      {"a.graphml",
       "<graphml>" + repeated("<a>", 100000) + repeated("</a>", 100000) + "</graphml>",
       {"nested more than 64 deep"}},
      {"a.graphml", "<graphml>\n" + repeated("<a>", 100000), {"line 2"}},
      {"a.graphml", "<graphml/>\n<graphml/>", {"line 2", "nothing beside it"}},
      {"a.graphml", std::string("<graphml>\n\0</graphml>", 21), {"line 2", "zero byte"}},
      {"a.graphml",
       "<!DOCTYPE graphml [<!ENTITY a \"1\"><!ENTITY b \"&a;&a;\">]>\n<graphml>"
       "<key id=\"x\" attr.name=\"x\"/><graph>\n<node><data key=\"x\">&b;</data></node></graph>"
       "</graphml>",
       {"line 3", "&b;", "a finite number"}},
      {"a.svg", "<svg></svg>", {"svg", "obj, ply, cgal"}},
      {"a.png", "?", {"png", "does not hold the graph"}},
      {"a.unknown", "?", {"no known extension", "obj, ply, cgal"}},
      {"a.json", "{\"joints\": [], \"weights\": {}}", {"found a rig", "rig --joints"}},
      {"a.usda", "#usda 1.0\n(\n", {"a USD scene", "obj, ply, cgal"}},
      {"a.usdz",
       std::string("PK\3\4") + std::string(22, '\0') + std::string("\10\0\0\0", 4) + "rig.usda",
       {"a USD scene (USDZ)"}},
      {"a.glb", "glTF\2", {"a surface file (glb)", "the skeleton of that surface"}},
      {"a.gltf",
       "{\"asset\": {\"version\": \"2.0\"}, \"nodes\": [], \"meshes\": []}",
       {"a surface file (gltf)", "the skeleton of that surface"}},
      {"a.off", "OFF\n0 0 0\n", {"a surface file (off)", "the skeleton of that surface"}},
      {"a.bvh", "HIERARCHY\nROOT hips\n{\n", {"a BVH motion", "obj, ply, cgal"}},
      {"a.obj", "BLENDER-v304RENDH", {"a Blender scene"}},
      {"a.swc", "# nothing\n", {"without nodes"}},
  };
  for (const Case& bad : cases) {
    const std::string message = failure_of(bad.file, bad.content);
    EXPECT_NE(message.find(bad.file), std::string::npos) << message;
    for (const std::string& words : bad.said) {
      EXPECT_NE(message.find(words), std::string::npos) << message << "\n  lacks: " << words;
    }
  }
}

}  // namespace
}  // namespace curveskel::skeleton_files_laws
