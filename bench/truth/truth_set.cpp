// A benchmark: 200 closed and open surfaces whose curve skeletons are known, with these. The same
// numbers, to seven digits, on every machine.
// usage: truth_set FOLDER
#include <CLI/CLI.hpp>
#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include <curveskel/advanced/coarsen.hpp>
#include <curveskel/advanced/indices.hpp>
#include <curveskel/curve_skeleton.hpp>
#include <curveskel/error.hpp>
#include "meshes/random.hpp"
#include "meshes/shapes.hpp"

namespace {

using namespace curveskel;
using shapes::Random;
using shapes::Shape;

struct Member {
  std::string family;
  std::string version = "clean";
  Shape shape;
};

std::string numbered(const std::string& name, int number) {
  const std::string digits = std::to_string(number);
  return name + "-" + std::string(3 - digits.size(), '0') + digits;
}

double least_radius(const Shape& shape) { return shape.axis.radii.minCoeff(); }

/// Graphs of straight tubes, with loops and without.
void add_graphs(std::vector<Member>& members) {
  for (int k = 0; k < 70; ++k) {
    Shape shape = shapes::random_tubes(1001 + k);
    shape.name = numbered("graph", k);
    members.push_back({"graph", "clean", std::move(shape)});
  }
  for (int k = 0; k < 30; ++k) {
    const CurveSkeleton tree = shapes::random_graph(idx(2001 + k), 14 + k % 9, 0, 1);
    members.push_back({"tree", "clean", shapes::tube_union(numbered("tree", k), tree)});
  }
}

/// One tube, open at both ends, of changing radius.
void add_tubes(std::vector<Member>& members) {
  const std::vector<shapes::Curve> curves{shapes::s_curve(12, 4), shapes::helix(3, 4, 2),
                                          shapes::arc(5, 4), shapes::straight(12)};
  for (int k = 0; k < 24; ++k) {
    const double radius = 0.4 + 0.08 * (k % 5);
    const shapes::Profile profiles[] = {shapes::constant(radius),
                                        shapes::tapered(1.5 * radius, 0.5 * radius),
                                        shapes::wavy(radius, 0.2 * radius, 2 + k % 4)};
    members.push_back({"tube", "clean",
                       shapes::tube(numbered("tube", k), curves[idx(k % 4)],
                                    profiles[idx(k / 4 % 3)], 16 + k % 9)});
  }
}

/// The knot that goes p times round the axis and q times round the core of a torus.
shapes::Curve torus_knot(int p, int q) {
  return [p, q](double t) -> Eigen::Vector3d {
    const double angle = 2 * std::numbers::pi * t;
    const double distance = 4 + 1.6 * std::cos(q * angle);
    return {distance * std::cos(p * angle), distance * std::sin(p * angle),
            1.6 * std::sin(q * angle)};
  };
}

void add_knots(std::vector<Member>& members) {
  const std::vector<std::pair<int, int>> kinds{{2, 3}, {3, 2}, {2, 5}, {3, 4}};
  for (int k = 0; k < 12; ++k) {
    const auto [p, q] = kinds[idx(k % 4)];
    members.push_back({"knot", "clean",
                       shapes::tube(numbered("knot", k), torus_knot(p, q),
                                    shapes::constant(0.3 + 0.08 * (k / 4)), 14 + k % 5)});
  }
  for (int k = 0; k < 4; ++k) {
    Shape rings = shapes::linked_rings(3, 0.4 + 0.2 * k, 18);
    rings.name = numbered("rings", k);
    members.push_back({"knot", "clean", std::move(rings)});
  }
}

/// Tubes along plane curves, flattened across the plane: the curve stays, the lesser half axis is
/// the radius.
void add_elliptic(std::vector<Member>& members) {
  for (int k = 0; k < 20; ++k) {
    const shapes::Curve curve = k % 2 == 0 ? shapes::arc(5, 3 + 0.1 * k) : shapes::s_curve(12, 3);
    Shape shape = shapes::tube(numbered("elliptic", k), curve,
                               shapes::tapered(0.9, k % 3 == 0 ? 0.9 : 0.5), 24);
    const double flatness = 0.5 + 0.04 * (k % 10);
    shape.surface.positions.col(2) *= flatness;
    shape.axis.radii *= flatness;
    members.push_back({"elliptic", "clean", std::move(shape)});
  }
}

/// Without some faces round two of its vertices.
Surface with_holes(const Shape& shape, std::uint64_t seed) {
  Random random(seed);
  const Positions& at = shape.surface.positions;
  std::vector<Eigen::Index> centres{static_cast<Eigen::Index>(random.index(idx(at.rows()))),
                                    static_cast<Eigen::Index>(random.index(idx(at.rows())))};
  const double reach = 0.7 * least_radius(shape);
  const auto is_lost = [&](const auto& face) {
    return std::any_of(centres.begin(), centres.end(), [&](Eigen::Index centre) {
      return std::all_of(face.begin(), face.end(), [&](int vertex) {
        return (at.row(vertex) - at.row(centre)).norm() < reach;
      });
    });
  };
  std::vector<int> number(idx(at.rows()), -1);
  std::vector<int> kept;
  std::vector<Eigen::Index> faces;
  for (Eigen::Index face = 0; face < shape.surface.triangles.rows(); ++face) {
    const Eigen::RowVector3i corners = shape.surface.triangles.row(face);
    if (is_lost(corners)) continue;
    faces.push_back(face);
    for (const int vertex : corners) {
      if (number[idx(vertex)] >= 0) continue;
      number[idx(vertex)] = static_cast<int>(kept.size());
      kept.push_back(vertex);
    }
  }
  Surface rest{at(kept, Eigen::all), shape.surface.triangles(faces, Eigen::all)};
  for (auto& vertex : rest.triangles.reshaped()) vertex = number[idx(vertex)];
  return rest;
}

void add_versions(std::vector<Member>& members) {
  const std::size_t clean = members.size();
  const auto pick = [&](int k, int of) { return members[idx(k) * (clean / idx(of))]; };
  for (int k = 0; k < 16; ++k) {
    Member member = pick(k, 16);
    member.version = "noisy";
    member.shape = shapes::noisy(member.shape, 0.04 * least_radius(member.shape), idx(3001 + k));
    members.push_back(std::move(member));
  }
  for (int k = 0; k < 12; ++k) {
    Member member = pick(k, 12);
    member.version = "uneven";
    const auto target = static_cast<int>(member.shape.surface.positions.rows() / 4);
    member.shape.surface = coarsen(member.shape.surface, {target, 0}).surface;
    members.push_back(std::move(member));
  }
  for (int k = 0; k < 12; ++k) {
    Member member = pick(k, 12);
    member.version = "holes";
    member.shape.surface = with_holes(member.shape, idx(4001 + k));
    members.push_back(std::move(member));
  }
}

/// Lines of ASCII PLY: nodes with radii, edges.
void write_truth(const CurveSkeleton& axis, const std::filesystem::path& file) {
  std::ofstream out(file);
  char line[128];
  out << "ply\nformat ascii 1.0\nelement vertex " << axis.nodes.rows()
      << "\nproperty double x\nproperty double y\nproperty double z\nproperty double radius\n"
      << "element edge " << axis.edges.rows()
      << "\nproperty int vertex1\nproperty int vertex2\nend_header\n";
  for (Eigen::Index node = 0; node < axis.nodes.rows(); ++node) {
    std::snprintf(line, sizeof line, "%.7g %.7g %.7g %.7g\n", axis.nodes(node, 0),
                  axis.nodes(node, 1), axis.nodes(node, 2), axis.radii[node]);
    out << line;
  }
  for (const auto& edge : axis.edges.rowwise()) out << edge[0] << ' ' << edge[1] << '\n';
  out.flush();
  if (!out) throw Error(Fault::output, file.string() + ": cannot be written");
}

void make(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  std::vector<Member> members;
  add_graphs(members);
  add_tubes(members);
  add_knots(members);
  add_elliptic(members);
  add_versions(members);
  std::ofstream index(folder / "INDEX.csv");
  index << "name,family,version,vertices,faces,components,genus,tips,junctions\n";
  for (const Member& member : members) {
    const Shape& shape = member.shape;
    const std::string name = shape.name + (member.version == "clean" ? "" : "-" + member.version);
    const GraphTopology truth = graph_topology(shape.axis);
    shapes::write_surface(shape.surface, folder / (name + ".off"), 7);
    write_truth(shape.axis, folder / (name + ".truth.ply"));
    index << name << ',' << member.family << ',' << member.version << ','
          << shape.surface.positions.rows() << ',' << shape.surface.triangles.rows() << ','
          << shape.components << ',' << shape.genus << ',' << truth.tips << ',' << truth.junctions
          << '\n';
  }
  index.flush();
  if (!index) throw Error(Fault::output, (folder / "INDEX.csv").string() + ": cannot be written");
  std::printf("%zu surfaces in %s\n", members.size(), folder.string().c_str());
}

}  // namespace

int main(int count, char** values) {
  std::string folder;
  CLI::App program("Surfaces with known curve skeletons");
  program.add_option("FOLDER", folder, "where they go")->required();
  CLI11_PARSE(program, count, values);
  try {
    make(folder);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "truth_set: %s\n", error.what());
    return 1;
  }
  return 0;
}
