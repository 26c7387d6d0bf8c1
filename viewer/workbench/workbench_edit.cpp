// The workbench's selection and corrections.
#include <algorithm>
#include <exception>
#include <utility>

#include "viewer/workbench/workbench.hpp"

namespace curveskel::viewer {
namespace {

/// Some edge at the node, or -1.
int edge_at(const CurveSkeleton& skeleton, int node) {
  for (Eigen::Index row = 0; row < skeleton.edges.rows(); ++row) {
    if (skeleton.edges(row, 0) == node || skeleton.edges(row, 1) == node) {
      return static_cast<int>(row);
    }
  }
  return -1;
}

std::vector<int> edges_along(const CurveSkeleton& skeleton, const std::vector<int>& nodes) {
  std::vector<int> edges;
  edges.reserve(nodes.size());
  for (std::size_t i = 1; i < nodes.size(); ++i) {
    edges.push_back(edge_between(skeleton, nodes[i - 1], nodes[i]));
  }
  return edges;
}

/// A word for the person if the root is another node now, and not just another number.
std::string about_root(const Edited& before, const Edited& after) {
  if (before.root < 0) return {};
  if (after.root < 0) return "; the root went with its node, set another one (T)";
  const bool same_place =
      before.skeleton->nodes.row(before.root) == after.skeleton->nodes.row(after.root);
  if (same_place) return {};
  return "; the root is node " + std::to_string(after.root) + " now";
}

}  // namespace

/// A skeleton that was made or read: the next step of the history, or instead of the last one.
void Workbench::show_made(Edited made, bool as_next_step) {
  drop_rig();
  scene->own_skeleton.reset();
  const bool hides_corrections = as_next_step && history_.corrected();
  if (as_next_step) {
    history_.add(std::move(made));
  } else {
    history_.replace(std::move(made));
  }
  if (hides_corrections) say("the skeleton that was corrected by hand is one step back (Ctrl-Z)");
  clear_selection();
  show_state();
}

/// Shows the state of the history at the end of the timeline, the rig included, and what was
/// recorded before it.
void Workbench::show_state() {
  const std::size_t end = scene->recording.moments().size() - (has_rig() ? 2 : 1);
  const bool at_end = scene->moment >= end;
  const auto before = scene->skeleton();
  const auto rig = scene->rig();
  scene->own_skeleton = at_end && !history_.empty() && !run_ ? history_.now().skeleton : nullptr;
  if (scene->skeleton() != before) {
    clear_selection();
    failed_edges_.clear();
  }
  if (rig != shown_rig_) {
    selected_joint_ = -1;
    scene->turn_back();
    poses_ = {};
  }
  shown_rig_ = rig;
  set_highlights();
  judge();
}

void Workbench::select(const Pick& picked, bool more) {
  const auto skeleton = scene->skeleton();
  int node = picked.kind == Pick::Kind::node ? picked.index : -1;
  if (picked.kind == Pick::Kind::face && skeleton &&
      skeleton->node_of_vertex.size() == scene->document.surface.positions.rows()) {
    node = skeleton->node_of_vertex[picked.vertex];
  }
  if (picked.kind == Pick::Kind::joint) {
    select_joint(picked.index == selected_joint_ ? -1 : picked.index);
    return;
  }
  if (!more) {
    selected_nodes_.clear();
    selected_edge_ = -1;
    selected_joint_ = -1;
  }
  if (node >= 0) {
    selected_edge_ = -1;
    const auto found = std::find(selected_nodes_.begin(), selected_nodes_.end(), node);
    if (found != selected_nodes_.end()) {
      selected_nodes_.erase(found);
    } else {
      selected_nodes_.push_back(node);
    }
    constexpr std::size_t most = 2;
    if (selected_nodes_.size() > most) selected_nodes_.erase(selected_nodes_.begin());
  } else if (picked.kind == Pick::Kind::edge) {
    selected_nodes_.clear();
    selected_edge_ = picked.index;
  }
  measured_ = {};
  if (skeleton && selected_nodes_.size() == 2) {
    measured_ = shortest_path(*skeleton, selected_nodes_[0], selected_nodes_[1]);
  }
  set_highlights();
}

void Workbench::select_joint(int joint) {
  selected_joint_ = joint;
  set_highlights();
}

void Workbench::clear_selection() {
  selected_nodes_.clear();
  selected_edge_ = -1;
  selected_joint_ = -1;
  measured_ = {};
  set_highlights();
}

void Workbench::set_highlights() {
  Highlights lit;
  lit.nodes = selected_nodes_;
  if (selected_edge_ >= 0) lit.edges.push_back(selected_edge_);
  if (const auto skeleton = scene->skeleton()) {
    const std::vector<int> path = edges_along(*skeleton, measured_.nodes);
    lit.edges.insert(lit.edges.end(), path.begin(), path.end());
  }
  lit.joint = selected_joint_;
  lit.failed_edges = failed_edges_;
  lit.failed_faces = failed_faces_;
  scene->highlights = std::move(lit);
}

/// True if they are red now; false where they were so before.
bool Workbench::show_or_hide(std::vector<int>& red, std::vector<int> wanted) {
  const bool was_red = !wanted.empty() && red == wanted;
  red = was_red ? std::vector<int>{} : std::move(wanted);
  set_highlights();
  return !was_red;
}

void Workbench::clear_faults() {
  failed_edges_.clear();
  failed_faces_.clear();
  set_highlights();
}

void Workbench::show_exits() {
  const Judgement* found = judgement();
  if (found == nullptr) return;
  std::vector<int> edges;
  const Exit* worst = nullptr;
  for (const Exit& exit : found->findings.exits) {
    if (exit.edge < 0) continue;
    edges.push_back(exit.edge);
    if (worst == nullptr || exit.depth > worst->depth) worst = &exit;
  }
  if (!show_or_hide(failed_edges_, std::move(edges))) return;
  if (worst != nullptr) {
    const Eigen::RowVector3d from =
        found->skeleton->nodes.row(found->skeleton->edges(worst->edge, 0));
    const Eigen::RowVector3d to =
        found->skeleton->nodes.row(found->skeleton->edges(worst->edge, 1));
    wants_look_at = shown_point((from + to) / 2, scene->document.space);
  } else {
    say("no edge leaves the surface");
  }
}

void Workbench::show_spurs() {
  const Judgement* found = judgement();
  if (found == nullptr) return;
  std::vector<int> edges;
  for (const Branch& spur : found->findings.spurs) {
    const std::vector<int> along = edges_along(*found->skeleton, spur.nodes);
    edges.insert(edges.end(), along.begin(), along.end());
  }
  if (!show_or_hide(failed_edges_, std::move(edges))) return;
  if (found->findings.spurs.empty()) {
    say("there is no spur");
  } else {
    wants_look_at =
        shown_point(found->skeleton->nodes.row(found->findings.spurs.front().nodes.front()),
                    scene->document.space);
  }
}

void Workbench::show_faces(const std::vector<int>& faces) {
  if (!show_or_hide(failed_faces_, faces)) return;
  if (!faces.empty()) {
    const auto corners = scene->document.surface.triangles.row(faces.front());
    wants_look_at =
        shown_point(scene->document.surface.positions.row(corners[0]), scene->document.space);
  }
}

/// Else says why a correction would not be of it.
bool Workbench::shows_what_is_corrected() {
  if (run_ || history_.empty()) {
    say("there is nothing to correct before the skeleton is there", true);
    return false;
  }
  if (scene->skeleton() == history_.now().skeleton) return true;
  say("corrections are of the skeleton at the end of the timeline (End), not of this curve", true);
  return false;
}

/// Makes the change part of the history, or says why it cannot be.
void Workbench::edit(const std::function<CurveSkeleton(const CurveSkeleton&)>& change,
                     const std::string& what) {
  if (!shows_what_is_corrected()) return;
  try {
    const Edited before = history_.now();
    Edited next = changed_with_root(before, change);
    next.corrected = true;
    const bool fewer = next.skeleton->nodes.rows() < before.skeleton->nodes.rows();
    history_.add(next);
    drop_rig();
    scene->moment = scene->recording.moments().size() - 1;
    show_state();
    say(what + (fewer ? about_root(before, next) : std::string()));
  } catch (const std::exception& error) {
    say(error.what(), true);
  }
}

void Workbench::prune() {
  const auto skeleton = scene->skeleton();
  if (!skeleton) return;
  int edge = selected_edge_;
  if (edge < 0 && selected_nodes_.size() == 1) edge = edge_at(*skeleton, selected_nodes_[0]);
  if (edge < 0) {
    say("select an edge or a tip of the branch to prune", true);
    return;
  }
  edit([edge](const CurveSkeleton& now) { return prune_branch(now, edge); }, "pruned a branch");
}

void Workbench::remove() {
  if (selected_nodes_.size() != 1) {
    say("select the node to remove", true);
    return;
  }
  edit([node = selected_nodes_[0]](const CurveSkeleton& now) { return remove_node(now, node); },
       "removed a node");
}

void Workbench::merge() {
  if (selected_nodes_.size() != 2) {
    say("select two nodes to merge (the second one with Shift)", true);
    return;
  }
  edit(
      [this, a = selected_nodes_[0], b = selected_nodes_[1]](const CurveSkeleton& now) {
        return merge_nodes(now, a, b, MergePlace::midpoint, tree());
      },
      "merged two nodes");
}

void Workbench::cut() {
  const auto skeleton = scene->skeleton();
  int edge = selected_edge_;
  if (skeleton && selected_nodes_.size() == 2) {
    edge = edge_between(*skeleton, selected_nodes_[0], selected_nodes_[1]);
  }
  if (edge < 0) {
    say("select the edge to cut", true);
    return;
  }
  edit([edge](const CurveSkeleton& now) { return cut_edge(now, edge); }, "cut an edge");
}

void Workbench::join() {
  if (selected_nodes_.size() != 2) {
    say("select two nodes to join (the second one with Shift)", true);
    return;
  }
  edit([a = selected_nodes_[0],
        b = selected_nodes_[1]](const CurveSkeleton& now) { return join_nodes(now, a, b); },
       "joined two nodes");
}

void Workbench::split() {
  if (selected_edge_ < 0) {
    say("select the edge that is to get a node", true);
    return;
  }
  edit([this, edge = selected_edge_](
           const CurveSkeleton& now) { return split_edge(now, edge, 0.5, tree()); },
       "put a node on an edge");
}

void Workbench::move(int node, const glm::vec3& place) {
  const Eigen::Vector3d position = model_point(place, scene->document.space);
  edit([&](const CurveSkeleton& now) { return move_node(now, node, position, tree()); },
       "moved a node");
}

void Workbench::set_root() {
  if (selected_nodes_.size() != 1) {
    say("select the node that is to be the root", true);
    return;
  }
  if (!shows_what_is_corrected()) return;
  Edited next = history_.now();
  next.root = selected_nodes_[0];
  next.corrected = true;
  history_.add(std::move(next));
  drop_rig();
  show_state();
  say("the root is node " + std::to_string(history_.now().root));
}

/// The rig stays where the skeleton does.
void Workbench::go_in_history(const std::function<void()>& way) {
  const Edited before = history_.now();
  way();
  const Edited& now = history_.now();
  if (!run_) pipeline.extract.embed.detail = now.detail;  // which a run shows at its end
  if (now.skeleton == before.skeleton && now.root == before.root) {
    change_roles();
    return;
  }
  drop_rig();
  show_state();
}

bool Workbench::can_undo() const { return has_pose(poses_.before) || history_.can_undo(); }

bool Workbench::can_redo() const { return has_pose(poses_.after) || history_.can_redo(); }

void Workbench::undo() {
  if (has_pose(poses_.before)) {
    go_to_pose(poses_.before, poses_.after);
    return;
  }
  if (!history_.can_undo()) {
    say("nothing to take back");
    return;
  }
  go_in_history([&] { history_.undo(); });
}

void Workbench::redo() {
  if (has_pose(poses_.after)) {
    go_to_pose(poses_.after, poses_.before);
    return;
  }
  if (!history_.can_redo()) {
    say("nothing to do again");
    return;
  }
  go_in_history([&] { history_.redo(); });
}

}  // namespace curveskel::viewer
