#include <string>
#include <vector>

#include <curveskel/advanced/indices.hpp>
#include "rig/io/rig_writers.hpp"
#include "rig/skin/four_weights.hpp"

namespace curveskel {

std::string format_rignet_rig(const Rig& rig) {
  const std::vector<std::string> names = names_as_words(rig);
  std::string text;
  for (Eigen::Index joint = 0; joint < rig.joints.rows(); ++joint) {
    text += "joints " + names[idx(joint)];
    for (const double coordinate : rig.joints.row(joint)) text += " " + number_text(coordinate);
    text += "\n";
  }
  std::string roots;
  std::string links;
  for (Eigen::Index joint = 0; joint < rig.joints.rows(); ++joint) {
    const int parent = rig.parents[joint];
    if (parent < 0) {
      roots += "root " + names[idx(joint)] + "\n";
    } else {
      links += "hier " + names[idx(parent)] + " " + names[idx(joint)] + "\n";
    }
  }
  text += roots;
  for (Eigen::Index vertex = 0; vertex < rig.weights.rows(); ++vertex) {
    const FourWeights four = four_weights(rig.weights, vertex);
    text += "skin " + std::to_string(vertex);
    for (std::size_t k = 0; k < 4; ++k) {
      if (four.weights[k] <= 0) continue;
      text += " " + names[idx(four.joints[k])] + " " + number_text(four.weights[k]);
    }
    text += "\n";
  }
  return text + links;
}

}  // namespace curveskel
