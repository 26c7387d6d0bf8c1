#include <curveskel/advanced/inscribed_balls.hpp>

#include <vector>

#include <curveskel/advanced/closed_manifold.hpp>
#include <curveskel/advanced/measures.hpp>
#include <curveskel/error.hpp>
#include <curveskel/monitor.hpp>
#include "base/parallel.hpp"

namespace curveskel {
namespace {

/// Fills what is not valid with the mean of the valid neighbours, ring by ring; what no valid ball
/// reaches keeps the vertex itself with radius 0.
void fill_invalid(const Surface& surface, std::vector<char>& valid, InscribedBalls& balls) {
  const Eigen::Index vertices = surface.positions.rows();
  for (bool changed = true; changed;) {
    changed = false;
    Positions centre_sum = Positions::Zero(vertices, 3);
    Eigen::VectorXd radius_sum = Eigen::VectorXd::Zero(vertices);
    Eigen::VectorXi count = Eigen::VectorXi::Zero(vertices);
    for (Eigen::Index t = 0; t < surface.triangles.rows(); ++t) {
      for (int k = 0; k < 3; ++k) {
        const int v = surface.triangles(t, k);
        const int next = surface.triangles(t, (k + 1) % 3);
        // Every edge is seen once from each side, so one direction per triangle is enough.
        if (valid[static_cast<std::size_t>(v)] != 0 || valid[static_cast<std::size_t>(next)] == 0) {
          continue;
        }
        centre_sum.row(v) += balls.centres.row(next);
        radius_sum[v] += balls.radii[next];
        ++count[v];
      }
    }
    for (Eigen::Index v = 0; v < vertices; ++v) {
      if (count[v] == 0) continue;
      balls.centres.row(v) = centre_sum.row(v) / count[v];
      balls.radii[v] = radius_sum[v] / count[v];
      valid[static_cast<std::size_t>(v)] = 1;
      changed = true;
    }
  }
}

}  // namespace

InscribedBalls inscribed_balls(const Surface& surface, const SurfaceTree& tree, int threads,
                               const std::stop_token& stop) {
  require_sound(surface, "inscribed_balls");
  const Eigen::Index vertices = surface.positions.rows();
  const Positions normals = vertex_normals(surface);
  const double largest = 0.5 * bounding_box_diagonal(surface.positions);

  InscribedBalls balls{surface.positions, Eigen::VectorXd::Zero(vertices)};
  std::vector<char> valid(static_cast<std::size_t>(vertices), 0);
  parallel_for(static_cast<std::size_t>(vertices), 256, threads,
               [&](std::size_t begin, std::size_t end) {
                 for (std::size_t i = begin; i < end; ++i) {
                   throw_if_stopped(stop);
                   const auto v = static_cast<Eigen::Index>(i);
                   const Eigen::Vector3d inward = -normals.row(v);
                   if (inward.squaredNorm() == 0) continue;
                   const auto fits = [&](const SurfaceTree::Ball& ball) {
                     return ball.radius < largest && tree.inside(ball.centre);
                   };
                   auto ball = tree.inscribed_ball(surface.positions.row(v), inward);
                   if (!fits(ball)) {
                     // A vertex off the tree's surface touches it from outside.
                     const auto nearest = tree.nearest(surface.positions.row(v));
                     ball = tree.inscribed_ball(nearest.point, inward);
                     if (!fits(ball)) continue;
                   }
                   balls.centres.row(v) = ball.centre;
                   balls.radii[v] = ball.radius;
                   valid[i] = 1;
                 }
               });
  fill_invalid(surface, valid, balls);
  return balls;
}

Positions smoothed_centres(const Surface& surface, const InscribedBalls& balls, int rounds) {
  require_corners(surface, "smoothed_centres");
  if (balls.centres.rows() != surface.positions.rows()) {
    throw Error(Fault::input, "smoothed_centres: found " + std::to_string(balls.centres.rows()) +
                                  " balls, needed one for each of the surface's " +
                                  std::to_string(surface.positions.rows()) + " vertices");
  }
  Positions centres = balls.centres;
  for (int round = 0; round < rounds; ++round) {
    Positions sum = Positions::Zero(centres.rows(), 3);
    Eigen::VectorXd neighbours = Eigen::VectorXd::Zero(centres.rows());
    for (const auto& t : surface.triangles.rowwise()) {
      for (int k = 0; k < 3; ++k) {
        sum.row(t(k)) += centres.row(t((k + 1) % 3));  // the other way in the next triangle
        ++neighbours[t(k)];
      }
    }
    centres = sum.array().colwise() / neighbours.array().max(1);
  }
  return centres;
}

}  // namespace curveskel
