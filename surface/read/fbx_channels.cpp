#include "surface/read/fbx_channels.hpp"

#include <cmath>
#include <cstddef>

namespace curveskel {
namespace {

constexpr double all_of_it = 100;

/// Of a single shape programs write other things there, as Blender weights of vertices.
std::vector<FbxChannel::Stop> stops_of(const FileBytes& file, const FbxRecord& channel,
                                       const std::vector<const FbxRecord*>& shapes) {
  std::vector<FbxChannel::Stop> last_alone{{shapes.back(), all_of_it}};
  const FbxRecord* given = channel.child("FullWeights");
  if (shapes.size() < 2 || given == nullptr) return last_alone;
  const std::vector<double> percents = fbx_numbers(file, *given);
  if (percents.size() != shapes.size()) return last_alone;
  std::vector<FbxChannel::Stop> stops;
  double before = 0;
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    if (!std::isfinite(percents[k]) || !(percents[k] > before)) return last_alone;
    before = percents[k];
    stops.push_back({shapes[k], before});
  }
  return stops;
}

}  // namespace

std::vector<double> FbxChannel::shares(double at_percent) const {
  std::vector<double> found(stops.size(), 0);
  std::size_t next = 0;
  while (next + 1 < stops.size() && at_percent > stops[next].percent) ++next;
  const double before = next == 0 ? 0 : stops[next - 1].percent;
  const double share = (at_percent - before) / (stops[next].percent - before);
  if (next == 0 || share > 1) {
    found[next] = at_percent / stops[next].percent;
  } else {
    found[next - 1] = 1 - share;
    found[next] = share;
  }
  return found;
}

std::vector<FbxChannel> fbx_channels(const FileBytes& file, const FbxScene& scene,
                                     const FbxRecord& geometry) {
  std::vector<FbxChannel> channels;
  for (const FbxRecord* morph : scene.below(geometry, "Deformer", "BlendShape")) {
    for (const FbxRecord* channel : scene.below(*morph, "Deformer", "BlendShapeChannel")) {
      const std::vector<const FbxRecord*> shapes = scene.below(*channel, "Geometry");
      if (shapes.empty()) continue;
      const FbxRecord* given = channel->child("DeformPercent");
      const double percent = given == nullptr ? 0 : given->number(0, 0);
      channels.push_back(
          {channel, std::isfinite(percent) ? percent : 0, stops_of(file, *channel, shapes)});
    }
  }
  return channels;
}

}  // namespace curveskel
