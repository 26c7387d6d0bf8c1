#include "rig/usd/usd_animations.hpp"

#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include "rig/animations/node_move.hpp"
#include "rig/animations/track_moments.hpp"
#include "rig/usd/usd_names.hpp"

namespace curveskel {
namespace {

using Eigen::Affine3d;

/// To a ten-thousandth: keys at frames lie at whole ones.
double time_code(double seconds) {
  constexpr double parts = 1e4;
  return std::round(usd_codes_a_second * seconds * parts) / parts + 0.0;
}

NodeMove rest_move(const tinygltf::Node& node) {
  if (!node.matrix.empty()) return node_move(frame_of(node));
  NodeMove move{Eigen::Vector3d::Zero(), Eigen::Quaterniond::Identity(), Eigen::Vector3d::Ones()};
  if (node.translation.size() == 3) move.shift = Eigen::Vector3d(node.translation.data());
  if (node.scale.size() == 3) move.scale = Eigen::Vector3d(node.scale.data());
  if (node.rotation.size() == 4) {
    const Eigen::Vector4d turn(node.rotation.data());
    if (turn.norm() > 0) move.turn = Eigen::Quaterniond(turn).normalized();
  }
  return move;
}

NodeMove move_of(const tinygltf::Node& node, const GltfMotion* motion, double seconds) {
  NodeMove move = rest_move(node);
  if (motion == nullptr || !node.matrix.empty()) return move;  // which the standard forbids
  if (!motion->shift.empty()) move.shift = motion->shift.at(seconds);
  if (!motion->scale.empty()) move.scale = motion->scale.at(seconds);
  if (!motion->turn.empty()) {
    const Eigen::Vector4d turn = motion->turn.at(seconds);
    if (turn.norm() > 0) move.turn = Eigen::Quaterniond(turn).normalized();
  }
  return move;
}

Affine3d frame_of_move(const NodeMove& move) {
  return Eigen::Translation3d(move.shift) * move.turn * Eigen::Scaling(move.scale);
}

const GltfMotion* motion_of(const GltfAnimation& animation, int node) {
  const auto found = animation.motions.find(node);
  return found == animation.motions.end() ? nullptr : &found->second;
}

/// One row for each moment, of all joints or shapes.
using UsdRows = std::vector<std::vector<double>>;

/// Shifts, turns (real part first) and scales of several nodes.
struct UsdMoves {
  UsdRows shifts, turns, scales;

  /// Turns go the short way from those before, as lines between them shall.
  void add(const std::vector<NodeMove>& moves) {
    std::vector<double> shift, turn, scale;
    for (std::size_t k = 0; k < moves.size(); ++k) {
      const auto& [at, around, factors] = moves[k];
      shift.insert(shift.end(), {at.x(), at.y(), at.z()});
      scale.insert(scale.end(), {factors.x(), factors.y(), factors.z()});
      std::array<double, 4> now{around.w(), around.x(), around.y(), around.z()};
      double cosine = now[0];
      if (!turns.empty()) {
        cosine = 0;
        for (std::size_t c = 0; c < 4; ++c) cosine += now[c] * turns.back()[4 * k + c];
      }
      for (double& number : now) turn.push_back(cosine < 0 ? -number : number);
    }
    shifts.push_back(std::move(shift));
    turns.push_back(std::move(turn));
    scales.push_back(std::move(scale));
  }
};

bool all_stay(const UsdRows& rows, const std::vector<double>& rest) {
  constexpr double rounding = 1e-6;
  return std::ranges::all_of(rows, [&](const std::vector<double>& row) {
    for (std::size_t k = 0; k < row.size(); ++k) {
      if (std::abs(row[k] - rest[k]) > rounding * (1 + std::abs(rest[k]))) return false;
    }
    return true;
  });
}

/// Without times where all is as at rest; rows that never change come once.
void write_rows_in_time(UsdText& text, const std::string& head, std::size_t width,
                        const std::vector<double>& codes, const UsdRows& rows,
                        const std::vector<double>& rest, bool is_array = true) {
  if (all_stay(rows, rest)) return text.samples(head, {}, {rest}, width, is_array);
  if (all_stay(rows, rows.front())) {
    return text.samples(head, {codes.front()}, {rows.front()}, width, is_array);
  }
  text.samples(head, codes, rows, width, is_array);
}

/// Those that differ as time codes.
std::vector<double> distinct_codes(const std::vector<double>& moments, std::vector<double>& codes) {
  std::vector<double> kept;
  for (const double seconds : moments) {
    const double code = time_code(seconds);
    if (!codes.empty() && code <= codes.back()) continue;
    codes.push_back(code);
    kept.push_back(seconds);
  }
  return kept;
}

void write_shape_names(UsdText& text, const std::vector<UsdSlider>& sliders) {
  std::vector<std::string> tokens;
  tokens.reserve(sliders.size());
  for (const UsdSlider& slider : sliders) tokens.push_back(slider.token);
  text.words("uniform token[] blendShapes", tokens);
}

std::vector<double> rest_of(const std::vector<UsdSlider>& sliders) {
  std::vector<double> rest;
  rest.reserve(sliders.size());
  for (const UsdSlider& slider : sliders) rest.push_back(slider.rest);
  return rest;
}

double share_at(const GltfTrack& track, const UsdSlider& slider, double seconds) {
  if (track.empty()) return slider.rest;
  const Eigen::VectorXd shares = track.at(seconds);
  return slider.shape < idx(shares.size()) ? shares[static_cast<Eigen::Index>(slider.shape)]
                                           : slider.rest;
}

class SkelAnimationWriter {
 public:
  SkelAnimationWriter(const GltfAnimation& animation, const UsdMoved& moved)
      : animation_(animation), moved_(moved) {
    for (const std::vector<int>& chain : moved.skeleton.chains) {
      for (const int node : chain) {
        const GltfMotion* motion = motion_of(animation, node);
        if (motion == nullptr) continue;
        for (const GltfTrack* track : {&motion->shift, &motion->turn, &motion->scale}) {
          moves_joints_ = moves_joints_ || !track->empty();
          tracks_.push_back(track);
        }
      }
    }
    for (const UsdSlider& slider : moved.sliders) {
      const GltfMotion* motion = motion_of(animation, slider.node);
      if (motion == nullptr || motion->sliders.empty()) continue;
      tracks_.push_back(&motion->sliders);
    }
  }

  bool write(UsdText& text, const std::string& name, UsdSpan& span) const {
    std::vector<double> codes;
    const std::vector<double> moments = distinct_codes(track_moments(tracks_), codes);
    if (codes.empty()) return false;
    const UsdRows shares = shares_at(moments);
    if (!moves_joints_ && all_stay(shares, rest_of(moved_.sliders))) return false;
    text.begin("SkelAnimation", name, {{}, usd_true_name(animation_.name, name)});
    if (moves_joints_) write_joints(text, moments, codes);
    if (!moved_.sliders.empty()) {
      write_shape_names(text, moved_.sliders);
      write_rows_in_time(text, "float[] blendShapeWeights", 1, codes, shares,
                         rest_of(moved_.sliders));
    }
    text.end();
    span.take(codes);
    return true;
  }

 private:
  [[nodiscard]] std::vector<NodeMove> moves_at(double seconds, bool at_rest) const {
    std::vector<NodeMove> moves;
    for (const std::vector<int>& chain : moved_.skeleton.chains) {
      Affine3d frame = Affine3d::Identity();
      for (const int node : chain) {
        const NodeMove move = move_of(moved_.model.nodes[idx(node)],
                                      at_rest ? nullptr : motion_of(animation_, node), seconds);
        if (chain.size() == 1) moves.push_back(move);
        if (chain.size() > 1) frame = frame * frame_of_move(move);
      }
      if (chain.size() > 1) moves.push_back(node_move(frame));
    }
    return moves;
  }

  void write_joints(UsdText& text, const std::vector<double>& moments,
                    const std::vector<double>& codes) const {
    UsdMoves rest;
    rest.add(moves_at(0, true));
    UsdMoves moves = rest;
    for (const double seconds : moments) moves.add(moves_at(seconds, false));
    for (UsdRows* rows : {&moves.shifts, &moves.turns, &moves.scales}) rows->erase(rows->begin());
    text.words("uniform token[] joints", moved_.skeleton.paths);
    write_rows_in_time(text, "float3[] translations", 3, codes, moves.shifts, rest.shifts[0]);
    write_rows_in_time(text, "quatf[] rotations", 4, codes, moves.turns, rest.turns[0]);
    write_rows_in_time(text, "half3[] scales", 3, codes, moves.scales, rest.scales[0]);
  }

  [[nodiscard]] UsdRows shares_at(const std::vector<double>& moments) const {
    UsdRows rows;
    for (const double seconds : moments) {
      std::vector<double> row;
      for (const UsdSlider& slider : moved_.sliders) {
        const GltfMotion* motion = motion_of(animation_, slider.node);
        row.push_back(motion == nullptr ? slider.rest : share_at(motion->sliders, slider, seconds));
      }
      rows.push_back(std::move(row));
    }
    return rows;
  }

  const GltfAnimation& animation_;
  const UsdMoved& moved_;
  std::vector<const GltfTrack*> tracks_;
  bool moves_joints_ = false;
};

bool slide_alike(const UsdSlider& one, const UsdSlider& other,
                 const std::vector<GltfAnimation>& animations) {
  if (one.rest != other.rest) return false;
  return std::ranges::all_of(animations, [&](const GltfAnimation& animation) {
    const auto track = [&](const UsdSlider& slider) {
      const GltfMotion* motion = motion_of(animation, slider.node);
      return motion == nullptr ? GltfTrack() : motion->sliders;
    };
    const GltfTrack first = track(one);
    const GltfTrack second = track(other);
    if (first.times() != second.times() || first.between() != second.between()) return false;
    return std::ranges::all_of(track_moments({&first}), [&](double seconds) {
      return share_at(first, one, seconds) == share_at(second, other, seconds);
    });
  });
}

}  // namespace

std::vector<std::string> usd_shape_tokens(const std::vector<UsdSlider>& shapes,
                                          const std::string& mesh,
                                          const std::vector<GltfAnimation>& animations,
                                          UsdSliders& sliders) {
  const std::size_t known = sliders.all.size();
  std::vector<std::string> tokens;
  for (const UsdSlider& shape : shapes) {
    std::string token = usd_identifier(shape.token, "shape");
    const auto same = sliders.number_of_token.find(token);
    const bool is_taken = same != sliders.number_of_token.end();
    const bool is_others = is_taken && same->second < known;
    const bool is_own = std::ranges::find(tokens, token) != tokens.end();
    if (is_others && !is_own && slide_alike(shape, sliders.all[same->second], animations)) {
      tokens.push_back(token);
      continue;
    }
    if (is_others && !is_own) token.insert(0, "_").insert(0, mesh);
    std::string free = token;
    for (int number = 2; sliders.number_of_token.contains(free); ++number) {
      free = token;
      free.append("_").append(std::to_string(number));
    }
    sliders.number_of_token[free] = sliders.all.size();
    sliders.all.push_back(shape);
    sliders.all.back().token = free;
    tokens.push_back(std::move(free));
  }
  return tokens;
}

void UsdSpan::take(const std::vector<double>& codes) {
  if (codes.empty()) return;
  first = is_there ? std::min(first, codes.front()) : codes.front();
  last = is_there ? std::max(last, codes.back()) : codes.back();
  is_there = true;
}

bool write_usd_animation(UsdText& text, const std::string& name, const GltfAnimation& animation,
                         const UsdMoved& moved, UsdSpan& span) {
  return SkelAnimationWriter(animation, moved).write(text, name, span);
}

void write_usd_rest_shapes(UsdText& text, const std::string& name,
                           const std::vector<UsdSlider>& sliders) {
  text.begin("SkelAnimation", name);
  write_shape_names(text, sliders);
  text.numbers("float[] blendShapeWeights", rest_of(sliders), 1);
  text.end();
}

std::string usd_place(const tinygltf::Node& node, const GltfMotion* motion, std::size_t depth,
                      UsdSpan& span) {
  UsdText text(depth);
  if (!node.matrix.empty()) {
    const Affine3d frame = frame_of(node);
    if (frame.matrix().isIdentity(0)) return "";
    text.line("matrix4d xformOp:transform = " + usd_matrix(frame));
    text.line("uniform token[] xformOpOrder = [\"xformOp:transform\"]");
    return text.text();
  }
  UsdMoves rest;
  rest.add({rest_move(node)});
  std::vector<double> codes;
  std::vector<double> moments;
  if (motion != nullptr) {
    moments = distinct_codes(track_moments({&motion->shift, &motion->turn, &motion->scale}), codes);
  }
  if (moments.empty() && frame_of(node).matrix().isIdentity(0)) return "";
  UsdMoves moves = rest;
  for (const double seconds : moments) moves.add({move_of(node, motion, seconds)});
  if (!moments.empty()) {
    for (UsdRows* rows : {&moves.shifts, &moves.turns, &moves.scales}) rows->erase(rows->begin());
  }
  const auto write = [&](const char* head, const UsdRows& rows, const UsdRows& at_rest) {
    write_rows_in_time(text, head, at_rest[0].size(), codes, rows, at_rest[0], false);
  };
  write("double3 xformOp:translate", moves.shifts, rest.shifts);
  write("quatf xformOp:orient", moves.turns, rest.turns);
  write("float3 xformOp:scale", moves.scales, rest.scales);
  text.line(
      "uniform token[] xformOpOrder = [\"xformOp:translate\", \"xformOp:orient\", "
      "\"xformOp:scale\"]");
  span.take(codes);
  return text.text();
}

}  // namespace curveskel
