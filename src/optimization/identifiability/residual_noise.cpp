// SPDX-License-Identifier: Apache-2.0
#include "optimization/identifiability/residual_noise.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "numerics/dense/cholesky.h"
#include "numerics/dense/orthogonal_factors.h"
#include "numerics/dense/self_adjoint_eigen.h"
#include "optimization/problem/point_vector.h"

namespace latsch {
namespace {

using numerics::Autoregression;

constexpr size_t kMostOrder = 8;  // largest order of the autoregression
// Least number of samples of a curve in addition to the number of variables.
constexpr Eigen::Index kFewestSamples = 12;
// Least number of samples for each order of the autoregression.
constexpr Eigen::Index kSamplesAnOrder = 6;
// Number of higher orders without improvement after which the search for the order ends.
constexpr size_t kOrdersInVain = 2;
constexpr double kMostZ = 4.5;  // largest z = atanh(kappa): |kappa| is at most 0.99975
/// Largest deviation of the noise, as a multiple of the spread that the residuals show.
/// A fit hides slow noise, but the data do not show noise that is hidden almost whole: its level
/// may then be any number. Deviations beyond the limit cost kHiddenCost in the deviance for each
/// unit of their logarithm.
constexpr double kMostHidden = 3.0, kHiddenCost = 1e4;
/// Least degrees of freedom of an interval if correlations are uncertain. With fewer, an interval
/// becomes infinite without containing the truth more often.
constexpr double kFewestFreedomOfNoise = 2.0;
/// Least degrees of freedom if groups of residuals have spreads of their own, one of which a single
/// value may tell.
constexpr double kFewestFreedomOfGroups = 1.0;
/// Share of the spread of all residuals below which noise cannot be recognized. If a few residuals
/// are far larger than all others, they determine the spread, and noise of a thousandth of it does
/// not influence them.
constexpr double kFarOff = 1e-3;
/// Limits for residuals that form a smooth pattern: largest deviation of a residual, as a multiple
/// of the spread that the residuals show, and least degrees of freedom. An autoregression takes a
/// smooth pattern for noise so slow that its level may be any number.
constexpr double kMostUnseen = 2.0, kFewestFreedom = 3.0;
/// Largest ratio of the second differences of a pattern to its first ones. It is at least 1.2 for
/// the sums of independent errors, the slowest noise, and 2 sin(w / 2) for a wave of w per sample.
constexpr double kSmooth = 0.8;
/// Largest ratio of the medians of their moduli, which a bend at one place of a pattern does not
/// change. It scatters more than the ratio above.
constexpr double kSmoothInMost = 0.6;
// Largest number of neighbors that are averaged before differences are taken, so that weak noise on
// a pattern does not hide it, and fewest averages that tell a pattern from noise.
constexpr Eigen::Index kMostAveraged = 4, kFewestAverages = 8;
constexpr double kGolden = 0.6180339887498949;
constexpr int kFirstCuts = 16, kLaterCuts = 9;  // numbers of steps of the golden-section search
constexpr double kDerivative = 0.05;            // step in z of numerical derivatives

Autoregression process_of(const std::vector<double>& z) {
  std::vector<double> kappa;
  for (const double value : z) kappa.push_back(std::tanh(value));
  return Autoregression(kappa);
}

/// Returns the median of the values.
double middle_of(std::vector<double> values) {
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Returns the position of a minimum between a and b by golden-section search.
template <class Function>
double least_between(double a, double b, int cuts, const Function& f) {
  double x = b - kGolden * (b - a), y = a + kGolden * (b - a), fx = f(x), fy = f(y);
  for (int cut = 0; cut < cuts; ++cut) {
    if (fx < fy) {
      b = y;
      y = x;
      fy = fx;
      x = b - kGolden * (b - a);
      fx = f(x);
    } else {
      a = x;
      x = y;
      fx = fy;
      y = a + kGolden * (b - a);
      fy = f(y);
    }
  }
  return fx < fy ? x : y;
}

/// True if, after a few of the largest residuals are removed, a new fit of all others leaves a
/// spread of no more than `least`: these are exact values beside a few wrong ones. The wrong ones
/// contain no information on noise that neighbors share. A robust loss removes the derivatives of
/// wrong values. A variable that changes all other residuals alike could then be taken for noise
/// shared by these, and a wrong value for the only one that determines the variable.
bool is_exact_but_for_few(const Eigen::VectorXd& x, const Eigen::MatrixXd& Q, double least) {
  constexpr Eigen::Index kMostFar = 5;
  std::vector<Eigen::Index> rows(static_cast<size_t>(x.size()));
  std::iota(rows.begin(), rows.end(), 0);
  for (Eigen::Index far = 1; far <= kMostFar; ++far) {
    rows.erase(std::max_element(rows.begin(), rows.end(), [&](Eigen::Index a, Eigen::Index b) {
      return std::abs(x[a]) < std::abs(x[b]);
    }));
    const Eigen::Index freedom = std::ssize(rows) - Q.cols();
    if (freedom < kMostFar) return false;
    Eigen::VectorXd left = x(rows);
    if (Q.cols() > 0) {
      const Eigen::MatrixXd basis = numerics::range_basis(Q(rows, Eigen::all));
      left -= basis * (basis.transpose() * left);
    }
    if (left.norm() <= least * std::sqrt(static_cast<double>(freedom))) return true;
  }
  return false;
}

/// Returns the changes of the residuals by the variables and by solved unknowns, all of about the
/// same size.
Eigen::MatrixXd changes_caused(const Eigen::MatrixXd& J,
                               const std::vector<Eigen::VectorXd>& solved) {
  Eigen::MatrixXd caused(J.rows(), J.cols() + std::ssize(solved));
  caused.leftCols(J.cols()) = J;
  const double size = J.cols() > 0 ? J.colwise().norm().maxCoeff() : 0.0;
  for (std::size_t k = 0; k < solved.size(); ++k)
    caused.col(J.cols() + static_cast<Eigen::Index>(k)) =
        solved[k].normalized() * (size > 0.0 ? size : 1.0);
  return caused;
}

}  // namespace

ResidualTraits ResidualTraits::of(const std::vector<Eigen::Index>& rows) const {
  ResidualTraits some;
  for (const Eigen::Index row : rows) {
    if (!deviations.empty()) some.deviations.push_back(deviations[static_cast<size_t>(row)]);
    if (!curves.empty()) some.curves.push_back(curves[static_cast<size_t>(row)]);
    if (!losses.empty()) some.losses.push_back(losses[static_cast<size_t>(row)]);
    if (!groups.empty()) some.groups.push_back(groups[static_cast<size_t>(row)]);
  }
  for (const Eigen::VectorXd& changes : solved) some.solved.emplace_back(changes(rows));
  return some;
}

ResidualNoise::ResidualNoise(const Eigen::VectorXd& r,
                             const Eigen::MatrixXd& J,
                             const ResidualTraits& traits,
                             double least_seen)
    : deviations_(Eigen::VectorXd::Ones(r.size())) {
  const Eigen::Index m = r.size();
  if (!traits.deviations.empty()) {
    deviations_ = to_vector(traits.deviations);
  }
  x_ = r.cwiseQuotient(deviations_);
  const Eigen::MatrixXd caused = changes_caused(J, traits.solved);
  const auto take_basis = [&] {
    Q_ = caused.cols() == 0
             ? Eigen::MatrixXd(m, 0)
             : numerics::range_basis(deviations_.cwiseInverse().asDiagonal() * caused);
  };
  take_basis();
  const bool has_loss = std::any_of(traits.losses.begin(), traits.losses.end(), [](const auto& l) {
    return l.loss != Loss::squares;
  });
  if (has_several_groups(traits.groups) && !has_loss && m > Q_.cols() &&
      x_.norm() > least_seen * std::sqrt(static_cast<double>(m))) {
    groups_ = GroupSpreads(x_, deviations_.cwiseInverse().asDiagonal() * caused, traits.groups);
    deviations_.array() *= groups_.of_residuals().array();
    x_ = r.cwiseQuotient(deviations_);
    take_basis();
  }
  freedom_ = static_cast<double>(m - Q_.cols());
  std::map<int, std::vector<Eigen::Index>> rows;
  for (Eigen::Index row = 0; row < m; ++row) {
    const int curve = traits.curves.empty() ? -1 : traits.curves[static_cast<size_t>(row)];
    if (curve >= 0) rows[curve].push_back(row);
    if (curve < 0) alone_.push_back(row);
  }
  for (auto& [number, own] : rows) {
    if (std::ssize(own) - Q_.cols() >= kFewestSamples) {
      curves_.push_back({std::move(own), Autoregression(), {}});
    } else {
      alone_.insert(alone_.end(), own.begin(), own.end());
    }
  }
  alone_sums_ = sums({alone_, Autoregression(), {}}, Autoregression());
  Sums all = alone_sums_;
  const auto add = [](Sums& to, const Sums& part, double sign) {
    to.A += sign * part.A;
    to.b += sign * part.b;
    to.c += sign * part.c;
    to.log_determinant += sign * part.log_determinant;
  };
  for (const Curve& curve : curves_) {
    curve_sums_.push_back(sums(curve, curve.process));
    add(all, curve_sums_.back(), 1.0);
  }
  seen_ = sigma_of(all);
  if (freedom_ > 0.0 && !curves_.empty() && seen_ > least_seen &&
      !is_exact_but_for_few(x_, Q_, std::max(least_seen, kFarOff * seen_))) {
    for (size_t k = 0; k < curves_.size(); ++k) {
      add(all, curve_sums_[k], -1.0);
      fit(curves_[k], all);
      curve_sums_[k] = sums(curves_[k], curves_[k].process);
      add(all, curve_sums_[k], 1.0);
    }
  }
  sigma_ = sigma_of(all);
  if (!is_white() && forms_pattern()) take_for_pattern();
}

void ResidualNoise::take_for_pattern() {
  if (is_white()) return;
  is_pattern_ = true;
  sigma_ = std::min(sigma_, kMostUnseen * seen_);
}

/// True if the part of the residuals that the fit cannot change is smooth along the curves whose
/// neighbors share noise: the differences of its differences are smaller than these.
bool ResidualNoise::forms_pattern() const {
  const Eigen::VectorXd left = x_ - Q_ * (Q_.transpose() * x_);
  for (Eigen::Index averaged = 1; averaged <= kMostAveraged; ++averaged) {
    double first = 0.0, second = 0.0;
    std::vector<double> firsts, seconds;
    for (const Curve& curve : curves_) {
      const Eigen::Index count = std::ssize(curve.rows) / averaged;
      if (curve.process.order() == 0 || count < kFewestAverages) continue;
      const Eigen::VectorXd own = left(curve.rows);
      const Eigen::VectorXd means =
          own.head(count * averaged).reshaped(averaged, count).colwise().mean();
      const Eigen::VectorXd steps = means.tail(count - 1) - means.head(count - 1);
      const Eigen::VectorXd bends = steps.tail(count - 2) - steps.head(count - 2);
      first += steps.squaredNorm() / static_cast<double>(count - 1);
      second += bends.squaredNorm() / static_cast<double>(count - 2);
      for (const double step : steps) firsts.push_back(std::abs(step));
      for (const double bend : bends) seconds.push_back(std::abs(bend));
    }
    if (firsts.empty()) continue;
    const bool is_smooth_in_most =
        averaged == 1 && middle_of(seconds) < kSmoothInMost * middle_of(firsts);
    if (is_smooth_in_most) return true;
    if (first > 0.0 && second < kSmooth * kSmooth * first) return true;
  }
  return false;
}

bool ResidualNoise::is_white() const {
  return std::all_of(
      curves_.begin(), curves_.end(), [](const Curve& c) { return c.process.order() == 0; });
}

ResidualNoise::Sums ResidualNoise::sums(const Curve& curve, const Autoregression& process) const {
  const Eigen::Index k = Q_.cols();
  Eigen::MatrixXd own(std::ssize(curve.rows), k + 1);
  own << Q_(curve.rows, Eigen::all), x_(curve.rows);
  const Eigen::MatrixXd white = process.whitened(own);
  const Eigen::MatrixXd gram = white.transpose() * white;
  return {gram.topLeftCorner(k, k),
          gram.topRightCorner(k, 1),
          gram(k, k),
          process.log_determinant(own.rows())};
}

double ResidualNoise::sigma_of(const Sums& all) const {
  if (!(freedom_ > 0.0)) return std::numeric_limits<double>::quiet_NaN();
  double left = all.c;
  if (all.b.size() > 0) left -= all.b.dot(Eigen::VectorXd(numerics::Cholesky(all.A).solve(all.b)));
  return std::sqrt(std::max(0.0, left) / freedom_);
}

double ResidualNoise::deviance(const Sums& all) const {
  const double reached = all.b.size() > 0 ? numerics::Cholesky(all.A).log_determinant() : 0.0;
  const double sigma = sigma_of(all);
  return all.log_determinant + reached + 2.0 * freedom_ * std::log(sigma) +
         std::max(0.0, kHiddenCost * std::log(sigma / (kMostHidden * seen_)));
}

double ResidualNoise::deviance_with(const Sums& rest,
                                    const Curve& curve,
                                    const std::vector<double>& z) const {
  Sums all = sums(curve, process_of(z));
  all.A += rest.A;
  all.b += rest.b;
  all.c += rest.c;
  all.log_determinant += rest.log_determinant;
  return deviance(all);
}

/// Fits orders one after the other: each new partial correlation first alone, then together with
/// the lower ones.
void ResidualNoise::fit(Curve& curve, const Sums& rest) const {
  const size_t longest =
      std::min(kMostOrder, static_cast<size_t>(std::ssize(curve.rows) / kSamplesAnOrder));
  std::vector<double> z, best;
  double least = deviance_with(rest, curve, z);
  for (size_t order = 1; order <= std::min(longest, best.size() + kOrdersInVain); ++order) {
    const auto search = [&](size_t i, double from, double to, int cuts) {
      z[i] = least_between(from, to, cuts, [&](double value) {
        std::vector<double> tried = z;
        tried[i] = value;
        return deviance_with(rest, curve, tried);
      });
    };
    z.push_back(0.0);
    search(order - 1, -kMostZ, kMostZ, kFirstCuts);
    for (double width : {0.4, 0.1}) {
      for (size_t i = 0; order > 1 && i < order; ++i) {
        search(i, std::max(-kMostZ, z[i] - width), std::min(kMostZ, z[i] + width), kLaterCuts);
      }
    }
    const double value = deviance_with(rest, curve, z) + 2.0 * static_cast<double>(order);
    if (value < least) {
      least = value;
      best = z;
    }
  }
  curve.process = process_of(best);
  const auto p = static_cast<Eigen::Index>(best.size());
  Eigen::MatrixXd H(p, p);  // Hessian of -2 l, which is twice the information matrix
  const auto at = [&](Eigen::Index i, double di, Eigen::Index j, double dj) {
    std::vector<double> moved = best;
    moved[static_cast<size_t>(i)] += di;
    moved[static_cast<size_t>(j)] += dj;
    return deviance_with(rest, curve, moved);
  };
  const double h = kDerivative;
  for (Eigen::Index i = 0; i < p; ++i) {
    for (Eigen::Index j = 0; j <= i; ++j) {
      H(i, j) = H(j, i) =
          (at(i, h, j, h) - at(i, h, j, -h) - at(i, -h, j, h) + at(i, -h, j, -h)) / (4.0 * h * h);
    }
  }
  if (p == 0) return;
  const auto [values, vectors] = numerics::self_adjoint_eigen(H);
  // Smallest curvature of a direction. Less curvature means that the data do not bound the
  // direction.
  constexpr double kLeast = 1e-3;
  curve.variance =
      2.0 * vectors * values.cwiseMax(kLeast).cwiseInverse().asDiagonal() * vectors.transpose();
}

Eigen::MatrixXd ResidualNoise::colored(const Eigen::MatrixXd& Y) const {
  Eigen::MatrixXd Z = deviations_.asDiagonal() * Y;
  for (const Curve& curve : curves_) {
    if (curve.process.order() == 0) continue;
    const Eigen::MatrixXd own = Z(curve.rows, Eigen::all);
    Z(curve.rows, Eigen::all) = curve.process.colored(own);
  }
  return Z;
}

Eigen::MatrixXd ResidualNoise::covariance(const Eigen::MatrixXd& Y) const {
  const Eigen::MatrixXd Z = colored(Y);
  Eigen::MatrixXd all = Z.transpose() * Z;
  if (has_groups()) all += groups_.more_covariance(deviations_.asDiagonal() * Y);
  return all;
}

Eigen::MatrixXd ResidualNoise::whitened(const Eigen::MatrixXd& Y) const {
  Eigen::MatrixXd Z = deviations_.cwiseInverse().asDiagonal() * Y;
  for (const Curve& curve : curves_) {
    if (curve.process.order() == 0) continue;
    const Eigen::MatrixXd own = Z(curve.rows, Eigen::all);
    Z(curve.rows, Eigen::all) = curve.process.whitened(own);
  }
  return Z;
}

Eigen::MatrixXd ResidualNoise::unwhitened(const Eigen::MatrixXd& Z) const {
  Eigen::MatrixXd Y = Z;
  for (const Curve& curve : curves_) {
    if (curve.process.order() == 0) continue;
    const Eigen::MatrixXd own = Y(curve.rows, Eigen::all);
    Y(curve.rows, Eigen::all) = curve.process.unwhitened(own);
  }
  return deviations_.asDiagonal() * Y;
}

Eigen::VectorXd ResidualNoise::effective_deviations() const {
  Eigen::VectorXd effective = deviations_;
  for (const Curve& curve : curves_) {
    effective(curve.rows) *= std::sqrt(curve.process.samples_for_one());
  }
  return effective;
}

double ResidualNoise::samples_for_one() const {
  double sum = 0.0, count = 0.0;
  for (const Curve& curve : curves_) {
    if (curve.process.order() == 0) continue;
    const auto rows = static_cast<double>(curve.rows.size());
    sum += rows * curve.process.samples_for_one();
    count += rows;
  }
  return count > 0.0 ? sum / count : 1.0;
}

double ResidualNoise::log_variance(const Eigen::VectorXd& y,
                                   size_t curve,
                                   const std::vector<double>& z,
                                   const Sums& rest,
                                   bool known) const {
  const Autoregression process = process_of(z);
  const Eigen::VectorXd own = deviations_.cwiseProduct(y)(curves_[curve].rows);
  const double part = process.colored(own).squaredNorm();
  const double before = curves_[curve].process.colored(own).squaredNorm();
  const double variance = colored(y).squaredNorm() - before + part;
  if (known) return std::log(variance);
  Sums all = sums(curves_[curve], process);
  all.A += rest.A;
  all.b += rest.b;
  all.c += rest.c;
  return std::log(variance) + 2.0 * std::log(sigma_of(all));
}

double ResidualNoise::freedom_of(const Eigen::VectorXd& y, bool known) const {
  double spread = known ? 0.0 : 2.0 / freedom_;  // relative variance of the variance
  if (has_groups()) spread = groups_.relative_variance(colored(y));
  for (size_t k = 0; k < curves_.size(); ++k) {
    if (curves_[k].process.order() == 0) continue;
    Sums rest = alone_sums_;
    for (size_t other = 0; other < curves_.size(); ++other) {
      if (other == k) continue;
      rest.A += curve_sums_[other].A;
      rest.b += curve_sums_[other].b;
      rest.c += curve_sums_[other].c;
    }
    std::vector<double> z;
    for (const double kappa : curves_[k].process.partial()) z.push_back(std::atanh(kappa));
    Eigen::VectorXd slope(std::ssize(z));
    for (size_t i = 0; i < z.size(); ++i) {
      std::vector<double> up = z, down = z;
      up[i] += kDerivative;
      down[i] -= kDerivative;
      slope[static_cast<Eigen::Index>(i)] =
          (log_variance(y, k, up, rest, known) - log_variance(y, k, down, rest, known)) /
          (2.0 * kDerivative);
    }
    spread += slope.dot(curves_[k].variance * slope);
  }
  const double freedom = spread > 0.0 ? 2.0 / spread : std::numeric_limits<double>::infinity();
  const double fewest = has_groups() ? kFewestFreedomOfGroups : kFewestFreedomOfNoise;
  return std::max(is_pattern_ ? kFewestFreedom : fewest, freedom);
}

}  // namespace latsch
