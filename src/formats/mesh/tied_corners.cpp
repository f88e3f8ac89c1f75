// SPDX-License-Identifier: Apache-2.0
#include "formats/mesh/tied_corners.h"

#include <cmath>
#include <utility>

namespace latsch::formats {
namespace {

// tolerance of the position along a line; decks state positions with more digits
constexpr double kSamePlace = 1e-6;

/// Two tied corners on one side of an element, both in one plane: the nodes of the line and the
/// positions on it.
struct Edge {
  int lower = 0, upper = 0;
  double from = 0.0, to = 1.0;
};

std::optional<Edge> edge_of(int first,
                            int second,
                            const std::optional<TiedNode>& first_tie,
                            const std::optional<TiedNode>& second_tie) {
  if (!first_tie && !second_tie) return std::nullopt;
  const TiedNode& line = first_tie ? *first_tie : *second_tie;
  Edge edge{line.lower, line.upper, 0.0, 1.0};
  const auto place = [&](int corner, const std::optional<TiedNode>& tie) -> std::optional<double> {
    if (!tie) {
      if (corner == edge.lower) return 0.0;
      if (corner == edge.upper) return 1.0;
      return std::nullopt;
    }
    if (tie->lower == edge.lower && tie->upper == edge.upper) return tie->at;
    if (tie->lower == edge.upper && tie->upper == edge.lower) return 1.0 - tie->at;
    return std::nullopt;
  };
  const auto from = place(first, first_tie), to = place(second, second_tie);
  if (!from || !to || *from == *to) return std::nullopt;
  edge.from = *from;
  edge.to = *to;
  if (edge.from > edge.to) {
    std::swap(edge.lower, edge.upper);
    edge.from = 1.0 - edge.from;
    edge.to = 1.0 - edge.to;
  }
  return edge;
}

}  // namespace

std::optional<TiedElement> tied_element(const HexNodes& corners,
                                        const std::function<std::optional<TiedNode>(int)>& tie_of) {
  std::array<std::optional<TiedNode>, 8> ties;
  int count = 0;
  for (int a = 0; a < 8; ++a) {
    ties[a] = tie_of(corners[a]);
    count += ties[a] ? 1 : 0;
  }
  TiedElement result{corners, {}};
  if (count == 0) return result;
  for (const int eta : {-1, 1}) {
    result.tie.eta = eta;
    const auto pairs = result.tie.pairs();
    int here = 0;
    for (const auto& pair : pairs)
      for (const int corner : pair) here += ties[corner] ? 1 : 0;
    if (here != count) continue;
    std::array<std::optional<Edge>, 2> edges;
    for (int k = 0; k < 2; ++k) {
      const auto [i, j] = pairs[k];
      edges[k] = edge_of(corners[i], corners[j], ties[i], ties[j]);
      if (!edges[k]) return std::nullopt;
      result.node[i] = edges[k]->lower;
      result.node[j] = edges[k]->upper;
    }
    if (std::abs(edges[0]->from - edges[1]->from) > kSamePlace ||
        std::abs(edges[0]->to - edges[1]->to) > kSamePlace)
      return std::nullopt;
    result.tie.lower = edges[0]->from;
    result.tie.upper = edges[0]->to;
    return result;
  }
  return std::nullopt;
}

}  // namespace latsch::formats
