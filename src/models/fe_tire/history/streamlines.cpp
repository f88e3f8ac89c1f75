// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/history/streamlines.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <complex>
#include <numbers>
#include <type_traits>

namespace latsch::fe_tire {
namespace {

/// |z| below which phi_1 and phi_2 are summed as series; above it their differences lose no digits.
constexpr double kSeries = 0.5;
/// Terms of these series: 0.5^15/17! is below the rounding of 1/2.
constexpr int kTerms = 15;
/// Real part of z above which e^(-z) is 0.
constexpr double kForgotten = 700.0;

double real_of(double z) { return z; }
double real_of(const std::complex<double>& z) { return z.real(); }

/// Returns 1 - e^(-z) without cancellation for small z.
double lost(double z) { return -std::expm1(-z); }
std::complex<double> lost(const std::complex<double>& z) {
  const double sine = std::sin(0.5 * z.imag());
  return {lost(z.real()) + 2.0 * std::exp(-z.real()) * sine * sine,
          std::exp(-z.real()) * std::sin(z.imag())};
}

/// The coefficients of one step, or of the whole turn, for a finite z.
template <class Scalar>
struct StepFactors {
  Scalar kept;  // e^(-z)
  Scalar gone;  // 1 - e^(-z)
  Scalar phi_1, phi_2;
  Scalar z_phi_2;  // 1 - phi_1

  explicit StepFactors(const Scalar& z) {
    if (real_of(z) > kForgotten) {
      kept = 0.0;
      gone = 1.0;
    } else {
      kept = std::exp(-z);
      gone = lost(z);
    }
    if (std::abs(z) >= kSeries) {
      phi_1 = gone / z;
      z_phi_2 = 1.0 - phi_1;
      phi_2 = z_phi_2 / z;
      return;
    }
    // phi_2 = sum (-z)^j/(j + 2)!, phi_1 = 1 - z phi_2
    phi_2 = 0.0;
    double inverse = 1.0;
    for (int j = 2; j < kTerms + 2; ++j) inverse /= j;
    for (int j = kTerms - 1; j >= 0; --j) {
      phi_2 = inverse - z * phi_2;
      inverse *= j + 2;
    }
    z_phi_2 = z * phi_2;
    phi_1 = 1.0 - z_phi_2;
  }
};

}  // namespace

Streamline::Streamline(const std::vector<double>& theta) : order_(theta.size()) {
  assert(theta.size() >= 2);
  constexpr double kTurn = 2.0 * std::numbers::pi;
  const auto wrapped = [&](int k) { return theta[k] - kTurn * std::floor(theta[k] / kTurn); };
  for (int k = 0; k < points(); ++k) order_[k] = k;
  std::ranges::sort(order_, [&](int a, int b) { return wrapped(a) > wrapped(b); });
  steps_.resize(points());
  for (int k = 0; k + 1 < points(); ++k) steps_[k] = wrapped(order_[k]) - wrapped(order_[k + 1]);
  steps_[points() - 1] = wrapped(order_.back()) - wrapped(order_.front()) + kTurn;
}

int Streamline::from(int k, bool forward) const {
  const int m = points(), at = k % m;
  return order_[forward ? at : (m - at) % m];
}

template <class Scalar>
Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic> Streamline::history_of(
    const PronyTerm& term,
    double Omega,
    double omega,
    const Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>& S) const {
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
  using Column = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;
  using Factors = StepFactors<Scalar>;
  assert(S.cols() == points());
  const bool forward = Omega >= 0.0;
  Scalar lambda_tau = 1.0;  // lambda tau = 1 + i omega tau
  if constexpr (!std::is_same_v<Scalar, double>) lambda_tau = {1.0, omega * term.tau};
  const Scalar r = 1.0 / lambda_tau;
  const int m = points();
  const double per_turn = std::abs(Omega) * term.tau;  // a = Delta theta/per_turn
  const Scalar turn = 2.0 * std::numbers::pi / per_turn * lambda_tau;
  // At rest nothing is carried from one point to the next.
  if (!std::isfinite(real_of(turn))) return term.beta * (1.0 - r) * S;
  std::vector<Factors> steps;
  steps.reserve(m);
  for (int k = 0; k < m; ++k) steps.emplace_back(step(k, forward) / per_turn * lambda_tau);
  const Factors whole(turn);
  // (1 - e^(-z_k))/(1 - b) and z_k phi_2/(1 - b); both ratios exist at z = 0.
  const auto first = [&](int k) -> Scalar {
    if (std::abs(turn) < kSeries)
      return step(k, forward) / (2.0 * std::numbers::pi) * steps[k].phi_1 / whole.phi_1;
    return steps[k].gone / whole.gone;
  };
  const auto second = [&](int k) -> Scalar {
    if (std::abs(turn) < kSeries)
      return step(k, forward) / (2.0 * std::numbers::pi) * steps[k].phi_2 / whole.phi_1;
    return steps[k].z_phi_2 / whole.gone;
  };
  const Column first_S = S.col(from(0, forward));  // h of a constant stress is known
  Matrix rest(S.rows(), m + 1);                    // in the order of flow
  for (int k = 0; k <= m; ++k) rest.col(k) = S.col(from(k, forward)) - first_S;
  Column g = Column::Zero(S.rows());
  for (int k = 0; k < m; ++k) {
    const Scalar one = term.beta * r * first(k), two = term.beta * r * second(k);
    g = steps[k].kept * g - (one - two) * rest.col(k) - two * rest.col(k + 1);
  }
  Matrix h(S.rows(), S.cols());
  for (int k = 0; k < m; ++k) {
    h.col(from(k, forward)) = g + term.beta * (rest.col(k) + (1.0 - r) * first_S);
    const Scalar one = term.beta * r * steps[k].gone, two = term.beta * r * steps[k].z_phi_2;
    g = steps[k].kept * g - (one - two) * rest.col(k) - two * rest.col(k + 1);
  }
  return h;
}

Eigen::MatrixXd Streamline::history(const PronyTerm& term,
                                    double Omega,
                                    const Eigen::MatrixXd& S) const {
  return history_of<double>(term, Omega, 0.0, S);
}

Eigen::MatrixXcd Streamline::history(const PronyTerm& term,
                                     double Omega,
                                     double omega,
                                     const Eigen::MatrixXcd& S) const {
  return history_of<std::complex<double>>(term, Omega, omega, S);
}

Eigen::VectorXd Streamline::local_tangent(const PronyTerm& term, double Omega) const {
  const bool forward = Omega >= 0.0;
  const double per_turn = std::abs(Omega) * term.tau;
  Eigen::VectorXd tangent = Eigen::VectorXd::Zero(points());
  if (per_turn == 0.0) return tangent;
  for (int k = 0; k < points(); ++k) {
    const double a = step(k, forward) / per_turn;
    tangent[to(k, forward)] = term.beta * (std::isinf(a) ? 0.0 : StepFactors<double>(a).phi_1);
  }
  return tangent;
}

double Streamline::power(double Omega, const Eigen::MatrixXd& H, const Eigen::MatrixXd& E) const {
  const bool forward = Omega >= 0.0;
  double work = 0.0;
  for (int k = 0; k < points(); ++k) {
    const int here = from(k, forward), next = to(k, forward);
    work += 0.5 * (H.col(here) + H.col(next)).dot(E.col(next) - E.col(here));
  }
  return std::abs(Omega) * work;
}

double Streamline::power(const PronyTerm& term,
                         double Omega,
                         const Eigen::MatrixXd& S,
                         const Eigen::MatrixXd& h,
                         const Eigen::MatrixXd& E) const {
  const bool forward = Omega >= 0.0;
  const double per_turn = std::abs(Omega) * term.tau;
  if (per_turn == 0.0) return 0.0;
  double work = 0.0;
  for (int k = 0; k < points(); ++k) {
    const double a = step(k, forward) / per_turn;
    if (std::isinf(a)) continue;
    const StepFactors<double> factors(a);
    const int here = from(k, forward), next = to(k, forward);
    const auto mean =
        factors.phi_1 * h.col(here) + factors.phi_2 * term.beta * (S.col(next) - S.col(here));
    work += mean.dot(E.col(next) - E.col(here));
  }
  return std::abs(Omega) * work;
}

}  // namespace latsch::fe_tire
