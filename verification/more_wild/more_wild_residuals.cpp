// SPDX-License-Identifier: Apache-2.0
#include "more_wild/more_wild_residuals.h"

#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

namespace latsch::more_wild {
namespace {

constexpr double square(double a) { return a * a; }

/// sum over j = first..last of  j x_j
double weighted_sum(const Vector& x, int first, int last) {
  double sum = 0.0;
  for (int j = first; j <= last; ++j) sum += j * x[j - 1];
  return sum;
}

int size(const Vector& x) { return static_cast<int>(x.size()); }

/// v (sin(ln v)^5 + cos(ln v)^5)
double mancino_term(double v) {
  return v * (std::pow(std::sin(std::log(v)), 5) + std::pow(std::cos(std::log(v)), 5));
}

}  // namespace

Vector linear_full_rank(const Vector& x, int m) {
  const double mean = 2.0 / m * std::accumulate(x.begin(), x.end(), 0.0);
  Vector r(m, -mean - 1.0);
  for (int i = 0; i < size(x); ++i) r[i] += x[i];
  return r;
}

Vector linear_rank_one(const Vector& x, int m) {
  Vector r(m);
  for (int i = 1; i <= m; ++i) r[i - 1] = i * weighted_sum(x, 1, size(x)) - 1.0;
  return r;
}

Vector linear_rank_one_zeros(const Vector& x, int m) {
  Vector r(m, -1.0);
  for (int i = 2; i < m; ++i) r[i - 1] = (i - 1) * weighted_sum(x, 2, size(x) - 1) - 1.0;
  return r;
}

Vector rosenbrock(const Vector& x, int) { return {10.0 * (x[1] - square(x[0])), 1.0 - x[0]}; }

Vector helical_valley(const Vector& x, int) {
  // Its angle jumps across the negative x_2 axis, between -1/4 and 3/4 of a turn.
  double turn = 0.25;
  if (x[0] != 0.0) turn = std::atan(x[1] / x[0]) / (2.0 * std::numbers::pi);
  if (x[0] < 0.0) turn += 0.5;
  return {10.0 * (x[2] - 10.0 * turn), 10.0 * (std::hypot(x[0], x[1]) - 1.0), x[2]};
}

Vector powell_singular(const Vector& x, int) {
  return {x[0] + 10.0 * x[1],
          std::sqrt(5.0) * (x[2] - x[3]),
          square(x[1] - 2.0 * x[2]),
          std::sqrt(10.0) * square(x[0] - x[3])};
}

Vector freudenstein_roth(const Vector& x, int) {
  return {-13.0 + x[0] + ((5.0 - x[1]) * x[1] - 2.0) * x[1],
          -29.0 + x[0] + ((x[1] + 1.0) * x[1] - 14.0) * x[1]};
}

Vector bard(const Vector& x, int m) {
  constexpr std::array y{
      .14, .18, .22, .25, .29, .32, .35, .39, .37, .58, .73, .96, 1.34, 2.10, 4.39};
  Vector r(m);
  for (int i = 1; i <= m; ++i) {
    const double u = i, v = 16 - i, w = std::min(u, v);
    r[i - 1] = y[i - 1] - (x[0] + u / (v * x[1] + w * x[2]));
  }
  return r;
}

Vector kowalik_osborne(const Vector& x, int m) {
  constexpr std::array y{
      .1957, .1947, .1735, .1600, .0844, .0627, .0456, .0342, .0323, .0235, .0246};
  constexpr std::array u{4.0, 2.0, 1.0, .5, .25, .167, .125, .1, .0833, .0714, .0625};
  Vector r(m);
  for (int i = 0; i < m; ++i) {
    r[i] = y[i] - x[0] * (square(u[i]) + u[i] * x[1]) / (square(u[i]) + u[i] * x[2] + x[3]);
  }
  return r;
}

Vector meyer(const Vector& x, int m) {
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
  Vector r(m);
  for (int i = 1; i <= m; ++i)
    r[i - 1] = x[0] * std::exp(x[1] / (45.0 + 5.0 * i + x[2])) - y[i - 1];
  return r;
}

Vector watson(const Vector& x, int m) {
  Vector r(m);
  for (int i = 1; i <= 29; ++i) {
    const double t = i / 29.0;
    double sum = 0.0, slope = 0.0;  // of the polynomial with coefficients x at t
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

Vector box_3d(const Vector& x, int m) {
  Vector r(m);
  for (int i = 1; i <= m; ++i) {
    const double t = 0.1 * i;
    r[i - 1] =
        std::exp(-t * x[0]) - std::exp(-t * x[1]) - x[2] * (std::exp(-t) - std::exp(-10.0 * t));
  }
  return r;
}

Vector jennrich_sampson(const Vector& x, int m) {
  Vector r(m);
  for (int i = 1; i <= m; ++i) r[i - 1] = 2.0 + 2.0 * i - (std::exp(i * x[0]) + std::exp(i * x[1]));
  return r;
}

Vector brown_dennis(const Vector& x, int m) {
  Vector r(m);
  for (int i = 1; i <= m; ++i) {
    const double t = i / 5.0;
    r[i - 1] =
        square(x[0] + t * x[1] - std::exp(t)) + square(x[2] + x[3] * std::sin(t) - std::cos(t));
  }
  return r;
}

Vector chebyquad(const Vector& x, int m) {
  Vector r(m, 0.0);
  for (const double x_j : x) {
    double before = 1.0, T = 2.0 * x_j - 1.0;  // Chebyshev polynomials on [0, 1]
    for (int i = 1; i <= m; ++i) {
      r[i - 1] += T / size(x);
      const double next = 2.0 * (2.0 * x_j - 1.0) * T - before;
      before = T;
      T = next;
    }
  }
  for (int i = 2; i <= m; i += 2) r[i - 1] += 1.0 / (square(i) - 1.0);  // minus their integrals
  return r;
}

Vector brown_almost_linear(const Vector& x, int m) {
  const int n = size(x);
  const double sum = std::accumulate(x.begin(), x.end(), -(n + 1.0));
  Vector r(m);
  for (int i = 0; i < n - 1; ++i) r[i] = x[i] + sum;
  r[n - 1] = std::accumulate(x.begin(), x.end(), 1.0, std::multiplies<>()) - 1.0;
  return r;
}

Vector osborne_1(const Vector& x, int m) {
  constexpr std::array y{.844, .908, .932, .936, .925, .908, .881, .850, .818, .784, .751,
                         .718, .685, .658, .628, .603, .580, .558, .538, .522, .506, .490,
                         .478, .467, .457, .448, .438, .431, .424, .420, .414, .411, .406};
  Vector r(m);
  for (int i = 0; i < m; ++i) {
    const double t = 10.0 * i;
    r[i] = y[i] - (x[0] + x[1] * std::exp(-t * x[3]) + x[2] * std::exp(-t * x[4]));
  }
  return r;
}

Vector osborne_2(const Vector& x, int m) {
  constexpr std::array y{1.366, 1.191, 1.112, 1.013, .991, .885, .831, .847, .786, .725, .746,
                         .679,  .608,  .655,  .616,  .606, .602, .626, .651, .724, .649, .649,
                         .694,  .644,  .624,  .661,  .612, .558, .533, .495, .500, .423, .395,
                         .375,  .372,  .391,  .396,  .405, .428, .429, .523, .562, .607, .653,
                         .672,  .708,  .633,  .668,  .645, .632, .591, .559, .597, .625, .739,
                         .710,  .729,  .720,  .636,  .581, .428, .292, .162, .098, .054};
  Vector r(m);
  for (int i = 0; i < m; ++i) {
    const double t = i / 10.0;
    r[i] = y[i] -
           (x[0] * std::exp(-t * x[4]) + x[1] * std::exp(-square(t - x[8]) * x[5]) +
            x[2] * std::exp(-square(t - x[9]) * x[6]) + x[3] * std::exp(-square(t - x[10]) * x[7]));
  }
  return r;
}

Vector bdqrtic(const Vector& x, int m) {
  const int terms = size(x) - 4;
  Vector r(m);
  for (int i = 0; i < terms; ++i) {
    r[i] = 3.0 - 4.0 * x[i];
    r[terms + i] = square(x[i]) + 2.0 * square(x[i + 1]) + 3.0 * square(x[i + 2]) +
                   4.0 * square(x[i + 3]) + 5.0 * square(x.back());
  }
  return r;
}

Vector cube(const Vector& x, int m) {
  Vector r(m, x[0] - 1.0);
  for (int i = 1; i < m; ++i) r[i] = 10.0 * (x[i] - x[i - 1] * x[i - 1] * x[i - 1]);
  return r;
}

Vector mancino(const Vector& x, int m) {
  Vector r(m);
  for (int i = 1; i <= m; ++i) {
    r[i - 1] = 1400.0 * x[i - 1] + std::pow(i - 50.0, 3);
    for (int j = 1; j <= size(x); ++j) {
      r[i - 1] += mancino_term(std::sqrt(square(x[i - 1]) + static_cast<double>(i) / j));
    }
  }
  return r;
}

Vector mancino_start(int n) {
  constexpr double kFactor = -8.710996e-4;
  Vector start(n);
  for (int i = 1; i <= n; ++i) {
    double sum = std::pow(i - 50.0, 3);
    for (int j = 1; j <= n; ++j) sum += mancino_term(std::sqrt(static_cast<double>(i) / j));
    start[i - 1] = kFactor * sum;
  }
  return start;
}

Vector heart_8(const Vector& x, int) {
  const double a = x[0], b = x[1], c = x[2], d = x[3], t = x[4], u = x[5], v = x[6], w = x[7];
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

}  // namespace latsch::more_wild
