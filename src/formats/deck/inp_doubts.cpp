// SPDX-License-Identifier: Apache-2.0
#include "formats/deck/inp_doubts.h"

#include <fmt/format.h>

#include <set>

namespace latsch::formats {
namespace {

void doubt_pressures(const InpDeck& deck, std::vector<LedgerDoubt>& doubts) {
  std::set<int> told;  // without repetition, because a surface of several sets has one line
  for (const InpStep& step : deck.steps)
    for (const InpPressure& pressure : step.pressures) {
      if (!(pressure.value < 0.0) || !told.insert(pressure.where.line).second) continue;
      doubts.push_back({"*DLOAD",
                        fmt::format("the pressure is {:g}: a negative pressure pulls at the inner "
                                    "faces, while one that inflates the tire is positive",
                                    pressure.value),
                        Place{deck.file, pressure.where.line}});
    }
}

/// Adds a doubt for elements that belong to two sections: only the last section would count.
void doubt_sections(const InpDeck& deck, std::vector<LedgerDoubt>& doubts) {
  std::map<int, const InpSection*> section_of;
  for (const InpSection& section : deck.sections) {
    const auto elements = deck.element_sets.find(section.elset);
    if (elements == deck.element_sets.end()) continue;
    const InpSection* before = nullptr;
    int count = 0;
    for (const int element : elements->second) {
      const InpSection*& of = section_of[element];
      const bool differs =
          of && of != &section &&
          (of->material != section.material || of->orientation != section.orientation);
      if (differs && ++count == 1) before = of;
      of = &section;
    }
    if (!before) continue;
    doubts.push_back(
        {"*SOLID SECTION",
         fmt::format("{} elements of {} are in the *SOLID SECTION of line {}, too: here they have "
                     "the material {} of the last one, not {}",
                     count,
                     section.elset,
                     before->place.line,
                     section.material,
                     before->material),
         section.place});
  }
}

}  // namespace

std::vector<LedgerDoubt> doubts_of_deck(const InpDeck& deck) {
  std::vector<LedgerDoubt> doubts;
  doubt_sections(deck, doubts);
  doubt_pressures(deck, doubts);
  return doubts;
}

}  // namespace latsch::formats
