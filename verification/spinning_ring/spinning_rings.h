// SPDX-License-Identifier: Apache-2.0
// Errors of spinning rings compared with CalculiX 2.20, an independent program and closed forms;
// used by the tests of this folder and the benchmark `rolling`.
#pragma once

#include <vector>

#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/motion/spinning_tire.h"

namespace latsch::verification {

inline constexpr double kGyroSpeed = 100.0;  // rad/s, speed of the listed results

/// A mode in gyro_ring.csv: results for gyro_ring.inp by CalculiX 2.20 (*COMPLEX FREQUENCY,
/// CORIOLIS, in rotating axes) and by an independent program of some 200 lines (HEX8, total
/// Lagrangian, whole ring).
struct ListedMode {
  int n;  // number of waves; positive: the wave travels with the rotation
  fe_tire::ModeType type;
  /// Hz; hub: by the independent program in axes that do not rotate
  double calculix, independent, hub;
};
const std::vector<ListedMode>& gyro_ring_modes();

/// Returns the ring of gyro_ring.inp with elements of full integration.
fe_tire::FeTire gyro_ring(int sectors = 36);

/// Returns the lowest frequencies, Hz, of K - Omega^2 W + i omega Omega G - omega^2 M, equation
/// (W.1), about the state, for one n and one sense (1: with the rotation). `kind` is that of the
/// tire's elements.
std::vector<double> frequencies_by_flow(const fe_tire::FeTire& tire,
                                        fe_tire::ElementKind kind,
                                        const fe_tire::Inflated& state,
                                        int n,
                                        int sign);

/// Largest relative errors compared with the listed results.
struct GyroRingErrors {
  double calculix = 0.0, independent = 0.0, hub = 0.0;  // largest of the 24 modes
  double by_flow = 0.0;                                 // largest of six frequencies by (W.1)
  double growth = 0.0;
  double standing_wave = 0.0;  // on 36 sectors
};
GyroRingErrors gyro_ring_errors();

/// Errors of a thin free ring on the default element at 20 rad/s, the largest over n = 2 ... 5,
/// compared with equation (Q.1): omega = sqrt(omega_n^2 + kappa^2 Omega^2) +- kappa Omega with
/// kappa = n (n^2 - 1) / (n^2 + 1). `split` is the relative error of 2 kappa Omega, the difference
/// between the waves with and against the rotation; `product` is that of their product omega_n^2,
/// where omega_n is the frequency of the same ring at rest. [Bryan 1890]
struct SplitErrors {
  double split = 0.0, product = 0.0;
};
SplitErrors bryan_errors(int sectors);
/// Returns the same errors for frequencies that were computed by equation (W.1).
SplitErrors bryan_errors_by_flow(int sectors);

/// Errors of the damped waves of the same ring at 20 rad/s, whose shear stress relaxes by one term:
/// the largest of frequency and damping, over n = 2 ... 5 and both senses, compared with the roots
/// of
///   (sigma + g)^2 = omega_n^2 + omega_b^2 (E(i sigma)/E - 1) + kappa^2 Omega^2,
///   omega = sigma + n Omega,   g = 2 n Omega/(n^2 + 1),   E(s) = 9 K G(s)/(3 K + G(s)),
/// which is (Q.1) with the Young's modulus of a bulk that is elastic. omega_n is the frequency of
/// the same ring at rest with relaxed moduli, and omega_b^2 = n^2 (n^2 - 1)^2/(n^2 + 1) E I/(rho A
/// R^4) the part of its square that bending has: the soft foundation does not relax.
struct DampedRingErrors {
  double frequency = 0.0, damping = 0.0;
};
DampedRingErrors damped_ring_errors(int sectors);

}  // namespace latsch::verification
