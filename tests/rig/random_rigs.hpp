// Rigs drawn by lot, for what writers must keep.
#pragma once

#include <cstdint>
#include <map>
#include <random>
#include <string>
#include <vector>

#include <curveskel/rig.hpp>
#include "meshes/shapes.hpp"

namespace curveskel {

/// Joints anywhere, hung from any before them, one to four of which move each vertex.
inline Rig random_rig(Eigen::Index vertices, int joints, const std::string& name) {
  std::mt19937_64 random(static_cast<std::uint64_t>(joints));
  std::uniform_real_distribution<double> unit(-1, 1);
  Rig rig;
  rig.joints.resize(joints, 3);
  for (double& coordinate : rig.joints.reshaped()) coordinate = 5 * unit(random);
  rig.parents.resize(joints);
  const auto below = [&](int end) {
    return static_cast<int>(random() % static_cast<std::uint64_t>(end));
  };
  for (int joint = 0; joint < joints; ++joint) {
    rig.parents[joint] = joint == 0 ? -1 : below(joint);
    rig.names.push_back(name + std::to_string(joint));
  }
  rig.weights.resize(vertices, joints);
  for (Eigen::Index vertex = 0; vertex < vertices; ++vertex) {
    std::map<int, float> row;
    float sum = 0;
    for (int k = below(4); k >= 0; --k) {
      const auto share = static_cast<float>(1.1 + unit(random));
      row[vertex == 0 ? joints - 1 - k % joints : below(joints)] = share;
    }
    for (const auto& [joint, share] : row) sum += share;
    for (const auto& [joint, share] : row) rig.weights.insert(vertex, joint) = share / sum;
  }
  rig.weights.makeCompressed();
  return rig;
}

struct WrittenCase {
  int joints;
  std::string name;
};

/// On both sides of what a byte counts to; names of other alphabets and with a quote.
inline const std::vector<WrittenCase>& written_cases() {
  static const std::vector<WrittenCase> all{
      {1, "root"},     {2, "b"},        {7, "Höhle \"骨\" 🦴 "},
      {256, "joint "}, {257, "joint "}, {900, "é"}};
  return all;
}

inline Surface torus_surface() { return shapes::torus(3, 1, 12).surface; }

}  // namespace curveskel
