#include "viewer/model/history.hpp"

#include <algorithm>
#include <utility>

namespace curveskel::viewer {

namespace {

bool has_work_by_hand(const Edited& state) { return state.corrected || !state.roles.empty(); }

}  // namespace

bool is_as_made(const Edited& state) {
  return state.run != nullptr && !state.corrected && state.root < 0;
}

void History::add(Edited next) {
  next.saved = false;
  if (!states_.empty()) states_.resize(at_ + 1);
  states_.push_back(std::move(next));
  at_ = states_.size() - 1;
}

void History::replace(Edited other) { states_[at_] = std::move(other); }

void History::go_over_to(Eigen::Index vertices) {
  const auto forget = [vertices](std::shared_ptr<const CurveSkeleton>& skeleton) {
    if (skeleton == nullptr) return;
    const Eigen::Index mapped = skeleton->node_of_vertex.size();
    if (mapped == 0 || mapped == vertices) return;
    auto other = std::make_shared<CurveSkeleton>(*skeleton);
    other->node_of_vertex.resize(0);
    skeleton = std::move(other);
  };
  for (Edited& state : states_) {
    state.run.reset();
    forget(state.skeleton);
    forget(state.whole);
  }
}

bool History::has_corrections() const {
  return std::any_of(states_.begin(), states_.end(), has_work_by_hand);
}

void History::note_saved() { states_[at_].saved = true; }

bool History::unsaved() const { return !empty() && has_work_by_hand(now()) && !now().saved; }

void History::undo() {
  if (can_undo()) --at_;
}

void History::redo() {
  if (can_redo()) ++at_;
}

Edited changed_with_root(const Edited& before,
                         const std::function<CurveSkeleton(const CurveSkeleton&)>& change) {
  Edited after = before;
  if (before.root < 0) {
    after.skeleton = std::make_shared<const CurveSkeleton>(change(*before.skeleton));
    return after;
  }
  CurveSkeleton marked = *before.skeleton;
  const Eigen::Index vertices = marked.node_of_vertex.size();
  marked.node_of_vertex.conservativeResize(vertices + 1);
  marked.node_of_vertex[vertices] = before.root;
  CurveSkeleton changed = change(marked);
  after.root = changed.node_of_vertex[vertices];
  changed.node_of_vertex.conservativeResize(vertices);
  after.skeleton = std::make_shared<const CurveSkeleton>(std::move(changed));
  return after;
}

}  // namespace curveskel::viewer
