#include "skeleton/homology/homology_classes.hpp"

#include <algorithm>
#include <bit>
#include <random>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include "skeleton/homology/homology_rank.hpp"
#include "skeleton/homology/linking.hpp"

namespace curveskel {

bool IndependentRows::add(BitRow row) {
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    if ((row[pivots_[i] / 64] >> (pivots_[i] % 64) & 1U) == 0) continue;
    for (std::size_t w = 0; w < row.size(); ++w) row[w] ^= rows_[i][w];
  }
  const auto word = std::find_if(row.begin(), row.end(), [](std::uint64_t w) { return w != 0; });
  if (word == row.end()) return false;
  pivots_.push_back(64 * static_cast<std::size_t>(word - row.begin()) +
                    static_cast<std::size_t>(std::countr_zero(*word)));
  rows_.push_back(std::move(row));
  return true;
}

struct HomologyClasses::Implementation {
  explicit Implementation(const Surface& surface) : loops(surface) {
    std::mt19937_64 random(1);
    number_of_edge.assign(loops.edges.size(), 0);
    for (const auto& loop : loops.handles.loops) {
      const std::uint64_t number = random();
      for (const int edge : loop) number_of_edge[idx(edge)] ^= number;
    }
  }

  [[nodiscard]] std::uint64_t number_of(const linking::Segment& segment) {
    std::uint64_t number = 0;
    loops.edges.crossed_by(segment, [&](int under) { number ^= number_of_edge[idx(under)]; });
    return number;
  }

  linking::SeenLoops loops;
  std::vector<std::uint64_t> number_of_edge;  // the sum of its loops' numbers
};

HomologyClasses::HomologyClasses(const Surface& surface)
    : implementation_(std::make_shared<Implementation>(surface)) {}

bool HomologyClasses::has_handles() const { return implementation_->loops.edges.size() > 0; }

bool HomologyClasses::homologous(const std::vector<Eigen::Vector3d>& there,
                                 const std::vector<Eigen::Vector3d>& back) {
  const linking::Projection& projection = implementation_->loops.projection;
  linking::Seen last = projection(there.front());
  std::uint64_t number = 0;
  const auto go_on_to = [&](const Eigen::Vector3d& point) {
    const linking::Seen next = projection(point);
    number ^= implementation_->number_of({last, next});
    last = next;
  };
  std::for_each(there.begin() + 1, there.end(), go_on_to);
  std::for_each(back.rbegin(), back.rend(), go_on_to);
  go_on_to(there.front());
  return number == 0;
}

std::uint64_t HomologyClasses::number(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  const linking::Projection& projection = implementation_->loops.projection;
  return implementation_->number_of({projection(from), projection(to)});
}

std::vector<BitRow> HomologyClasses::linking_numbers(
    const std::vector<std::vector<Eigen::Vector3d>>& polygons) const {
  linking::SeenLoops& loops = implementation_->loops;
  std::vector<linking::Crossing> crossings;
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    linking::Seen last = loops.projection(polygons[i].back());
    for (const Eigen::Vector3d& point : polygons[i]) {
      const linking::Seen next = loops.projection(point);
      loops.edges.crossed_by({last, next}, [&](int under) {
        crossings.push_back({static_cast<int>(i), under});
      });
      last = next;
    }
  }
  std::vector<BitRow> rows(polygons.size());
  linking::for_words(loops.handles, crossings, polygons.size(), [&](const BitRow& words) {
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i].push_back(words[i]);
  });
  return rows;
}

int HomologyClasses::rank(const CurveSkeleton& skeleton) const {
  return homology_rank(implementation_->loops, skeleton);
}

}  // namespace curveskel
