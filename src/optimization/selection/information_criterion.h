// SPDX-License-Identifier: Apache-2.0
// Criteria that compare models with different numbers of coefficients, fitted to the same values.
//
//   -2 log L = S / s^2          if the noise s is stated, with S the sum of squares of whitened
//                               residuals, or
//   -2 log L = m ln(S / m)      if s is estimated from the m residuals, both up to a constant
//   BIC  = -2 log L + k ln m_e                          [Schwarz, Ann. Stat. 6 (1978) 461]
//   AICc = -2 log L + 2 k + 2 k (k + 1) / (m_e - k - 1) [Hurvich, Tsai, Biometrika 76 (1989) 297]
//
// k is the number of coefficients, one more if s is estimated. m_e is the number of independent
// values: neighbors that share noise count as correspondingly fewer. BIC keeps a useless
// coefficient with a chance that vanishes as values become many; AICc keeps about one of six, but
// predicts better if no model is true.
#pragma once

#include <string>

namespace latsch {

enum class SelectionCriterion { bic, aicc, cross_validation };

/// The values to which all models of a comparison are fitted.
struct CountedValues {
  double values = 0.0;       // m
  double independent = 0.0;  // m_e
  bool noise_known = false;  // true: the whitened residuals have the deviation 1
};

/// Returns -2 log L up to a constant. S is positive.
double minus_two_log_likelihood(double S, const CountedValues& counted);

/// Returns BIC for k coefficients.
double bic(double minus_two_log, int k, const CountedValues& counted);

/// Returns AICc for k coefficients; infinite if there are no more independent values than k + 1.
double aicc(double minus_two_log, int k, const CountedValues& counted);

/// Returns the name for people: "BIC", "AICc", "the squared error of recordings left out".
std::string in_words(SelectionCriterion criterion);

}  // namespace latsch
