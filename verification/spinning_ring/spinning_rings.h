// SPDX-License-Identifier: Apache-2.0
// Errors of spinning rings against CalculiX 2.20, an independent program and closed forms, for the
// tests of this folder and the benchmark `rolling`.
#pragma once

#include <vector>

#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/motion/spinning_tire.h"

namespace latsch::verification {

inline constexpr double kGyroSpeed = 100.0;  // rad/s, of the listed results

/// A mode of gyro_ring.csv: results for gyro_ring.inp by CalculiX 2.20 (*COMPLEX FREQUENCY,
/// CORIOLIS, in axes that spin along) and by an independent program of some 200 lines (HEX8, total
/// Lagrangian, whole ring).
struct ListedMode {
  int n;  // positive: with the spin
  fe_tire::ModeType type;
  double calculix, independent, hub;  // Hz; hub: the independent one in axes that stand
};
const std::vector<ListedMode>& gyro_ring_modes();

/// The ring on elements of full integration.
fe_tire::FeTire gyro_ring(int sectors = 36);

/// Returns the lowest frequencies, Hz, of K - Omega^2 W + i omega Omega G - omega^2 M (W.1) of one
/// n and sign (1: with the spin) about the state. `kind`: that of the tire's elements.
std::vector<double> frequencies_by_flow(const fe_tire::FeTire& tire,
                                        fe_tire::ElementKind kind,
                                        const fe_tire::Inflated& state,
                                        int n,
                                        int sign);

/// Largest relative errors of the listed results.
struct GyroRingErrors {
  double calculix = 0.0, independent = 0.0, hub = 0.0;  // worst of the 24 modes
  double by_flow = 0.0;                                 // worst of six frequencies by (W.1)
  double growth = 0.0;
  double standing_wave = 0.0;  // on 36 sectors
};
GyroRingErrors gyro_ring_errors();

/// Largest relative errors over n = 2 ... 5 of a thin free ring on the default element at 20 rad/s
/// against (Q.1), omega = sqrt(omega_n^2 + kappa^2 Omega^2) +- kappa Omega with kappa = n (n^2 - 1)
/// / (n^2 + 1): of the difference 2 kappa Omega of the waves with and against the spin, and of
/// their product omega_n^2, where omega_n is that of the same ring at rest. [Bryan 1890]
struct SplitErrors {
  double split = 0.0, product = 0.0;
};
SplitErrors bryan_errors(int sectors);
/// Works as bryan_errors() by (W.1).
SplitErrors bryan_errors_by_flow(int sectors);

}  // namespace latsch::verification
