// SPDX-License-Identifier: Apache-2.0
// Prony series of a linear viscoelastic stress: a generalized Maxwell model,
//   S = S_vol + S_iso + sum_i H_i,   H_i' + H_i/tau_i = beta_i S_iso'                         (H.1)
// with the time derivative along the material. S_iso is the relaxed stress, so beta_i is the share
// of a term relative to the relaxed modulus. Storage and loss of a modulus at the angular frequency
// omega, relative to the relaxed modulus, are
//   1 + sum beta_i (omega tau_i)^2/(1 + (omega tau_i)^2),
//   sum beta_i omega tau_i/(1 + (omega tau_i)^2).
// [Simo, CMAME 60 (1987) 153-173]
// A loss factor that is constant over a band is a series with one term a decade: shares beta_i by
// least squares. Within the band the loss factor ripples by some percent about its value, below and
// above the band it falls.
#pragma once

#include <complex>
#include <string>
#include <vector>

#include "base/result.h"

namespace latsch::fe_tire {

/// A relaxing part of a stress.
struct PronyTerm {
  double beta;  // share, relative to the relaxed modulus
  double tau;   // s, relaxation time
  bool operator==(const PronyTerm&) const = default;
};

/// Terms relative to the relaxed modulus; none: the stress is elastic.
using PronyTerms = std::vector<PronyTerm>;

/// Largest sum of shares that is accepted. Rubber from rest to the glassy state has more, but not
/// in a tire's frequencies; a larger sum mostly is a mistake of units.
inline constexpr double kMostProny = 50.0;

/// Says what is wrong with the terms: a share below 0, a time that is not positive, two times that
/// are alike, or a sum of shares above kMostProny.
Status check(const PronyTerms& terms);

/// Returns the terms whose shares `unrelaxed`, in place of beta, are relative to the unrelaxed
/// modulus: beta = g/(1 - sum g). A Failure says if a sum of 1 or more leaves no relaxed modulus.
Result<PronyTerms> from_unrelaxed(const PronyTerms& unrelaxed);

/// Returns the modulus at an angular frequency omega, rad/s, over the relaxed one: storage + i
/// loss.
std::complex<double> relative_modulus(const PronyTerms& terms, double omega);

/// Returns the term's part of relative_modulus().
std::complex<double> relative_modulus(const PronyTerm& term, double omega);

/// Returns terms with the given loss factor (tangent of the loss angle, 0 to 1) from the frequency
/// `lowest` to `highest`, Hz: one term a decade, the first and the last at the ends of the band. A
/// Failure says which argument is out of range.
Result<PronyTerms> constant_loss_factor(double loss_factor, double lowest, double highest);

}  // namespace latsch::fe_tire
