// SPDX-License-Identifier: Apache-2.0
// The target function: relative distance of a simulation from the measurement; 0 is perfect.
//
//   df_i = (f_i^mea - f_i^sim) / f_i^mea       i = 1..N modes                                  (1)
//   dF_j = (F_j^mea - F_j^sim) / F_j^mea       j = 1..M deflections                            (2)
//   target = 1/2 (1/N sum |df_i| + 1/M sum |dF_j|^1/2)                                         (3)
//   [Hempel & Oertel 2016]
//
// Here every experiment e has a value T_e = mean |d|^k with an exponent k of its own, and the
// target is their weighted mean, target = sum w_e T_e / sum w_e. Equal weights for one modal and
// one static experiment are the 1/2 of (3).
//
// The root in (3) is there because a frequency depends on the root of a stiffness, omega = sqrt(c /
// m) (4), a force on the stiffness itself. Taken literally (k = 1/2), the root turns a 2 % force
// error into 14 %, which the results published with (3) do not show; they fit k = 1. The purpose of
// (4) is met by comparing roots, d = (sqrt F_mea - sqrt F_sim) / sqrt F_mea. Therefore both are
// settings of the objective, and mean |df| and mean |dF| are always reported beside the target.
//
// For modes of one n that are too close to be distinguished, f_i^sim are taken in the order of
// their frequencies (close_modes.h).
//
// A measured mode without a simulated partner counts as |df| = `missing_mode`, 1 unless set, as if
// it were simulated at 0 Hz.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "correlation/laboratory/measurement_noise.h"
#include "correlation/observable/curve_delay.h"
#include "correlation/observable/mode_pairing.h"
#include "correlation/observable/solved_nuisance.h"

namespace latsch::correlation {

enum class Compared { force, root_force };

struct ObjectiveSettings {
  double weight = 1.0;                  // >= 0
  double exponent = 1.0;                // k > 0
  Compared compared = Compared::force;  // used by load-deflection experiments
  /// Error |df| that counts for a measured mode without a simulated partner; used by modal
  /// experiments.
  double missing_mode = 1.0;
  PairingSettings pairing;  // used by modal experiments
};

/// The part of one experiment in the target.
struct Comparison {
  double value = 0.0;          // T_e = mean |d|^k
  double mean_error = 0.0;     // mean |dF| or mean |df|, independent of `compared` and exponent
  double largest_error = 0.0;  // the largest |dF| or |df|
  std::vector<double> differences;  // d, signed, as compared
  /// Signed dF_j or df_i as in (1), (2), one for each measured value; missing_mode for a missing
  /// mode.
  std::vector<double> errors;
  ModePairing pairing;  // for modal experiments
  /// for modes: one for each pair, in the order of `pairing`
  std::vector<ComparedFrequency> compared = {};
  /// Derivatives of the differences by the variables, one row for each difference; empty: not
  /// known.
  std::vector<double> slopes = {};
  std::optional<FittedDelay> delay = {};  // for a curve whose delay is fitted
  /// d difference / d shift of the abscissa, for a comparison at a stated shift
  std::vector<double> by_shift = {};
  std::vector<SolvedNumber> nuisance = {};  // nuisance numbers of the recording in this trial
};

/// Computes value, mean and largest error anew from differences and errors.
void summarize(Comparison& comparison, const ObjectiveSettings& settings);

/// Simulated counterparts of the measured values, with their slopes as in Channel::slopes.
struct SimulatedValues {
  std::vector<double> values, slopes = {};
  std::vector<int> missing = {};  // indices of modes that were not simulated; their value is 0
  std::vector<ComparedFrequency> compared = {};  // for modes, as in a Comparison
  std::vector<int> mixed = {};  // indices of modes whose partner has another name, see take_mixed()
  std::optional<FittedDelay> delay = {};  // for a curve whose delay is fitted
};

/// Compares values by d = (measured - simulated) / scale, with one scale for each value.
Comparison compare_values(const std::vector<double>& measured,
                          const SimulatedValues& simulated,
                          const std::vector<double>& scales,
                          const ObjectiveSettings& settings = {});

/// Compares forces at equal deflections. Measured forces are positive, N.
Comparison compare_forces(const std::vector<double>& measured,
                          const SimulatedValues& simulated,
                          const ObjectiveSettings& settings = {});

/// Compares frequencies; measured ones are positive, Hz. `slopes` are the derivatives of the
/// simulated ones, as in Channel::slopes, if known. For the derivatives the pairing is assumed to
/// stay the same, and a mode without a partner does not change.
Comparison compare_modes(const std::vector<ModeRecord>& measured,
                         const std::vector<ModeRecord>& simulated,
                         const ObjectiveSettings& settings = {},
                         const std::vector<double>& slopes = {});

/// Replaces each difference d by the size of loss(d / sigma), and its derivatives accordingly. An
/// empty `sigma` means 1 for all.
void scale_by_noise(Comparison& comparison,
                    const std::vector<double>& sigma,
                    const RobustLoss& loss,
                    double size);

/// Returns sum w_e T_e / sum w_e. The sum of the weights must be positive.
double target(const std::vector<Comparison>& comparisons, const std::vector<double>& weights);

/// Returns in words which kind of mean a target with these exponents is and, if all exponents are
/// equal, the corresponding error: "mean of the errors", "mean square of the errors, its root 2.45
/// %". A mean square of 0.06 % corresponds to errors of about 2.5 %.
std::string target_in_words(const std::vector<double>& exponents, double target);

/// Returns sqrt(w_e / (N_e sum w)) d for every measured value. If all exponents are 2, the sum of
/// squares of these residuals is the target. For other exponents a least-squares method minimizes
/// this sum instead of the target.
std::vector<double> weighted_residuals(const std::vector<Comparison>& comparisons,
                                       const std::vector<double>& weights);
/// Returns the slopes of the weighted residuals, one row for each; empty if those of one comparison
/// are not known.
std::vector<double> weighted_slopes(const std::vector<Comparison>& comparisons,
                                    const std::vector<double>& weights);

}  // namespace latsch::correlation
