// SPDX-License-Identifier: Apache-2.0
#include "correlation/nuisance/nuisance_solver.h"

#include <algorithm>
#include <cmath>

#include "correlation/nuisance/nuisance_projection.h"

namespace latsch::correlation {
namespace {

constexpr int kFirstShifts = 21;     // shifts from which a free one starts
constexpr int kMostShiftSteps = 12;  // Gauss-Newton steps; two to four are usual
constexpr int kMostHalvings = 8;
constexpr double kSettledShift = 1e-12;  // share of the range; a smaller step ends the search

/// Channels without their slopes, for the comparisons at which a shift is only tried.
Channels without_slopes(const Channels& trial) {
  Channels plain;
  for (Channel channel : trial.all()) {
    channel.slopes.clear();
    plain.add(std::move(channel));
  }
  return plain;
}

class NuisanceSolver {
 public:
  NuisanceSolver(const Nuisance& nuisance,
                 const NuisanceWeights& weights,
                 const Observable& observable,
                 const ObjectiveSettings& settings)
      : nuisance_(nuisance), observable_(observable), settings_(settings) {
    const auto m = static_cast<Eigen::Index>(observable.values());
    rows_ = Eigen::VectorXd::Constant(m, weights.weight > 0.0 ? std::sqrt(weights.weight) : 1.0);
    for (Eigen::Index i = 0; i < m && !weights.deviations.empty(); ++i)
      rows_[i] /= weights.deviations[static_cast<std::size_t>(i)];
    sigma_.resize(std::ssize(nuisance.numbers));
    for (Eigen::Index k = 0; k < sigma_.size(); ++k)
      sigma_[k] = nuisance.numbers[static_cast<std::size_t>(k)].prior;
  }

  /// The comparison at given numbers: differences d, d d/d number, sum of squares with priors.
  struct At {
    Comparison plain;  // at the shift, without offset and gain
    Eigen::VectorXd z, d;
    Eigen::MatrixXd A;
    double sum = INFINITY;
  };

  Result<At> at(const Channels& trial, const Eigen::VectorXd& z) const {
    const int shift = nuisance_.shift();
    auto plain = shift < 0 ? observable_.compare(trial, settings_)
                           : observable_.compare_shifted(trial, settings_, z[shift]);
    if (!plain) return plain.failure();
    At at{std::move(*plain), z, {}, {}};
    fill(at);
    return at;
  }

  /// Returns the numbers with the least sum of squares at the shift of `z`.
  Result<At> solved_at_shift(const Channels& trial, const Eigen::VectorXd& z) const {
    auto found = at(trial, z);
    if (!found) return found;
    const int shift = nuisance_.shift();
    Eigen::MatrixXd A = rows_.asDiagonal() * found->A;
    if (shift >= 0) A.col(shift).setZero();
    const NuisanceProjection projection(A, sigma_);
    Eigen::VectorXd step = projection.step(rows_.cwiseProduct(found->d), found->z);
    if (shift >= 0) step[shift] = 0.0;
    found->z += step;
    fill(*found);
    return found;
  }

  Result<At> solved(const Channels& trial, const DelayRange& range, bool& at_end) const {
    const int shift = nuisance_.shift();
    Eigen::VectorXd z = Eigen::VectorXd::Zero(sigma_.size());
    if (shift < 0) return solved_at_shift(trial, z);
    const Channels plain = without_slopes(trial);
    z[shift] = std::clamp(0.0, range.lower, range.upper);
    auto best = solved_at_shift(plain, z);
    if (!best) return best;
    if (nuisance_.numbers[static_cast<std::size_t>(shift)].is_free()) {
      for (int k = 0; k < kFirstShifts; ++k) {
        z[shift] = range.lower + (range.upper - range.lower) * k / (kFirstShifts - 1);
        auto one = solved_at_shift(plain, z);
        if (one && one->sum < best->sum) best = std::move(one);
      }
    }
    const double width = range.upper - range.lower;
    for (int pass = 0; pass < kMostShiftSteps; ++pass) {
      const NuisanceProjection projection(rows_.asDiagonal() * best->A, sigma_);
      double step = projection.step(rows_.cwiseProduct(best->d), best->z)[shift];
      bool is_better = false;
      for (int halving = 0; halving < kMostHalvings && !is_better; ++halving, step *= 0.5) {
        z[shift] = std::clamp(best->z[shift] + step, range.lower, range.upper);
        if (std::abs(z[shift] - best->z[shift]) <= kSettledShift * width) break;
        auto one = solved_at_shift(plain, z);
        if (!one || !(one->sum < best->sum)) continue;
        is_better = true;
        best = std::move(one);
      }
      if (!is_better) break;
    }
    at_end = best->z[shift] <= range.lower + kSettledShift * width ||
             best->z[shift] >= range.upper - kSettledShift * width;
    const Eigen::VectorXd numbers = best->z;
    return at(trial, numbers);
  }

  /// Returns the comparison at the numbers, with projected slopes unless the numbers are held.
  Comparison finished(At at, const DelayRange& range, bool at_end) const {
    Comparison c = std::move(at.plain);
    const std::size_t m = c.differences.size(), n = c.slopes.size() / m;
    const int shift = nuisance_.shift();
    const int gain = position(NuisanceKind::gain);
    const double times = gain < 0 ? 1.0 : 1.0 + at.z[gain];
    for (double& slope : c.slopes) slope *= times;
    Eigen::MatrixXd A = at.A;
    // A shift at the end of its range does not follow the variables.
    if (at_end && shift >= 0) A.col(shift).setZero();
    const NuisanceProjection projection(rows_.asDiagonal() * A, sigma_);
    const Eigen::VectorXd deviations = projection.deviations();
    Eigen::MatrixXd following;
    if (n > 0 && nuisance_.held.empty()) {
      Eigen::MatrixXd J(m, n);
      for (std::size_t i = 0; i < m; ++i)
        for (std::size_t j = 0; j < n; ++j)
          J(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = c.slopes[i * n + j];
      following = projection.following(rows_.asDiagonal() * J);
      if (at_end && shift >= 0) following.row(shift).setZero();
      J += A * following;
      for (std::size_t i = 0; i < m; ++i)
        for (std::size_t j = 0; j < n; ++j)
          c.slopes[i * n + j] = J(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
    }
    for (std::size_t k = 0; k < nuisance_.numbers.size(); ++k) {
      const auto column = static_cast<Eigen::Index>(k);
      SolvedNumber number{nuisance_.numbers[k].kind, at.z[column], nuisance_.numbers[k].prior};
      if (static_cast<int>(k) == shift && nuisance_.held.empty()) {
        number.at_end = at_end;
        number.lower = range.lower;
        number.upper = range.upper;
      }
      number.is_determined = projection.determines(column);
      number.deviation = deviations[column];
      number.columns.assign(at.A.col(column).begin(), at.A.col(column).end());
      if (nuisance_.held.empty() && n > 0)
        number.slopes.assign(following.row(column).begin(), following.row(column).end());
      else if (n > 0)
        number.slopes.assign(n, 0.0);
      c.nuisance.push_back(std::move(number));
    }
    c.errors = c.differences = {at.d.begin(), at.d.end()};
    summarize(c, settings_);
    return c;
  }

 private:
  int position(NuisanceKind kind) const {
    for (std::size_t k = 0; k < nuisance_.numbers.size(); ++k)
      if (nuisance_.numbers[k].kind == kind) return static_cast<int>(k);
    return -1;
  }

  /// Sets d, A and the sum of squares for the comparison at the shift and the numbers z.
  void fill(At& at) const {
    const auto m = static_cast<Eigen::Index>(at.plain.differences.size());
    const auto& measured = observable_.measured_values();
    const auto& scales = observable_.scales();
    const int offset = position(NuisanceKind::offset), gain = position(NuisanceKind::gain);
    const int shift = nuisance_.shift();
    at.d.resize(m);
    at.A = Eigen::MatrixXd::Zero(m, at.z.size());
    for (Eigen::Index i = 0; i < m; ++i) {
      const auto k = static_cast<std::size_t>(i);
      // (measured - simulated) / scale is the plain difference
      const double simulated = measured[k] / scales[k] - at.plain.differences[k];
      at.d[i] = at.plain.differences[k];
      if (gain >= 0) {
        at.A(i, gain) = -simulated;
        at.d[i] -= at.z[gain] * simulated;
      }
      if (offset >= 0) {
        at.A(i, offset) = -1.0 / scales[k];
        at.d[i] -= at.z[offset] / scales[k];
      }
      if (shift >= 0) at.A(i, shift) = at.plain.by_shift[k] * (gain < 0 ? 1.0 : 1.0 + at.z[gain]);
    }
    at.sum = rows_.cwiseProduct(at.d).squaredNorm();
    for (Eigen::Index k = 0; k < at.z.size(); ++k)
      if (std::isfinite(sigma_[k])) at.sum += at.z[k] * at.z[k] / (sigma_[k] * sigma_[k]);
  }

  const Nuisance& nuisance_;
  const Observable& observable_;
  const ObjectiveSettings& settings_;
  Eigen::VectorXd rows_, sigma_;
};

}  // namespace

Result<Comparison> compare_with(const Nuisance& nuisance,
                                const NuisanceWeights& weights,
                                const Observable& observable,
                                const ObjectiveSettings& settings,
                                const Channels& trial) {
  if (nuisance.empty()) return observable.compare(trial, settings);
  const NuisanceSolver solver(nuisance, weights, observable, settings);
  if (!nuisance.held.empty()) {
    const Eigen::VectorXd z =
        Eigen::Map<const Eigen::VectorXd>(nuisance.held.data(), std::ssize(nuisance.held));
    auto at = solver.at(trial, z);
    if (!at) return at.failure();
    return solver.finished(std::move(*at), {}, false);
  }
  DelayRange range;
  if (nuisance.shift() >= 0) {
    const auto found = observable.shift_range(trial);
    if (!found) return found.failure();
    range = *found;
  }
  bool at_end = false;
  auto at = solver.solved(trial, range, at_end);
  if (!at) return at.failure();
  return solver.finished(std::move(*at), range, at_end);
}

}  // namespace latsch::correlation
