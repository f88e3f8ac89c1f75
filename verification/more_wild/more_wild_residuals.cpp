// SPDX-License-Identifier: Apache-2.0
#include "more_wild/more_wild_residuals.h"

#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "more_wild/dual.h"

namespace latsch::more_wild {
namespace {

using std::atan, std::cos, std::exp, std::hypot, std::log, std::pow, std::sin, std::sqrt;

template <class T>
constexpr T square(const T& a) {
  return a * a;
}

/// Returns the sum over j = first..last of  j x_j.
template <class T>
T weighted_sum(const std::vector<T>& x, int first, int last) {
  T sum = 0.0;
  for (int j = first; j <= last; ++j) sum += j * x[j - 1];
  return sum;
}

template <class T>
int size(const std::vector<T>& x) {
  return static_cast<int>(x.size());
}

/// Returns v (sin(ln v)^5 + cos(ln v)^5).
template <class T>
T mancino_term(const T& v) {
  return v * (pow(sin(log(v)), 5) + pow(cos(log(v)), 5));
}

}  // namespace

template <class T>
std::vector<T> linear_full_rank(const std::vector<T>& x, int m) {
  const T mean = 2.0 / m * std::accumulate(x.begin(), x.end(), T(0.0));
  std::vector<T> r(m, -mean - 1.0);
  for (int i = 0; i < size(x); ++i) r[i] += x[i];
  return r;
}

template <class T>
std::vector<T> linear_rank_one(const std::vector<T>& x, int m) {
  std::vector<T> r(m);
  for (int i = 1; i <= m; ++i) r[i - 1] = i * weighted_sum(x, 1, size(x)) - 1.0;
  return r;
}

template <class T>
std::vector<T> linear_rank_one_zeros(const std::vector<T>& x, int m) {
  std::vector<T> r(m, -1.0);
  for (int i = 2; i < m; ++i) r[i - 1] = (i - 1) * weighted_sum(x, 2, size(x) - 1) - 1.0;
  return r;
}

template <class T>
std::vector<T> rosenbrock(const std::vector<T>& x, int) {
  return {10.0 * (x[1] - square(x[0])), 1.0 - x[0]};
}

template <class T>
std::vector<T> helical_valley(const std::vector<T>& x, int) {
  // The angle, in turns, jumps across the negative x_2 axis between -1/4 and 3/4.
  T turn = 0.25;
  if (x[0] != 0.0) turn = atan(x[1] / x[0]) / (2.0 * std::numbers::pi);
  if (x[0] < 0.0) turn += 0.5;
  return {10.0 * (x[2] - 10.0 * turn), 10.0 * (hypot(x[0], x[1]) - 1.0), x[2]};
}

template <class T>
std::vector<T> powell_singular(const std::vector<T>& x, int) {
  return {x[0] + 10.0 * x[1],
          sqrt(5.0) * (x[2] - x[3]),
          square(x[1] - 2.0 * x[2]),
          sqrt(10.0) * square(x[0] - x[3])};
}

template <class T>
std::vector<T> freudenstein_roth(const std::vector<T>& x, int) {
  return {-13.0 + x[0] + ((5.0 - x[1]) * x[1] - 2.0) * x[1],
          -29.0 + x[0] + ((x[1] + 1.0) * x[1] - 14.0) * x[1]};
}

template <class T>
std::vector<T> bard(const std::vector<T>& x, int m) {
  constexpr std::array y{
      .14, .18, .22, .25, .29, .32, .35, .39, .37, .58, .73, .96, 1.34, 2.10, 4.39};
  std::vector<T> r(m);
  for (int i = 1; i <= m; ++i) {
    const double u = i, v = 16 - i, w = std::min(u, v);
    r[i - 1] = y[i - 1] - (x[0] + u / (v * x[1] + w * x[2]));
  }
  return r;
}

template <class T>
std::vector<T> kowalik_osborne(const std::vector<T>& x, int m) {
  constexpr std::array y{
      .1957, .1947, .1735, .1600, .0844, .0627, .0456, .0342, .0323, .0235, .0246};
  constexpr std::array u{4.0, 2.0, 1.0, .5, .25, .167, .125, .1, .0833, .0714, .0625};
  std::vector<T> r(m);
  for (int i = 0; i < m; ++i) {
    r[i] = y[i] - x[0] * (square(u[i]) + u[i] * x[1]) / (square(u[i]) + u[i] * x[2] + x[3]);
  }
  return r;
}

template <class T>
std::vector<T> meyer(const std::vector<T>& x, int m) {
  constexpr std::array<double, 16> y{34780,
                                     28610,
                                     23650,
                                     19630,
                                     16370,
                                     13720,
                                     11540,
                                     9744,
                                     8261,
                                     7030,
                                     6005,
                                     5147,
                                     4427,
                                     3820,
                                     3307,
                                     2872};
  std::vector<T> r(m);
  for (int i = 1; i <= m; ++i) r[i - 1] = x[0] * exp(x[1] / (45.0 + 5.0 * i + x[2])) - y[i - 1];
  return r;
}

template <class T>
std::vector<T> watson(const std::vector<T>& x, int m) {
  std::vector<T> r(m);
  for (int i = 1; i <= 29; ++i) {
    const double t = i / 29.0;
    T sum = 0.0, slope = 0.0;  // value and derivative at t of the polynomial with coefficients x
    for (int j = size(x); j >= 1; --j) {
      slope = slope * t + sum;
      sum = sum * t + x[j - 1];
    }
    r[i - 1] = slope - square(sum) - 1.0;
  }
  r[29] = x[0];
  r[30] = x[1] - square(x[0]) - 1.0;
  return r;
}

template <class T>
std::vector<T> box_3d(const std::vector<T>& x, int m) {
  std::vector<T> r(m);
  for (int i = 1; i <= m; ++i) {
    const double t = 0.1 * i;
    r[i - 1] = exp(-t * x[0]) - exp(-t * x[1]) - x[2] * (exp(-t) - exp(-10.0 * t));
  }
  return r;
}

template <class T>
std::vector<T> jennrich_sampson(const std::vector<T>& x, int m) {
  std::vector<T> r(m);
  for (int i = 1; i <= m; ++i) r[i - 1] = 2.0 + 2.0 * i - (exp(i * x[0]) + exp(i * x[1]));
  return r;
}

template <class T>
std::vector<T> brown_dennis(const std::vector<T>& x, int m) {
  std::vector<T> r(m);
  for (int i = 1; i <= m; ++i) {
    const double t = i / 5.0;
    r[i - 1] = square(x[0] + t * x[1] - exp(t)) + square(x[2] + x[3] * sin(t) - cos(t));
  }
  return r;
}

template <class T>
std::vector<T> chebyquad(const std::vector<T>& x, int m) {
  std::vector<T> r(m, 0.0);
  for (const T& x_j : x) {
    // Chebyshev polynomials on [0, 1]: the previous one and the present one
    T before = 1.0, now = 2.0 * x_j - 1.0;
    for (int i = 1; i <= m; ++i) {
      r[i - 1] += now / size(x);
      const T next = 2.0 * (2.0 * x_j - 1.0) * now - before;
      before = now;
      now = next;
    }
  }
  // subtracts the integrals of the polynomials of even degree
  for (int i = 2; i <= m; i += 2) r[i - 1] += 1.0 / (square(i) - 1.0);
  return r;
}

template <class T>
std::vector<T> brown_almost_linear(const std::vector<T>& x, int m) {
  const int n = size(x);
  const T sum = std::accumulate(x.begin(), x.end(), T(-(n + 1.0)));
  std::vector<T> r(m);
  for (int i = 0; i < n - 1; ++i) r[i] = x[i] + sum;
  r[n - 1] = std::accumulate(x.begin(), x.end(), T(1.0), std::multiplies<>()) - 1.0;
  return r;
}

template <class T>
std::vector<T> osborne_1(const std::vector<T>& x, int m) {
  constexpr std::array y{.844, .908, .932, .936, .925, .908, .881, .850, .818, .784, .751,
                         .718, .685, .658, .628, .603, .580, .558, .538, .522, .506, .490,
                         .478, .467, .457, .448, .438, .431, .424, .420, .414, .411, .406};
  std::vector<T> r(m);
  for (int i = 0; i < m; ++i) {
    const double t = 10.0 * i;
    r[i] = y[i] - (x[0] + x[1] * exp(-t * x[3]) + x[2] * exp(-t * x[4]));
  }
  return r;
}

template <class T>
std::vector<T> osborne_2(const std::vector<T>& x, int m) {
  constexpr std::array y{1.366, 1.191, 1.112, 1.013, .991, .885, .831, .847, .786, .725, .746,
                         .679,  .608,  .655,  .616,  .606, .602, .626, .651, .724, .649, .649,
                         .694,  .644,  .624,  .661,  .612, .558, .533, .495, .500, .423, .395,
                         .375,  .372,  .391,  .396,  .405, .428, .429, .523, .562, .607, .653,
                         .672,  .708,  .633,  .668,  .645, .632, .591, .559, .597, .625, .739,
                         .710,  .729,  .720,  .636,  .581, .428, .292, .162, .098, .054};
  std::vector<T> r(m);
  for (int i = 0; i < m; ++i) {
    const double t = i / 10.0;
    r[i] = y[i] - (x[0] * exp(-t * x[4]) + x[1] * exp(-square(t - x[8]) * x[5]) +
                   x[2] * exp(-square(t - x[9]) * x[6]) + x[3] * exp(-square(t - x[10]) * x[7]));
  }
  return r;
}

template <class T>
std::vector<T> bdqrtic(const std::vector<T>& x, int m) {
  const int terms = size(x) - 4;
  std::vector<T> r(m);
  for (int i = 0; i < terms; ++i) {
    r[i] = 3.0 - 4.0 * x[i];
    r[terms + i] = square(x[i]) + 2.0 * square(x[i + 1]) + 3.0 * square(x[i + 2]) +
                   4.0 * square(x[i + 3]) + 5.0 * square(x.back());
  }
  return r;
}

template <class T>
std::vector<T> cube(const std::vector<T>& x, int m) {
  std::vector<T> r(m, x[0] - 1.0);
  for (int i = 1; i < m; ++i) r[i] = 10.0 * (x[i] - x[i - 1] * x[i - 1] * x[i - 1]);
  return r;
}

template <class T>
std::vector<T> mancino(const std::vector<T>& x, int m) {
  std::vector<T> r(m);
  for (int i = 1; i <= m; ++i) {
    r[i - 1] = 1400.0 * x[i - 1] + pow(i - 50.0, 3);
    for (int j = 1; j <= size(x); ++j) {
      r[i - 1] += mancino_term(sqrt(square(x[i - 1]) + static_cast<double>(i) / j));
    }
  }
  return r;
}

Vector mancino_start(int n) {
  constexpr double kFactor = -8.710996e-4;
  Vector start(n);
  for (int i = 1; i <= n; ++i) {
    double sum = pow(i - 50.0, 3);
    for (int j = 1; j <= n; ++j) sum += mancino_term(sqrt(static_cast<double>(i) / j));
    start[i - 1] = kFactor * sum;
  }
  return start;
}

template <class T>
std::vector<T> heart_8(const std::vector<T>& x, int) {
  const T a = x[0], b = x[1], c = x[2], d = x[3], t = x[4], u = x[5], v = x[6], w = x[7];
  return {a + b + 0.69,
          c + d + 0.044,
          t * a + u * b - v * c - w * d + 1.57,
          v * a + w * b + t * c + u * d + 1.31,
          a * (t * t - v * v) - 2.0 * c * t * v + b * (u * u - w * w) - 2.0 * d * u * w + 2.65,
          c * (t * t - v * v) + 2.0 * a * t * v + d * (u * u - w * w) + 2.0 * b * u * w - 2.0,
          a * t * (t * t - 3.0 * v * v) + c * v * (v * v - 3.0 * t * t) +
              b * u * (u * u - 3.0 * w * w) + d * w * (w * w - 3.0 * u * u) + 12.6,
          c * t * (t * t - 3.0 * v * v) - a * v * (v * v - 3.0 * t * t) +
              d * u * (u * u - 3.0 * w * w) - b * w * (w * w - 3.0 * u * u) - 9.48};
}

#define LATSCH_INSTANTIATE(f)                                      \
  template std::vector<double> f(const std::vector<double>&, int); \
  template std::vector<Dual> f(const std::vector<Dual>&, int)
LATSCH_INSTANTIATE(linear_full_rank);
LATSCH_INSTANTIATE(linear_rank_one);
LATSCH_INSTANTIATE(linear_rank_one_zeros);
LATSCH_INSTANTIATE(rosenbrock);
LATSCH_INSTANTIATE(helical_valley);
LATSCH_INSTANTIATE(powell_singular);
LATSCH_INSTANTIATE(freudenstein_roth);
LATSCH_INSTANTIATE(bard);
LATSCH_INSTANTIATE(kowalik_osborne);
LATSCH_INSTANTIATE(meyer);
LATSCH_INSTANTIATE(watson);
LATSCH_INSTANTIATE(box_3d);
LATSCH_INSTANTIATE(jennrich_sampson);
LATSCH_INSTANTIATE(brown_dennis);
LATSCH_INSTANTIATE(chebyquad);
LATSCH_INSTANTIATE(brown_almost_linear);
LATSCH_INSTANTIATE(osborne_1);
LATSCH_INSTANTIATE(osborne_2);
LATSCH_INSTANTIATE(bdqrtic);
LATSCH_INSTANTIATE(cube);
LATSCH_INSTANTIATE(mancino);
LATSCH_INSTANTIATE(heart_8);
#undef LATSCH_INSTANTIATE

}  // namespace latsch::more_wild
