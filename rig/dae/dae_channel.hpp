// Numbers of a COLLADA file over time. Internal to rig/.
#pragma once

#include <optional>
#include <vector>

#include "surface/read/dae_document.hpp"
#include "surface/read/dae_nodes.hpp"

namespace curveskel {

/// A <channel>: what moves an element of a node, or one of its numbers.
class DaeChannel {
 public:
  /// Nothing of a channel that moves something else than a node. Throws Error(Fault::input) with
  /// the line where numbers are missing, are none, or times descend.
  [[nodiscard]] static std::optional<DaeChannel> read(const DaeDocument& document,
                                                      const XmlElement& channel);

  /// Those of its keys, and for each step one just before it. Never empty.
  [[nodiscard]] const std::vector<double>& seconds() const { return moments_; }
  /// True for a <matrix> as a whole: between keys it moves as glTF's nodes do.
  [[nodiscard]] bool is_matrix() const { return is_matrix_; }
  /// Before the first key as at the first, likewise at the end. O(log keys).
  void move(double seconds, MovedNumbers& numbers) const;

 private:
  enum class Between { line, step, bezier, hermite };
  /// Places of its numbers in those of the element it moves.
  struct Target {
    const XmlElement* element = nullptr;
    std::vector<double> rest;
    std::vector<std::size_t> members;
  };

  [[nodiscard]] static std::optional<Target> target_of(const DaeDocument& document,
                                                       const XmlElement& channel);
  void read_between(const DaeDocument& document, const XmlElement& sampler);
  [[nodiscard]] std::vector<double> tangents(const DaeDocument& document, const XmlElement& sampler,
                                             std::string_view semantic) const;
  [[nodiscard]] double value(std::size_t key, std::size_t member) const;
  [[nodiscard]] double at(double seconds, std::size_t key, std::size_t member) const;
  [[nodiscard]] std::vector<double> row_at(double seconds) const;

  Target target_;
  bool is_matrix_ = false;
  std::vector<double> keys_;
  std::vector<double> rows_;
  std::vector<Between> between_;  // by key
  std::vector<double> arriving_;  // of each key and member a control point, or its value
  std::vector<double> leaving_;
  std::vector<double> moments_;
};

}  // namespace curveskel
