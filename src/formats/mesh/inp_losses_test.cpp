// SPDX-License-Identifier: Apache-2.0
// Losses of a deck's materials: those of the same tire described in TOML, closed forms of a wave,
// and nothing of a round tire.
#include "formats/mesh/inp_losses.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string>

#include "formats/mesh/ccx_deck.h"
#include "formats/mesh/rebar_deck_testing.h"
#include "models/fe_tire/analysis/ring_assembly.h"
#include "models/fe_tire/description/reference_tires.h"
#include "models/fe_tire/element/hex8_shape.h"
#include "models/fe_tire/rolling/rolling_history.h"
#include "models/fe_tire/rolling/rolling_losses.h"

namespace latsch::formats {
namespace {

using namespace fe_tire;

constexpr double kGasPressure = 2.6e5, kTurn = 60.0;  // Pa, rad/s
constexpr double kShare = 0.25, kRelaxation = 2e-3;   // g, s

/// Tire B with few columns, its rubbers and plies with one term each.
TireDescription described_tire(CordModel cords) {
  TireDescription tire = reference_tire_b();
  tire.element = ElementKind::solid_shell;
  tire.cord_model = cords;
  tire.section.meridional = 9;
  tire.section.sectors = 40;
  for (Rubber& rubber : tire.rubbers) rubber.prony = {{kShare / (1.0 - kShare), kRelaxation}};
  for (CordPly& ply : tire.plies) {
    ply.prony = {{kShare / (1.0 - kShare), kRelaxation}};
    ply.cords.E_compression = ply.cords.E_tension;
    ply.cords.pretension = 0.0;
    ply.cords.density = 1500.0;
  }
  return tire;
}

/// Returns the deck of a tire, with *VISCOELASTIC below every material but the ground's.
std::string relaxing_deck(const TireDescription& tire) {
  CcxRun run;
  run.pressure = kGasPressure;
  run.element = tire.element;
  std::string text;
  if (tire.cord_model == CordModel::rebar) {
    text = rebar_deck(build_mesh(tire), build_materials(tire), run);
  } else {
    std::ostringstream out;
    write_ccx_deck(out, build_mesh(tire), build_materials(tire), run);
    text = out.str();
  }
  std::string relaxing;
  std::istringstream lines(text);
  std::string name;
  bool is_rubber = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("*MATERIAL,NAME=")) name = line.substr(15);
    if (line.starts_with("*HYPERELASTIC")) is_rubber = true;
    if (line.starts_with("*ELASTIC")) is_rubber = false;
    if (line.starts_with("*DENSITY") && name != "RIGID")
      relaxing += fmt::format(
          "*VISCOELASTIC, TIME=PRONY\n{},{},{}\n", kShare, is_rubber ? 0.0 : kShare, kRelaxation);
    relaxing += line + "\n";
  }
  return relaxing;
}

InpTire tire_of_deck(const std::string& text) { return tire_from(parse_inp(text, "tire.inp")); }

Eigen::Matrix3Xd wave(const Mesh& mesh, double a, int n) {
  Eigen::Matrix3Xd u = Eigen::Matrix3Xd::Zero(3, mesh.nodes());
  for (int s = 0; s < mesh.sectors; ++s)
    u.middleCols(s * mesh.nodes_per_sector(), mesh.nodes_per_sector())
        .row(1)
        .setConstant(a * std::cos(n * mesh.angle(s)));
  return u;
}

Inflated without_load(const Mesh& mesh) {
  Inflated none;
  none.u = Eigen::Matrix3Xd::Zero(3, mesh.nodes_per_sector());
  none.alpha = Eigen::VectorXd::Zero(8 * std::ssize(mesh.elements));
  return none;
}

/// Powers that a wave loses.
RollingLosses losses_of_wave(const FeTire& tire, const LossMaterials& losses, int n) {
  const Mesh& mesh = tire.mesh();
  constexpr double kSmall = 1e-6;  // m
  return LossMeter(tire, losses, without_load(mesh))
      .measure(wave(mesh, kSmall, n), Eigen::VectorXd::Zero(8 * mesh.element_count()), kTurn);
}

TEST(InpLosses, RubberAndRebarsLoseWhatTheDescribedTireLoses) {
  const TireDescription described = described_tire(CordModel::rebar);
  const InpTire deck = tire_of_deck(relaxing_deck(described));
  ASSERT_FALSE(deck.losses.is_elastic());
  ASSERT_EQ(deck.losses.solids.size(), deck.materials.solids.size());
  ASSERT_EQ(deck.losses.layers.size(), deck.materials.layers.size());
  const RollingLosses expected = losses_of_wave(FeTire(described), build_losses(described), 3);
  const RollingLosses found =
      losses_of_wave(FeTire(deck.mesh, deck.materials, {.element = deck.element}), deck.losses, 3);
  EXPECT_GT(expected.rubber, 0.0);
  EXPECT_GT(expected.cords, 0.0);
  EXPECT_NEAR(found.rubber, expected.rubber, 1e-5 * expected.rubber);
  EXPECT_NEAR(found.cords, expected.cords, 1e-5 * expected.cords);
}

/// P = n Omega/2 (loss of the modulus) times the integral of G (a n/r)^2: the wave's only strain is
/// the shear between the circumference and the axis, whose modulus G is.
double power_of_wave(const InpTire& tire, int n) {
  constexpr double kSmall = 1e-6;  // m
  const PronyTerm term{kShare / (1.0 - kShare), kRelaxation};
  double sum = 0.0;
  for (int s = 0; s < tire.mesh.sectors; ++s)
    for (const Element& element : tire.mesh.elements) {
      const auto& law = tire.materials.solids[element.solid].law;
      const auto* rubber = std::get_if<Hyperelastic>(&law);
      const double G =
          rubber ? 2.0 * (rubber->C10 + rubber->C01) : std::get<StVenantKirchhoff>(law).D(4, 4);
      const HexShape shape =
          make_shape(ElementKind::full_integration, tire.mesh.coordinates(element, s));
      for (int q = 0; q < 8; ++q) {
        const Eigen::Vector3d X =
            shape.X * shape_functions(kGauss * kXi[q], kGauss * kEta[q], kGauss * kZeta[q]);
        sum += shape.dV[q] * G * std::pow(kSmall * n, 2) / (X.x() * X.x() + X.z() * X.z());
      }
    }
  return 0.5 * n * kTurn * relative_modulus(term, n * kTurn).imag() * sum;
}

TEST(InpLosses, ASolidOfSeveralDirectionsRelaxesAsAWhole) {
  const InpTire deck = tire_of_deck(relaxing_deck(described_tire(CordModel::smeared)));
  ASSERT_TRUE(std::ranges::any_of(
      deck.losses.solids, [](const RelaxingSolid& solid) { return !solid.smeared.empty(); }));
  const RollingLosses found =
      losses_of_wave(FeTire(deck.mesh, deck.materials, {.element = deck.element}), deck.losses, 2);
  const double expected = power_of_wave(deck, 2);
  EXPECT_NEAR(found.rubber, expected, 0.03 * expected);  // 40 sectors
}

/// Returns a deck whose rubber is linear, of one direction.
std::string linear_deck() {
  std::string text = relaxing_deck(described_tire(CordModel::rebar));
  for (std::size_t at; (at = text.find("*HYPERELASTIC")) != text.npos;) {
    const std::size_t end = text.find('\n', text.find('\n', at) + 1);
    text.replace(at, end - at, "*ELASTIC\n20,0.45");
  }
  return text;
}

TEST(InpLosses, ALinearSolidOfOneDirectionRelaxesInShear) {
  const InpTire deck = tire_of_deck(linear_deck());
  const RollingLosses found =
      losses_of_wave(FeTire(deck.mesh, deck.materials, {.element = deck.element}), deck.losses, 2);
  const double expected = power_of_wave(deck, 2);
  EXPECT_NEAR(found.rubber, expected, 0.03 * expected);
}

/// Expects that the history of a round tire exerts no moment about the axle and that nothing is
/// lost, with sectors of three widths.
void expect_nothing(Mesh mesh,
                    const Materials& materials,
                    ElementKind element,
                    const LossMaterials& losses,
                    const std::string& of) {
  TireDescription zoned = described_tire(CordModel::rebar);
  zoned.section.sector_zones = {{4, 0.07}, {4, 0.12}};
  mesh.theta = build_mesh(zoned).theta;
  ASSERT_EQ(std::ssize(mesh.theta), mesh.sectors) << of;
  ASSERT_FALSE(losses.is_elastic()) << of;
  FeTire tire(mesh, materials, {.element = element});
  const auto inflated = tire.inflate(kGasPressure);
  ASSERT_TRUE(inflated) << of << ": " << inflated.failure().reason;
  const Inflated& rest = *inflated;
  const Ring ring(mesh, element);
  const RingElements elements(ring, materials);
  const RingUnknowns unknowns(ring, RingSymmetry::none, {});
  const RingAssembly assembly(unknowns);
  RollingHistory history(elements, losses, rest);
  const auto moment_of = [&](const Eigen::Matrix3Xd& u) {
    AssembledState state{unknowns.compress(u), rest.alpha.replicate(mesh.sectors, 1)};
    history.update(unknowns, state, kTurn);
    AssembledState again = state;
    Eigen::VectorXd with, without;
    EXPECT_TRUE(assembly.assemble(history.elements(), state, 0.0, with, nullptr, nullptr));
    EXPECT_TRUE(assembly.assemble(elements, again, 0.0, without, nullptr, nullptr));
    const Eigen::Matrix3Xd f = unknowns.expand(with - without);
    double moment = 0.0;
    for (int k = 0; k < mesh.nodes(); ++k)
      moment -= mesh.X(2, k % mesh.nodes_per_sector()) * f(0, k);
    return std::abs(moment);
  };
  const Eigen::Matrix3Xd round = rest.u.replicate(1, mesh.sectors);
  EXPECT_LT(moment_of(round), 1e-6) << of;  // N m
  const LossMeter meter(tire, losses, rest);
  const RollingLosses lost = meter.measure(round, rest.alpha.replicate(mesh.sectors, 1), kTurn);
  EXPECT_LT(std::abs(lost.rubber) + std::abs(lost.cords), 1e-6) << of;  // W
  // A tire that is not round has a moment.
  EXPECT_GT(moment_of(round + wave(mesh, 1e-3, 2)), 1e-3) << of;
}

TEST(InpLosses, ATireThatSpinsOffTheGroundHasNoMoment) {
  const InpTire rubber = tire_of_deck(relaxing_deck(described_tire(CordModel::rebar)));
  expect_nothing(rubber.mesh, rubber.materials, rubber.element, rubber.losses, "rubber, rebars");
  const InpTire linear = tire_of_deck(linear_deck());
  expect_nothing(linear.mesh, linear.materials, linear.element, linear.losses, "linear solids");
  const InpTire whole = tire_of_deck(relaxing_deck(described_tire(CordModel::smeared)));
  expect_nothing(whole.mesh, whole.materials, whole.element, whole.losses, "several directions");
  const TireDescription smeared = described_tire(CordModel::smeared);
  expect_nothing(build_mesh(smeared),
                 build_materials(smeared),
                 smeared.element,
                 build_losses(smeared),
                 "smeared cords");
}

TEST(InpLosses, SharesAndTimesAreNumbersOfTheDeck) {
  const std::string text = relaxing_deck(described_tire(CordModel::rebar));
  InpDeck deck = parse_inp(text, "tire.inp");
  const auto number = [&](const std::string& path) {
    return std::ranges::find(deck.numbers, path, &InpNumber::path);
  };
  ASSERT_NE(number("material.SOLID0.g1"), deck.numbers.end());
  ASSERT_NE(number("material.CORD0.tau1"), deck.numbers.end());
  EXPECT_EQ(number("material.SOLID0.g1")->value, kShare);
  number("material.SOLID0.g1")->value = 0.4;
  const InpTire changed = tire_from(parse_inp(with_numbers_of(deck, text), "tire.inp"));
  EXPECT_NEAR(changed.losses.solids[0].terms[0].beta, 0.4 / 0.6, 1e-12);
  EXPECT_EQ(changed.losses.solids[0].terms[0].tau, kRelaxation);
}

TEST(InpLosses, WrongTermsAreRefusedInWords) {
  const std::string good = relaxing_deck(described_tire(CordModel::rebar));
  const auto said = [&](const std::string& from, const std::string& to) -> std::string {
    std::string text = good;
    const std::size_t at = text.find(from);
    if (at == text.npos) return "the deck has no " + from;
    text.replace(at, from.size(), to);
    try {
      (void)tire_of_deck(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  };
  const std::string card = "*VISCOELASTIC, TIME=PRONY\n", row = "0.25,0,0.002\n";
  struct Wrong {
    std::string from, to, words;
  };
  for (const Wrong& wrong : {
           Wrong{card, "*VISCOELASTIC\n", "expected TIME=PRONY"},
           Wrong{card, "*VISCOELASTIC, FREQUENCY=PRONY\n", "FREQUENCY"},
           Wrong{card, "*VISCOELASTIC, TIME=CREEP TEST DATA\n", "PRONY"},
           Wrong{row, "1.25,0,0.002\n", "SOLID0"},
           Wrong{row, "-0.25,0,0.002\n", "SOLID0"},
           Wrong{row, "0.25,0,0\n", "SOLID0"},
           Wrong{row, "0.25,0,0.002\n0.1,0,0.002\n", "SOLID0"},
           Wrong{row, "0.25,0.1,0.002\n", "k is 0.1"},
           Wrong{"0.25,0.25,0.002\n", "0.25,0,0.002\n", "whole stress"},
           Wrong{"*HYPERELASTIC,", "*HYPERELASTIC,MODULI=INSTANTANEOUS,", "LONG TERM"},
       }) {
    const std::string found = said(wrong.from, wrong.to);
    EXPECT_NE(found.find(wrong.words), std::string::npos) << wrong.to << found;
    EXPECT_NE(found.find("tire.inp:"), std::string::npos) << found;
  }
}

}  // namespace
}  // namespace latsch::formats
