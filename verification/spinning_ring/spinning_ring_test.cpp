// SPDX-License-Identifier: Apache-2.0
// Spinning rings against CalculiX 2.20, an independent program and closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "models/fe_tire/analysis/inflation.h"
#include "models/fe_tire/motion/spin.h"
#include "models/fe_tire/motion/spinning_harmonics.h"
#include "models/fe_tire/motion/spinning_tire.h"
#include "models/fe_tire/motion/standing_wave.h"
#include "ring_mesh.h"

namespace latsch::verification {
namespace {

using namespace latsch::fe_tire;

constexpr double kTwoPi = 2.0 * std::numbers::pi;
constexpr double kGyroSpeed = 100.0;  // rad/s

/// A mode of gyro_ring.csv: results for gyro_ring.inp by CalculiX 2.20 (*COMPLEX FREQUENCY,
/// CORIOLIS, in axes that spin along) and by an independent program of some 200 lines.
struct ListedMode {
  int n;  // positive: with the spin
  ModeType type;
  double calculix, independent, hub;  // Hz
};
const std::vector<ListedMode>& gyro_ring_modes() {
  using enum ModeType;
  static const std::vector<ListedMode> modes = {
      {2, lateral, 35.30543, 35.3022, 67.1332},    {1, lateral, 37.13526, 37.1335, 53.0490},
      {-1, lateral, 38.35025, 38.3499, 22.4344},   {-2, lateral, 38.91299, 38.9093, 7.0783},
      {0, lateral, 40.93675, 40.9355, 40.9355},    {3, lateral, 56.84152, 56.8329, 104.5794},
      {-3, lateral, 63.49434, 63.4839, 15.7374},   {0, torsional, 68.87417, 68.8730, 68.8730},
      {1, torsional, 89.51153, 89.5108, 105.4263}, {4, radial, 98.24166, 98.2215, 161.8835},
      {-4, lateral, 107.62030, 107.5974, 43.9354}, {-1, torsional, 114.09780, 114.0964, 98.1809},
      {2, radial, 117.10880, 117.1040, 148.9350},  {3, radial, 133.80750, 133.7935, 181.5400},
      {0, radial, 140.91410, 140.7864, 140.7864},  {1, radial, 142.80640, 142.6880, 158.6035},
      {-1, radial, 143.80120, 143.6787, 127.7632}, {-2, radial, 147.12710, 147.1194, 115.2884},
      {5, radial, 149.71580, 149.6795, 229.2570},  {4, radial, 151.58980, 151.5377, 215.1997},
      {2, radial, 152.76460, 152.6644, 184.4954},  {-2, radial, 153.21360, 153.1074, 121.2764},
      {-3, radial, 156.92280, 156.9032, 109.1567}, {-5, radial, 160.82070, 160.7796, 81.2021}};
  return modes;
}

class GyroRing : public testing::Test {
 protected:
  FeTire tire{gyro_ring_mesh(), gyro_ring_materials(), {.element = ElementKind::full_integration}};
  Inflated at_rest = *tire.inflate(0.0);
};

TEST_F(GyroRing, grows_as_calculix_says) {
  const auto spinning = SpinningTire(tire).inflate(at_rest, kGyroSpeed);
  ASSERT_TRUE(spinning) << spinning.failure().reason;
  EXPECT_EQ(spinning->spin, kGyroSpeed);
  double growth = 0.0, axial = 0.0;
  for (int k = 0; k < tire.mesh().nodes_per_sector(); ++k) {
    const Eigen::Vector3d X = tire.mesh().X.col(k);
    if (std::abs(X.z() + 0.30) > 1e-9 || std::abs(X.y() - 0.01) > 1e-9) continue;
    growth = -spinning->u(2, k);
    axial = spinning->u(1, k);
  }
  EXPECT_NEAR(growth, 2.18728e-3, 1e-4 * 2.18728e-3);
  EXPECT_NEAR(axial, -0.07673e-3, 1e-3 * 0.07673e-3);
}

/// Relative distance of the listed mode to the nearest one that was found with its n and sense.
double distance(const std::vector<SpinningMode>& modes, const ListedMode& listed, bool on_tire) {
  double nearest = 1.0;
  const double wanted = on_tire ? listed.independent : listed.hub;
  for (const SpinningMode& mode : modes) {
    const bool is_meant = mode.n == std::abs(listed.n) &&
                          (listed.n == 0 || (mode.sense == Sense::with) == (listed.n > 0));
    if (!is_meant) continue;
    const double found = on_tire ? mode.frequency_on_tire : mode.frequency;
    nearest = std::min(nearest, std::abs(found / wanted - 1.0));
  }
  return nearest;
}

TEST_F(GyroRing, modes_in_axes_that_spin_along_are_those_of_calculix) {
  SpinningTire spinning(tire);
  const auto modes = spinning.modes(*spinning.inflate(at_rest, kGyroSpeed), {}, 60);
  ASSERT_TRUE(modes) << modes.failure().reason;
  for (const ListedMode& listed : gyro_ring_modes()) {
    EXPECT_LT(distance(*modes, listed, true), 2e-4) << listed.n << " " << listed.independent;
    EXPECT_LT(distance(*modes, {listed.n, listed.type, 0.0, listed.calculix, 0.0}, true), 1e-3)
        << listed.n << " " << listed.calculix;
    EXPECT_LT(distance(*modes, listed, false), 2e-4) << listed.n << " " << listed.hub;
  }
}

TEST_F(GyroRing, gives_the_lowest_modes_seen_from_the_axle_and_no_other) {
  SpinningTire spinning(tire);
  const Inflated state = *spinning.inflate(at_rest, kGyroSpeed);
  const auto few = spinning.modes(state, {}, 12), many = spinning.modes(state, {}, 60);
  ASSERT_EQ(few->size(), 12u);
  for (std::size_t k = 0; k < few->size(); ++k) {
    EXPECT_NEAR((*few)[k].frequency, (*many)[k].frequency, 1e-7 * (*many)[k].frequency);
    EXPECT_EQ((*few)[k].label(), (*many)[k].label());
  }
  EXPECT_EQ((*few)[0].label(), "lateral n=2 against");
  EXPECT_NEAR((*few)[0].frequency, 7.0783, 1e-3);
}

/// The lowest frequencies, Hz, of K - Omega^2 W + i omega Omega G - omega^2 M (W.1) of one n and
/// sign.
std::vector<double> frequencies_by_flow(FeTire& tire, double speed, int n, int sign) {
  const Ring ring(tire.mesh(), ElementKind::full_integration);
  const RingElements elements(ring, tire.materials());
  const SectorFlow flow(elements);
  const Inflated state = *SpinningTire(tire).inflate(*tire.inflate(0.0), speed);
  SectorBlocks K(ring);
  Eigen::VectorXd f, alpha = state.alpha;
  assemble_sector(elements, ring.compress(state.u), 0.0, alpha, f, &K, nullptr);
  using numerics::BorderedHermitian;
  numerics::GyroscopicProblem problem{BorderedHermitian(K.harmonic(n)),
                                      BorderedHermitian(flow.G.harmonic_of_skew(n)),
                                      BorderedHermitian(flow.M.harmonic(n))};
  problem.K.banded.lower() -= speed * speed * flow.W.harmonic(n).lower();
  problem.G.banded.lower() *= speed;
  numerics::BorderedCholesky factor;
  EXPECT_TRUE(factor.factorize(problem.K));
  const auto modes = numerics::gyroscopic_modes(problem, factor, sign, 3, 1e-8);
  std::vector<double> frequencies;
  for (const double omega : modes.omega) frequencies.push_back(std::abs(omega) / kTwoPi);
  return frequencies;
}

TEST_F(GyroRing, inertia_of_the_standing_mesh_gives_the_listed_frequencies) {
  // In the hub frame with inertia (W.1) on the same elements, by the independent program.
  EXPECT_NEAR(frequencies_by_flow(tire, kGyroSpeed, 2, -1)[0], 7.0651, 1e-4 * 7.0651);
  EXPECT_NEAR(frequencies_by_flow(tire, kGyroSpeed, 1, -1)[0], 22.3975, 1e-4 * 22.3975);
  EXPECT_NEAR(frequencies_by_flow(tire, kGyroSpeed, 0, 1)[0], 40.8826, 1e-4 * 40.8826);
  EXPECT_NEAR(frequencies_by_flow(tire, kGyroSpeed, 1, 1)[0], 53.0101, 1e-4 * 53.0101);
  EXPECT_NEAR(frequencies_by_flow(tire, kGyroSpeed, 2, 1)[0], 67.1143, 1e-4 * 67.1143);
  EXPECT_NEAR(frequencies_by_flow(tire, kGyroSpeed, 3, 1)[0], 104.4534, 1e-4 * 104.4534);
}

TEST_F(GyroRing, waves_stand_still_at_the_listed_speed) {
  const auto wave = SpinningTire(tire).standing_wave(at_rest);
  ASSERT_TRUE(wave) << wave.failure().reason;
  EXPECT_NEAR(wave->speed, 170.4, 2e-3 * 170.4);
  EXPECT_EQ(wave->n, 3);
  FeTire fine(
      gyro_ring_mesh(72), gyro_ring_materials(), {.element = ElementKind::full_integration});
  const auto finer = SpinningTire(fine).standing_wave(*fine.inflate(0.0));
  ASSERT_TRUE(finer) << finer.failure().reason;
  EXPECT_NEAR(finer->speed, 164.0, 2e-3 * 164.0);
}

TEST_F(GyroRing, above_the_standing_wave_nothing_is_given_but_words) {
  SpinningTire spinning(tire);
  EXPECT_TRUE(spinning.inflate(at_rest, 170.0));
  const auto above = spinning.inflate(at_rest, 171.0);
  ASSERT_FALSE(above);
  EXPECT_NE(above.failure().reason.find("171 rad/s"), std::string::npos) << above.failure().reason;
  EXPECT_NE(above.failure().reason.find("170.3"), std::string::npos) << above.failure().reason;
  EXPECT_NE(above.failure().reason.find("km/h"), std::string::npos) << above.failure().reason;
  EXPECT_NE(above.failure().reason.find("n = 3"), std::string::npos) << above.failure().reason;
}

TEST_F(GyroRing, backward_spin_is_the_mirror_image) {
  SpinningTire spinning(tire);
  const auto forward = spinning.modes(*spinning.inflate(at_rest, 60.0), {}, 12);
  const auto backward = spinning.modes(*spinning.inflate(at_rest, -60.0), {}, 12);
  ASSERT_TRUE(forward && backward);
  for (std::size_t k = 0; k < forward->size(); ++k) {
    EXPECT_NEAR((*forward)[k].frequency, (*backward)[k].frequency, 1e-8 * (*forward)[k].frequency);
    EXPECT_EQ((*forward)[k].label(), (*backward)[k].label());
  }
}

/// A free ring that is thin enough for the closed forms: radius 0.3 m, stiff, so that it hardly
/// grows.
constexpr double kRadius = 0.3, kThickness = 1e-3, kModulus = 5e10, kDensity = 1200.0;

FeTire free_ring(int sectors) {
  const double inner = kRadius - 0.5 * kThickness, outer = kRadius + 0.5 * kThickness;
  return FeTire(ring_mesh({{{inner, outer}, {0.005, 0.0, -0.005}, 0}}, sectors, -1.0),
                {{linear_solid(kModulus, 0.3, kDensity)}, {}});
}

/// Lowest radial frequencies, rad/s, with and against the spin.
struct Split {
  double with, against;
};
Split split_of(FeTire& ring, double speed, int n) {
  SpinningTire spinning(ring);
  const auto modes = spinning.modes(*spinning.inflate(*ring.inflate(0.0), speed), {}, 40);
  EXPECT_TRUE(modes);
  Split split{0.0, 0.0};
  for (auto mode = modes->rbegin(); mode != modes->rend(); ++mode) {
    if (mode->n != n || mode->type != ModeType::radial) continue;
    (mode->sense == Sense::against ? split.against : split.with) = kTwoPi * mode->frequency;
    if (speed == 0.0) split.against = split.with;
  }
  return split;
}

// (Q.1): omega_hub = sqrt(omega_n^2 + kappa^2 Omega^2) +- kappa Omega, kappa = n (n^2 - 1) / (n^2 +
// 1), of an inextensible ring.
TEST(FreeRing, waves_with_and_against_the_spin_split_as_bryan_says) {
  FeTire ring = free_ring(120);
  constexpr double kSpeed = 20.0;
  for (int n = 2; n <= 5; ++n) {
    const Split spinning = split_of(ring, kSpeed, n), resting = split_of(ring, 0.0, n);
    const double kappa = n * (n * n - 1.0) / (n * n + 1.0);
    EXPECT_NEAR((spinning.with - spinning.against) / (2.0 * kappa * kSpeed), 1.0, 5e-4) << n;
    EXPECT_NEAR(spinning.with * spinning.against / (resting.with * resting.with), 1.0, 5e-4) << n;
    RecordProperty(
        "split_n" + std::to_string(n),
        std::to_string((spinning.with - spinning.against) / (2.0 * kappa * kSpeed) - 1.0));
  }
}

// A free thin ring grows by rho Omega^2 r^3 / E.
TEST(FreeRing, grows_by_the_tension_that_holds_its_mass) {
  const double inner = 0.2995, outer = 0.3005;
  FeTire ring(ring_mesh({{{inner, outer}, {0.005, 0.0, -0.005}, 0}}, 120, -1.0),
              {{linear_solid(5e10, 0.0, 1200.0)}, {}});
  const auto grown = SpinningTire(ring).inflate(*ring.inflate(0.0), 500.0);
  ASSERT_TRUE(grown) << grown.failure().reason;
  const double expected = 1200.0 * 500.0 * 500.0 * 0.027 / 5e10;
  EXPECT_NEAR(grown->growth, expected, 2e-3 * expected);
}

}  // namespace
}  // namespace latsch::verification
