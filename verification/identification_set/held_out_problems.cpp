// SPDX-License-Identifier: Apache-2.0
// The half of the identification problems that is evaluated only once, after a method is decided.
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

Model over(const Vector& t, const std::function<double(double, const Vector&)>& y) {
  return [t, y](const Vector& x) {
    Vector values;
    for (const double at : t) values.push_back(y(at, x));
    return values;
  };
}

/// Side force at three loads as a function of slip; peak, shape and stiffness depend on the load.
Vector loads(const Vector& x) {
  Vector values;
  for (const double load : {0.5, 1.0, 1.5}) {
    const double df = load - 1.0, D = (x[1] + x[2] * df) * load, C = x[0];
    const double K = x[5] * sin(2.0 * atan(load / x[6])), B = K / (C * D);
    const double E = x[3] + x[4] * df;
    for (const double slip : grid(-0.2, 0.2, 21)) {
      const double s = B * (slip + x[7]);
      values.push_back(D * sin(C * atan(s - E * (s - atan(s)))) + load * x[8]);
    }
  }
  return values;
}

Vector two_modes(const Vector& x) {
  Vector values;
  for (const double w : grid(0.4, 2.6, 60)) {
    std::complex<double> H = x[6] - x[7] / (w * w);
    for (int k = 0; k < 2; ++k) {
      const double w0 = x[3 * k + 1];
      H += x[3 * k] / std::complex<double>(w0 * w0 - w * w, 2 * x[3 * k + 2] * w0 * w);
    }
    values.push_back(H.real());
    values.push_back(H.imag());
  }
  return values;
}

Vector duffing(const Vector& x) {
  const auto states = integrate(
      [&](double, const Vector& y) {
        return Vector{y[1], -x[0] * y[0] - x[1] * y[1] - x[2] * y[0] * y[0] * y[0]};
      },
      {1.0, 0.0},
      grid(0, 8, 65),
      5);
  Vector values;
  for (const Vector& y : states) values.push_back(y[0]);
  return values;
}

/// Force of a parallel arrangement of elastic-slip elements (Iwan's model) with smoothed limits,
/// along a path that reverses twice.
Vector iwan(const Vector& x) {
  Vector values;
  double last = 0.0, s1 = 0.0, s2 = 0.0;
  for (const double t : grid(0, 3, 121)) {
    const double u = t < 1 ? t : t < 2 ? 2 - 1.6 * (t - 0.375) : 0.9 * (t - 2) - 0.6;
    const double du = u - last;
    last = u;
    s1 += x[1] * du / (1 + pow(abs(s1 / x[2]), 4));
    s2 += x[3] * du / (1 + pow(abs(s2 / x[4]), 4));
    values.push_back(x[0] * u + s1 + s2);
  }
  return values;
}

/// Frequencies of eight masses in a ring, with two kinds of springs between them and springs to the
/// ground.
Vector ring_of_masses(const Vector& x) {
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(8, 8);
  for (int i = 0; i < 8; ++i) {
    const int j = (i + 1) % 8;
    const double k = i % 2 ? x[0] : x[1];
    K(i, i) += k + x[2] + (i == 0 ? x[3] : 0.0);
    K(j, j) += k;
    K(i, j) -= k;
    K(j, i) -= k;
  }
  Vector values;
  for (const double square : numerics::self_adjoint_eigenvalues(K)) values.push_back(sqrt(square));
  return values;
}

/// Displacement of a cart on a spring, which sticks and slips because of Dahl's friction.
Vector dahl(const Vector& x) {
  const auto states = integrate(
      [&](double t, const Vector& y) {
        const double drive = sin(3 * t) + 0.5 * sin(7.3 * t), v = y[1];
        return Vector{
            v, 5.0 * drive - x[2] * y[0] - x[3] * v - y[2], x[0] * (v - abs(v) * y[2] / x[1])};
      },
      {0, 0, 0},
      grid(0, 5, 61),
      8);
  Vector values;
  for (const Vector& y : states) values.push_back(y[0]);
  return values;
}

Vector epidemic(const Vector& x) {
  const auto states = integrate(
      [&](double, const Vector& y) {
        const double newly = x[0] * y[0] * y[1];
        return Vector{-newly, newly - x[1] * y[1]};
      },
      {1.0, x[2]},
      grid(0, 20, 41),
      5);
  Vector values;
  for (const Vector& y : states) values.push_back(y[1]);
  return values;
}

Vector ten_stiffnesses(const Vector& E) {
  Vector values;
  for (int i = 0; i < 18; ++i) {
    RandomStream weight(17, i);
    double product = 0.0, sum = 0.0, total = 1e-3;
    for (const double e : E) {
      const double w = pow(weight.uniform(), 2);
      product += w * std::log(e);
      sum += w * e;
      total += w;
    }
    values.push_back(i % 2 ? exp(0.8 * product / total) : sqrt(0.2 + sum / total));
  }
  return values;
}

/// Distances from an unknown place to six known points, measured by an instrument whose scale and
/// offset are unknown too.
Vector distances(const Vector& x) {
  Vector values;
  for (int i = 0; i < 6; ++i) {
    const double a = 4 * sin(1.0 + 2.2 * i), b = 3 * cos(0.3 + 1.7 * i);
    values.push_back(x[2] * std::hypot(x[0] - a, x[1] - b) + x[3]);
  }
  return values;
}

/// Side force and aligning moment of the brush tire model; when the whole patch slides, the force
/// is constant.
Vector brush(const Vector& x) {
  Vector values;
  for (const double slip : grid(0.005, 0.3, 25)) {
    const double theta = x[0] * slip / (3 * x[1]);
    const double l = theta < 1 ? 1 - theta : 0;
    values.push_back(x[1] * (1 - l * l * l));
    values.push_back(2 * x[1] * x[2] * l * l * l * theta + 0.02 * x[3] * slip);
  }
  return values;
}

/// Response of two coupled resonances to a short impact at two speeds; the coupling depends on the
/// speed.
Vector blow(const Vector& x) {
  Vector values;
  for (const double speed : {1.0, 2.2}) {
    const auto states = integrate(
        [&](double t, const Vector& y) {
          const double f = t * speed < 0.5 ? sin(2 * std::numbers::pi * speed * t) : 0.0;
          return Vector{y[1],
                        60 * f - 900 * x[0] * y[0] - 60 * x[1] * y[1] - 200 * (y[0] - y[2]),
                        y[3],
                        400 * (y[0] - y[2]) - 12 * x[1] * y[3] - 300 * x[0] * y[2]};
        },
        {0, 0, 0, 0},
        grid(0, 1.2, 97),
        4);
    for (const Vector& y : states) values.push_back(y[0] + 0.3 * y[2]);
  }
  return values;
}

std::vector<Problem> written_down() {
  std::vector<Problem> all;
  all.push_back(
      fitted("taken in and given off",
             {{"ka", 0.1, 10, 0.5, 2.1}, {"ke", 0.02, 2, 0.4, 0.25}, {"V", 0.3, 30, 1, 4.0}},
             over(grid(0.2, 12, 24), [](double t, const Vector& x) {
               const double d = x[0] - x[1] + 1e-9;
               return 10 * x[0] / (x[2] * d) * (exp(-x[1] * t) - exp(-x[0] * t));
             })));
  all.push_back(fitted("side force at three loads",
                       {{"C", 1, 2, 1.7, 1.3},
                        {"D1", 0.4, 2, 0.8, 1.1},
                        {"D2", -0.5, 0.3, 0, -0.15},
                        {"E1", -3, 0.9, 0, -0.8},
                        {"E2", -2, 2, 0, -0.4},
                        {"K1", 3, 60, 8, 18},
                        {"K2", 0.3, 5, 1, 1.7},
                        {"H", -0.02, 0.02, 0, 0.004},
                        {"V", -0.2, 0.2, 0, 0.04}},
                       loads,
                       5e-3));
  all.push_back(fitted("two modes and the rest",
                       {{"a1", -2, 2, 0.4, 1.0},
                        {"w1", 0.6, 1.3, 1.1, 0.92},
                        {"z1", 0.005, 0.5, 0.1, 0.03},
                        {"a2", -2, 2, 0.4, -0.6},
                        {"w2", 1.4, 2.3, 1.7, 1.85},
                        {"z2", 0.005, 0.5, 0.1, 0.02},
                        {"u", -1, 1, 0, 0.2},
                        {"l", -0.5, 0.5, 0, 0.1}},
                       two_modes));
  all.push_back(fitted("spring that hardens",
                       {{"k", 1, 12, 4, 6.0}, {"c", 0.02, 2, 0.6, 0.2}, {"k3", 0, 10, 0.5, 3.0}},
                       duffing));
  all.push_back(fitted("elements that slip",
                       {{"k0", 0, 3, 1, 0.4},
                        {"k1", 0.5, 50, 3, 9},
                        {"f1", 0.03, 3, 1, 0.25},
                        {"k2", 0.1, 10, 1, 2},
                        {"f2", 0.05, 5, 0.3, 0.6}},
                       iwan));
  all.push_back(fitted("ratio of cubics",
                       {{"a0", -3, 3, 1, 0.6},
                        {"a1", -3, 3, 0, 1.5},
                        {"a2", -3, 3, 0, 1.1},
                        {"a3", -3, 3, 0, 0.4},
                        {"b1", -1, 3, 1, 0.9},
                        {"b2", 0, 3, 1, 0.6},
                        {"b3", -0.2, 1, 0.3, 0.15}},
                       over(grid(-1, 2.2, 37), [](double t, const Vector& x) {
                         return (x[0] + t * (x[1] + t * (x[2] + t * x[3]))) /
                                (2.5 + t * (x[4] + t * (x[5] + t * x[6])));
                       })));
  all.push_back(fitted("ring of masses",
                       {{"k1", 0.2, 20, 1, 3.0},
                        {"k2", 0.2, 20, 6, 1.2},
                        {"kg", 0.05, 5, 1, 0.3},
                        {"kf", 0.1, 20, 1, 4.0}},
                       ring_of_masses));
  all.push_back(fitted("relaxation in three times",
                       {{"E0", 0.05, 5, 1, 0.4},
                        {"E1", 0.05, 5, 0.5, 1.0},
                        {"E2", 0.05, 5, 0.5, 0.8},
                        {"E3", 0.05, 5, 0.5, 0.6},
                        {"t1", 0.005, 0.5, 0.03, 0.02},
                        {"t2", 0.1, 10, 1, 0.5},
                        {"t3", 2, 200, 30, 12}},
                       over(grid(-2.5, 2, 46), [](double d, const Vector& x) {
                         const double t = pow(10.0, d);
                         return x[0] + x[1] * exp(-t / x[4]) + x[2] * exp(-t / x[5]) +
                                x[3] * exp(-t / x[6]);
                       })));
  all.push_back(fitted("stretch of a rubber",
                       {{"mu1", 0.02, 3, 0.2, 0.6},
                        {"a1", 0.5, 4, 3, 1.4},
                        {"mu2", 0.0005, 0.5, 0.05, 0.008},
                        {"a2", 3, 8, 4, 5.2}},
                       over(grid(0.6, 4, 28), [](double l, const Vector& x) {
                         const auto term = [l](double mu, double a) {
                           return mu * (pow(l, a - 1) - pow(l, -0.5 * a - 1));
                         };
                         return term(x[0], x[1]) + term(x[2], x[3]);
                       })));
  all.push_back(fitted("shift over temperature",
                       {{"C1", 2, 40, 10, 17}, {"C2", 10, 200, 100, 52}},
                       over(grid(-20, 80, 21),
                            [](double T, const Vector& x) { return -x[0] * T / (x[1] + T + 25); }),
                       1e-2));
  all.push_back(fitted("growth with a base line",
                       {{"A", 0.5, 10, 1, 3.2},
                        {"b", 0.5, 50, 2, 9},
                        {"c", 0.05, 5, 0.2, 0.9},
                        {"d", -1, 2, 0, 0.5}},
                       over(grid(0, 9, 31), [](double t, const Vector& x) {
                         return x[3] + x[0] * exp(-x[1] * exp(-x[2] * t));
                       })));
  all.push_back(fitted("spectrum of three lines",
                       {{"h1", 0, 4, 1, 2.0},
                        {"p1", 0.5, 3.5, 1.5, 2.0},
                        {"w1", 0.1, 3, 1, 0.5},
                        {"h2", 0, 4, 1, 1.0},
                        {"p2", 3.5, 6.5, 5.5, 4.6},
                        {"w2", 0.1, 3, 1, 0.8},
                        {"h3", 0, 4, 1, 3.0},
                        {"p3", 6.5, 9.5, 8.8, 8.1},
                        {"w3", 0.1, 3, 1, 0.4}},
                       over(grid(0, 10, 71), [](double t, const Vector& x) {
                         double sum = 0.0;
                         for (int k = 0; k < 9; k += 3) {
                           const double s = (t - x[k + 1]) / x[k + 2];
                           sum += x[k] / (1 + s * s);
                         }
                         return sum;
                       })));
  all.push_back(fitted("two tones",
                       {{"a1", 0, 3, 1, 1.5},
                        {"w1", 1.5, 3.5, 2.3, 2.7},
                        {"p1", -2, 2, 0, 0.5},
                        {"a2", 0, 3, 1, 0.7},
                        {"w2", 4, 7, 5.2, 5.6},
                        {"p2", -2, 2, 0, -0.4}},
                       over(grid(0, 5, 61), [](double t, const Vector& x) {
                         return x[0] * sin(x[1] * t + x[2]) + x[3] * sin(x[4] * t + x[5]);
                       })));
  all.push_back(fitted("stick and slip",
                       {{"sigma", 3, 300, 20, 60},
                        {"Fc", 0.2, 5, 0.5, 1.5},
                        {"k", 1, 30, 4, 9},
                        {"c", 0.05, 5, 1.5, 0.4}},
                       dahl));
  all.push_back(fitted("two decays on a line, truth outside",
                       {{"a", 0, 1.5, 1, 2.0},
                        {"k", 0.05, 5, 0.3, 0.4},
                        {"b", 0, 5, 1, 1.0},
                        {"l", 0.5, 3, 1.5, 4.0},
                        {"c", 0.1, 1, 0.5, 0.02},
                        {"d", -0.1, 0.1, 0, 0.01}},
                       over(grid(0, 5, 51), [](double t, const Vector& x) {
                         return x[0] * exp(-x[1] * t) + x[2] * exp(-x[3] * t) + x[4] + x[5] * t;
                       })));
  all.push_back(fitted(
      "epidemic",
      {{"beta", 0.3, 3, 0.6, 1.3}, {"gamma", 0.05, 2, 0.2, 0.45}, {"i0", 1e-4, 0.1, 0.02, 2e-3}},
      epidemic));
  all.push_back(fitted("beam that shears",
                       {{"EI", 0.1, 10, 1, 3.0},
                        {"GA", 3, 3000, 30, 120},
                        {"kf", 0.01, 10, 1, 0.2},
                        {"m", 0.3, 3, 0.6, 1.4}},
                       over(grid(1, 8, 8),
                            [](double n, const Vector& x) {
                              const double q = 0.5 * n, q2 = q * q;
                              return sqrt((x[0] * q2 * q2 / (1 + x[0] * q2 / x[1]) + x[2]) / x[3]) /
                                     n;
                            }),
                       2e-3));
  std::vector<Number> ten;
  static const char* names[] = {"1", "2", "3", "4", "5", "6", "7", "8", "9", "10"};
  for (int k = 0; k < 10; ++k)
    ten.push_back({names[k], 0.2, 5.0, 1.0, exp(0.8 * cos(1.0 + 2.0 * k))});
  all.push_back(fitted("ten stiffnesses", ten, ten_stiffnesses));
  all.push_back(
      fitted("breakthrough",
             {{"v", 0.2, 3, 0.5, 1.1}, {"D", 0.005, 0.5, 0.2, 0.04}, {"c", 0.3, 3, 0.6, 1.0}},
             over(grid(0.1, 4, 33), [](double t, const Vector& x) {
               return 0.5 * x[2] * std::erfc((1.5 - x[0] * t) / (2 * sqrt(x[1] * t)));
             })));
  all.push_back(fitted(
      "place from distances",
      {{"x", -5, 5, 3, -1.2}, {"y", -5, 5, -3, 0.8}, {"s", 0.5, 2, 1, 1.2}, {"o", -1, 1, 0, 0.15}},
      distances));
  all.push_back(fitted("brush",
                       {{"C", 3, 60, 8, 19},
                        {"mu", 0.3, 2, 0.6, 1.05},
                        {"trail", 0.01, 0.3, 0.1, 0.04},
                        {"k", -5, 5, 0, 1.5}},
                       brush,
                       5e-3));
  all.push_back(
      fitted("blow at two speeds", {{"k", 0.3, 3, 0.7, 1.3}, {"c", 0.03, 3, 0.8, 0.15}}, blow));
  std::vector<Number> fifteen;
  static const char* of_fifteen[] = {
      "1", "2", "3", "4", "5", "6", "7", "8", "9", "10", "11", "12", "13", "14", "15"};
  for (int k = 0; k < 15; ++k) {
    fifteen.push_back({of_fifteen[k], -2, 2, 0.4, 1.2 * sin(1.0 + 1.9 * k)});
  }
  all.push_back(
      fitted("fifteen shares", fifteen, over(grid(0, 1, 40), [](double t, const Vector& x) {
               double sum = 0.0;
               for (int k = 0; k < 15; ++k) {
                 const double s = 10 * (t - k / 14.0);
                 sum += x[k] * exp(-s * s) + 0.1 * x[k] * x[(k + 1) % 15];
               }
               return sum + 0.1 * sum * sum;
             })));
  all.push_back(fitted("four moduli hardly felt",
                       {{"a", 0.2, 20, 1, 6.0},
                        {"b", 0.1, 10, 0.3, 1.5},
                        {"c", 0.2, 5, 0.5, 1.4},
                        {"d", 0.1, 10, 3, 0.7}},
                       over(grid(0.2, 1, 7),
                            [](double d, const Vector& x) {
                              return d * pow(x[1], 0.3) * (1 + 0.2 * d * pow(x[0], 0.1)) +
                                     0.1 * d * d * pow(x[2], 0.5) + 0.003 * d * d * d * x[3];
                            }),
                       1e-3));
  for (Problem& problem : all) problem.is_held_out = true;
  return all;
}

}  // namespace

std::vector<Problem> held_out_problems() { return written_down(); }

}  // namespace latsch::identification_set
