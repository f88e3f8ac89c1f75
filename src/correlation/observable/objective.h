// SPDX-License-Identifier: Apache-2.0
// The target function: how far a simulation is from the measurement, relative; 0 is perfect.
//
//   df_i = (f_i^mea - f_i^sim) / f_i^mea       i = 1..N modes                                  (1)
//   dF_j = (F_j^mea - F_j^sim) / F_j^mea       j = 1..M deflections                            (2)
//   target = 1/2 (1/N sum |df_i| + 1/M sum |dF_j|^1/2)                                         (3)
//   [Hempel & Oertel 2016]
//
// Here every experiment e has a value T_e = mean |d|^k with an exponent k of its own, and the
// target is their weighted mean, target = sum w_e T_e / sum w_e; equal weights for one modal and
// one static experiment are the 1/2 of (3).
//
// The root in (3) is there because a frequency goes with the root of a stiffness, omega = sqrt(c /
// m) (4), a force with the stiffness itself. Taken literally (k = 1/2) it makes 14 % of a 2 % force
// error, which the results published with (3) do not show; they fit k = 1. What (4) argues for is
// done by comparing roots, d = (sqrt F_mea - sqrt F_sim) / sqrt F_mea. So both are settings of the
// objective, and mean |df| and mean |dF| are always reported beside the target.
//
// f_i^sim of modes of one n too close to tell apart are taken in the order of their frequencies
// (close_modes.h).
//
// A measured mode without a simulated partner counts as |df| = `missing_mode`, 1 unless set: as if
// simulated at 0 Hz.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "correlation/laboratory/measurement_noise.h"
#include "correlation/observable/curve_delay.h"
#include "correlation/observable/mode_pairing.h"

namespace latsch::correlation {

enum class Compared { force, root_force };

struct ObjectiveSettings {
  double weight = 1.0;                  // >= 0
  double exponent = 1.0;                // k > 0
  Compared compared = Compared::force;  // load-deflection experiments
  double missing_mode = 1.0;            // modal experiments
  PairingSettings pairing;              // modal experiments
};

/// One experiment's part of the target.
struct Comparison {
  double value = 0.0;       // T_e = mean |d|^k
  double mean_error = 0.0;  // mean |dF| or mean |df|, whatever is compared with whatever exponent
  double largest_error = 0.0;       // the largest |dF| or |df|
  std::vector<double> differences;  // d, signed, as compared
  std::vector<double> errors;       // signed dF_j or df_i as in (1), (2), one a measured value; a
                                    // missing mode: missing_mode
  ModePairing pairing;              // modal experiments
  std::vector<ComparedFrequency> compared = {};  // of modes: one a pair, as `pairing` has them
  /// d difference / d variable, a row a difference; empty: not known.
  std::vector<double> slopes = {};
  std::optional<FittedDelay> delay = {};  // of a curve whose delay is fitted
};

/// What a trial has in the place of measured values, with its slopes: Channel::slopes.
struct SimulatedValues {
  std::vector<double> values, slopes = {};
  std::vector<int> missing = {};  // modes that are not there: 0 stands in their place
  std::vector<ComparedFrequency> compared = {};  // of modes, as in a Comparison
  std::vector<int> mixed = {};  // modes whose partner has another name: take_mixed()
  std::optional<FittedDelay> delay = {};  // of a curve whose delay is fitted
};

/// Values that differ by d = (measured - simulated) / scale, a scale a value.
Comparison compare_values(const std::vector<double>& measured,
                          const SimulatedValues& simulated,
                          const std::vector<double>& scales,
                          const ObjectiveSettings& settings = {});

/// Forces at the same deflections. Measured forces are positive, N.
Comparison compare_forces(const std::vector<double>& measured,
                          const SimulatedValues& simulated,
                          const ObjectiveSettings& settings = {});

/// Measured frequencies are positive, Hz. `slopes` of the simulated ones as in Channel::slopes,
/// where known: which mode is compared with which is held while it is differentiated, and a mode
/// without a partner does not change.
Comparison compare_modes(const std::vector<ModeRecord>& measured,
                         const std::vector<ModeRecord>& simulated,
                         const ObjectiveSettings& settings = {},
                         const std::vector<double>& slopes = {});

/// d -> size loss(d / sigma) with its slopes; sigma empty: 1 for all.
void scale_by_noise(Comparison& comparison,
                    const std::vector<double>& sigma,
                    const RobustLoss& loss,
                    double size);

/// sum w_e T_e / sum w_e; the sum of the weights is positive.
double target(const std::vector<Comparison>& comparisons, const std::vector<double>& weights);

/// What kind of mean a target with these exponents is, with the error it stands for where they are
/// alike: "mean of the errors", "mean square of the errors, its root 2.45 %". A mean of squares of
/// 0.06 % belongs to errors of some 2.5 %.
std::string target_in_words(const std::vector<double>& exponents, double target);

/// sqrt(w_e / (N_e sum w)) d of every measured value: their sum of squares is the target for
/// exponents of 2. What a least-squares method minimizes in the place of another exponent.
std::vector<double> weighted_residuals(const std::vector<Comparison>& comparisons,
                                       const std::vector<double>& weights);
/// Their slopes, a row each; empty where those of one comparison are not known.
std::vector<double> weighted_slopes(const std::vector<Comparison>& comparisons,
                                    const std::vector<double>& weights);

}  // namespace latsch::correlation
