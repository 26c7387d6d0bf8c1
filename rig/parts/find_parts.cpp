#include <curveskel/rig_parts.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

#include <curveskel/advanced/closed_manifold.hpp>
#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/measures.hpp>
#include <curveskel/topology.hpp>
#include "base/median.hpp"
#include "base/option_ranges.hpp"
#include "rig/parts/body.hpp"
#include "rig/parts/nearest_first.hpp"
#include "rig/parts/sound_parts.hpp"
#include "rig/parts/twins.hpp"
#include "surface/mesh/triangle_area.hpp"
#include "surface/repair/renumber.hpp"
#include "surface/repair/select_components.hpp"
#include "surface/repair/sound_repaired.hpp"

namespace curveskel {
namespace {

using Eigen::Vector3d;

Vector3d centroid(const Surface& surface) {
  Vector3d sum = Vector3d::Zero();
  double area = 0;
  for (const auto& t : surface.triangles.rowwise()) {
    const Vector3d a = surface.positions.row(t(0));
    const Vector3d b = surface.positions.row(t(1));
    const Vector3d c = surface.positions.row(t(2));
    const double twice = twice_area(a, b, c);
    sum += twice / 3 * (a + b + c);
    area += twice;
  }
  return area > 0 ? Vector3d(sum / area) : Vector3d(surface.positions.row(0));
}

class PartFinder {
 public:
  PartFinder(const Surface& surface, const PartOptions& options, const Monitor& monitor)
      : PartFinder(surface, topology(surface), options, monitor) {}

  PartFinder(const Surface& surface, const Topology& counted, const PartOptions& options,
             const Monitor& monitor)
      : options_(options),
        monitor_(monitor),
        components_(split_components(surface, counted)),
        body_(components_) {
    found_.part_of_vertex = counted.component_of_vertex;
    found_.parts.resize(components_.size());
    double all = 0;
    for (const Component& component : components_) {
      areas_.push_back(area(component.surface));
      all += areas_.back();
    }
    for (std::size_t c = 0; c < areas_.size(); ++c) found_.parts[c].area_share = areas_[c] / all;
    for (const Component& component : components_) middles_.push_back(centroid(component.surface));
    diagonal_ = bounding_box_diagonal(surface.positions);
    sort_by_area();
  }

  RigParts find() {
    if (components_.size() < 2 || options_.follow <= 0) return std::move(found_);
    pair_twins();
    std::vector<char> decided(components_.size(), 0);
    for (std::size_t rank = 0; rank < by_area_.size(); ++rank) {
      monitor_.report("parts", static_cast<double>(rank) / static_cast<double>(by_area_.size()));
      if (decided[idx(by_area_[rank])] != 0) continue;
      std::vector<std::vector<int>> alike;  // each with its twin
      const std::int64_t share = rounded_share(by_area_[rank]);
      for (std::size_t k = rank; k < by_area_.size() && rounded_share(by_area_[k]) == share; ++k) {
        add_undecided(by_area_[k], decided, alike);
      }
      const std::vector<std::vector<int>> rest = decide(alike, rank == 0);
      // Arms are asked again with the legs there: beside the head alone the body looks thicker.
      if (rest.size() < alike.size()) (void)decide(rest, false);
    }
    return std::move(found_);
  }

 private:
  /// Mirror images differ by rounding.
  [[nodiscard]] std::int64_t rounded_share(int c) const {
    return std::llround(1e6 * found_.parts[idx(c)].area_share);
  }

  /// Of equals by their places: numbers depend on the order of faces.
  void sort_by_area() {
    const double unit = diagonal_ > 0 ? 1e-6 * diagonal_ : 1;
    std::vector<std::array<std::int64_t, 4>> keys;
    for (std::size_t c = 0; c < components_.size(); ++c) {
      const Vector3d place = middles_[c] / unit;
      keys.push_back({-rounded_share(static_cast<int>(c)), std::llround(place.x()),
                      std::llround(place.y()), std::llround(place.z())});
    }
    by_area_.resize(components_.size());
    std::iota(by_area_.begin(), by_area_.end(), 0);
    std::stable_sort(by_area_.begin(), by_area_.end(),
                     [&](int a, int b) { return keys[idx(a)] < keys[idx(b)]; });
  }

  void add_undecided(int c, std::vector<char>& decided,
                     std::vector<std::vector<int>>& alike) const {
    if (decided[idx(c)] != 0) return;
    alike.push_back({c});
    const int twin = found_.parts[idx(c)].twin;
    if (twin >= 0 && decided[idx(twin)] == 0) alike.back().push_back(twin);
    for (const int one : alike.back()) decided[idx(one)] = 1;
  }

  /// All of them as to the body before: of the limbs of a block figure, which are alike, none is
  /// there when another one is asked about. Of the largest none is worn by another. Returns those
  /// that follow.
  std::vector<std::vector<int>> decide(const std::vector<std::vector<int>>& alike,
                                       bool are_largest) {
    std::vector<std::vector<int>> following;
    std::vector<int> joining;
    for (const std::vector<int>& together : alike) {
      double reach = 0;
      for (const int c : together) {
        if (are_largest) continue;
        measure(c);
        reach += found_.parts[idx(c)].reach / static_cast<double>(together.size());
      }
      const bool follows = !are_largest && reach < options_.follow;
      for (const int c : together) found_.parts[idx(c)].follows = follows;
      if (follows) following.push_back(together);
      if (!follows) joining.insert(joining.end(), together.begin(), together.end());
    }
    for (const int c : joining) {
      found_.parts[idx(c)].host = -1;
      body_.add(c, components_[idx(c)], options_.threads);
    }
    return following;
  }

  /// Sets the component's reach, and its host as if it followed.
  void measure(int c) {
    RigPart& part = found_.parts[idx(c)];
    const ProbedPart probe = probed(components_[idx(c)]);
    const double apart = body_.distance_to_boxes(probe.box);
    if (apart > options_.follow * body_.most_thickness()) {
      part.reach = apart / std::max(body_.most_thickness(), 1e-12 * diagonal_);
      return;
    }
    const std::vector<BodySoFar::NearestPlace> contacts = nearest_first(body_.contacts(probe));
    std::vector<double> radii;
    for (std::size_t i = 0; i < places_that_count(contacts.size()); ++i) {
      radii.push_back(body_.thickness_at(contacts[i]));
    }
    const double thickness =
        std::max({median_of(radii), body_.thickness_within(probe, 0.5 * probe.diagonal()),
                  1e-12 * diagonal_});
    part.host = contacts.front().component;
    part.reach = contacts[contacts.size() * 98 / 100].distance / thickness;
  }

  void pair_twins() {
    const Positions& largest = components_[idx(by_area_[0])].surface.positions;
    const Vector3d middle =
        0.5 * (largest.colwise().minCoeff() + largest.colwise().maxCoeff()).transpose();
    const std::vector<int> twins =
        mirrored_twins({middles_, areas_, by_area_}, middle, 0.01 * diagonal_, monitor_.stop);
    for (std::size_t c = 0; c < twins.size(); ++c) found_.parts[c].twin = twins[c];
  }

  const PartOptions& options_;
  const Monitor& monitor_;
  std::vector<Component> components_;
  std::vector<double> areas_;
  std::vector<Vector3d> middles_;
  std::vector<int> by_area_;
  double diagonal_ = 0;
  BodySoFar body_;
  RigParts found_;
};

}  // namespace

void require_valid(const PartOptions& options) {
  constexpr OptionRange follow{0, 100};
  const OptionCheck check("PartOptions");
  check.number("follow", options.follow, follow);
  check.number("threads", options.threads, thread_range);
}

bool RigParts::all_body() const {
  return std::none_of(parts.begin(), parts.end(), [](const RigPart& p) { return p.follows; });
}

RigParts find_parts(const Surface& surface, const PartOptions& options, const Monitor& monitor) {
  require_valid(options);
  require_sound(surface, "find_parts");
  return PartFinder(surface, options, monitor).find();
}

RepairedSurface body_of(const RepairedSurface& repaired, const RigParts& parts) {
  require_sound(repaired, "body_of");
  RepairedSurface body = repaired;
  if (parts.all_body()) return body;
  require_parts_of(parts, repaired.surface.positions.rows(), "body_of");
  const Topology counted = topology(repaired.surface);
  std::vector<Fate> fates;
  for (const RigPart& part : parts.parts) {
    fates.push_back(part.follows ? Fate::not_chosen : Fate::kept);
  }
  const std::vector<std::int32_t> number = keep_components(body.surface, counted, fates);
  const auto new_number = [&](std::int32_t v) { return number[idx(v)]; };
  renumber(body, new_number, [&](std::int32_t v) { return new_number(v) < 0; });
  return body;
}

}  // namespace curveskel
