#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include "rig/io/rig_writers.hpp"

namespace curveskel {
namespace {

using Eigen::RowVector3d;

constexpr const char* six_channels =
    "CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation";

class BvhWriter {
 public:
  explicit BvhWriter(const Rig& rig)
      : rig_(rig), names_(names_as_words(rig)), children_(idx(rig.joints.rows())) {
    for (Eigen::Index joint = 0; joint < rig.joints.rows(); ++joint) {
      const int parent = rig.parents[joint];
      (parent < 0 ? roots_ : children_[idx(parent)]).push_back(static_cast<int>(joint));
    }
  }

  std::string write() {
    text_ = "HIERARCHY\n";
    const bool needs_holder = roots_.size() > 1;
    if (needs_holder) begin_holder();
    for (const int root : roots_) {
      add(root, needs_holder ? "JOINT" : "ROOT", rig_.joints.row(root));
    }
    if (needs_holder) close();
    text_ += "MOTION\nFrames: 1\nFrame Time: 0.0333333\n";
    return text_ + still_ + "\n";
  }

 private:
  void line(const std::string& text) { text_ += std::string(2 * depth_, ' ') + text + "\n"; }

  void offset(const RowVector3d& by) {
    std::string text = "OFFSET";
    for (const double coordinate : by) text += " " + number_text(coordinate);
    line(text);
  }

  void open(const std::string& head) {
    line(head);
    line("{");
    ++depth_;
  }
  void close() {
    --depth_;
    line("}");
  }

  /// Depth first, as the order of the channels is. A stack of its own: chains may be long.
  void add(int root, const std::string& word, const RowVector3d& by) {
    begin(root, word, by);
    if (children_[idx(root)].empty()) end_site(RowVector3d::Zero());
    std::vector<std::pair<int, std::size_t>> open_joints{{root, 0}};
    while (!open_joints.empty()) {
      const int joint = open_joints.back().first;
      const std::size_t next = open_joints.back().second++;
      if (next == children_[idx(joint)].size()) {
        close();
        open_joints.pop_back();
        continue;
      }
      const int child = children_[idx(joint)][next];
      const RowVector3d way = rig_.joints.row(child) - rig_.joints.row(joint);
      const bool is_end = children_[idx(child)].empty() && children_[idx(joint)].size() == 1 &&
                          rig_.names[idx(child)].find("_end") != std::string::npos;
      if (is_end) {
        end_site(way);
      } else {
        begin(child, "JOINT", way);
        if (children_[idx(child)].empty()) end_site(0.5 * way);
        open_joints.emplace_back(child, 0);
      }
    }
  }

  void begin(int joint, const std::string& word, const RowVector3d& by) {
    open(word + " " + names_[idx(joint)]);
    offset(by);
    const bool is_root = word == "ROOT";
    line(is_root ? six_channels : "CHANNELS 3 Zrotation Xrotation Yrotation");
    if (is_root) {  // readers take its position for an absolute one
      for (const double coordinate : by) {
        still_ += (still_.empty() ? "" : " ") + number_text(coordinate);
      }
    }
    still_ += " 0 0 0";
  }

  /// Most readers take one root alone: others hang from one at the origin then.
  void begin_holder() {
    std::string name = "root";
    while (std::count(names_.begin(), names_.end(), name) > 0) name += "_";
    open("ROOT " + name);
    offset(RowVector3d::Zero());
    line(six_channels);
    still_ = "0 0 0 0 0 0";
  }

  void end_site(const RowVector3d& by) {
    open("End Site");
    offset(by);
    close();
  }

  const Rig& rig_;
  const std::vector<std::string> names_;
  std::vector<int> roots_;
  std::vector<std::vector<int>> children_;
  std::string text_;
  std::size_t depth_ = 0;
  std::string still_;  // the values of all channels at rest
};

}  // namespace

std::string format_bvh_rig(const Rig& rig) { return BvhWriter(rig).write(); }

}  // namespace curveskel
