// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/history/prony.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <cmath>
#include <numbers>

#include "numerics/dense/cholesky.h"

namespace latsch::fe_tire {
namespace {

/// Frequencies a decade at which the loss factor is fitted. More change shares by less than 1e-3.
constexpr int kFittedPerDecade = 20;

std::string in_words(const PronyTerm& term) {
  return fmt::format("[{:.4g}, {:.4g} s]", term.beta, term.tau);
}

/// Returns the x >= 0 that minimizes |A x - b|: components that would be negative are left at 0.
Eigen::VectorXd nonnegative_least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  std::vector<int> free(A.cols());
  for (int k = 0; k < A.cols(); ++k) free[k] = k;
  for (;;) {
    const Eigen::MatrixXd part = A(Eigen::all, free);
    const Eigen::VectorXd x = numerics::PivotedCholesky(part.transpose() * part)
                                  .solve(Eigen::VectorXd(part.transpose() * b));
    std::vector<int> kept;
    for (std::size_t k = 0; k < free.size(); ++k) {
      if (x[static_cast<Eigen::Index>(k)] >= 0.0) kept.push_back(free[k]);
    }
    if (kept.size() < free.size()) {
      free = kept;
      continue;
    }
    Eigen::VectorXd all = Eigen::VectorXd::Zero(A.cols());
    all(free) = x;
    return all;
  }
}

}  // namespace

Status check(const PronyTerms& terms) {
  double sum = 0.0;
  for (std::size_t k = 0; k < terms.size(); ++k) {
    const PronyTerm& term = terms[k];
    if (!(term.beta >= 0.0))
      return Failure{"the Prony term " + in_words(term) +
                     " has a share below 0, which would create energy; expected 0 or more"};
    if (!(term.tau > 0.0) || std::isinf(term.tau))
      return Failure{"the Prony term " + in_words(term) +
                     " has no positive relaxation time; expected one above 0, such as 1 ms"};
    for (std::size_t before = 0; before < k; ++before) {
      if (terms[before].tau == term.tau)
        return Failure{"the Prony terms " + in_words(terms[before]) + " and " + in_words(term) +
                       " have the same relaxation time; add their shares to one term"};
    }
    sum += term.beta;
  }
  if (sum <= kMostProny) return {};
  return Failure{fmt::format(
      "the shares of the Prony terms sum to {:.4g}; expected at most {:.4g} times the relaxed "
      "modulus",
      sum,
      kMostProny)};
}

Result<PronyTerms> from_unrelaxed(const PronyTerms& unrelaxed) {
  double sum = 0.0;
  for (const PronyTerm& term : unrelaxed) sum += term.beta;
  if (!(sum < 1.0))
    return Failure{fmt::format(
        "the shares of the Prony terms, relative to the unrelaxed modulus, sum to {:.4g}; expected "
        "less than 1, or nothing is left of the modulus at rest",
        sum)};
  PronyTerms terms = unrelaxed;
  for (PronyTerm& term : terms) term.beta /= 1.0 - sum;
  if (const Status good = check(terms); !good.ok()) return good.failure();
  return terms;
}

std::complex<double> relative_modulus(const PronyTerm& term, double omega) {
  const std::complex<double> turned(0.0, omega * term.tau);
  return term.beta * (turned / (1.0 + turned));
}

std::complex<double> relative_modulus(const PronyTerms& terms, double omega) {
  std::complex<double> sum = 1.0;
  for (const PronyTerm& term : terms) sum += relative_modulus(term, omega);
  return sum;
}

Result<PronyTerms> constant_loss_factor(double loss_factor, double lowest, double highest) {
  if (!(loss_factor >= 0.0 && loss_factor <= 1.0))
    return Failure{fmt::format("the loss factor is {:.4g}; expected 0 to 1", loss_factor)};
  if (!(lowest > 0.0) || !(highest > lowest) || std::isinf(highest))
    return Failure{fmt::format(
        "the loss factor's band is from {:.4g} to {:.4g} Hz; expected a lowest frequency above 0 "
        "and a highest one above the lowest",
        lowest,
        highest)};
  if (loss_factor == 0.0) return PronyTerms{};
  const double decades = std::log10(highest / lowest);
  const int count = std::max(2, static_cast<int>(std::lround(decades)) + 1);
  PronyTerms terms(count);
  for (int i = 0; i < count; ++i)
    terms[i] = {1.0, 0.5 / (std::numbers::pi * lowest * std::pow(10.0, decades * i / (count - 1)))};
  // loss - d storage = 0 is linear in the shares: sum beta_i (loss_i - d storage_i) = d.
  const int fitted = static_cast<int>(std::ceil(kFittedPerDecade * decades)) + 1;
  Eigen::MatrixXd A(fitted, count);
  Eigen::VectorXd b = Eigen::VectorXd::Constant(fitted, loss_factor);
  for (int k = 0; k < fitted; ++k) {
    const double frequency = lowest * std::pow(10.0, decades * k / (fitted - 1));
    for (int i = 0; i < count; ++i) {
      const std::complex<double> part =
          relative_modulus(terms[i], 2.0 * std::numbers::pi * frequency);
      A(k, i) = part.imag() - loss_factor * part.real();
    }
  }
  // Rows are divided by the storage, which grows with frequency, so that errors are those of the
  // loss factor. The storage of a constant loss angle is a power of the frequency.
  for (int k = 0; k < fitted; ++k) {
    const double growth =
        2.0 / std::numbers::pi * std::atan(loss_factor) * decades * k / (fitted - 1);
    A.row(k) *= std::pow(10.0, -growth);
    b[k] *= std::pow(10.0, -growth);
  }
  const Eigen::VectorXd beta = nonnegative_least_squares(A, b);
  PronyTerms found;
  for (int i = 0; i < count; ++i) {
    if (beta[i] > 0.0) found.push_back({beta[i], terms[i].tau});
  }
  if (const Status good = check(found); !good.ok())
    return Failure{fmt::format("a loss factor of {:.4g} from {:.4g} to {:.4g} Hz: {}",
                               loss_factor,
                               lowest,
                               highest,
                               good.failure().reason)};
  return found;
}

}  // namespace latsch::fe_tire
