// SPDX-License-Identifier: Apache-2.0
// Residuals and standard starts of the 22 test functions. Each function states its number in
//   [MGH]  Moré, Garbow, Hillstrom, Testing unconstrained optimization software,
//          ACM TOMS 7 (1981) 17; four functions are not in it but in [Moré & Wild 2009].
// Indices in the formulas count from 1 as in these papers. T is double, or Dual for derivatives.
#pragma once

#include <vector>

namespace latsch::more_wild {

using Vector = std::vector<double>;

template <class T>
std::vector<T> linear_full_rank(const std::vector<T>& x, int m);  // MGH 32
template <class T>
std::vector<T> linear_rank_one(const std::vector<T>& x, int m);  // MGH 33
template <class T>
std::vector<T> linear_rank_one_zeros(const std::vector<T>& x, int m);  // MGH 34
template <class T>
std::vector<T> rosenbrock(const std::vector<T>& x, int m);  // MGH 1
template <class T>
std::vector<T> helical_valley(const std::vector<T>& x, int m);  // MGH 7
template <class T>
std::vector<T> powell_singular(const std::vector<T>& x, int m);  // MGH 13
template <class T>
std::vector<T> freudenstein_roth(const std::vector<T>& x, int m);  // MGH 2
template <class T>
std::vector<T> bard(const std::vector<T>& x, int m);  // MGH 8
template <class T>
std::vector<T> kowalik_osborne(const std::vector<T>& x, int m);  // MGH 15
template <class T>
std::vector<T> meyer(const std::vector<T>& x, int m);  // MGH 10
template <class T>
std::vector<T> watson(const std::vector<T>& x, int m);  // MGH 20
template <class T>
std::vector<T> box_3d(const std::vector<T>& x, int m);  // MGH 12
template <class T>
std::vector<T> jennrich_sampson(const std::vector<T>& x, int m);  // MGH 6
template <class T>
std::vector<T> brown_dennis(const std::vector<T>& x, int m);  // MGH 16
template <class T>
std::vector<T> chebyquad(const std::vector<T>& x, int m);  // MGH 35
template <class T>
std::vector<T> brown_almost_linear(const std::vector<T>& x, int m);  // MGH 27
template <class T>
std::vector<T> osborne_1(const std::vector<T>& x, int m);  // MGH 17
template <class T>
std::vector<T> osborne_2(const std::vector<T>& x, int m);  // MGH 19
template <class T>
std::vector<T> bdqrtic(const std::vector<T>& x, int m);  // Conn, Gould, Toint 1994
template <class T>
std::vector<T> cube(const std::vector<T>& x, int m);  // Moré & Wild
template <class T>
std::vector<T> mancino(const std::vector<T>& x, int m);  // Mancino 1967, as Spedicato 1975
template <class T>
std::vector<T> heart_8(const std::vector<T>& x,
                       int m);  // dipole model of the heart, Dennis et al. 1985

Vector mancino_start(int n);

}  // namespace latsch::more_wild
