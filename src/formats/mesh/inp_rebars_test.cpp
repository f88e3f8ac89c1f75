// SPDX-License-Identifier: Apache-2.0
#include "formats/mesh/inp_rebars.h"

#include <gtest/gtest.h>

#include "formats/mesh/inp_tire.h"
#include "formats/mesh/rebar_deck_testing.h"
#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/description/reference_tires.h"

namespace latsch::formats {
namespace {

using namespace fe_tire;

struct RebarTire {
  Mesh mesh;
  Materials materials;
};

/// Returns tire B on a coarse mesh with its plies as rebars, limited to the properties that rebars
/// in Abaqus have.
RebarTire rebar_tire() {
  TireDescription tire = reference_tire_b();
  tire.section.meridional = 9;
  tire.section.sectors = 12;
  tire.cord_model = CordModel::rebar;
  RebarTire result{build_mesh(tire), build_materials(tire)};
  for (CordLayer& layer : result.materials.layers) {
    layer.E_compression = layer.angle == 0.0 ? 0.0 : layer.E_tension;
    layer.pretension = 0.0;
    layer.density = 1390.0;
  }
  return result;
}

std::string deck_of(const RebarTire& tire) {
  CcxRun run;
  run.pressure = 2.6e5;
  return rebar_deck(tire.mesh, tire.materials, run);
}

/// Compares the depth and the cord properties of every layer of two elements, whatever the
/// numbering of the layers.
void expect_same_cords(const Element& a,
                       const Materials& ma,
                       const Element& b,
                       const Materials& mb) {
  ASSERT_EQ(a.rebars.size(), b.rebars.size());
  for (const RebarPlacement& one : a.rebars) {
    const CordLayer& x = ma.layers[static_cast<std::size_t>(one.layer)];
    int found = 0;
    for (const RebarPlacement& other : b.rebars) {
      const CordLayer& y = mb.layers[static_cast<std::size_t>(other.layer)];
      found += std::abs(one.zeta - other.zeta) < 1e-8 && std::abs(x.angle - y.angle) < 1e-12 &&
               std::abs(x.thickness - y.thickness) < 1e-12 * x.thickness &&
               std::abs(x.E_tension - y.E_tension) < 1e-9 * x.E_tension &&
               std::abs(x.E_compression - y.E_compression) < 1e-9 * x.E_tension &&
               std::abs(x.density - y.density) < 1e-9 * x.density;
    }
    EXPECT_EQ(found, 1);
  }
}

TEST(InpRebars, EmbeddedSurfacesWithRebarLayersAreTheCordsOfTheTire) {
  const RebarTire tire = rebar_tire();
  const InpTire deck = tire_from(parse_inp(deck_of(tire), "rebars.inp"));
  ASSERT_EQ(deck.mesh.sectors, tire.mesh.sectors);
  ASSERT_EQ(deck.mesh.elements.size(), tire.mesh.elements.size());
  std::size_t placed = 0;
  for (std::size_t e = 0; e < tire.mesh.elements.size(); ++e) {
    placed += tire.mesh.elements[e].rebars.size();
    expect_same_cords(tire.mesh.elements[e], tire.materials, deck.mesh.elements[e], deck.materials);
  }
  EXPECT_GT(placed, 9u);
  FeTire ours(tire.mesh, tire.materials, {.element = ElementKind::full_integration});
  FeTire theirs(deck.mesh, deck.materials, {.element = deck.element});
  const auto a = ours.inflate(2.6e5), b = theirs.inflate(2.6e5);
  ASSERT_TRUE(a && b);
  EXPECT_NEAR(a->growth, b->growth, 1e-7 * a->growth);  // the deck has twelve digits
}

TEST(InpRebars, AreaSpacingAngleAndModulusAreNumbersOfTheFile) {
  const InpDeck before = parse_inp(deck_of(rebar_tire()), "rebars.inp");
  const InpTire tire = tire_from(before);
  InpDeck deck = before;
  const auto set = [&](const std::string& path, double factor) {
    for (InpNumber& number : deck.numbers)
      if (number.path == path) {
        number.value *= factor;
        return true;
      }
    return false;
  };
  ASSERT_TRUE(set("layer.PLY0.area", 2.0));
  ASSERT_TRUE(set("layer.PLY0.spacing", 4.0));
  ASSERT_TRUE(set("layer.PLY0.angle", 0.5));
  ASSERT_TRUE(set("material.CORD0.E", 3.0));
  const Materials changed = materials_of(tire, deck);
  const auto of_ply = [&](const Materials& materials) {
    for (std::size_t i = 0; i < tire.layers.size(); ++i)
      if (before.rebars[static_cast<std::size_t>(tire.layers[i].rebars)].name == "PLY0")
        return materials.layers[i];
    return CordLayer{};
  };
  const CordLayer a = of_ply(tire.materials), b = of_ply(changed);
  ASSERT_GT(a.thickness, 0.0);
  EXPECT_DOUBLE_EQ(b.thickness, 0.5 * a.thickness);
  EXPECT_DOUBLE_EQ(b.angle, 0.5 * a.angle);
  EXPECT_DOUBLE_EQ(b.E_tension, 3.0 * a.E_tension);
}

TEST(InpRebars, WhatALayerCannotBeIsRefused) {
  const std::string deck = deck_of(rebar_tire());
  const auto complaint = [&](const std::string& from, const std::string& to) {
    std::string text = deck;
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
    try {
      tire_from(parse_inp(text, "bad.inp"));
    } catch (const InputError& error) {
      EXPECT_GT(error.place().line, 0) << error.what();
      return std::string(error.what());
    }
    return std::string("nothing");
  };
  const auto says = [](const std::string& text, const char* part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  says(complaint("*REBAR LAYER,ORIENTATION=WHEEL", "*REBAR LAYER"), "cylindrical");
  says(complaint("*REBAR LAYER,", "*REBAR LAYER,GEOMETRY=ANGULAR,"), "expected CONSTANT");
  says(complaint("*EMBEDDED ELEMENT,HOST ELSET=TIRE\nLAYER0\n", ""), "*EMBEDDED ELEMENT");
  says(complaint("*EMBEDDED ELEMENT,HOST ELSET=TIRE", "*EMBEDDED ELEMENT,HOST ELSET=GONE"),
       "\"GONE\" is not defined");
  says(complaint("*REBAR LAYER,ORIENTATION=WHEEL\nPLY0,", "*REBAR LAYER,ORIENTATION=WHEEL\nPLY0,-"),
       "expected more than 0");
  // Displace one node of the surface element sideways.
  const std::string node = deck.substr(deck.find("\n1000000,"), 12);
  says(complaint(node, "\n1000000,9"), "from side to side");
}

}  // namespace
}  // namespace latsch::formats
