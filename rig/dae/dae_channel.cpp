#include "rig/dae/dae_channel.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>

#include <curveskel/advanced/indices.hpp>
#include "rig/animations/bezier.hpp"
#include "rig/animations/moments.hpp"
#include "rig/animations/node_move.hpp"

namespace curveskel {
namespace {

constexpr std::size_t matrix_numbers = 16;

/// The element or one below it, depth first.
const XmlElement* with_sid(const XmlElement& element, std::string_view sid) {
  for (const XmlElement& child : element.children) {
    if (child.attribute("sid") == sid) return &child;
    if (const XmlElement* found = with_sid(child, sid)) return found;
  }
  return nullptr;
}

/// Numbers of an element that moves a node; 0 of another.
std::size_t numbers_in(const XmlElement& element) {
  if (element.name == "matrix") return matrix_numbers;
  if (element.name == "translate" || element.name == "scale") return 3;
  if (element.name == "lookat") return 9;
  return element.name == "rotate" ? 4 : 0;
}

/// The place behind ".ANGLE", "(3)" or "(3)(1)"; nothing if there is none such.
std::optional<std::size_t> member_of(std::string_view name) {
  if (name == ".X") return 0;
  if (name == ".Y") return 1;
  if (name == ".Z") return 2;
  if (name == ".ANGLE") return 3;
  std::vector<std::size_t> places;
  for (std::size_t k = 0; k + 2 < name.size() && places.size() < 2; k += 3) {
    if (name[k] != '(' || name[k + 1] < '0' || name[k + 1] > '9' || name[k + 2] != ')') break;
    places.push_back(static_cast<std::size_t>(name[k + 1] - '0'));
  }
  if (places.empty() || name.size() != 3 * places.size()) return std::nullopt;
  return places.size() == 1 ? places[0] : 4 * places[1] + places[0];  // column, row
}

Eigen::Affine3d matrix_of(const double* numbers) {
  using Rows = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;
  Eigen::Affine3d frame = Eigen::Affine3d::Identity();
  frame.matrix().topRows<3>() = Eigen::Map<const Rows>(numbers).topRows<3>();
  return frame;
}

}  // namespace

std::optional<DaeChannel::Target> DaeChannel::target_of(const DaeDocument& document,
                                                        const XmlElement& channel) {
  const std::string_view path = channel.attribute("target");
  const std::size_t slash = path.find('/');
  if (slash == std::string_view::npos) return std::nullopt;
  const std::size_t name_end = std::min(path.find_first_of(".(", slash), path.size());
  const XmlElement* element = document.find(path.substr(0, slash));
  std::size_t begin = slash + 1;
  while (element != nullptr && begin < name_end) {
    const std::size_t end = std::min(path.find('/', begin), name_end);
    element = with_sid(*element, path.substr(begin, end - begin));
    begin = end + 1;
  }
  const std::size_t count = element == nullptr ? 0 : numbers_in(*element);
  if (count == 0) return std::nullopt;
  Target target{element, document.numbers(*element), {}};
  if (target.rest.size() != count) return std::nullopt;  // which the scene refuses by its line
  if (name_end == path.size()) {
    for (std::size_t k = 0; k < count; ++k) target.members.push_back(k);
    return target;
  }
  const std::optional<std::size_t> member = member_of(path.substr(name_end));
  if (!member || *member >= count) return std::nullopt;
  target.members.push_back(*member);
  return target;
}

std::optional<DaeChannel> DaeChannel::read(const DaeDocument& document, const XmlElement& channel) {
  const std::optional<Target> target = target_of(document, channel);
  if (!target) return std::nullopt;
  const XmlElement& sampler = document.referred(channel, "source");
  const XmlElement* input = document.input(sampler, "INPUT").source;
  const XmlElement* output = document.input(sampler, "OUTPUT").source;
  if (input == nullptr || output == nullptr) {
    document.fail(sampler, "a sampler without INPUT or OUTPUT", "both");
  }
  DaeChannel made;
  made.target_ = *target;
  made.is_matrix_ = target->members.size() == matrix_numbers;
  made.keys_ = document.rows(*input, 1);
  made.rows_ = document.rows(*output, target->members.size());
  if (made.keys_.empty()) return std::nullopt;
  if (made.rows_.size() != made.keys_.size() * target->members.size()) {
    document.fail(*output, std::to_string(made.rows_.size()) + " numbers of an animation",
                  std::to_string(target->members.size()) + " for each of the " +
                      std::to_string(made.keys_.size()) + " keys");
  }
  const auto is_finite = [](double number) { return std::isfinite(number); };
  if (!std::ranges::all_of(made.keys_, is_finite) || !std::ranges::is_sorted(made.keys_) ||
      !std::ranges::all_of(made.rows_, is_finite)) {
    document.fail(sampler, "a key that is no number or goes back in time",
                  "numbers, times in their order");
  }
  made.read_between(document, sampler);
  return made;
}

void DaeChannel::read_between(const DaeDocument& document, const XmlElement& sampler) {
  between_.assign(keys_.size(), Between::line);
  if (const XmlElement* source = document.input(sampler, "INTERPOLATION").source) {
    bool are_ids = false;
    const std::vector<std::string> names = document.names(*source, "an animation", are_ids);
    for (std::size_t key = 0; key < std::min(names.size(), keys_.size()); ++key) {
      if (names[key] == "STEP") between_[key] = Between::step;
      if (names[key] == "BEZIER" && !is_matrix_) between_[key] = Between::bezier;
      if (names[key] == "HERMITE" && !is_matrix_) between_[key] = Between::hermite;
    }
  }
  arriving_ = tangents(document, sampler, "IN_TANGENT");
  leaving_ = tangents(document, sampler, "OUT_TANGENT");
  if (arriving_.empty() || leaving_.empty()) {
    for (Between& one : between_) one = one == Between::step ? one : Between::line;
  }
  for (std::size_t key = 0; key < keys_.size(); ++key) {
    moments_.push_back(keys_[key]);
    if (key + 1 == keys_.size() || between_[key] != Between::step) continue;
    const double length = keys_[key + 1] - keys_[key];
    moments_.push_back(keys_[key + 1] - std::min(step_seconds, 0.5 * length));
  }
}

/// A time and a value for each key and member; nothing where the file has others.
std::vector<double> DaeChannel::tangents(const DaeDocument& document, const XmlElement& sampler,
                                         std::string_view semantic) const {
  const XmlElement* source = document.input(sampler, semantic).source;
  if (source == nullptr) return {};
  std::vector<double> rows = document.rows(*source, 2 * target_.members.size());
  return rows.size() == 2 * rows_.size() ? rows : std::vector<double>();
}

double DaeChannel::value(std::size_t key, std::size_t member) const {
  return rows_[key * target_.members.size() + member];
}

/// Between this key and the next, which is there.
double DaeChannel::at(double seconds, std::size_t key, std::size_t member) const {
  const TimedValue from{keys_[key], value(key, member)};
  const TimedValue to{keys_[key + 1], value(key + 1, member)};
  const double share = (seconds - from.seconds) / (to.seconds - from.seconds);
  if (between_[key] == Between::step) return from.value;
  if (between_[key] == Between::line) return from.value + share * (to.value - from.value);
  const std::size_t width = target_.members.size();
  const double* leaving = leaving_.data() + 2 * (key * width + member);
  const double* arriving = arriving_.data() + 2 * ((key + 1) * width + member);
  if (between_[key] == Between::bezier) {
    return bezier_value(from, {leaving[0], leaving[1]}, {arriving[0], arriving[1]}, to, seconds);
  }
  return bezier_value(from, {from.seconds + leaving[0] / 3, from.value + leaving[1] / 3},
                      {to.seconds - arriving[0] / 3, to.value - arriving[1] / 3}, to, seconds);
}

std::vector<double> DaeChannel::row_at(double seconds) const {
  const std::size_t width = target_.members.size();
  const auto above = std::upper_bound(keys_.begin(), keys_.end(), seconds);
  const bool is_first = above == keys_.begin();
  const auto key = static_cast<std::size_t>(above - keys_.begin()) - (is_first ? 0 : 1);
  const double* row = rows_.data() + key * width;
  if (is_first || above == keys_.end() || seconds == keys_[key]) return {row, row + width};
  std::vector<double> numbers(width);
  if (is_matrix_ && between_[key] == Between::line) {
    const double share = (seconds - keys_[key]) / (keys_[key + 1] - keys_[key]);
    const Eigen::Matrix4d frame =
        frame_between(matrix_of(row), matrix_of(row + width), share).matrix().transpose();
    std::copy(frame.data(), frame.data() + width, numbers.begin());
    return numbers;
  }
  for (std::size_t member = 0; member < width; ++member) {
    numbers[member] = at(seconds, key, member);
  }
  return numbers;
}

void DaeChannel::move(double seconds, MovedNumbers& numbers) const {
  std::vector<double>& moved = numbers.try_emplace(target_.element, target_.rest).first->second;
  const std::vector<double> row = row_at(seconds);
  for (std::size_t k = 0; k < row.size(); ++k) moved[target_.members[k]] = row[k];
}

}  // namespace curveskel
