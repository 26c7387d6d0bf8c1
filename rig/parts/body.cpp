#include "rig/parts/body.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/measures.hpp>
#include "base/parallel.hpp"
#include "surface/spatial/spread_points.hpp"

namespace curveskel {
namespace {

using Eigen::Vector3d;

constexpr int probes = 200;                // vertices, and as many points over the area
constexpr Eigen::Index most_balls = 1000;  // of a component

// A ball is about a place if that lies in it or nearly so: balls touch the surface at some places
// only.
constexpr double about_radii = 1.25;

// Of distances: what a query finds another finds, too.
constexpr double rounding = 1e-12;

Eigen::Index stride_of(Eigen::Index vertices, Eigen::Index most) {
  return std::max<Eigen::Index>(1, vertices / most);
}

/// The radius of the largest ball about the point; where none is, as at the edge of a flat end, of
/// the nearest for its size. 0 if there are no balls.
double largest_about(const std::vector<SurfaceTree::Ball>& balls, const Vector3d& point) {
  double largest = 0;
  double of_nearest = 0;
  double least_squared_radii = std::numeric_limits<double>::infinity();
  for (const SurfaceTree::Ball& ball : balls) {
    if (ball.radius <= largest) continue;
    const double squared_radii = (ball.centre - point).squaredNorm() / (ball.radius * ball.radius);
    if (squared_radii <= about_radii * about_radii) largest = ball.radius;
    if (squared_radii >= least_squared_radii) continue;
    least_squared_radii = squared_radii;
    of_nearest = ball.radius;
  }
  return largest > 0 ? largest : of_nearest;
}

Eigen::AlignedBox3d box_of(const Surface& surface) {
  Eigen::AlignedBox3d box;
  for (const auto& p : surface.positions.rowwise()) box.extend(p.transpose());
  return box;
}

Positions middles_of(const std::vector<Component>& components) {
  Positions middles(static_cast<Eigen::Index>(components.size()), 3);
  for (std::size_t c = 0; c < components.size(); ++c) {
    middles.row(static_cast<Eigen::Index>(c)) = box_of(components[c].surface).center().transpose();
  }
  return middles;
}

}  // namespace

BodySoFar::BodySoFar(const std::vector<Component>& components) : boxes_(middles_of(components)) {}

ProbedPart probed(const Component& component) {
  ProbedPart part;
  part.places = spread_points(component.surface, probes);
  const Positions& positions = component.surface.positions;
  const Eigen::Index stride = stride_of(positions.rows(), probes);
  for (Eigen::Index v = 0; v < positions.rows(); v += stride) {
    part.places.emplace_back(positions.row(v));
  }
  part.box = box_of(component.surface);
  return part;
}

void BodySoFar::add(int number, const Component& component, int threads) {
  const Surface& surface = component.surface;
  Piece piece{number, box_of(surface), SurfaceTree(surface, threads), {}, {}};
  const Positions normals = vertex_normals(surface);
  const double diagonal = piece.box.diagonal().norm();
  const Eigen::Index stride = stride_of(surface.positions.rows(), most_balls);
  for (Eigen::Index v = 0; v < surface.positions.rows(); v += stride) {
    piece.places.emplace_back(surface.positions.row(v));
  }
  piece.balls.resize(piece.places.size());
  parallel_for(piece.places.size(), 64, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Vector3d inward = -normals.row(static_cast<Eigen::Index>(i) * stride).transpose();
      if (!(inward.norm() > 0)) continue;
      const SurfaceTree::Ball ball = piece.tree.inscribed_ball(piece.places[i], inward);
      if (ball.radius < 0.5 * diagonal && piece.tree.inside(ball.centre)) piece.balls[i] = ball;
    }
  });
  for (const SurfaceTree::Ball& ball : piece.balls) {
    most_thickness_ = std::max(most_thickness_, ball.radius);
  }
  boxes_.put(idx(number), {piece.box});
  piece_of_number_[number] = pieces_.size();
  pieces_.push_back(std::move(piece));
}

std::vector<BodySoFar::NearestPlace> BodySoFar::contacts(const ProbedPart& part) const {
  const std::vector<const Piece*> pieces = near(part);
  std::vector<NearestPlace> found;
  found.reserve(part.places.size());
  const Piece* last = nullptr;  // the nearest of the place before
  for (const Vector3d& place : part.places) found.push_back(nearest_of(pieces, place, last));
  return found;
}

std::vector<const BodySoFar::Piece*> BodySoFar::near(const ProbedPart& part) const {
  const Vector3d& first = part.places.front();
  double distance = std::numeric_limits<double>::infinity();
  boxes_.search([&](const BoxTree::Item& item) { return item.box.exteriorDistance(first); },
                distance,
                [&](std::size_t number) {
                  const SurfaceTree& tree = pieces_[piece_of_number_.at(int(number))].tree;
                  distance = std::min(distance, tree.nearest(first).distance);
                });
  // No place of the part is further from the body than the first one and the part's extent.
  const double most = (1 + rounding) * (distance + part.diagonal());
  std::vector<const Piece*> pieces;
  boxes_.search(
      [&](const BoxTree::Item& item) { return part.box.exteriorDistance(item.box); }, most,
      [&](std::size_t number) { pieces.push_back(&pieces_[piece_of_number_.at(int(number))]); });
  std::sort(pieces.begin(), pieces.end());
  return pieces;
}

BodySoFar::NearestPlace BodySoFar::nearest_of(const std::vector<const Piece*>& pieces,
                                              const Vector3d& place, const Piece*& guess) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto within = [&](double limit) {
    NearestPlace contact{limit, -1, place};
    for (const Piece* piece : pieces) {
      if (piece->box.exteriorDistance(place) >= contact.distance) continue;
      const SurfaceTree::Nearest nearest = piece->tree.nearest(place, contact.distance);
      if (nearest.triangle < 0) continue;
      contact = {nearest.distance, piece->number, nearest.point};
      guess = piece;
    }
    return contact;
  };
  if (guess != nullptr) {  // others are asked only if they may be nearer
    const double limit = (1 + rounding) * guess->tree.nearest(place).distance;
    NearestPlace contact = within(limit);
    if (contact.component >= 0) return contact;
  }
  return within(infinity);
}

double BodySoFar::thickness_at(const NearestPlace& contact) const {
  return largest_about(pieces_[piece_of_number_.at(contact.component)].balls, contact.point);
}

double BodySoFar::thickness_within(const ProbedPart& part, double distance) const {
  constexpr std::size_t centres = 60;  // among the part's places
  const std::size_t stride = std::max<std::size_t>(1, part.places.size() / centres);
  std::vector<double> found;
  const double most = (1 + rounding) * distance;
  const auto apart = [&](const BoxTree::Item& item) { return part.box.exteriorDistance(item.box); };
  boxes_.search(apart, most, [&](std::size_t number) {
    const Piece& piece = pieces_[piece_of_number_.at(int(number))];
    for (const Vector3d& place : piece.places) {
      if (part.box.exteriorDistance(place) > distance) continue;
      for (std::size_t k = 0; k < part.places.size(); k += stride) {
        if ((part.places[k] - place).squaredNorm() > distance * distance) continue;
        found.push_back(largest_about(piece.balls, place));
        break;
      }
    }
  });
  if (found.empty()) return 0;
  const auto quartile = found.begin() + static_cast<std::ptrdiff_t>(found.size() * 3 / 4);
  std::nth_element(found.begin(), quartile, found.end());
  return *quartile;
}

double BodySoFar::distance_to_boxes(const Eigen::AlignedBox3d& box) const {
  double least = std::numeric_limits<double>::infinity();
  const auto apart = [&](const BoxTree::Item& item) { return box.exteriorDistance(item.box); };
  boxes_.search(apart, least, [&](std::size_t number) {
    const Piece& piece = pieces_[piece_of_number_.at(int(number))];
    least = std::min(least, box.exteriorDistance(piece.box));
  });
  return least;
}

}  // namespace curveskel
