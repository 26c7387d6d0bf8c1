// Laws of FBX files out of files with polygons: their faces and vertices are those of the file.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <optional>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/read.hpp>
#include <curveskel/rig_files.hpp>
#include "rig/gltf/dressed_file.hpp"
#include "surface/read/fbx_scene.hpp"
#include "surface/read/fbx_tree.hpp"
#include "tests/own_folder.hpp"
#include "tests/rig/random_rigs.hpp"

namespace curveskel::fbx_polygons_laws {
namespace {

namespace fs = std::filesystem;

/// Tori of quads, some cut into triangles, drawn by lot.
struct PolygonSubject {
  unsigned seed = 1;
  int objects = 1;
  int materials = 0;
  bool textures = false;  ///< of each corner by its face, so that all edges are seams
  bool normals = false;   ///< likewise

  [[nodiscard]] std::string text() const {
    std::mt19937 random(seed);
    std::ostringstream obj;
    for (int k = 0; textures && k < 40; ++k) obj << "vt " << k << "e-2 " << 2 * k << "e-2\n";
    if (normals) obj << "vn 0 0 1\nvn 1 0 0\nvn .6 .8 0\n";
    for (int object = 0; object < objects; ++object) {
      if (objects > 1) obj << "o part " << object << '\n';
      write_torus(obj, object, random);
    }
    return obj.str();
  }

 private:
  static constexpr int rows = 5;
  static constexpr int columns = 9;

  void write_torus(std::ostringstream& obj, int number, std::mt19937& random) const {
    for (int row = 0; row < rows; ++row) {
      for (int column = 0; column < columns; ++column) {
        const double a = 2 * std::numbers::pi * row / rows;
        const double b = 2 * std::numbers::pi * column / columns;
        const double far = 3 + std::cos(a);
        obj << "v " << far * std::cos(b) + 10 * number << ' ' << std::sin(a) << ' '
            << far * std::sin(b) << '\n';
      }
    }
    const int first = number * rows * columns;
    const auto vertex = [&](int row, int column) {
      return first + row % rows * columns + column % columns;
    };
    for (int row = 0; row < rows; ++row) {
      for (int column = 0; column < columns; ++column) {
        const std::vector<int> quad{vertex(row, column), vertex(row + 1, column),
                                    vertex(row + 1, column + 1), vertex(row, column + 1)};
        if (materials > 0) obj << "usemtl m" << random() % unsigned(materials) << '\n';
        if (random() % 3 == 0) {
          write_face(obj, {quad[0], quad[1], quad[2]}, random);
          write_face(obj, {quad[2], quad[3], quad[0]}, random);
        } else {
          write_face(obj, quad, random);
        }
      }
    }
  }

  void write_face(std::ostringstream& obj, const std::vector<int>& face,
                  std::mt19937& random) const {
    obj << 'f';
    for (const int v : face) {
      obj << ' ' << v + 1;
      if (textures || normals) obj << '/';
      if (textures) obj << random() % 40 + 1;
      if (normals) obj << '/' << random() % 3 + 1;
    }
    obj << '\n';
  }
};

std::vector<PolygonSubject> subjects() {
  return {{},
          {.seed = 2, .textures = true},
          {.seed = 3, .materials = 3, .textures = true},
          {.seed = 4, .materials = 2, .normals = true},
          {.seed = 5, .objects = 3},
          {.seed = 6, .objects = 2, .materials = 4, .textures = true, .normals = true}};
}

class FbxPolygons : public testing::Test {
 protected:
  /// The file with a rig, as FBX.
  [[nodiscard]] fs::path fbx_of(const fs::path& file, const std::string& name) const {
    const Rig rig = random_rig(read_polygons(file, {}).positions.rows(), 7, "bone ");
    const auto edited =
        format_rig_into(file, rig, {RigFormat::fbx, OldRig::replaced, "rig", "a test"});
    EXPECT_TRUE(edited);
    return folder_.write(name, edited->bytes);
  }

  [[nodiscard]] static DressedFile looks_of(const fs::path& file) {
    std::vector<std::string> notes;
    const FileBytes bytes = read_file(file, {});
    return *read_dressed_file(bytes, {.with_polygons = true}, notes, {});
  }

  OwnFolder folder_;
};

void expect_same_faces(const DressedFile& found, const DressedFile& wanted) {
  const DressedMesh& a = found.mesh;
  const DressedMesh& b = wanted.mesh;
  ASSERT_EQ(a.offsets, b.offsets);
  for (std::size_t face = 0; face + 1 < b.offsets.size() && !b.materials.empty(); ++face) {
    EXPECT_EQ(a.materials.at(idx(a.material_of_face[face])),
              b.materials.at(idx(b.material_of_face[face])));
  }
  for (std::size_t c = 0; c < b.corners.size(); ++c) {
    ASSERT_EQ(a.corners[c].place, b.corners[c].place);
    for (std::size_t k = 0; k < 2 && b.corners[c].texture >= 0; ++k) {
      EXPECT_NEAR(a.textures.at(idx(a.corners[c].texture)).at(k),
                  b.textures.at(idx(b.corners[c].texture)).at(k), 1e-6);
    }
    for (std::size_t k = 0; k < 3 && b.corners[c].normal >= 0; ++k) {
      EXPECT_NEAR(a.normals.at(idx(a.corners[c].normal)).at(k),
                  b.normals.at(idx(b.corners[c].normal)).at(k), 1e-6);
    }
  }
}

// Quads came out as triangles, and vertices on seams as several.
TEST_F(FbxPolygons, AreThoseOfTheFileAndSoAreVertices) {
  for (const PolygonSubject& subject : subjects()) {
    SCOPED_TRACE(subject.seed);
    const fs::path file = folder_.write("given.obj", subject.text());
    const fs::path once = fbx_of(file, "once.fbx");
    const fs::path twice = fbx_of(once, "twice.fbx");
    const DressedFile given = looks_of(file);
    for (const fs::path& written : {once, twice}) {
      const DressedFile found = looks_of(written);
      ASSERT_EQ(found.mesh.places.size(), given.mesh.places.size());
      for (std::size_t k = 0; k < given.mesh.places.size(); ++k) {
        EXPECT_NEAR(found.mesh.places[k], given.mesh.places[k], 1e-5);
      }
      expect_same_faces(found, given);
      EXPECT_EQ(found.mesh.parts.size(), std::size_t(subject.objects));
    }
  }
}

// A file of two thousand objects was 2.9 GB, a cluster for each of them with each of the joints.
TEST_F(FbxPolygons, AMeshNamesTheJointsThatMoveItAndEachJointIsNamed) {
  constexpr int joints = 40;
  const PolygonSubject subject{.seed = 7, .objects = 5};
  const fs::path given = folder_.write("given.obj", subject.text());
  const Eigen::Index vertices = read_polygons(given, {}).positions.rows();
  Rig rig = random_rig(vertices, joints, "bone ");
  rig.weights.setZero();  // an object has two joints of its own
  for (Eigen::Index v = 0; v < vertices; ++v) {
    rig.weights.insert(v, 2 * (v * subject.objects / vertices) + v % 2) = 1;
  }
  const auto edited =
      format_rig_into(given, rig, {RigFormat::fbx, OldRig::replaced, "rig", "a test"});
  ASSERT_TRUE(edited);
  const FileBytes file{"rig.fbx", edited->bytes};
  const FbxRecord root = parse_fbx(file);
  int moving = 0;
  int idle = 0;
  for (const FbxRecord* deformer : FbxScene(file, root).all("Deformer")) {
    if (deformer->text(2) == "Cluster") ++(deformer->child("Indexes") != nullptr ? moving : idle);
  }
  EXPECT_EQ(moving, 2 * subject.objects);
  EXPECT_EQ(idle, joints - 2);  // of the first object, which names all
}

}  // namespace
}  // namespace curveskel::fbx_polygons_laws
