// SPDX-License-Identifier: Apache-2.0
// A rigid wheel with a thin layer of independent columns rolls on rigid ground: the rolling
// resistance of contact alone. The columns have one Prony term, M_1 = M_inf, and are solved here on
// points around the wheel with the histories of streamlines.h. The table was computed by an
// independent program that integrates the columns' law along the patch.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <vector>

#include "models/fe_tire/history/streamlines.h"

namespace latsch::fe_tire {
namespace {

constexpr double kWheel = 0.3, kLayer = 5e-3, kPenetration = 0.3e-3,
                 kColumnModulus = 8e6;  // m, m, m, Pa
constexpr double kContactZone = 0.08;   // rad, half of the zone of fine points: 24 mm

struct Foundation {
  double load = 0.0;        // N/m
  double resistance = 0.0;  // moment/(R load)
  double trailing = 0.0;    // m, length of contact behind the middle
};

/// Angles of points, `fine` of them in the zone of contact.
std::vector<double> angles(int fine) {
  std::vector<double> theta;
  for (int k = 0; k < fine; ++k)
    theta.push_back(-kContactZone + 2.0 * kContactZone * (k + 0.5) / fine);
  constexpr int kRest = 100;
  for (int k = 0; k < kRest; ++k)
    theta.push_back(kContactZone +
                    (2.0 * std::numbers::pi - 2.0 * kContactZone) * (k + 0.5) / kRest);
  return theta;
}

/// Rolls with the relaxation length V tau. A column in contact has the strain that the ground
/// gives, one off the ground has no stress.
Foundation roll(double relaxation_length, int fine) {
  const std::vector<double> theta = angles(fine);
  const int m = static_cast<int>(theta.size());
  const Streamline line(theta);
  const PronyTerm term{1.0, relaxation_length / kWheel};  // Omega = 1 rad/s
  const Eigen::MatrixXd law =
      kColumnModulus *
      (Eigen::MatrixXd::Identity(m, m) + line.history(term, 1.0, Eigen::MatrixXd::Identity(m, m)))
          .transpose();
  Eigen::VectorXd given(fine), strain(m), stress(m);
  std::vector<bool> touches(m, false);
  for (int k = 0; k < fine; ++k) {
    given[k] = (kPenetration - 0.5 * kWheel * theta[k] * theta[k]) / kLayer;
    touches[k] = given[k] > 0.0;
  }
  for (bool changes = true; changes;) {
    std::vector<int> held, loose;
    for (int k = 0; k < m; ++k) (touches[k] ? held : loose).push_back(k);
    strain.setZero();
    for (const int k : held) strain[k] = given[k];
    strain(loose) = -law(loose, loose).lu().solve((law(loose, held) * strain(held)).eval());
    stress = law * strain;
    changes = false;
    for (int k = 0; k < fine; ++k) {
      const bool is_down = touches[k] ? stress[k] > 0.0 : strain[k] < given[k];
      changes |= is_down != touches[k];
      touches[k] = is_down;
    }
  }
  Foundation found;
  const double length = 2.0 * kContactZone * kWheel / fine;
  for (int k = 0; k < fine; ++k) {
    if (!touches[k]) continue;
    found.load += stress[k] * length;
    found.resistance += stress[k] * length * theta[k];  // moment over R: the arm is R theta
    found.trailing = std::max(found.trailing, -kWheel * theta[k] + 0.5 * length);
  }
  found.resistance /= found.load;
  return found;
}

struct FoundationRow {
  double relaxation_length, load, resistance, trailing;  // m, N/m, 1, m
};
const std::vector<FoundationRow> kFoundations = {{1e-3, 8681.8, 0.002784, 12.528e-3},
                                                 {3e-3, 9252.1, 0.005563, 11.387e-3},
                                                 {10e-3, 11583.7, 0.005513, 10.954e-3},
                                                 {30e-3, 14318.5, 0.002963, 11.989e-3},
                                                 {100e-3, 16128.6, 0.001089, 12.878e-3}};

TEST(RollingFoundation, HasTheLoadAndTheResistanceOfTheTable) {
  for (const FoundationRow& row : kFoundations) {
    const Foundation found = roll(row.relaxation_length, 480);
    EXPECT_NEAR(found.load, row.load, 0.002 * row.load) << row.relaxation_length;
    EXPECT_NEAR(found.resistance, row.resistance, 0.01 * row.resistance) << row.relaxation_length;
    EXPECT_NEAR(found.trailing, row.trailing, 0.1e-3) << row.relaxation_length;  // one point
  }
}

TEST(RollingFoundation, ResistsMostWhereThePatchIsPassedInAFewRelaxationTimes) {
  // The maximum lies between 3 and 10 mm, a quarter to all of half the patch.
  double most = 0.0, at = 0.0;
  for (double length = 1e-3; length < 60e-3; length *= 1.3) {
    const double resistance = roll(length, 240).resistance;
    if (resistance > most) at = length;
    most = std::max(most, resistance);
  }
  EXPECT_GT(at, 3e-3);
  EXPECT_LT(at, 10e-3);
  EXPECT_GT(most, 0.0057);
  EXPECT_LT(most, 0.0065);
}

}  // namespace
}  // namespace latsch::fe_tire
