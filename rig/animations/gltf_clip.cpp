#include "rig/animations/gltf_clip.hpp"

#include <algorithm>
#include <utility>

#include "base/utf8.hpp"
#include "rig/gltf/number_bytes.hpp"

namespace curveskel {

bool GltfRows::stays_at(const Eigen::VectorXd& rest, double size) const {
  constexpr double rounding = 1e-6;
  return std::ranges::all_of(rows, [&](const Eigen::VectorXd& row) {
    return (row - rest).cwiseAbs().maxCoeff() <= rounding * size;
  });
}

float GltfClip::time_of(double seconds) const { return static_cast<float>(seconds - start_); }

std::vector<std::size_t> GltfClip::distinct(const std::vector<double>& seconds) const {
  std::vector<std::size_t> kept;
  for (std::size_t k = 0; k < seconds.size(); ++k) {
    if (kept.empty() || time_of(seconds[k]) > time_of(seconds[kept.back()])) kept.push_back(k);
  }
  return kept;
}

std::size_t GltfClip::add_times(const std::vector<double>& seconds) {
  std::string rows;
  for (const double moment : seconds) put_number(rows, time_of(moment));
  const std::size_t accessor = add_accessor(document_, rows, "SCALAR", gltf_float, seconds.size());
  OrderedJson& written = document_.json["accessors"][accessor];
  written["min"] = {time_of(seconds.front())};
  written["max"] = {time_of(seconds.back())};
  return accessor;
}

void GltfClip::add_channel(std::size_t node, const GltfRows& rows, std::size_t times) {
  std::string bytes;
  for (const Eigen::VectorXd& row : rows.rows) {
    for (const double number : row) put_number(bytes, static_cast<float>(number));
  }
  const bool is_scalar = std::string(rows.type) == "SCALAR";
  const auto width = static_cast<std::size_t>(is_scalar ? rows.rows.front().size() : 1);
  const std::size_t numbers =
      add_accessor(document_, bytes, rows.type, gltf_float, width * rows.rows.size());
  channels_.push_back(
      {{"sampler", samplers_.size()}, {"target", {{"node", node}, {"path", rows.path}}}});
  samplers_.push_back({{"input", times}, {"output", numbers}});
}

void GltfClip::write(const std::string& name) {
  if (channels_.empty()) return;
  OrderedJson& all = array_in(document_.json, "animations");
  const std::string number = std::to_string(all.size() + 1);
  all.push_back({{"name", as_utf8(name.empty() ? "animation " + number : name)},
                 {"samplers", std::move(samplers_)},
                 {"channels", std::move(channels_)}});
}

}  // namespace curveskel
