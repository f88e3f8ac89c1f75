// SPDX-License-Identifier: Apache-2.0
// Rolling resistance without contact: an inextensible ring on a foundation, whose bending stiffness
// and foundation relax, turns below a force that stands. It is solved here on points around the
// ring with the histories of streamlines.h, and compared with the sum over harmonics, in which each
// n sees the complex moduli at n Omega. The table was computed by an independent program.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "models/fe_tire/history/streamlines.h"

namespace latsch::fe_tire {
namespace {

constexpr double kOneTurn = 2.0 * std::numbers::pi;
// The ring of tire models' ring table: m, N m^2, N/m, N/m^2.
constexpr double kR = 0.30, kEI = 2.0, kPressure = 36e3, kRadial = 0.7e6, kTangential = 0.25e6;
constexpr double kForce = 100.0;  // N
constexpr double kShare = 0.2;    // part of the unrelaxed moduli that relaxes

/// Solved ring: moment and deflection at the force.
struct TurningRing {
  double moment = 0.0;      // N m, by the power of the histories
  double deflection = 0.0;  // m
  double by_force = 0.0;    // N m, by the force on the sloping ring
};

/// One of the stresses of the ring: its unrelaxed stiffness and its strain by the harmonics of v.
struct RingStress {
  double stiffness;
  Eigen::MatrixXd strain;  // [points x unknowns]
};

/// v = sum V_c cos(n theta) + V_s sin(n theta) over the harmonics first ... last, w = -v' (w
/// outward), curvature (w + w'')/R^2.
std::vector<RingStress> stresses(const std::vector<double>& theta, int first, int last) {
  const int m = static_cast<int>(theta.size());
  Eigen::MatrixXd v(m, 2 * (last - first + 1)), w = v, bent = v;
  for (int k = 0; k < m; ++k) {
    for (int n = first, c = 0; n <= last; ++n, c += 2) {
      const double cosine = std::cos(n * theta[k]), sine = std::sin(n * theta[k]);
      v.row(k).segment<2>(c) << cosine, sine;
      w.row(k).segment<2>(c) << n * sine, -n * cosine;
      bent.row(k).segment<2>(c) = (1.0 - n * n) / (kR * kR) * w.row(k).segment<2>(c);
    }
  }
  return {{kEI, bent}, {kRadial, w}, {kTangential, v}};
}

/// The ring that moves in the harmonics first ... last only, on these points.
TurningRing solve_ring(
    const std::vector<double>& theta, double Omega, double tau, int first, int last) {
  const Streamline line(theta);
  const PronyTerm term = (*from_unrelaxed({{kShare, tau}}))[0];
  const int m = line.points(), unknowns = 2 * (last - first + 1);
  Eigen::VectorXd length(m);  // m, of the ring that a point stands for
  for (int k = 0; k < m; ++k) {
    const double before = line.steps()[(k + m - 1) % m], after = line.steps()[k];
    length[line.order()[k]] = 0.5 * kR * (before + after);
  }
  // The tension p b R acts on the slope; it does not relax. Masses have no effect, because the
  // deflection by a force that does not move is constant in time at every place.
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(unknowns, unknowns);
  Eigen::VectorXd w_0(unknowns), slope(unknowns);  // w and w' below the force at theta = 0
  for (int n = first, c = 0; n <= last; ++n, c += 2) {
    K.diagonal().segment<2>(c).setConstant(std::numbers::pi * kPressure * n * n * (n * n - 1.0));
    w_0.segment<2>(c) << 0.0, -n;
    slope.segment<2>(c) << n * n, 0.0;
  }
  const auto all = stresses(theta, first, last);
  for (const auto& [stiffness, strain] : all) {
    const Eigen::MatrixXd relaxed = (1.0 - kShare) * stiffness * strain;
    const Eigen::MatrixXd H = line.history(term, Omega, relaxed.transpose()).transpose();
    K += strain.transpose() * length.asDiagonal() * (relaxed + H);
  }
  const Eigen::VectorXd V = K.fullPivLu().solve(kForce * w_0);
  TurningRing ring;
  ring.deflection = w_0.dot(V);
  // Material below the force moves outward at the speed -Omega w'.
  ring.by_force = -kForce * slope.dot(V);
  for (const auto& [stiffness, strain] : all) {
    const Eigen::MatrixXd E = (strain * V).transpose();
    const Eigen::MatrixXd H = line.history(term, Omega, (1.0 - kShare) * stiffness * E);
    ring.moment += kR * line.power(Omega, H, E) / Omega;
  }
  return ring;
}

/// The sum over harmonics of complex moduli.
TurningRing sum_of_harmonics(double Omega, double tau, int last) {
  const PronyTerms terms = *from_unrelaxed({{kShare, tau}});
  TurningRing ring;
  for (int n = 1; n <= last; ++n) {
    const double n2 = static_cast<double>(n) * n;
    const std::complex<double> stiff = (1.0 - kShare) * relative_modulus(terms, n * Omega);
    const double bending = kEI / std::pow(kR, 4) * n2 * (n2 - 1.0) * (n2 - 1.0);
    const std::complex<double> K =
        stiff * (bending + kRadial * n2 + kTangential) + kPressure / kR * n2 * (n2 - 1.0);
    const double f = kForce / (kOneTurn * kR);
    const std::complex<double> w = n2 * f / K;
    ring.deflection += 2.0 * w.real();
    ring.moment += 2.0 * kOneTurn * kR * n * std::abs(f * w.imag());
  }
  ring.by_force = ring.moment;
  return ring;
}

std::vector<double> even_ring(int m) {
  std::vector<double> theta(m);
  for (int k = 0; k < m; ++k) theta[k] = kOneTurn * k / m;
  return theta;
}

/// On points at equal distances harmonics do not couple.
TurningRing solve_even_ring(double Omega, double tau, int last, int points) {
  TurningRing sum;
  for (int n = 1; n <= last; ++n) {
    // No fewer than 32 points a wave.
    const auto theta = even_ring(std::max(points, 32 * n));
    const TurningRing ring = solve_ring(theta, Omega, tau, n, n);
    sum.moment += ring.moment;
    sum.deflection += ring.deflection;
    sum.by_force += ring.by_force;
  }
  return sum;
}

/// Two points a sector, sectors near the force of a third of the others' width.
std::vector<double> zoned_ring(int fine, int coarse) {
  std::vector<double> theta;
  const double half = 0.6, gauss = 0.5 / std::sqrt(3.0);
  const auto zone = [&](double from, double to, int sectors) {
    for (int s = 0; s < sectors; ++s) {
      for (const double at : {0.5 - gauss, 0.5 + gauss})
        theta.push_back(from + (to - from) * (s + at) / sectors);
    }
  };
  zone(-half, half, fine);
  zone(half, kOneTurn - half, coarse);
  return theta;
}

struct TableRow {
  double Omega, tau, moment, deflection;  // rad/s, s, N m, m
};
const std::vector<TableRow> kTable = {{25, 1e-4, 0.000997, 0.497945e-3},
                                      {25, 1e-3, 0.004332, 0.496749e-3},
                                      {25, 1e-2, 0.005716, 0.481964e-3},
                                      {50, 1e-4, 0.001762, 0.497871e-3},
                                      {50, 1e-3, 0.005079, 0.495145e-3},
                                      {50, 1e-2, 0.005195, 0.468308e-3},
                                      {100, 1e-4, 0.002835, 0.497647e-3},
                                      {100, 1e-3, 0.005480, 0.491910e-3},
                                      {100, 1e-2, 0.003837, 0.453395e-3}};

TEST(RollingRing, MomentAndDeflectionAreThoseOfTheTable) {
  for (const TableRow& row : kTable) {
    // Harmonics above 100 add up to 12 % of the moment (tau = 0.1 ms): those of the closed sum.
    const int last = 100;
    const TurningRing all = sum_of_harmonics(row.Omega, row.tau, 5000),
                      first = sum_of_harmonics(row.Omega, row.tau, last);
    EXPECT_NEAR(all.moment, row.moment, 1e-3 * row.moment);
    EXPECT_NEAR(all.deflection, row.deflection, 1e-5 * row.deflection);
    TurningRing ring = solve_even_ring(row.Omega, row.tau, last, 1200);
    ring.moment += all.moment - first.moment;
    ring.by_force += all.moment - first.moment;
    EXPECT_NEAR(ring.moment, row.moment, 0.01 * row.moment) << row.Omega << " " << row.tau;
    EXPECT_NEAR(ring.by_force, row.moment, 0.01 * row.moment) << row.Omega << " " << row.tau;
    EXPECT_NEAR(ring.deflection, row.deflection, 0.002 * row.deflection);
  }
}

TEST(RollingRing, UnequalStepsGiveTheSameMoment) {
  // The harmonics up to 20, which couple on unequal steps.
  for (const TableRow& row : kTable) {
    const TurningRing expected = sum_of_harmonics(row.Omega, row.tau, 20);
    const TurningRing ring = solve_ring(zoned_ring(70, 100), row.Omega, row.tau, 1, 20);
    EXPECT_NEAR(ring.by_force, expected.moment, 0.01 * expected.moment) << row.Omega << row.tau;
    EXPECT_NEAR(ring.deflection, expected.deflection, 0.002 * expected.deflection);
  }
}

TEST(RollingRing, EnergyBalanceClosesWithSecondOrder) {
  double before = 0.0;
  for (const int m : {720, 1440, 2880}) {
    const TurningRing ring = solve_even_ring(50.0, 1e-3, 20, m);
    const double open = std::abs(ring.moment / ring.by_force - 1.0);
    if (before > 0.0) {
      EXPECT_NEAR(std::log2(before / open), 2.0, 0.2);
    }
    before = open;
  }
  EXPECT_LT(before, 0.002);
}

TEST(RollingRing, SlowRollingIsRelaxed) {
  const TurningRing slow = solve_even_ring(1e-3, 1e-3, 40, 240);
  EXPECT_LT(std::abs(slow.moment), 1e-6);
  double sum = 0.0;
  for (int n = 1; n <= 40; ++n) {
    const double n2 = n * n, bending = kEI / std::pow(kR, 4) * n2 * (n2 - 1) * (n2 - 1);
    const double K =
        (1.0 - kShare) * (bending + kRadial * n2 + kTangential) + kPressure / kR * n2 * (n2 - 1);
    sum += 2.0 * n2 * kForce / (kOneTurn * kR) / K;
  }
  EXPECT_NEAR(slow.deflection, sum, 1e-6 * sum);
}

}  // namespace
}  // namespace latsch::fe_tire
