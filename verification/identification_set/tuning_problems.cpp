// SPDX-License-Identifier: Apache-2.0
// The half of the identification problems on which a method may be tuned.
#include <Eigen/Core>
#include <cmath>
#include <complex>
#include <numbers>

#include "base/random.h"
#include "identification_set/identification_problems.h"
#include "numerics/dense/self_adjoint_eigen.h"

namespace latsch::identification_set {
namespace {

using std::exp, std::sin, std::cos, std::atan, std::pow, std::sqrt, std::abs, std::tanh;

Model curve(const Vector& t, const std::function<double(double, const Vector&)>& y) {
  return [t, y](const Vector& x) {
    Vector values;
    for (const double at : t) values.push_back(y(at, x));
    return values;
  };
}

/// Natural frequencies of a chain of five masses and springs whose first spring is fixed to the
/// ground, and three static forces.
Vector chain(const Vector& k) {
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(5, 5);
  for (int i = 0; i < 5; ++i) {
    K(i, i) += k[i];
    if (i == 0) continue;
    K(i - 1, i - 1) += k[i];
    K(i, i - 1) -= k[i];
    K(i - 1, i) -= k[i];
  }
  Vector values;
  for (const double square : numerics::self_adjoint_eigenvalues(K)) values.push_back(sqrt(square));
  values.push_back(0.2 * (k[0] + k[1]));
  values.push_back(0.2 * (k[2] * k[3]) / (k[2] + k[3]) + 0.1 * k[0]);
  values.push_back(0.3 * k[4]);
  return values;
}

/// Displacements of body and wheel of a quarter-car model over a bump.
Vector quarter_car(const Vector& x) {
  // k, c and kt are divided by the mass of the body; mu is the mass ratio
  const double k = x[0], c = x[1], kt = x[2], mu = x[3];
  const auto states = integrate(
      [&](double t, const Vector& y) {
        const double road = t < 0.1 ? 0.5 * (1.0 - cos(20.0 * std::numbers::pi * t)) : 0.0;
        const double spring = k * (y[1] - y[0]) + c * (y[3] - y[2]);
        return Vector{y[2], y[3], spring, (kt * (road - y[1]) - spring) / mu};
      },
      {0, 0, 0, 0},
      grid(0.0, 1.5, 61),
      4);
  Vector values;
  for (const Vector& y : states) {
    values.push_back(y[0]);
    values.push_back(0.3 * y[1]);
  }
  return values;
}

/// Force of a Bouc-Wen hysteresis element at two amplitudes.
Vector bouc_wen(const Vector& x) {
  const Vector times = grid(0.0, 2.0, 81);
  const auto motion = [](double t) {
    return (t < 1.0 ? 1.0 : 0.4) * sin(2.0 * std::numbers::pi * t);
  };
  const auto speed = [](double t) {
    return (t < 1.0 ? 1.0 : 0.4) * 2.0 * std::numbers::pi * cos(2.0 * std::numbers::pi * t);
  };
  const auto states = integrate(
      [&](double t, const Vector& z) {
        const double v = speed(t);
        return Vector{x[1] * v - x[2] * abs(v) * z[0] * abs(z[0]) - x[3] * v * z[0] * z[0]};
      },
      {0.0},
      times,
      6);
  Vector values;
  for (std::size_t i = 0; i < times.size(); ++i) {
    values.push_back(x[0] * motion(times[i]) + states[i][0]);
  }
  return values;
}

Vector lotka_volterra(const Vector& x) {
  const auto states = integrate(
      [&](double, const Vector& y) {
        return Vector{y[0] * (x[0] - x[1] * y[1]), y[1] * (x[2] * y[0] - x[3])};
      },
      {1.0, 0.5},
      grid(0.0, 10.0, 31),
      10);
  Vector values;
  for (const Vector& y : states) values.insert(values.end(), y.begin(), y.end());
  return values;
}

/// Sixteen frequencies and four forces, which depend on twelve stiffnesses in different shares.
Vector twelve_stiffnesses(const Vector& E) {
  Vector values;
  for (int i = 0; i < 20; ++i) {
    RandomStream weight(3, i);
    double sum = 1e-3, simulated = 1.0;
    Vector w;
    for (std::size_t k = 0; k < E.size(); ++k) sum += w.emplace_back(pow(weight.uniform(), 3));
    for (std::size_t k = 0; k < E.size(); ++k) {
      simulated += 0.9 * w[k] / sum * (pow(E[k], i < 16 ? 1.0 : 0.7) - 1.0);
    }
    values.push_back(i < 16 ? sqrt(simulated) : simulated);
  }
  return values;
}

/// Loads at five radii that depend on the sum of three moduli and hardly on each modulus alone.
Vector hardly_three(const Vector& x) {
  Vector values;
  for (int i = 0; i < 5; ++i) {
    const double d = 0.3 + 0.15 * i;
    const double carcass = pow(x[0], 0.02), wall = pow(x[1], 0.12), tread = 1.0 + 0.05 * x[2];
    values.push_back(d * (1.0 + 0.4 * d * wall + 0.05 * carcass) * (1.0 - 0.02 * d * tread * wall));
  }
  return values;
}

/// Frequencies of a ring on an elastic foundation as functions of its tension, its bending
/// stiffness and two foundation stiffnesses.
Vector ring_frequencies(const Vector& x) {
  Vector values;
  for (int n = 1; n <= 9; ++n) {
    const double s = n * n, bending = x[0] * s * (s - 1.0) * (s - 1.0);
    const double tension = x[1] * (s - 1.0) * s, foundation = x[2] * s + x[3];
    values.push_back(sqrt((bending + tension + foundation) / (1.0 + s) + 0.02 * x[4] * s));
  }
  return values;
}

Vector three_peaks_complex(const Vector& x) {
  Vector values;
  for (const double w : grid(0.3, 3.0, 55)) {
    std::complex<double> sum = 0.0;
    for (int k = 0; k < 3; ++k) {
      const double a = x[3 * k], w0 = x[3 * k + 1], zeta = x[3 * k + 2];
      sum += a / std::complex<double>(w0 * w0 - w * w, 2.0 * zeta * w0 * w);
    }
    values.push_back(sum.real());
    values.push_back(sum.imag());
  }
  return values;
}

std::vector<Problem> written_down() {
  std::vector<Problem> all;
  all.push_back(fitted(
      "two decays",
      {{"a", 0, 5, 1, 2.0}, {"k", 0.05, 5, 0.3, 0.5}, {"b", 0, 5, 1, 1.2}, {"l", 0.5, 50, 10, 3.0}},
      curve(grid(0, 4, 41), [](double t, const Vector& x) {
        return x[0] * exp(-x[1] * t) + x[2] * exp(-x[3] * t);
      })));
  all.push_back(fitted("lateral force",
                       {{"B", 3, 30, 6, 11.0},
                        {"C", 1, 2, 1.7, 1.35},
                        {"D", 0.4, 2, 0.8, 1.15},
                        {"E", -3, 1, 0.5, -0.6},
                        {"H", -0.03, 0.03, 0, 0.006},
                        {"V", -0.2, 0.2, 0, 0.03}},
                       curve(grid(-0.25, 0.25, 41),
                             [](double t, const Vector& x) {
                               const double s = x[0] * (t + x[4]);
                               return x[2] * sin(x[1] * atan(s - x[3] * (s - atan(s)))) + x[5];
                             }),
                       5e-3));
  all.push_back(fitted("one resonance",
                       {{"m", 0.2, 5, 1, 1.7}, {"c", 0.01, 1, 0.3, 0.09}, {"k", 0.2, 20, 1, 3.1}},
                       [](const Vector& x) {
                         Vector values;
                         for (const double w : grid(0.2, 3.0, 40)) {
                           const auto H = 1.0 / std::complex<double>(x[2] - x[0] * w * w, x[1] * w);
                           values.push_back(H.real());
                           values.push_back(H.imag());
                         }
                         return values;
                       }));
  all.push_back(fitted("quarter car",
                       {{"k", 10, 1000, 50, 180},
                        {"c", 0.3, 30, 2, 7},
                        {"kt", 100, 10000, 800, 2500},
                        {"mu", 0.03, 0.5, 0.2, 0.11}},
                       quarter_car));
  all.push_back(fitted("hysteresis",
                       {{"k", 0, 4, 2, 0.7},
                        {"A", 0.3, 30, 2, 6.0},
                        {"beta", 0.05, 20, 3, 1.1},
                        {"gamma", -3, 6, 0, 0.8}},
                       bouc_wen));
  all.push_back(fitted("ratio of polynomials",
                       {{"a0", -5, 5, 0, 1.2},
                        {"a1", -5, 5, 0, -2.0},
                        {"a2", -5, 5, 0, 1.4},
                        {"b1", -0.9, 5, 1, -0.5},
                        {"b2", 0, 5, 2, 0.9}},
                       curve(grid(0, 2, 31), [](double t, const Vector& x) {
                         return (x[0] + x[1] * t + x[2] * t * t) / (1 + x[3] * t + x[4] * t * t);
                       })));
  all.push_back(fitted("five springs",
                       {{"k1", 0.2, 5, 1, 2.0},
                        {"k2", 0.2, 5, 1, 0.6},
                        {"k3", 0.2, 5, 1, 3.0},
                        {"k4", 0.2, 5, 1, 1.5},
                        {"k5", 0.2, 5, 1, 0.4}},
                       chain));
  all.push_back(fitted("storage and loss modulus",
                       {{"E0", 0.1, 10, 2, 1.0},
                        {"E1", 0.1, 10, 1, 0.7},
                        {"E2", 0.1, 10, 1, 1.9},
                        {"E3", 0.1, 10, 1, 3.0},
                        {"t1", 1, 1000, 30, 90.0},
                        {"t2", 0.03, 30, 1, 2.0},
                        {"t3", 0.001, 1, 0.03, 0.06}},
                       [](const Vector& x) {
                         Vector values;
                         for (const double d : grid(-3, 3, 31)) {
                           const double w = pow(10.0, d);
                           double storage = x[0], loss = 0.0;
                           for (int k = 0; k < 3; ++k) {
                             const double wt = w * x[4 + k];
                             storage += x[1 + k] * wt * wt / (1 + wt * wt);
                             loss += x[1 + k] * wt / (1 + wt * wt);
                           }
                           values.push_back(storage);
                           values.push_back(loss);
                         }
                         return values;
                       }));
  all.push_back(fitted("load and deflection",
                       {{"k", 20, 400, 60, 190}, {"q", 1, 1e4, 30, 700}, {"p", 1.2, 3, 2.6, 1.7}},
                       curve(grid(0, 0.06, 13), [](double d, const Vector& x) {
                         return x[0] * d + x[1] * pow(d + 1e-9, x[2]);
                       })));
  all.push_back(
      fitted("rubber in two tests",
             {{"C10", 0, 2, 0.8, 0.35}, {"C01", 0, 2, 0.8, 0.06}, {"C20", -0.2, 0.5, 0.1, 0.02}},
             [](const Vector& x) {
               Vector values;
               for (const double l : grid(1.05, 2.2, 12)) {
                 const double I1 = l * l + 2 / l, slope = x[0] + 2 * x[2] * (I1 - 3);
                 values.push_back(2 * (l - 1 / (l * l)) * (slope + x[1] / l));
                 values.push_back(2 * (l - 1 / (l * l * l)) * (slope + x[1]));
               }
               return values;
             }));
  all.push_back(
      fitted("activation energy",
             {{"A", 1e2, 1e9, 1e4, 3e6}, {"E", 2, 12, 5, 7.2}},
             curve(grid(0.28, 0.42, 15),
                   [](double T, const Vector& x) { return x[0] * exp(-x[1] / (0.5 * T)) * 1e6; }),
             1e-2));
  all.push_back(fitted("saturation",
                       {{"L", 0.5, 10, 1.5, 4.0}, {"k", 0.1, 10, 0.5, 1.6}, {"t0", 0, 10, 8, 4.5}},
                       curve(grid(0, 10, 25), [](double t, const Vector& x) {
                         return x[0] / (1 + exp(-x[1] * (t - x[2])));
                       })));
  all.push_back(fitted("two peaks on a slope",
                       {{"c0", -2, 3, 0, 1.0},
                        {"c1", -0.5, 0.5, 0, 0.1},
                        {"h1", 0, 5, 1.5, 1.0},
                        {"p1", 1, 5, 2, 3.2},
                        {"w1", 0.2, 5, 1, 0.9},
                        {"h2", 0, 5, 1.5, 2.0},
                        {"p2", 5, 9, 8, 6.8},
                        {"w2", 0.2, 5, 1, 0.6}},
                       curve(grid(0, 10, 51), [](double t, const Vector& x) {
                         const double a = (t - x[3]) / x[4], b = (t - x[6]) / x[7];
                         return x[0] + x[1] * t + x[2] * exp(-a * a) + x[5] * exp(-b * b);
                       })));
  all.push_back(fitted("decay test",
                       {{"A", 0.1, 5, 2, 1.0},
                        {"delta", 0.02, 2, 0.5, 0.15},
                        {"omega", 1.5, 4.5, 2.6, 3.1},
                        {"phi", -3, 3, 0, 0.6},
                        {"c", -1, 1, 0.3, 0.05}},
                       curve(grid(0, 8, 65), [](double t, const Vector& x) {
                         return x[0] * exp(-x[1] * t) * cos(x[2] * t + x[3]) + x[4];
                       })));
  all.push_back(fitted("friction over speed",
                       {{"Fc", 0.2, 3, 0.5, 1.0},
                        {"Fs", 0.2, 5, 1.0, 1.8},
                        {"vs", 0.03, 3, 1.0, 0.3},
                        {"kv", 0, 1, 0.5, 0.12},
                        {"vr", 0.003, 0.3, 0.1, 0.02}},
                       curve(grid(-2.0, 2.0, 61),
                             [](double v, const Vector& x) {
                               const double s = v / x[2];
                               return (x[0] + (x[1] - x[0]) * exp(-s * s)) * tanh(v / x[4]) +
                                      x[3] * v;
                             }),
                       1e-2));
  all.push_back(fitted("rate with inhibition, truth outside",
                       {{"V", 0.5, 4, 1, 5.5}, {"K", 0.05, 5, 2, 0.9}, {"Ki", 1, 100, 50, 7.0}},
                       curve(grid(0.1, 20, 24), [](double s, const Vector& x) {
                         return x[0] * s / (x[1] + s + s * s / x[2]);
                       })));
  all.push_back(fitted("predator and prey",
                       {{"a", 0.2, 3, 0.7, 1.1},
                        {"b", 0.1, 3, 0.6, 0.8},
                        {"c", 0.1, 3, 0.6, 0.9},
                        {"d", 0.1, 3, 0.9, 0.7}},
                       lotka_volterra));
  all.push_back(fitted("ring on a foundation",
                       {{"EI", 0.001, 0.1, 0.02, 0.006},
                        {"N", 0.03, 3, 0.3, 0.8},
                        {"kr", 0.3, 30, 8, 3.0},
                        {"kt", 0.1, 10, 3, 0.9},
                        {"g", 0.01, 1, 0.2, 0.05}},
                       ring_frequencies,
                       2e-3));
  std::vector<Number> twelve;
  static const char* names[] = {"1", "2", "3", "4", "5", "6", "7", "8", "9", "10", "11", "12"};
  for (int k = 0; k < 12; ++k) {
    twelve.push_back({names[k], 0.2, 5.0, 1.0, exp(0.9 * sin(2.0 + 3.0 * k))});
  }
  all.push_back(fitted("twelve stiffnesses", twelve, twelve_stiffnesses));
  all.push_back(fitted("cooling of a slab",
                       {{"a", 0.02, 2, 0.1, 0.4}, {"Bi", 0.1, 30, 10, 1.5}, {"T", 0.2, 3, 2, 1.0}},
                       curve(grid(0.02, 4, 30), [](double t, const Vector& x) {
                         // zeta is a root of zeta tan(zeta) = Bi; the first three roots are used
                         double zeta = 0.7, sum = 0.0;
                         for (int k = 0; k < 3; ++k) {
                           double low = k * std::numbers::pi, high = low + 0.5 * std::numbers::pi;
                           for (int i = 0; i < 60; ++i) {
                             zeta = 0.5 * (low + high);
                             (zeta * std::tan(zeta) < x[1] ? low : high) = zeta;
                           }
                           sum += 4 * sin(zeta) / (2 * zeta + sin(2 * zeta)) *
                                  exp(-zeta * zeta * x[0] * t);
                         }
                         return x[2] * sum;
                       })));
  all.push_back(fitted(
      "three moduli hardly felt",
      {{"carcass", 0.5, 20, 1, 5.0}, {"sidewall", 0.1, 10, 0.2, 1.3}, {"tread", 0.2, 3, 0.5, 1.1}},
      hardly_three,
      1e-3));
  all.push_back(fitted("curved valley",
                       {{"x", -2, 2, -1.2, 0.8}, {"y", -2, 3, 1.0, 0.9}, {"z", -2, 3, 0.5, 0.5}},
                       [](const Vector& x) {
                         return Vector{10 * (x[1] - x[0] * x[0]),
                                       10 * (x[2] - x[1] * x[1]),
                                       1 + x[0],
                                       1 + x[1],
                                       x[0] + 0.3 * x[2]};
                       }));
  all.push_back(
      fitted("transient slip",
             {{"C", 2, 40, 5, 14.0}, {"sigma", 0.05, 3, 1.0, 0.35}, {"mu", 0.5, 1.5, 0.7, 1.05}},
             [](const Vector& x) {
               const auto states = integrate(
                   [&](double t, const Vector& y) {
                     const double slip = t < 1 ? 0.04 : t < 2 ? 0.15 : 0.08 * sin(4 * t);
                     return Vector{(slip - y[0]) * 5.0 / x[1]};
                   },
                   {0.0},
                   grid(0, 4, 41),
                   8);
               Vector values;
               for (const Vector& y : states) {
                 values.push_back(x[2] * tanh(x[0] * y[0] / x[2]));
               }
               return values;
             }));
  std::vector<Number> nine;
  static const char* peaks[] = {"a1", "w1", "z1", "a2", "w2", "z2", "a3", "w3", "z3"};
  const double truths[] = {1.0, 0.8, 0.03, 0.7, 1.5, 0.05, -0.9, 2.3, 0.04};
  const double starts[] = {0.5, 0.75, 0.1, 0.5, 1.6, 0.1, -0.5, 2.2, 0.1};
  for (int k = 0; k < 9; ++k) {
    const bool is_a = k % 3 == 0, is_w = k % 3 == 1;
    nine.push_back({peaks[k],
                    is_a   ? -2.0
                    : is_w ? truths[k] - 0.3
                           : 0.005,
                    is_a   ? 2.0
                    : is_w ? truths[k] + 0.3
                           : 0.3,
                    starts[k],
                    truths[k]});
  }
  all.push_back(fitted("three resonances", nine, three_peaks_complex));
  return all;
}

}  // namespace

std::vector<Problem> tuning_problems() { return written_down(); }

}  // namespace latsch::identification_set
