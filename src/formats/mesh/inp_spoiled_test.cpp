// SPDX-License-Identifier: Apache-2.0
// Spoiled decks end in a deck, a tire or an InputError, never otherwise, and never slowly.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <sstream>

#include "base/spoiled_text_testing.h"
#include "formats/mesh/ccx_deck.h"
#include "formats/mesh/inp_tire.h"
#include "models/fe_tire/description/reference_tires.h"

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

/// Whether it is a tire all the same.
bool read(const std::string& text) {
  try {
    tire_from(parse_inp(text, "spoiled.inp"));
    return true;
  } catch (const InputError&) {
    return false;
  }
}

TEST(InpSpoiled, BytesChangedLinesMovedOrCutAway) {
  const std::string deck = small_deck();
  constexpr int kDecks = 3000;
  int tires = 0;
  for (int i = 0; i < kDecks; ++i) {
    RandomStream random(1, i);
    tires +=
        read(spoiled(deck, {"*", ",", "*NSET", "*ELEMENT,TYPE=C3D8\n", "1e309", "-1"}, random));
  }
  EXPECT_GT(tires, 0);       // some changes do no harm
  EXPECT_LT(tires, kDecks);  // most do
}

TEST(InpSpoiled, OptionsAndNumbersThatExplode) {
  EXPECT_FALSE(read("*NSET,NSET=A,GENERATE\n1,2147483647,1\n"));
  EXPECT_FALSE(read("*NODE\n-2147483649,0,0,0\n"));
  EXPECT_FALSE(read("*NODE\n1,1e309,0,0\n"));
  EXPECT_FALSE(read("*ELEMENT\n"));
  EXPECT_FALSE(read("*ELSET,ELSET=A\nA,A,A,A\n"));
  std::string doubling = "*NODE,NSET=S0\n1,0,0,0\n";
  for (int i = 1; i < 64; ++i) {
    doubling += fmt::format("*NSET,NSET=S{}\nS{},S{}\n", i, i - 1, i - 1);
  }
  EXPECT_THROW(parse_inp(doubling, "doubling.inp"), InputError);
  EXPECT_THROW(parse_inp(std::string(10000, '*'), "stars.inp"), InputError);
}

}  // namespace
}  // namespace latsch::formats
