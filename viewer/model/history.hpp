// Corrections by hand that can all be taken back.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <curveskel/advanced/embed.hpp>
#include <curveskel/curve_skeleton.hpp>
#include "viewer/model/run.hpp"

namespace curveskel::viewer {

/// A role that was given to a joint by hand. Rigs come and go: the place tells which joint it is,
/// and of several in one place the number.
struct GivenRole {
  int joint = -1;
  Eigen::RowVector3d place;
  std::string role;  ///< "" = none
};

/// One state of the skeleton and its companions.
struct Edited {
  std::shared_ptr<const CurveSkeleton> skeleton;
  int root = -1;                 ///< node; -1 = none was chosen
  bool corrected = false;        ///< by hand, since it was made or read
  std::vector<GivenRole> roles;  ///< in the order in which they were given
  /// As it was made or read, with all its branches: levels are of it. With its root.
  std::shared_ptr<const CurveSkeleton> whole = nullptr;
  int whole_root = -1;
  double detail = EmbedOptions().detail;       ///< of the level that is shown
  double detail_made = EmbedOptions().detail;  ///< of the whole, of which other levels are parts
  bool saved = false;                          ///< to a file, as it is
  /// Of the run over the open surface that made it; null = it was read, or is of another surface.
  std::shared_ptr<const RunOptions> run = nullptr;
};

/// True if the skeleton, at whatever detail, is what a run over the open surface made, and the root
/// is for the rig to choose.
[[nodiscard]] bool is_as_made(const Edited& state);

/// States in order; the past is kept whole, the future until something else is done.
class History {
 public:
  void add(Edited next);
  /// In place of the present state, which is not worth going back to; later ones stay.
  /// Precondition: not empty.
  void replace(Edited other);
  /// Of another surface: forgets the runs, and the vertex maps that are not of so many vertices.
  void go_over_to(Eigen::Index vertices);
  [[nodiscard]] bool can_undo() const { return at_ > 0; }
  [[nodiscard]] bool can_redo() const { return at_ + 1 < states_.size(); }
  void undo();
  void redo();
  [[nodiscard]] bool empty() const { return states_.empty(); }
  /// True if the present state was corrected by hand.
  [[nodiscard]] bool corrected() const { return !empty() && now().corrected; }
  /// True if work by hand would be lost with the history.
  [[nodiscard]] bool has_corrections() const;
  /// The present state is in a file. Precondition: not empty.
  void note_saved();
  /// True if the present state has work by hand that is in no file.
  [[nodiscard]] bool unsaved() const;
  [[nodiscard]] const Edited& now() const { return states_[at_]; }

 private:
  std::vector<Edited> states_;
  std::size_t at_ = 0;
};

/// The state after this change of its skeleton, with the root where its node went: a correction
/// hands the vertices of a node on to its heir, and the root goes along as one more vertex.
[[nodiscard]] Edited changed_with_root(
    const Edited& before, const std::function<CurveSkeleton(const CurveSkeleton&)>& change);

}  // namespace curveskel::viewer
