// SPDX-License-Identifier: Apache-2.0
// Student's t distribution of the error of a mean of few measurements.
//
//   F(t; nu) = 1 - 1/2 I_x(nu / 2, 1/2),   x = nu / (nu + t^2),   t >= 0     [A&S 26.7.1]
//
// I is the incomplete beta function, computed by its continued fraction [A&S 26.5.8]. nu may be
// infinite; it is then the normal distribution. [Abramowitz, Stegun, Handbook of Mathematical
// Functions, 1964]
#pragma once

namespace latsch::numerics {

/// Returns the probability that a t-distributed number with nu > 0 degrees of freedom is below t.
double student_t_probability(double t, double nu);

/// Returns the t that a t-distributed number with nu > 0 degrees of freedom exceeds with
/// probability 1 - p; 0 < p < 1.
double student_t_quantile(double p, double nu);

}  // namespace latsch::numerics
