// SPDX-License-Identifier: Apache-2.0
// A deck that Latsch wrote is read back as the same tire: mesh with walls, tread and division into
// sectors, growth, force, modes. The deck has twelve to fifteen digits, which with the tolerances
// of the solvers determines how much the results differ.
#include <gtest/gtest.h>

#include <array>
#include <numbers>
#include <sstream>

#include "formats/mesh/ccx_deck.h"
#include "formats/mesh/inp_tire.h"
#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/description/reference_tires.h"

namespace latsch::formats {
namespace {

using namespace fe_tire;

constexpr double kDeckPressure = 2.6e5;
constexpr double kDegreeOfZone = std::numbers::pi / 180.0;

/// Returns a coarse tire B with rows of elements that end in the sidewall, with solid shells.
TireDescription tire_of_shells(CordModel cords, bool zones) {
  TireDescription tire = reference_tire_b();
  tire.section.meridional = 9;
  tire.section.sectors = 12;
  tire.section.faces = {{{0.0}, {-0.6e-3}}, {{0.0}, {0.6e-3}}, {{0.0}, {1.7e-3}}};
  tire.section.faces_to = 0.46;
  if (zones) tire.section.sector_zones = {{2, 12.0 * kDegreeOfZone}};
  tire.element = ElementKind::solid_shell;
  tire.cord_model = cords;
  for (CordPly& ply : tire.plies) ply.cords.E_compression = 0.2 * ply.cords.E_tension;
  return tire;
}

std::string deck_written_of(const TireDescription& tire, bool loaded) {
  std::ostringstream out;
  CcxRun run;
  run.pressure = kDeckPressure;
  run.element = tire.element;
  if (loaded) run.ground = CcxGround{0.32, 0.012, 2e10, 0.0};
  write_ccx_deck(out, build_mesh(tire), build_materials(tire), run);
  return out.str();
}

/// Returns growth, force on flat ground, and frequencies of the tire off and on the ground.
std::array<double, 6> results_of_deck(const Mesh& mesh,
                                      const Materials& materials,
                                      ElementKind element) {
  FeTire tire(mesh, materials, {.element = element});
  const auto inflated = tire.inflate(kDeckPressure);
  if (!inflated) ADD_FAILURE() << inflated.failure().reason;
  const auto states = tire.press(*inflated, {}, {0.012});
  if (!states) ADD_FAILURE() << states.failure().reason;
  const auto free = tire.modes(*inflated, 4), loaded = tire.modes(states->back(), 4);
  if (!free || !loaded) ADD_FAILURE();
  return {inflated->growth,
          tire.stand(states->back()).force.z(),
          (*free)[0].frequency,
          (*free)[3].frequency,
          (*loaded)[0].frequency,
          (*loaded)[3].frequency};
}

struct WrittenDeckCase {
  const char* name;
  CordModel cords;
  bool zones, loaded;
};

class WrittenDeck : public testing::TestWithParam<WrittenDeckCase> {};

TEST_P(WrittenDeck, ComesBackAsTheSameTire) {
  const auto& [name, cords, zones, loaded] = GetParam();
  const TireDescription tire = tire_of_shells(cords, zones);
  const Mesh mesh = build_mesh(tire);
  const Materials materials = build_materials(tire);
  const InpTire read = tire_from(parse_inp(deck_written_of(tire, loaded), "tire.inp"));
  EXPECT_EQ(read.element, tire.element);
  ASSERT_EQ(read.mesh.sectors, mesh.sectors);
  ASSERT_EQ(read.mesh.theta.size(), mesh.theta.size());
  for (std::size_t s = 0; s < mesh.theta.size(); ++s)
    EXPECT_NEAR(read.mesh.theta[s], mesh.theta[s], 1e-10);
  ASSERT_EQ(read.mesh.elements.size(), mesh.elements.size());
  int walls = 0, layers = 0;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    EXPECT_NEAR(read.mesh.elements[e].wall, mesh.elements[e].wall, 1e-15);
    EXPECT_EQ(read.mesh.elements[e].layer_rows, mesh.elements[e].layer_rows);
    EXPECT_EQ(read.mesh.elements[e].tread, mesh.elements[e].tread);
    walls += mesh.elements[e].wall > 0.0 ? 1 : 0;
    layers += mesh.elements[e].layer_rows > 0 ? 1 : 0;
  }
  EXPECT_GT(walls, 0);
  EXPECT_GT(layers, 0);
  const auto before = results_of_deck(mesh, materials, tire.element);
  const auto after = results_of_deck(read.mesh, read.materials, read.element);
  for (std::size_t i = 0; i < before.size(); ++i)
    EXPECT_NEAR(after[i] / before[i], 1.0, 1e-7) << name << ", result " << i;
}

INSTANTIATE_TEST_SUITE_P(
    OfEveryKind,
    WrittenDeck,
    testing::Values(WrittenDeckCase{"springs", CordModel::rebar, false, true},
                    WrittenDeckCase{"springs_free", CordModel::rebar, false, false},
                    WrittenDeckCase{"springs_zones", CordModel::rebar, true, true},
                    WrittenDeckCase{"springs_zones_free", CordModel::rebar, true, false},
                    WrittenDeckCase{"smeared", CordModel::smeared, false, true},
                    WrittenDeckCase{"smeared_zones_free", CordModel::smeared, true, false}),
    [](const auto& one) { return std::string(one.param.name); });

// A deck without ground has equal sectors, whatever the zones of the tire: Latsch inflates a tire
// with equal sectors, and in another program a ring of unequal sectors does not stay round.
TEST(WrittenDecks, OffTheGroundSectorsAreEqual) {
  const TireDescription tire = tire_of_shells(CordModel::rebar, true);
  TireDescription even = tire;
  even.section.sector_zones.clear();
  std::string zoned = deck_written_of(tire, false);
  const std::string equal = deck_written_of(even, false);
  for (std::size_t at; (at = zoned.find("** latsch planes")) != zoned.npos;)
    zoned.erase(at, zoned.find('\n', at) + 1 - at);
  EXPECT_EQ(zoned, equal);
}

TEST(WrittenDecks, ARemarkWithoutSenseIsRefusedWithItsLine) {
  const std::string good = deck_written_of(tire_of_shells(CordModel::rebar, true), false);
  const auto complaint = [&](const std::string& from, const std::string& to) -> std::string {
    std::string text = good;
    const std::size_t at = text.find(from);
    EXPECT_NE(at, text.npos) << from;
    text.replace(at, from.size(), to);
    try {
      tire_from(parse_inp(text, "bad.inp"));
    } catch (const InputError& error) {
      EXPECT_GT(error.place().line, 0) << error.what();
      return error.what();
    }
    return "nothing";
  };
  const auto says = [](const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  says(complaint("** latsch wall: WALL0,", "** latsch wall: WALL0, -"), "thickness");
  says(complaint("** latsch wall: WALL0", "** latsch wall: NONE"), "NONE is not defined");
  says(complaint("** latsch tread: TREADS", "** latsch tread:"), "element set");
  says(complaint("** latsch planes: 0, ", "** latsch planes: "), "11 planes");
  says(complaint("** latsch planes: 0, 12", "** latsch planes: 12, 0"), "rise");
  says(complaint("** latsch tread", "** latsch treed"), "treed");
}

}  // namespace
}  // namespace latsch::formats
