// SPDX-License-Identifier: Apache-2.0
#include "formats/deck/inp_equations.h"

#include <fmt/format.h>

#include <cmath>

namespace latsch::formats {
namespace {

constexpr double kSameWeight = 1e-6;  // tolerance of weights; decks have seven digits or more
constexpr double kOnTheLine = 1e-4;   // tolerance as a share of the length of the line
constexpr int kTerms = 3;

constexpr const char* kExpected =
    "expected three terms that hold a node on the line between two others";

}  // namespace

void InpEquations::add(const InpCard& card) {
  if (card.lines.empty()) throw InputError(card.place, "*EQUATION has no lines");
  for (std::size_t i = 0; i < card.lines.size();) {
    const InpLine& head = card.lines[i];
    const int count = card.integer(head, 0);
    if (count != kTerms || head.fields.size() != 1)
      throw InputError(card.at(head), fmt::format("an equation of {} terms, {}", count, kExpected));
    std::vector<Term> terms;
    for (++i; i < card.lines.size() && static_cast<int>(terms.size()) < count; ++i) {
      const InpLine& line = card.lines[i];
      if (line.fields.size() % 3 != 0)
        throw InputError(card.at(line),
                         fmt::format("{} fields, expected node, direction and factor of each term",
                                     line.fields.size()));
      for (std::size_t k = 0; k < line.fields.size(); k += 3)
        terms.push_back(
            {card.integer(line, k), card.integer(line, k + 1), card.number(line, k + 2)});
    }
    if (static_cast<int>(terms.size()) != count)
      throw InputError(card.at(head), fmt::format("{} terms, expected {}", terms.size(), count));
    add_equation(terms, card.at(head));
  }
}

void InpEquations::add_equation(const std::vector<Term>& terms, const Place& place) {
  const auto refuse = [&](const std::string& what) {
    throw InputError(place, fmt::format("the equation {}; {}", what, kExpected));
  };
  const Term &tied = terms[0], &lower = terms[1], &upper = terms[2];
  if (tied.direction < 1 || tied.direction > 3)
    refuse(fmt::format("is of direction {}", tied.direction));
  if (lower.direction != tied.direction || upper.direction != tied.direction)
    refuse("mixes directions");
  if (tied.node == lower.node || tied.node == upper.node || lower.node == upper.node)
    refuse("uses a node twice");
  if (tied.factor == 0.0) refuse("has the factor 0 at its first node");
  const double at = -upper.factor / tied.factor, rest = -lower.factor / tied.factor;
  if (std::abs(at + rest - 1.0) > kSameWeight)
    refuse(fmt::format("has weights {:.7g} and {:.7g}, which do not add up to 1", rest, at));
  if (at < 0.0 || at > 1.0) refuse(fmt::format("has the weight {:.7g}", at));
  const auto [found, first] =
      known_.try_emplace(tied.node, Known{{lower.node, upper.node, at, place}, {}});
  const InpTie& tie = found->second.tie;
  if (!first &&
      (tie.lower != lower.node || tie.upper != upper.node || std::abs(tie.at - at) > kSameWeight))
    refuse(fmt::format("ties node {} to other nodes than line {}", tied.node, tie.place.line));
  bool& known = found->second.directions[static_cast<std::size_t>(tied.direction - 1)];
  if (known) refuse(fmt::format("ties node {} twice", tied.node));
  known = true;
}

std::map<int, InpTie> InpEquations::ties(const std::map<int, Eigen::Vector3d>& nodes) const {
  std::map<int, InpTie> ties;
  for (const auto& [number, known] : known_) {
    const InpTie& tie = known.tie;
    if (!(known.directions[0] && known.directions[1] && known.directions[2]))
      throw InputError(
          tie.place,
          fmt::format("node {} is tied in some directions only, expected all three", number));
    for (const int node : {number, tie.lower, tie.upper})
      if (!nodes.count(node))
        throw InputError(tie.place, fmt::format("node {} is not defined", node));
    for (const int node : {tie.lower, tie.upper})
      if (known_.count(node))
        throw InputError(
            tie.place,
            fmt::format("node {} is tied to node {}, which is tied itself", number, node));
    const Eigen::Vector3d &a = nodes.at(tie.lower), &b = nodes.at(tie.upper);
    if ((nodes.at(number) - a - tie.at * (b - a)).norm() > kOnTheLine * (b - a).norm())
      throw InputError(tie.place,
                       fmt::format("node {} does not lie at the position that its weights give "
                                   "between nodes "
                                   "{} and {}",
                                   number,
                                   tie.lower,
                                   tie.upper));
    ties.emplace(number, tie);
  }
  return ties;
}

}  // namespace latsch::formats
