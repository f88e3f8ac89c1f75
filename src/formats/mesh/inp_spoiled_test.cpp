// SPDX-License-Identifier: Apache-2.0
// Reading a damaged deck must give a deck, a tire or an InputError, nothing else, and never take
// long.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <sstream>

#include "base/spoiled_text_testing.h"
#include "formats/mesh/ccx_deck.h"
#include "formats/mesh/inp_tire.h"
#include "formats/mesh/rebar_deck_testing.h"
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

/// Returns the small deck with its cords as layers of rebars in embedded surface elements.
std::string rebar_deck() {
  fe_tire::TireDescription tire = fe_tire::reference_tire_b();
  tire.section.meridional = 5;
  tire.section.sectors = 4;
  tire.cord_model = fe_tire::CordModel::rebar;
  fe_tire::Materials materials = build_materials(tire);
  for (fe_tire::CordLayer& layer : materials.layers) layer.density = 1390.0;
  CcxRun run;
  run.pressure = 2.6e5;
  return rebar_deck(build_mesh(tire), materials, run);
}

/// True if the text is still a tire. Checks that writing it back without changes gives the same
/// text.
bool read(const std::string& text) {
  try {
    const InpDeck deck = parse_inp(text, "spoiled.inp");
    EXPECT_EQ(with_numbers_of(deck, text), text);
    tire_from(deck);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

void spoil(const std::string& deck, int decks) {
  const std::vector<std::string> pieces = {"*",
                                           ",",
                                           "*NSET",
                                           "*ELEMENT,TYPE=C3D8\n",
                                           "*ELEMENT,TYPE=SFM3D4\n",
                                           "*REBAR LAYER\n",
                                           "*NO COMPRESSION\n",
                                           "** units: mm, N\n",
                                           "1e309",
                                           "-1"};
  EXPECT_TRUE(read(deck));
  int tires = 0;
  for (int i = 0; i < decks; ++i) {
    RandomStream random(1, i);
    tires += read(spoiled(deck, pieces, random));
  }
  EXPECT_GT(tires, 0);      // some changes leave a valid tire
  EXPECT_LT(tires, decks);  // most do
}

TEST(InpSpoiled, BytesChangedLinesMovedOrCutAway) { spoil(small_deck(), 2000); }

TEST(InpSpoiled, TheSameOfLayersOfRebars) { spoil(rebar_deck(), 1000); }

// A deck that ends before its steps is no tire, because every card of the model is needed.
TEST(InpSpoiled, ATruncatedDeckIsNoTire) {
  for (const std::string& deck : {small_deck(), rebar_deck()}) {
    const std::size_t steps = deck.find("*STEP");
    for (std::size_t i = 0; i < 200; ++i) EXPECT_FALSE(read(deck.substr(0, steps * i / 200)));
    EXPECT_FALSE(read(deck.substr(0, deck.find("*END STEP"))));
  }
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
