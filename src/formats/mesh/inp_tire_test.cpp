// SPDX-License-Identifier: Apache-2.0
#include "formats/mesh/inp_tire.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "formats/deck/inp_doubts.h"
#include "formats/mesh/ccx_deck.h"
#include "formats/mesh/inp_materials.h"
#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/description/reference_tires.h"

namespace latsch::formats {
namespace {

using namespace fe_tire;

const std::filesystem::path kDecks = LATSCH_SOURCE_DIR "/../shared/data/ccx";

TireDescription small_tire() {
  TireDescription tire = reference_tire_b();
  tire.section.meridional = 9;
  tire.section.sectors = 12;
  return tire;
}

std::string deck_of(const TireDescription& tire) {
  std::ostringstream out;
  CcxRun run;
  run.title = tire.name;
  run.pressure = 2.6e5;
  run.ground = CcxGround{0.32, 0.025, 2e10, 0.5};
  write_ccx_deck(out, build_mesh(tire), build_materials(tire), run);
  return out.str();
}

/// Returns the doubts about a deck, one in each line.
std::string deck_doubts(const std::string& text) {
  std::string all;
  for (const LedgerDoubt& doubt : doubts_of_deck(parse_inp(text, "tire.inp")))
    all += doubt.place.text() + " " + doubt.name + " " + doubt.sentence + "\n";
  return all;
}

int line_of(const std::string& text, std::size_t at) {
  return 1 + static_cast<int>(std::count(text.begin(), text.begin() + static_cast<long>(at), '\n'));
}

TEST(InpDoubts, ANegativePressureAndASecondSectionAreTold) {
  const std::string good = deck_of(small_tire());
  EXPECT_EQ(deck_doubts(good), "");
  std::string negative = good;
  const std::size_t pressure = negative.find("INNER,P1,");
  ASSERT_NE(pressure, negative.npos);
  negative.insert(pressure + 9, "-");
  EXPECT_EQ(
      deck_doubts(negative),
      "tire.inp:" + std::to_string(line_of(negative, pressure)) +
          " *DLOAD the pressure is -0.26: a negative pressure pulls at the inner faces, while "
          "one that inflates the tire is positive\n");
  std::string twice = good;
  const std::size_t section = twice.find("*SOLID SECTION,ELSET=SOLID0,");
  const std::size_t end = twice.find('\n', twice.find("*SOLID SECTION,ELSET=GROUNDBLOCK,")) + 1;
  twice.insert(end, "*SOLID SECTION,ELSET=SOLID0,MATERIAL=RIGID\n");
  const std::string said = deck_doubts(twice);
  EXPECT_EQ(said.find("tire.inp:" + std::to_string(line_of(twice, end)) + " *SOLID SECTION "), 0u)
      << said;
  EXPECT_NE(said.find("elements of SOLID0 are in the *SOLID SECTION of line " +
                      std::to_string(line_of(twice, section)) +
                      ", too: here they have the material RIGID of the last one, not SOLID0"),
            std::string::npos)
      << said;
  // Repeating a section without a change has no effect.
  std::string same = good;
  same.insert(end, good.substr(section, good.find('\n', section) + 1 - section));
  EXPECT_EQ(deck_doubts(same), "");
}

void expect_same(const Mesh& a, const Mesh& b, double tolerance) {
  ASSERT_EQ(a.sectors, b.sectors);
  ASSERT_EQ(a.X.cols(), b.X.cols());
  EXPECT_LT((a.X - b.X).cwiseAbs().maxCoeff(), tolerance);
  ASSERT_EQ(a.elements.size(), b.elements.size());
  for (std::size_t e = 0; e < a.elements.size(); ++e) {
    EXPECT_EQ(a.elements[e].node, b.elements[e].node);
    EXPECT_EQ(a.elements[e].inner, b.elements[e].inner);
    EXPECT_EQ(a.elements[e].tread, b.elements[e].tread);
  }
  EXPECT_EQ(a.clamped, b.clamped);
}

void expect_same_solids(const Mesh& a, const Materials& ma, const Mesh& b, const Materials& mb) {
  for (std::size_t e = 0; e < a.elements.size(); ++e) {
    const Solid &x = ma.solids[a.elements[e].solid], &y = mb.solids[b.elements[e].solid];
    EXPECT_NEAR(x.density, y.density, 1e-6 * y.density);
    ASSERT_EQ(x.law.index(), y.law.index());
    if (const auto* law = std::get_if<StVenantKirchhoff>(&x.law)) {
      const Matrix6& D = std::get<StVenantKirchhoff>(y.law).D;
      EXPECT_LT((law->D - D).cwiseAbs().maxCoeff(), 1e-6 * D.cwiseAbs().maxCoeff());
    } else {
      EXPECT_NEAR(std::get<Hyperelastic>(x.law).C10, std::get<Hyperelastic>(y.law).C10, 1.0);
      EXPECT_NEAR(std::get<Hyperelastic>(x.law).K, std::get<Hyperelastic>(y.law).K, 1.0);
    }
  }
}

// An independent generator wrote the deck, with nine digits.
TEST(InpTire, TheDeckOfTireBIsOneSectorOfTheSameTire) {
  if (!std::filesystem::exists(kDecks)) GTEST_SKIP() << "no decks in " << kDecks;
  const InpTire deck = read_inp_tire(kDecks / "tire_b_loaded.inp");
  const TireDescription tire = reference_tire_b();
  expect_same(deck.mesh, build_mesh(tire), 1e-9);
  expect_same_solids(deck.mesh, deck.materials, build_mesh(tire), build_materials(tire));
  EXPECT_EQ(deck.mesh.free_dofs(), 15480);
  EXPECT_DOUBLE_EQ(deck.pressure, 2.6e5);
  EXPECT_EQ(deck.modes, 20);
  ASSERT_TRUE(deck.ground);
  EXPECT_NEAR(deck.ground->radius, 0.319816346, 1e-12);
  EXPECT_NEAR(deck.ground->travel, 0.025, 1e-15);
  EXPECT_NEAR(deck.ground->stiffness, 2e10, 1.0);
  EXPECT_EQ(deck.ground->mu, 0.0);
}

TEST(InpTire, WhatTheDeckWriterWritesComesBack) {
  const TireDescription tire = small_tire();
  const InpTire deck = tire_from(parse_inp(deck_of(tire), "small.inp"));
  expect_same(deck.mesh, build_mesh(tire), 1e-12);
  expect_same_solids(deck.mesh, deck.materials, build_mesh(tire), build_materials(tire));
  ASSERT_TRUE(deck.ground);
  EXPECT_NEAR(deck.ground->radius, 0.32, 1e-12);
  EXPECT_NEAR(deck.ground->travel, 0.025, 1e-12);
  EXPECT_EQ(deck.ground->mu, 0.5);
  EXPECT_EQ(deck.mesh.sensors.size(), 5u);
}

/// Returns a tire whose rows of elements end in the sidewall: corners of the many rows lie on the
/// edges of the few.
TireDescription tied_tire() {
  TireDescription tire = small_tire();
  tire.section.faces = {{{0.0}, {-0.6e-3}}, {{0.0}, {0.6e-3}}, {{0.0}, {1.7e-3}}};
  tire.section.faces_to = 0.46;
  return tire;
}

TEST(InpTire, CornersTiedByEquationsComeBackAsEdgeTiesWithTheSameResults) {
  const TireDescription tire = tied_tire();
  const Mesh written = build_mesh(tire);
  const InpTire read = tire_from(parse_inp(deck_of(tire), "deck"));
  const auto ties = [](const Mesh& mesh) {
    int count = 0;
    for (const Element& element : mesh.elements) count += element.tie.eta != 0 ? 1 : 0;
    return count;
  };
  ASSERT_GT(ties(written), 0);
  EXPECT_EQ(ties(read.mesh), ties(written));
  expect_same(read.mesh, written, 1e-12);
  for (std::size_t e = 0; e < written.elements.size(); ++e) {
    EXPECT_EQ(read.mesh.elements[e].tie.eta, written.elements[e].tie.eta);
    EXPECT_NEAR(read.mesh.elements[e].tie.lower, written.elements[e].tie.lower, 1e-11);
    EXPECT_NEAR(read.mesh.elements[e].tie.upper, written.elements[e].tie.upper, 1e-11);
  }
  // Returns the growth and the force on the ground, computed with the element type of the deck.
  const auto results = [](const Mesh& mesh, const Materials& materials) {
    fe_tire::FeTire pressed(mesh, materials, {.element = fe_tire::ElementKind::full_integration});
    const auto inflated = pressed.inflate(2.6e5);
    EXPECT_TRUE(inflated);
    const auto states = pressed.press(*inflated, {}, {0.012});
    EXPECT_TRUE(states);
    return std::pair{inflated->growth, pressed.stand(states->back()).force.z()};
  };
  const auto [growth, force] = results(written, build_materials(tire));
  const auto [growth_read, force_read] = results(read.mesh, read.materials);
  EXPECT_NEAR(growth_read / growth, 1.0, 1e-8);
  EXPECT_NEAR(force_read / force, 1.0, 1e-7);
}

/// Returns a tire with its cords as rebars: a radial carcass that is soft in compression, crossed
/// belts, and rows of elements that end.
TireDescription corded_tire() {
  TireDescription tire = tied_tire();
  tire.element = ElementKind::solid_shell;
  tire.cord_model = CordModel::rebar;
  for (CordPly& ply : tire.plies) ply.cords.E_compression = 0.2 * ply.cords.E_tension;
  return tire;
}

std::string corded_deck(const TireDescription& tire, const Materials& materials) {
  std::ostringstream out;
  CcxRun run;
  run.pressure = 2.6e5;
  run.element = tire.element;
  run.ground = CcxGround{0.32, 0.025, 2e10, 0.5};
  write_ccx_deck(out, build_mesh(tire), materials, run);
  return out.str();
}

TEST(InpTire, CordsWrittenAsSpringsComeBackAsTheirLayers) {
  const TireDescription tire = corded_tire();
  Materials materials = build_materials(tire);
  materials.layers[0].pretension = 2e6;
  const Mesh written = build_mesh(tire);
  const InpTire read = tire_from(parse_inp(corded_deck(tire, materials), "cords.inp"));
  EXPECT_EQ(read.element, ElementKind::solid_shell);
  expect_same(read.mesh, written, 1e-12);
  const auto results = [](const Mesh& mesh, const Materials& of) {
    fe_tire::FeTire pressed(mesh, of, {});
    const auto inflated = pressed.inflate(2.6e5);
    EXPECT_TRUE(inflated);
    const auto modes = pressed.modes(*inflated, 3);
    const auto states = pressed.press(*inflated, {}, {0.012});
    EXPECT_TRUE(modes);
    EXPECT_TRUE(states);
    return std::array{inflated->growth,
                      (*modes)[0].frequency,
                      (*modes)[2].frequency,
                      pressed.stand(states->back()).force.z()};
  };
  const auto before = results(written, materials), after = results(read.mesh, read.materials);
  for (std::size_t i = 0; i < before.size(); ++i) EXPECT_NEAR(after[i] / before[i], 1.0, 1e-7) << i;
}

TEST(InpTire, ASpringThatIsNoCordIsRefusedWithItsLine) {
  const TireDescription tire = corded_tire();
  const std::string good = corded_deck(tire, build_materials(tire));
  const auto complaint = [&](std::string text) -> std::string {
    try {
      tire_from(parse_inp(text, "bad.inp"));
    } catch (const InputError& error) {
      EXPECT_GT(error.place().line, 0) << error.what();
      return error.what();
    }
    return "nothing";
  };
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    const std::size_t at = text.find(from);
    EXPECT_NE(at, text.npos) << from;
    return text.replace(at, from.size(), to);
  };
  EXPECT_NE(complaint(with(",NONLINEAR\n", "\n")).find("linear"), std::string::npos);
  EXPECT_NE(complaint(with("*SPRING,ELSET=CORDS0,", "*SPRING,ELSET=OTHER,")).find("no *SPRING"),
            std::string::npos);
  // The force of the spring jumps at one point of its force-elongation curve.
  const std::size_t law = good.find('\n', good.find("NONLINEAR\n\n") + 11) + 1;
  std::string jump = good;
  jump.insert(law + (good[law] == '-' ? 1 : 0), "9");
  EXPECT_NE(complaint(jump).find("is no cord"), std::string::npos) << complaint(jump);
}

TEST(InpTire, ElementsMayComeInAnyOfTheirTwentyFourNumberings) {
  const TireDescription tire = small_tire();
  InpDeck deck = parse_inp(deck_of(tire), "small.inp");
  // In every third element the axes are permuted evenly, and its loaded faces are renumbered
  // accordingly.
  static constexpr int kTurned[8] = {0, 3, 7, 4, 1, 2, 6, 5};  // new axes (eta, zeta, xi)
  // Numbers of the faces zeta = -1 and zeta = +1 after the permutation.
  static constexpr int kFace[7] = {0, 3, 5, 0, 0, 0, 0};
  const Mesh mesh = build_mesh(tire);
  InpDeck original = deck;
  for (auto& [number, element] : deck.elements)
    if (number % 3 == 0 && number <= mesh.element_count())
      for (int a = 0; a < 8; ++a) element.node[a] = original.elements.at(number).node[kTurned[a]];
  const auto split = [&](std::vector<InpFaces> faces) {
    std::vector<InpFaces> result;
    for (const InpFaces& face : faces)
      for (int number : face.elements) {
        const bool turned = number % 3 == 0 && number <= mesh.element_count();
        result.push_back({{number}, turned ? kFace[face.face] : face.face, face.place});
      }
    return result;
  };
  deck.surfaces["STREAD"] = split(deck.surfaces["STREAD"]);
  for (InpStep& step : deck.steps) {
    std::vector<InpPressure> pressures;
    for (const InpPressure& pressure : step.pressures)
      for (const InpFaces& face : split({pressure.faces}))
        pressures.push_back({face, pressure.value});
    step.pressures = pressures;
  }
  expect_same(tire_from(deck).mesh, mesh, 1e-12);
}

TEST(InpTire, AMeshWithOneOddNodeIsTakenWhole) {
  const TireDescription tire = small_tire();
  InpDeck deck = parse_inp(deck_of(tire), "small.inp");
  deck.nodes.at(100) *= 1.0005;
  const Mesh mesh = tire_from(deck).mesh;
  EXPECT_EQ(mesh.sectors, 1);
  EXPECT_EQ(mesh.element_count(), 9 * 2 * 12);
}

TEST(InpTire, EveryOtherSectorOfAnotherRubberHalvesTheNumberOfSectors) {
  const TireDescription tire = small_tire();
  InpDeck deck = parse_inp(deck_of(tire), "small.inp");
  InpMaterial stiff = deck.materials.at("SOLID0");
  stiff.name = "STIFF";
  InpNumber C10 = deck.numbers.at(stiff.constants[0]);
  C10.value *= 2.0;
  stiff.constants[0] = static_cast<int>(deck.numbers.size());
  deck.numbers.push_back(C10);
  deck.materials["STIFF"] = stiff;
  const int per_sector = 9 * 2;
  for (int s = 0; s < 12; s += 2) deck.element_sets["ODD"].push_back(s * per_sector + 2);
  deck.sections.push_back({"ODD", "STIFF", "", {}});
  const Mesh mesh = tire_from(deck).mesh;
  EXPECT_EQ(mesh.sectors, 6);
  EXPECT_EQ(mesh.elements.size(), 2u * per_sector);
}

TEST(InpTire, AHeldBodyWithoutContactIsNoPartOfTheTire) {
  const TireDescription tire = small_tire();
  InpDeck deck = parse_inp(deck_of(tire), "small.inp");
  deck.contacts.clear();
  const InpTire read = tire_from(deck);
  EXPECT_EQ(read.mesh.element_count(), build_mesh(tire).element_count());
  EXPECT_FALSE(read.ground);
  // Without a contact surface the tread consists of the faces that face outward: those of the
  // crown, not those of the sidewall.
  EXPECT_NEAR(read.mesh.outer_radius(), build_mesh(tire).outer_radius(), 1e-9);
  for (const Element& element : read.mesh.elements)
    EXPECT_TRUE(!element.tread || -read.mesh.coordinates(element).row(2).mean() > 0.28);
}

TEST(InpTire, UnitsAreThoseACommentStatesElseThoseOfTheSize) {
  const TireDescription tire = small_tire();
  std::string deck = deck_of(tire);
  EXPECT_TRUE(parse_inp(deck, "stated.inp").are_units_stated);
  const std::string statement = "** units: mm, N, tonne\n";
  ASSERT_NE(deck.find(statement), deck.npos);
  deck.erase(deck.find(statement), statement.size());
  EXPECT_EQ(parse_inp(deck, "mm.inp").units, InpUnits{});
  EXPECT_FALSE(parse_inp(deck, "mm.inp").are_units_stated);
  const InpTire meters = tire_from(parse_inp("** units: m, N, kg\n" + deck, "m.inp"));
  EXPECT_NEAR(meters.mesh.outer_radius(), 1e3 * build_mesh(tire).outer_radius(), 1e-9);
  EXPECT_DOUBLE_EQ(meters.pressure, 0.26);
  const InpTire kilo = tire_from(parse_inp("** UNITS: mm, kN, kg\n" + deck, "kN.inp"));
  EXPECT_NEAR(kilo.mesh.outer_radius(), build_mesh(tire).outer_radius(), 1e-12);
  EXPECT_DOUBLE_EQ(kilo.pressure, 0.26e9);
  EXPECT_THROW(parse_inp("** units: mm, kg, N\n" + deck, "wrong.inp"), InputError);
  EXPECT_THROW(parse_inp("** units: mm, N\n" + deck, "two.inp"), InputError);
  EXPECT_EQ(units_of_size(0.32), (InpUnits{1.0, 1.0, 1.0}));
  EXPECT_FALSE(units_of_size(13.0));  // inches are not recognized
}

/// Returns the error message for a deck in which every `from` is replaced by `to`.
std::string deck_complaint(const std::string& from, const std::string& to) {
  std::string text = deck_of(small_tire());
  EXPECT_NE(text.find(from), std::string::npos) << from;
  for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  try {
    tire_from(parse_inp(text, "bad.inp"));
  } catch (const InputError& error) {
    EXPECT_GT(error.place().line, 0) << error.what();
    return error.what();
  }
  return "nothing";
}

// The deck has 24 numbers: those of two rubbers, of one smeared composite, and the pressure.
TEST(InpTire, NumbersHaveTheNamesOfTheFile) {
  const InpDeck deck = parse_inp(deck_of(small_tire()), "small.inp");
  const auto find = [&](const std::string& path) -> const InpNumber* {
    for (const InpNumber& number : deck.numbers)
      if (number.path == path) return &number;
    return nullptr;
  };
  ASSERT_TRUE(find("pressure"));
  EXPECT_EQ(find("pressure")->value, 0.26);
  // The pressure occurs in the inflation step, in the load step and, halved for CalculiX, in the
  // frequency step.
  ASSERT_EQ(find("pressure")->where.size(), 3u);
  EXPECT_EQ(find("pressure")->where[2].times, 0.5);
  EXPECT_TRUE(find("material.SOLID0.density"));
  int laws = 0;
  for (const auto& [name, material] : deck.materials) {
    if (material.law == InpMaterial::Law::neo_hooke) {
      ++laws;
      EXPECT_TRUE(find("material." + name + ".C10"));
      EXPECT_TRUE(find("material." + name + ".D1"));
    }
    if (material.law == InpMaterial::Law::anisotropic) {
      ++laws;
      EXPECT_TRUE(find("material." + name + ".D1111"));
      EXPECT_TRUE(find("material." + name + ".D2323"));
    }
  }
  EXPECT_GE(laws, 2);
}

TEST(InpTire, WrittenBackOnlyChangedNumbersAreOther) {
  const std::string text = deck_of(small_tire());
  InpDeck deck = parse_inp(text, "small.inp");
  EXPECT_EQ(with_numbers_of(deck, text), text);
  deck.numbers[static_cast<std::size_t>(deck.pressure)].value = 0.3;
  InpNumber* C10 = nullptr;
  for (InpNumber& number : deck.numbers)
    if (number.path.ends_with(".C10")) C10 = &number;
  ASSERT_TRUE(C10);
  C10->value = 1.0 / 3.0;
  const std::string changed = with_numbers_of(deck, text);
  const InpDeck back = parse_inp(changed, "small.inp");
  for (std::size_t i = 0; i < deck.numbers.size(); ++i)
    EXPECT_DOUBLE_EQ(back.numbers[i].value, deck.numbers[i].value) << deck.numbers[i].path;
  EXPECT_EQ(back.steps.back().pressures[0].value, 0.15);
  std::istringstream a(text), b(changed);
  int other = 0;
  for (std::string one, two; std::getline(a, one) && std::getline(b, two);) other += one != two;
  EXPECT_EQ(other, 4);  // three fields hold the pressure
}

// The text around a number stays: blanks, line ends of another operating system, lower case.
TEST(InpTire, WrittenBackBlanksAndEndsOfLinesStay) {
  const std::string text =
      "*material, name=Soft\r\n*elastic\r\n  1.50 ,\t0.49\r\n*density\r\n1.1E-9,\r\n";
  InpDeck deck = parse_inp(text, "soft.inp");
  EXPECT_EQ(with_numbers_of(deck, text), text);
  ASSERT_EQ(deck.numbers[0].path, "material.SOFT.E");
  deck.numbers[0].value = 2.25;
  std::string expected = text;
  expected.replace(expected.find("1.50"), 4, "2.25");
  EXPECT_EQ(with_numbers_of(deck, text), expected);
}

// A field of CalculiX has 20 characters.
TEST(InpTire, WrittenNumbersFitIntoAField) {
  const std::string text = "*MATERIAL,NAME=A\n*DENSITY\n1e-9\n";
  InpDeck deck = parse_inp(text, "a.inp");
  deck.numbers[0].value = -1.2345678901234567e-109;
  const std::string written = with_numbers_of(deck, text);
  const std::string field = written.substr(written.find("DENSITY\n") + 8);
  EXPECT_LE(field.size(), 21u) << field;
  EXPECT_NEAR(parse_inp(written, "a.inp").numbers[0].value, deck.numbers[0].value, 1e-121);
}

TEST(InpTire, ComplaintsNameLineAndReason) {
  const auto says = [](const std::string& text, const char* part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
    EXPECT_EQ(text.rfind("bad.inp:", 0), 0u) << text;
  };
  says(deck_complaint("TYPE=C3D8", "TYPE=C3D20"), "element type C3D20 is not supported");
  says(deck_complaint("TYPE=C3D8", "TYPE=T3D2"), "expected C3D8, C3D8I");
  says(deck_complaint("*DENSITY", "*REBAR"), "*REBAR LAYER below a *SURFACE SECTION");
  says(deck_complaint("*HEADING", "*PART,NAME=P\n*HEADING"), "without parts and assemblies");
  says(deck_complaint("*STATIC", "*DYNAMIC"), "*DYNAMIC");
  says(deck_complaint("*DENSITY", "*CONDUCTIVITY"), "*CONDUCTIVITY is not supported");
  says(deck_complaint("INNER,P1,0.26", "INNER,P7,0.26"), "face \"P7\"");
  says(deck_complaint("INNER,P1,0.26", "INNER,P1,a"), "\"A\" in field 3");
  says(deck_complaint("INNER,P1,0.26", "INNER,P1,nan"), "expected a number");
  says(deck_complaint("INNER,P1,0.26", "OUTER,P1,0.26"), "\"OUTER\" is not defined");
  says(deck_complaint("RIM,1,3", "RIM,1,4"), "degrees of freedom 1 to 4");
  says(deck_complaint("NEO HOOKE", "OGDEN"), "expected NEO HOOKE");
  says(deck_complaint("\n1,1,31,34,4", "\n1,4,34,31,1"), "element 1 is inverted");
  says(deck_complaint("INNER,P1,0.26", "INNER,P2,0.26"), "on a face inside the wall");
  says(deck_complaint("\n2,", "\n1,"), "defined twice");
}

}  // namespace
}  // namespace latsch::formats
