#include "viewer/model/recording.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

#include "viewer/software/simpler_surface.hpp"

namespace curveskel::viewer {
namespace {

struct TriangleLists {
  std::vector<glm::uvec3> all;
  std::vector<glm::uvec3> fewer;
};

/// Positions and normals to the surface, triangles to the lists.
void append(ShownSurface& whole, TriangleLists& lists, const ShownSurface& part) {
  const auto first = static_cast<unsigned>(whole.positions.size());
  whole.positions.insert(whole.positions.end(), part.positions.begin(), part.positions.end());
  whole.normals.insert(whole.normals.end(), part.normals.begin(), part.normals.end());
  const auto add = [first](std::vector<glm::uvec3>& to, const SharedTriangles& from) {
    std::transform(from.begin(), from.end(), std::back_inserter(to),
                   [&](const glm::uvec3& triangle) { return triangle + first; });
  };
  add(lists.all, part.triangles);
  add(lists.fewer, part.fewer.empty() ? part.triangles : part.fewer);
}

/// A simpler form that is not simpler is none.
ShownSurface put_together(const std::map<int, const ShownSurface*>& parts) {
  if (parts.size() == 1) return *parts.begin()->second;
  ShownSurface whole;
  TriangleLists lists;
  for (const auto& [component, surface] : parts) append(whole, lists, *surface);
  if (lists.fewer.size() < lists.all.size()) whole.fewer = std::move(lists.fewer);
  whole.triangles = std::move(lists.all);
  return whole;
}

/// Nodes and edges alone.
CurveSkeleton put_together(const std::vector<std::shared_ptr<const CurveSkeleton>>& curves) {
  Eigen::Index nodes = 0;
  Eigen::Index edges = 0;
  for (const auto& curve : curves) {
    nodes += curve->nodes.rows();
    edges += curve->edges.rows();
  }
  CurveSkeleton whole;
  whole.nodes.resize(nodes, 3);
  whole.edges.resize(edges, 2);
  nodes = edges = 0;
  for (const auto& curve : curves) {
    whole.nodes.middleRows(nodes, curve->nodes.rows()) = curve->nodes;
    whole.edges.middleRows(edges, curve->edges.rows()) =
        curve->edges.array() + static_cast<int>(nodes);
    nodes += curve->nodes.rows();
    edges += curve->edges.rows();
  }
  return whole;
}

/// The pipeline's own.
int order_of(std::string_view stage) {
  if (stage == "input") return 0;
  if (stage == "fair") return 1;
  if (stage == "contract") return 2;
  if (stage == "surgery") return 3;
  return stage == "skeleton" ? 4 : 5;
}

void mark(Moment& moment, const ShownTry& made_in) {
  moment.try_number = made_in.number;
  moment.of_surface = made_in.of_surface;
  moment.try_name = made_in.name;
}

}  // namespace

std::string title_of(const Moment& moment) {
  const bool usual = moment.try_name.empty() || moment.try_name == try_as_asked;
  const std::string of_try = usual ? "" : " (" + moment.try_name + ")";
  if (moment.stage != "fair" && moment.stage != "contract") return moment.stage + of_try;
  const std::string name = moment.stage == "fair" ? "fairing" : "contraction";
  return name + " " + std::to_string(moment.iteration) + of_try;
}

Recording::Recording() {
  Moment input;
  input.stage = "input";
  add(std::move(input));
}

void Recording::add(Moment moment) {
  moments_.push_back(moment);
  all_.push_back({std::move(moment)});
}

void Recording::settle(const std::vector<Try>& history) {
  const auto kept = [&](const Moment& moment) {
    if (moment.try_number < 0) return true;
    const auto number = static_cast<std::size_t>(moment.try_number);
    return number < history.size() && history[number].outcome == Outcome::kept &&
           full_name(history, moment.try_number) == moment.try_name;
  };
  for (Recorded& one : all_) one.aside = !kept(one.moment);
  choose();
}

void Recording::show_all_tries(bool all) {
  shows_all_tries_ = all;
  choose();
}

void Recording::choose() {
  moments_.clear();
  has_other_tries_ = false;
  for (const Recorded& one : all_) {
    has_other_tries_ = has_other_tries_ || one.aside;
    if (shows_all_tries_ || !one.aside) moments_.push_back(one.moment);
  }
}

void Recording::cut_from(std::string_view stage) {
  const int first = order_of(stage);
  std::erase_if(moments_, [first](const Moment& one) { return order_of(one.stage) >= first; });
  std::erase_if(all_, [first](const Recorded& one) { return order_of(one.moment.stage) >= first; });
  has_other_tries_ =
      std::any_of(all_.begin(), all_.end(), [](const Recorded& one) { return one.aside; });
}

ShownSurface Recording::surface_at(std::size_t index) const {
  if (index >= moments_.size() || order_of(moments_[index].stage) > order_of("surgery")) return {};
  std::map<int, const ShownSurface*> latest;
  for (std::size_t i = 0; i <= index; ++i) {
    if (!moments_[i].surface || moments_[i].of_surface != moments_[index].of_surface) continue;
    latest[moments_[i].component] = moments_[i].surface.get();
  }
  return put_together(latest);
}

ShownSurface Recording::faired_at(std::size_t index) const {
  std::map<int, const ShownSurface*> faired;
  for (std::size_t i = 0; i < moments_.size(); ++i) {
    const Moment& moment = moments_[i];
    const bool other_try =
        moment.of_surface != moments_[std::min(index, moments_.size() - 1)].of_surface;
    if (moment.stage != "fair" || !moment.surface || other_try) continue;
    if (i <= index || !faired.contains(moment.component)) {
      faired[moment.component] = moment.surface.get();
    }
  }
  return put_together(faired);
}

std::shared_ptr<const ShownSurface> Recording::newest_surface(std::size_t index) const {
  const std::size_t end = std::min(index + 1, moments_.size());
  for (std::size_t i = end; i-- > 0;) {
    const bool same_try = moments_[i].of_surface == moments_[end - 1].of_surface;
    if (moments_[i].surface && same_try) return moments_[i].surface;
  }
  return nullptr;
}

std::shared_ptr<const CurveSkeleton> Recording::skeleton_at(std::size_t index) const {
  const std::size_t end = std::min(index + 1, moments_.size());
  for (std::size_t i = end; i-- > 0;) {
    const int of = moments_[end - 1].of_surface;
    if (moments_[i].skeleton && (of < 0 || moments_[i].of_surface == of)) {
      return moments_[i].stage == "surgery" ? curves_at(i) : moments_[i].skeleton;
    }
  }
  return nullptr;
}

/// Of a moment of surgery.
std::shared_ptr<const CurveSkeleton> Recording::curves_at(std::size_t index) const {
  std::map<int, std::shared_ptr<const CurveSkeleton>> latest;
  for (std::size_t i = 0; i <= index; ++i) {
    const Moment& moment = moments_[i];
    const bool is_of_it = moment.stage == "surgery" && moment.skeleton &&
                          moment.of_surface == moments_[index].of_surface;
    if (is_of_it) latest[moment.component] = moment.skeleton;
  }
  std::vector<std::shared_ptr<const CurveSkeleton>> curves;
  curves.reserve(latest.size());
  for (auto& [component, curve] : latest) curves.push_back(std::move(curve));
  if (curves.size() == 1) return curves.front();
  if (curves != curves_) {
    all_curves_ = std::make_shared<const CurveSkeleton>(put_together(curves));
    curves_ = std::move(curves);
  }
  return all_curves_;
}

Moment moment_of(const Frame& frame, const DrawnSpace& space, double seconds,
                 const ShownSurface* before) {
  Moment moment;
  moment.stage = frame.stage;
  moment.component = frame.component;
  mark(moment, frame.made_in);
  moment.iteration = frame.iteration;
  moment.area_ratio = frame.area_ratio;
  moment.volume_ratio = frame.volume_ratio;
  moment.residual = frame.residual;
  moment.seconds = seconds;
  ShownSurface shown = shown_surface(frame.surface, space);
  constexpr std::size_t simple = 3000;  // vertices
  if (before != nullptr && before->triangles == shown.triangles) {
    shown.triangles = before->triangles;
    shown.fewer = before->fewer;
  } else if (shown.positions.size() > 2 * simple) {
    shown.fewer = fewer_triangles(shown, simple);
  }
  moment.surface = std::make_shared<const ShownSurface>(std::move(shown));
  return moment;
}

Moment moment_of(const CurveFrame& curve, double seconds) {
  CurveSkeleton own;
  own.nodes = curve.nodes;
  own.edges = curve.edges;
  Moment moment;
  moment.stage = curve.stage;
  moment.component = curve.component;
  mark(moment, curve.made_in);
  moment.seconds = seconds;
  moment.skeleton = std::make_shared<const CurveSkeleton>(std::move(own));
  return moment;
}

}  // namespace curveskel::viewer
