#include "rig/skin/weight_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include <curveskel/advanced/indices.hpp>
#include <curveskel/advanced/measures.hpp>
#include <curveskel/advanced/union_find.hpp>
#include "surface/mesh/triangle_area.hpp"
#include "surface/repair/weld.hpp"

namespace curveskel {
namespace {

constexpr int no_piece = -1;

std::vector<int> own_places(Eigen::Index count) {
  std::vector<int> places(idx(count));
  std::iota(places.begin(), places.end(), 0);
  return places;
}

std::vector<std::pair<int, int>> edges_of(const Surface& surface, const std::vector<int>& place) {
  std::vector<std::pair<int, int>> edges;
  edges.reserve(idx(surface.triangles.size()));
  for (const auto& t : surface.triangles.rowwise()) {
    for (int k = 0; k < 3; ++k) {
      const int a = place[idx(t(k))];
      const int b = place[idx(t((k + 1) % 3))];
      if (a != b) edges.emplace_back(std::min(a, b), std::max(a, b));
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

}  // namespace

std::vector<int> welded_places(const Surface& surface) {
  constexpr double one_place = 1e-6;  // of D
  return nearby_vertices(surface.positions, std::vector<bool>(idx(surface.positions.rows()), true),
                         one_place * bounding_box_diagonal(surface.positions));
}

WeightRow largest_shares(WeightRow row, std::size_t kept) {
  std::stable_sort(row.begin(), row.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  row.resize(std::min(row.size(), kept));
  double sum = 0;
  for (const auto& [joint, share] : row) sum += share;
  for (auto& [joint, share] : row) share /= sum;
  std::sort(row.begin(), row.end());
  return row;
}

WeldedSurface::WeldedSurface(const Surface& surface)
    : WeldedSurface(surface, own_places(surface.positions.rows())) {}

WeldedSurface::WeldedSurface(const Surface& surface, std::vector<int> place_of)
    : place(std::move(place_of)), areas(Eigen::VectorXd::Zero(surface.positions.rows())) {
  const Eigen::Index count = surface.positions.rows();
  edges = edges_of(surface, place);
  const auto ends = static_cast<std::int64_t>(2 * edges.size());
  const auto end = [&](std::int64_t i, bool is_first) {
    const auto& [a, b] = edges[idx(i / 2)];
    return is_first == (i % 2 == 0) ? a : b;
  };
  neighbours_at = bucket<std::int32_t>(
      ends, count, [&](std::int64_t i) { return end(i, true); },
      [&](std::int64_t i) { return end(i, false); });
  UnionFind joined(count);
  for (const auto& [a, b] : edges) joined.unite(a, b);
  for (int v = 0; v < static_cast<int>(count); ++v) joined.unite(v, place[idx(v)]);
  component = joined.numbers();
  for (Eigen::Index face = 0; face < surface.triangles.rows(); ++face) {
    const double third = twice_area(surface, face) / 6;
    if (!std::isfinite(third)) continue;
    for (const int corner : surface.triangles.row(face)) areas[place[idx(corner)]] += third;
  }
}

std::span<const std::int32_t> WeldedSurface::neighbours(int place_number) const {
  const std::int64_t begin = neighbours_at.offsets[idx(place_number)];
  const std::int64_t end = neighbours_at.offsets[idx(place_number) + 1];
  return std::span(neighbours_at.values).subspan(idx(begin), idx(end - begin));
}

WeightPieces::WeightPieces(const WeldedSurface& surface)
    : surface_(surface), share_(surface.place.size(), 0), piece_(surface.place.size(), no_piece) {}

std::vector<WeightPieces::Piece> WeightPieces::find(std::span<const Member> members) {
  mark(members);
  return find_marked(members);
}

std::vector<WeightPieces::Piece> WeightPieces::find_grown(std::span<const Member> members) {
  std::vector<Piece> pieces = find(members);
  if (std::none_of(pieces.begin(), pieces.end(), [](const Piece& p) { return p.is_island; })) {
    return pieces;
  }
  mark(members);
  for (std::size_t number = 0; number < pieces.size(); ++number) {
    for (const int place : pieces[number].places) piece_[idx(place)] = static_cast<int>(number);
  }
  grow(pieces);
  for (const Member& member : members) {
    share_[idx(member.place)] = 0;
    piece_[idx(member.place)] = no_piece;
  }
  return pieces;
}

void WeightPieces::mark(std::span<const Member> members) {
  for (const Member& member : members) share_[idx(member.place)] = member.share;
}

std::vector<WeightPieces::Piece> WeightPieces::find_marked(std::span<const Member> members) {
  std::vector<Piece> pieces;
  std::map<int, std::size_t> heaviest;  // by component
  for (const Member& member : members) {
    if (!(member.share > moved_share) || piece_[idx(member.place)] != no_piece) continue;
    pieces.push_back(piece_from(member.place, static_cast<int>(pieces.size())));
    const auto [best, is_first] = heaviest.try_emplace(pieces.back().component, pieces.size() - 1);
    if (is_first) continue;
    const bool is_heavier = pieces.back().weight > pieces[best->second].weight;
    (is_heavier ? pieces[best->second] : pieces.back()).is_island = true;
    if (is_heavier) best->second = pieces.size() - 1;
  }
  for (const Member& member : members) {
    share_[idx(member.place)] = 0;
    piece_[idx(member.place)] = no_piece;
  }
  return pieces;
}

WeightPieces::Piece WeightPieces::piece_from(int place, int number) {
  Piece piece{{place}, surface_.component[idx(place)]};
  piece_[idx(place)] = number;
  for (std::size_t k = 0; k < piece.places.size(); ++k) {
    const int at = piece.places[k];
    piece.weight += surface_.areas[at] * share_[idx(at)];
    for (const int next : surface_.neighbours(at)) {
      if (piece_[idx(next)] != no_piece || !(share_[idx(next)] > moved_share)) continue;
      piece_[idx(next)] = number;
      piece.places.push_back(next);
    }
  }
  return piece;
}

void WeightPieces::grow(std::vector<Piece>& pieces) {
  std::vector<int> reached;
  for (const Piece& piece : pieces) {
    reached.insert(reached.end(), piece.places.begin(), piece.places.end());
  }
  for (std::size_t k = 0; k < reached.size(); ++k) {
    const int number = piece_[idx(reached[k])];
    for (const int next : surface_.neighbours(reached[k])) {
      if (piece_[idx(next)] != no_piece || !(share_[idx(next)] > 0)) continue;
      piece_[idx(next)] = number;
      pieces[idx(number)].places.push_back(next);
      reached.push_back(next);
    }
  }
}

namespace {

class IslandTaker {
 public:
  IslandTaker(const Surface& surface, const SkinWeights& weights, std::size_t kept, double least)
      : surface_(surface),
        kept_(kept),
        least_(least),
        rows_(idx(weights.rows())),
        pieces_(surface_) {
    for (Eigen::Index v = 0; v < weights.rows(); ++v) {
      if (surface_.place[idx(v)] != v) continue;
      for (SkinWeights::InnerIterator it(weights, v); it; ++it) {
        if (it.value() > 0) rows_[idx(v)].emplace_back(static_cast<int>(it.col()), it.value());
      }
    }
  }

  /// Returns whether there were any.
  bool take_once() {
    std::map<int, std::vector<int>> taken;  // by place, joints ascending
    for (const auto& [joint, members] : members_by_joint()) {
      for (const WeightPieces::Piece& piece : pieces_.find_grown(members)) {
        if (!piece.is_island) continue;
        for (const int place : piece.places) taken[place].push_back(joint);
      }
    }
    std::vector<int> bare;
    for (const auto& [place, joints] : taken) {
      WeightRow& row = rows_[idx(place)];
      std::erase_if(row, [&lost = joints](const auto& entry) {
        return std::binary_search(lost.begin(), lost.end(), entry.first);
      });
      changed_.insert(place);
      if (row.empty()) {
        bare.push_back(place);
      } else {
        row = largest_shares(std::move(row), kept_);
      }
    }
    fill(std::move(bare));
    return !taken.empty();
  }

  /// The weights with the rows that have changed.
  [[nodiscard]] SkinWeights result(const SkinWeights& weights) const {
    if (changed_.empty()) return weights;
    SkinWeights result(weights.rows(), weights.cols());
    result.reserve(Eigen::VectorXi::Constant(weights.rows(), static_cast<int>(kept_)));
    for (Eigen::Index v = 0; v < weights.rows(); ++v) {
      const int place = surface_.place[idx(v)];
      if (changed_.contains(place)) {
        for (const auto& [joint, share] : rows_[idx(place)]) {
          result.insert(v, joint) = static_cast<float>(share);
        }
      } else {
        for (SkinWeights::InnerIterator it(weights, v); it; ++it) {
          result.insert(v, it.col()) = it.value();
        }
      }
    }
    result.makeCompressed();
    return result;
  }

 private:
  [[nodiscard]] std::map<int, std::vector<WeightPieces::Member>> members_by_joint() const {
    std::map<int, std::vector<WeightPieces::Member>> members;
    for (int v = 0; v < static_cast<int>(rows_.size()); ++v) {
      for (const auto& [joint, share] : rows_[idx(v)]) members[joint].push_back({v, share});
    }
    return members;
  }

  /// Ring by ring, from those that have rows.
  void fill(std::vector<int> bare) {
    while (!bare.empty()) {
      std::vector<std::pair<int, WeightRow>> filled;
      std::vector<int> left;
      for (const int place : bare) {
        WeightRow row = mean_of_neighbours(place);
        if (row.empty()) {
          left.push_back(place);
        } else {
          filled.emplace_back(place, std::move(row));
        }
      }
      if (filled.empty()) return;
      for (auto& [place, row] : filled) rows_[idx(place)] = std::move(row);
      bare = std::move(left);
    }
  }

  [[nodiscard]] WeightRow mean_of_neighbours(int place) const {
    std::map<int, double> shares;
    for (const int next : surface_.neighbours(place)) {
      for (const auto& [joint, share] : rows_[idx(next)]) shares[joint] += share;
    }
    WeightRow row = largest_shares({shares.begin(), shares.end()}, kept_);
    std::erase_if(row, [&](const auto& entry) { return entry.second < least_; });
    return largest_shares(std::move(row), kept_);
  }

  WeldedSurface surface_;
  std::size_t kept_;
  double least_;
  std::vector<WeightRow> rows_;  // by place
  std::set<int> changed_;        // places
  WeightPieces pieces_;
};

}  // namespace

SkinWeights without_islands(const Surface& surface, const SkinWeights& weights, std::size_t kept,
                            double least) {
  constexpr int most_rounds = 4;
  IslandTaker taker(surface, weights, kept, least);
  for (int round = 0; round < most_rounds; ++round) {
    if (!taker.take_once()) break;
  }
  return taker.result(weights);
}

}  // namespace curveskel
