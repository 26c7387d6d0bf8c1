#include "viewer/model/history.hpp"

#include <utility>

namespace curveskel::viewer {

void History::begin(Edited first) {
  states_.clear();
  states_.push_back(std::move(first));
  at_ = 0;
}

void History::add(Edited next) {
  if (!states_.empty()) states_.resize(at_ + 1);
  states_.push_back(std::move(next));
  at_ = states_.size() - 1;
}

void History::undo() {
  if (can_undo()) --at_;
}

void History::redo() {
  if (can_redo()) ++at_;
}

}  // namespace curveskel::viewer
