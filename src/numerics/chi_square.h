// SPDX-License-Identifier: Apache-2.0
// The chi-square distribution of a sum of squares of normal numbers.
//
//   F(x; nu) = P(nu / 2, x / 2)
//   P(a, z) = z^a e^-z sum_k z^k / Gamma(a + k + 1)                      z < a + 1   [8.7.1]
//           = 1 - z^a e^-z / Gamma(a) 1/(z +) (1 - a)/(1 +) 1/(z +) ...  else        [8.9.2]
//
// [NIST Digital Library of Mathematical Functions, chapter 8]; nu need not be a whole number.
#pragma once

namespace latsch::numerics {

/// Returns the probability that the sum of nu > 0 squares is below x >= 0.
double chi_square_probability(double x, double nu);

/// Returns the x that the sum of nu > 0 squares exceeds with probability 1 - p; 0 < p < 1.
double chi_square_quantile(double p, double nu);

/// Returns the quantile of the chi-square distribution for the probability with which a standard
/// normal number is below z. Above a thousand degrees of freedom the cube-root approximation of
/// Wilson and Hilferty is used [Proc. Nat. Acad. Sci. 17 (1931) 684]; its error there is a
/// thousandth of the standard deviation. At two degrees of freedom, the fewest that a line of a
/// spectrum has, its error would be one percent of the 95 % quantile.
double chi_square_at(double z, double nu);

}  // namespace latsch::numerics
