// Small surfaces, spoiled as the bytes say, through repair, extract and make_rig: either an
// error that says why, or a skeleton of the right topology and a rig that moves every vertex.
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include <curveskel/extract.hpp>
#include <curveskel/make_rig.hpp>
#include <curveskel/repair.hpp>

namespace {

using namespace curveskel;

void require(bool holds) {
  if (!holds) std::abort();
}

/// Bytes taken one after the other, 0 once there are none left.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}
  [[nodiscard]] bool empty() const { return size_ == 0; }
  int next() {
    if (size_ == 0) return 0;
    --size_;
    return *data_++;
  }
  int below(int count) { return next() % count; }
  double coordinate() { return (next() - 128) / 16.0; }

 private:
  const std::uint8_t* data_;
  std::size_t size_;
};

using Corners = std::array<int, 3>;

struct Draft {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Corners> faces;

  void octahedron() {
    const int first = static_cast<int>(vertices.size());
    for (const double sign : {1.0, -1.0}) {
      for (int axis = 0; axis < 3; ++axis) vertices.push_back(sign * Eigen::Vector3d::Unit(axis));
    }
    for (int octant = 0; octant < 8; ++octant) {
      Corners face{first + (octant & 1 ? 3 : 0), first + (octant & 2 ? 4 : 1),
                   first + (octant & 4 ? 5 : 2)};
      const bool mirrored = ((octant ^ octant >> 1 ^ octant >> 2) & 1) != 0;
      if (mirrored) std::swap(face[1], face[2]);
      faces.push_back(face);
    }
  }

  void torus(int around, int across) {
    const int first = static_cast<int>(vertices.size());
    const auto index = [&](int i, int j) { return first + i % around * across + j % across; };
    for (int i = 0; i < around; ++i) {
      for (int j = 0; j < across; ++j) {
        const double a = 2 * 3.14159265 * i / around;
        const double b = 2 * 3.14159265 * j / across;
        const double radius = 2 + std::cos(b);
        vertices.emplace_back(radius * std::cos(a), radius * std::sin(a), std::sin(b));
        faces.push_back({index(i, j), index(i + 1, j), index(i + 1, j + 1)});
        faces.push_back({index(i, j), index(i + 1, j + 1), index(i, j + 1)});
      }
    }
  }

  int vertex(Bytes& bytes) { return bytes.below(static_cast<int>(vertices.size())); }
  Corners& face(Bytes& bytes) { return faces[at(bytes.below(static_cast<int>(faces.size())))]; }
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }

  void split_face(Bytes& bytes) {
    Corners& corners = face(bytes);
    const auto [a, b, c] = corners;
    const int middle = static_cast<int>(vertices.size());
    vertices.push_back((vertices[at(a)] + vertices[at(b)] + vertices[at(c)]) / 3);
    corners = {a, b, middle};
    faces.push_back({b, c, middle});
    faces.push_back({c, a, middle});
  }

  void spoil(Bytes& bytes) {
    switch (bytes.below(10)) {
      case 0:
        vertices[at(vertex(bytes))] = {bytes.coordinate(), bytes.coordinate(), bytes.coordinate()};
        break;
      case 1:
        vertices[at(vertex(bytes))] = vertices[at(vertex(bytes))];
        break;
      case 2:
        vertices[at(vertex(bytes))] *= std::exp2(bytes.next() / 4.0 - 32);
        break;
      case 3:
        split_face(bytes);
        break;
      case 4:
        std::swap(face(bytes)[0], face(bytes)[0]);
        break;
      case 5: {
        Corners& corners = face(bytes);
        std::swap(corners[0], corners[1]);
        break;
      }
      case 6: {
        const Corners again = face(bytes);
        faces.push_back(again);
        break;
      }
      case 7:
        face(bytes)[at(bytes.below(3))] = vertex(bytes);
        break;
      case 8:
        for (Eigen::Vector3d& p : vertices) p.z() *= bytes.next() / 255.0;
        break;
      case 9:
        face(bytes) = faces.back();
        if (faces.size() > 1) faces.pop_back();
        break;
    }
  }

  [[nodiscard]] PolygonSoup soup() const {
    PolygonSoup result;
    result.positions.resize(static_cast<Eigen::Index>(vertices.size()), 3);
    for (std::size_t v = 0; v < vertices.size(); ++v) {
      result.positions.row(static_cast<Eigen::Index>(v)) = vertices[v];
    }
    result.offsets.push_back(0);
    for (const Corners& corners : faces) {
      result.corners.insert(result.corners.end(), corners.begin(), corners.end());
      result.offsets.push_back(static_cast<std::int64_t>(result.corners.size()));
    }
    return result;
  }
};

PolygonSoup spoiled(Bytes bytes) {
  Draft draft;
  const int kind = bytes.next();
  if ((kind & 1) != 0) draft.octahedron();
  if ((kind & 2) != 0) draft.torus(3 + (kind >> 3 & 3), 3 + (kind >> 5 & 3));
  if ((kind & 4) != 0 || draft.faces.empty()) {
    const std::size_t before = draft.vertices.size();
    draft.octahedron();
    const Eigen::Vector3d offset(bytes.coordinate(), bytes.coordinate(), bytes.coordinate());
    for (std::size_t v = before; v < draft.vertices.size(); ++v) draft.vertices[v] += offset;
  }
  for (int change = 0; change < 40 && !bytes.empty(); ++change) draft.spoil(bytes);
  return draft.soup();
}

void check(const Surface& surface, const Extraction& found) {
  const CurveSkeleton& skeleton = found.skeleton;
  // A surface that cuts itself may have handles that nothing inside can go round.
  require(found.certificate.components == found.certificate.components_of_surface);
  require(found.certificate.cycle_rank == found.certificate.genus);
  require(skeleton.nodes.rows() > 0 && skeleton.nodes.allFinite() && skeleton.radii.allFinite());
  require(skeleton.node_of_vertex.size() == surface.positions.rows());
  require(skeleton.node_of_vertex.minCoeff() >= 0);
  require(skeleton.node_of_vertex.maxCoeff() < skeleton.nodes.rows());
  // A sheet folded upon itself has nothing inside to hold a curve, and the certificate says so.
  if (!found.certificate.inside_enough) return;
  const Eigen::RowVector3d low = surface.positions.colwise().minCoeff();
  const Eigen::RowVector3d high = surface.positions.colwise().maxCoeff();
  const double slack = 1e-6 * (high - low).norm();
  require(((skeleton.nodes.rowwise() - low).array() >= -slack).all());
  require(((skeleton.nodes.rowwise() - high).array() <= slack).all());
}

void check(const Surface& surface, const Rig& rig) {
  require(rig.joints.allFinite());
  require((rig.parents.array() < 0).count() == 1);
  require(rig.weights.rows() == surface.positions.rows());
  for (Eigen::Index vertex = 0; vertex < rig.weights.rows(); ++vertex) {
    float sum = 0;
    for (SkinWeights::InnerIterator it(rig.weights, vertex); it; ++it) {
      require(it.value() > 0);
      sum += it.value();
    }
    require(std::abs(sum - 1) < 1e-5F);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  ExtractOptions options;
  options.threads = 1;
  options.resolution = 200;
  options.least_resolution = 100;
  options.certificate.threads = 1;
  try {
    RepairOptions as_it_is;
    as_it_is.wrap = Wrapping::never;  // a wrap takes seconds and is no smaller for small surfaces
    const RepairedSurface repaired = repair(spoiled({data, size}), as_it_is, {}, 1);
    options.rims = repaired.rims;
    const Extraction found = extract(repaired.surface, options, {});
    check(repaired.surface, found);
    RigOptions rig;
    rig.skin.threads = 1;
    check(repaired.surface, make_rig(repaired.surface, found.skeleton, rig, {}));
  } catch (const Error&) {
    return 0;  // says why
  }
  return 0;
}
