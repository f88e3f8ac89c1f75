// SPDX-License-Identifier: Apache-2.0
#include "formats/deck/inp_springs.h"

#include <fmt/format.h>

namespace latsch::formats {

void InpSprings::add_elements(const InpCard& card) {
  const bool is_mass = card.option("TYPE") == "MASS";
  const std::size_t fields = is_mass ? 2 : 3;
  for (const InpLine& line : card.lines) {
    if (line.fields.size() != fields)
      throw InputError(card.at(line),
                       fmt::format("{} fields, expected the number of the element and {}",
                                   line.fields.size(),
                                   is_mass ? "a node" : "two nodes"));
    const int number = card.integer(line, 0), node = card.integer(line, 1);
    if (is_mass) {
      masses_.push_back({card.option("ELSET"), node, card.at(line)});
    } else {
      const InpSpring spring{number, {node, card.integer(line, 2)}, {}, card.at(line)};
      springs_.push_back({card.option("ELSET"), spring});
    }
  }
}

void InpSprings::add_law(const InpCard& card) {
  if (!card.has("NONLINEAR"))
    throw InputError(card.place,
                     "this *SPRING is linear, expected NONLINEAR: the law of a cord, as latsch "
                     "export --ccx writes it");
  std::vector<InpSpring::Point> points;
  for (const InpLine& line : card.lines) {
    points.push_back({card.number(line, 0), card.number(line, 1)});
    if (points.size() > 1 && !(points.back().elongation > (points.end() - 2)->elongation))
      throw InputError(card.at(line), "the elongation does not rise from line to line");
  }
  if (points.size() < 4)
    throw InputError(card.place,
                     fmt::format("*SPRING has {} points of force and elongation, expected four or "
                                 "more",
                                 points.size()));
  laws_[card.option("ELSET")] = std::move(points);
}

void InpSprings::add_mass(const InpCard& card) {
  if (card.lines.size() != 1)
    throw InputError(card.place,
                     fmt::format("*MASS has {} lines, expected one", card.lines.size()));
  const double mass = card.number(card.lines[0], 0);
  if (!(mass > 0.0))
    throw InputError(card.at(card.lines[0]), fmt::format("mass {}, expected more than 0", mass));
  mass_of_[card.option("ELSET")] = mass;
}

void InpSprings::put(InpDeck& deck) const {
  const auto expect_node = [&](int node, const Place& place) {
    if (!deck.nodes.count(node))
      throw InputError(place, fmt::format("node {} is not defined", node));
  };
  for (const auto& [elset, spring] : springs_) {
    for (const int node : spring.node) expect_node(node, spring.place);
    const auto law = laws_.find(elset);
    if (law == laws_.end())
      throw InputError(
          spring.place,
          fmt::format("spring {} has no *SPRING of its ELSET {}", spring.number, elset));
    deck.springs.push_back(spring);
    deck.springs.back().law = law->second;
  }
  for (const Mass& mass : masses_) {
    expect_node(mass.node, mass.place);
    const auto found = mass_of_.find(mass.elset);
    if (found == mass_of_.end())
      throw InputError(mass.place, fmt::format("there is no *MASS of the ELSET {}", mass.elset));
    deck.masses[mass.node] += found->second;
  }
}

}  // namespace latsch::formats
