// SPDX-License-Identifier: Apache-2.0
// Residuals and standard starts of the functions, each with its number in
//   [MGH]  Moré, Garbow, Hillstrom, Testing unconstrained optimization software,
//          ACM TOMS 7 (1981) 17, and the four of [Moré & Wild 2009] that are not in it.
// Indices in the formulas count from 1 as there.
#pragma once

#include <vector>

namespace latsch::more_wild {

using Vector = std::vector<double>;

Vector linear_full_rank(const Vector& x, int m);       // MGH 32
Vector linear_rank_one(const Vector& x, int m);        // MGH 33
Vector linear_rank_one_zeros(const Vector& x, int m);  // MGH 34
Vector rosenbrock(const Vector& x, int m);             // MGH 1
Vector helical_valley(const Vector& x, int m);         // MGH 7
Vector powell_singular(const Vector& x, int m);        // MGH 13
Vector freudenstein_roth(const Vector& x, int m);      // MGH 2
Vector bard(const Vector& x, int m);                   // MGH 8
Vector kowalik_osborne(const Vector& x, int m);        // MGH 15
Vector meyer(const Vector& x, int m);                  // MGH 10
Vector watson(const Vector& x, int m);                 // MGH 20
Vector box_3d(const Vector& x, int m);                 // MGH 12
Vector jennrich_sampson(const Vector& x, int m);       // MGH 6
Vector brown_dennis(const Vector& x, int m);           // MGH 16
Vector chebyquad(const Vector& x, int m);              // MGH 35
Vector brown_almost_linear(const Vector& x, int m);    // MGH 27
Vector osborne_1(const Vector& x, int m);              // MGH 17
Vector osborne_2(const Vector& x, int m);              // MGH 19
Vector bdqrtic(const Vector& x, int m);                // Conn, Gould, Toint 1994
Vector cube(const Vector& x, int m);                   // Moré & Wild
Vector mancino(const Vector& x, int m);                // Mancino 1967, as Spedicato 1975
Vector heart_8(const Vector& x, int m);  // dipole model of the heart, Dennis et al. 1985

Vector mancino_start(int n);

}  // namespace latsch::more_wild
