// SPDX-License-Identifier: Apache-2.0
#include "formats/deck/inp_equations.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace latsch::formats {
namespace {

constexpr double kSameWeight = 1e-6;  // tolerance of weights; decks have seven digits or more
constexpr double kOnTheLine = 1e-4;   // tolerance as a share of the length of the line
constexpr int kTermsOfTie = 3, kMostTerms = 9;

constexpr const char* kExpected =
    "expected three terms that hold a node on the line between two others, or four to nine that "
    "hold it at a mean of others";

}  // namespace

void InpEquations::add(const InpCard& card) {
  if (card.lines.empty()) throw InputError(card.place, "*EQUATION has no lines");
  for (std::size_t i = 0; i < card.lines.size();) {
    const InpLine& head = card.lines[i];
    const int count = card.integer(head, 0);
    if (count < kTermsOfTie || count > kMostTerms || head.fields.size() != 1)
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
    count == kTermsOfTie ? add_tie(terms, card.at(head)) : add_mean(terms, card.at(head));
  }
}

void InpEquations::add_tie(const std::vector<Term>& terms, const Place& place) {
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

void InpEquations::add_mean(const std::vector<Term>& terms, const Place& place) {
  const auto refuse = [&](const std::string& what) {
    throw InputError(place, fmt::format("the equation {}; {}", what, kExpected));
  };
  const Term& own = terms.front();
  if (own.direction < 1 || own.direction > 3)
    refuse(fmt::format("is of direction {}", own.direction));
  if (own.factor == 0.0) refuse("has the factor 0 at its first node");
  InpMean mean{{}, place};
  double sum = 0.0;
  for (std::size_t k = 1; k < terms.size(); ++k) {
    if (terms[k].direction != own.direction) refuse("mixes directions");
    const double weight = -terms[k].factor / own.factor;
    if (terms[k].node == own.node || !mean.weights.emplace(terms[k].node, weight).second)
      refuse("uses a node twice");
    sum += weight;
  }
  if (std::abs(sum - 1.0) > kSameWeight)
    refuse(fmt::format("has weights that add up to {:.7g}, not to 1", sum));
  const auto [found, first] = means_.try_emplace(own.node, KnownMean{mean, {}});
  const InpMean& known = found->second.mean;
  if (!first) {
    bool same = known.weights.size() == mean.weights.size();
    for (const auto& [node, weight] : mean.weights) {
      const auto other = known.weights.find(node);
      same = same && other != known.weights.end() && std::abs(other->second - weight) < kSameWeight;
    }
    if (!same)
      refuse(fmt::format("holds node {} at another mean than line {}", own.node, known.place.line));
  }
  bool& given = found->second.directions[static_cast<std::size_t>(own.direction - 1)];
  if (given) refuse(fmt::format("holds node {} twice", own.node));
  given = true;
}

std::map<int, InpMean> InpEquations::means(const std::map<int, Eigen::Vector3d>& nodes) const {
  std::map<int, InpMean> means;
  for (const auto& [number, known] : means_) {
    const InpMean& mean = known.mean;
    const auto refuse = [&](const std::string& what) { throw InputError(mean.place, what); };
    if (!(known.directions[0] && known.directions[1] && known.directions[2]))
      refuse(fmt::format("node {} is held in some directions only, expected all three", number));
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
    double size = 0.0;
    for (const auto& [node, weight] : mean.weights) {
      if (!nodes.count(node)) refuse(fmt::format("node {} is not defined", node));
      if (known_.count(node) || means_.count(node))
        refuse(fmt::format("node {} is held at node {}, which is tied itself", number, node));
      place += weight * nodes.at(node);
      size = std::max(size, (nodes.at(node) - nodes.at(mean.weights.begin()->first)).norm());
    }
    if (!nodes.count(number)) refuse(fmt::format("node {} is not defined", number));
    if ((nodes.at(number) - place).norm() > kOnTheLine * size)
      refuse(fmt::format("node {} does not lie at the position that its weights give", number));
    means.emplace(number, mean);
  }
  return means;
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
