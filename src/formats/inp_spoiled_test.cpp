// SPDX-License-Identifier: Apache-2.0
// Spoiled decks end in a deck, a tire or an InputError, never otherwise, and never slowly.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <random>
#include <sstream>

#include "formats/ccx_deck.h"
#include "formats/inp_tire.h"
#include "models/fe_tire/reference_tires.h"

namespace latsch::formats {
namespace {

std::string small_deck() {
  fe_tire::TireDescription tire = fe_tire::reference_tire_b();
  tire.section.meridional = 5;
  tire.section.sectors = 8;
  std::ostringstream out;
  CcxRun run;
  run.pressure = 2.6e5;
  run.ground = CcxGround{0.32, 0.025, 2e10, 0.5};
  write_ccx_deck(out, build_mesh(tire), build_materials(tire), run);
  return out.str();
}

void read(const std::string& text) {
  try {
    tire_from(parse_inp(text, "spoiled.inp"));
  } catch (const InputError&) {
  }
}

TEST(InpSpoiled, BytesChangedLinesMovedOrCutAway) {
  const std::string deck = small_deck();
  std::mt19937 random(1);  // the same spoiled decks in every run
  const auto below = [&](std::size_t n) {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
  };
  static constexpr char kBytes[] = "*,=-+.0123456789eEnaif \n\t\"\0\x80";
  for (int i = 0; i < 3000; ++i) {
    std::string text = deck;
    for (std::size_t spoil = 1 + below(4); spoil > 0; --spoil) {
      const std::size_t at = below(text.size());
      switch (below(4)) {
        case 0:
          text[at] = kBytes[below(sizeof kBytes - 1)];
          break;
        case 1:
          text.erase(at, below(200));
          break;
        case 2:
          text.insert(at, text.substr(below(text.size()), below(100)));
          break;
        default:
          text.resize(at + 1);
      }
    }
    read(text);
  }
}

TEST(InpSpoiled, OptionsAndNumbersThatExplode) {
  read("*NSET,NSET=A,GENERATE\n1,2147483647,1\n");
  read("*NODE\n-2147483649,0,0,0\n");
  read("*NODE\n1,1e309,0,0\n");
  read("*ELEMENT\n");
  read("*ELSET,ELSET=A\nA,A,A,A\n");
  std::string doubling = "*NODE,NSET=S0\n1,0,0,0\n";
  for (int i = 1; i < 64; ++i) {
    doubling += fmt::format("*NSET,NSET=S{}\nS{},S{}\n", i, i - 1, i - 1);
  }
  EXPECT_THROW(parse_inp(doubling, "doubling.inp"), InputError);
  EXPECT_THROW(parse_inp(std::string(10000, '*'), "stars.inp"), InputError);
}

}  // namespace
}  // namespace latsch::formats
