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

class NuisanceSolver {
 public:
  /// `fixed` has a value for every number that is not solved, and NaN for the others.
  NuisanceSolver(const Nuisance& nuisance,
                 const NuisanceWeights& weights,
                 const Observable& observable,
                 const ObjectiveSettings& settings,
                 Eigen::VectorXd fixed)
      : nuisance_(nuisance),
        observable_(observable),
        settings_(settings),
        rows_(root_weights(weights, observable.values())),
        fixed_(std::move(fixed)) {
    for (Eigen::Index k = 0; k < fixed_.size(); ++k)
      if (std::isnan(fixed_[k])) solved_.push_back(k);
    sigma_.resize(std::ssize(solved_));
    for (Eigen::Index j = 0; j < sigma_.size(); ++j) sigma_[j] = number(solved_[place(j)]).prior;
    shift_ = nuisance.shift();
    own_shift_ = shift_ >= 0 && std::isnan(fixed_[shift_]) ? shift_ : -1;
  }

  bool solves_shift() const { return own_shift_ >= 0; }

  /// The comparison at given numbers: differences d, d d/d number, sum of squares with priors.
  struct At {
    Comparison plain;  // at the shift, without offset and gain
    Eigen::VectorXd z, d;
    Eigen::MatrixXd A;
    double sum = INFINITY;
  };

  Result<At> at(const Channels& trial, const Eigen::VectorXd& z) const {
    auto plain = shift_ < 0 ? observable_.compare(trial, settings_)
                            : observable_.compare_shifted(trial, settings_, z[shift_]);
    if (!plain) return plain.failure();
    At at{std::move(*plain), z, {}, {}};
    fill(at);
    return at;
  }

  /// Returns the numbers with the least sum of squares at the shift of `z`.
  Result<At> solved_at_shift(const Channels& trial, const Eigen::VectorXd& z) const {
    auto found = at(trial, z);
    if (!found) return found;
    Eigen::VectorXd step = this->step(*found, own_shift_ >= 0);
    for (Eigen::Index j = 0; j < step.size(); ++j)
      if (solved_[place(j)] != own_shift_) found->z[solved_[place(j)]] += step[j];
    fill(*found);
    return found;
  }

  Result<At> solved(const Channels& trial, const DelayRange& range, bool& at_end) const {
    Eigen::VectorXd z = fixed_.array().isNaN().select(0.0, fixed_);
    if (own_shift_ < 0) return solved_at_shift(trial, z);
    const int shift = own_shift_;
    const Channels plain = without_slopes(trial);
    z[shift] = std::clamp(0.0, range.lower, range.upper);
    auto best = solved_at_shift(plain, z);
    if (!best) return best;
    if (number(shift).is_free()) {
      for (int k = 0; k < kFirstShifts; ++k) {
        z[shift] = range.lower + (range.upper - range.lower) * k / (kFirstShifts - 1);
        auto one = solved_at_shift(plain, z);
        if (one && one->sum < best->sum) best = std::move(one);
      }
    }
    const double width = range.upper - range.lower;
    const auto place_of_shift = std::find(solved_.begin(), solved_.end(), shift) - solved_.begin();
    for (int pass = 0; pass < kMostShiftSteps; ++pass) {
      double step = this->step(*best, false)[place_of_shift];
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

  /// Returns the comparison at the numbers, with slopes for which the solved numbers follow. The
  /// fixed numbers are taken for variables, too, in the order of their positions.
  ComparedAtShared finished(At at, const DelayRange& range, bool at_end) const {
    ComparedAtShared all;
    Comparison& c = all.comparison = std::move(at.plain);
    const auto m = static_cast<Eigen::Index>(c.differences.size());
    const auto n = static_cast<Eigen::Index>(c.slopes.size()) / m;
    const int gain = position(NuisanceKind::gain);
    const double times = gain < 0 ? 1.0 : 1.0 + at.z[gain];
    for (double& slope : c.slopes) slope *= times;
    std::vector<Eigen::Index> fixed;
    for (Eigen::Index k = 0; k < fixed_.size(); ++k)
      if (!std::isnan(fixed_[k])) fixed.push_back(k);
    Eigen::MatrixXd A = at.A(Eigen::all, solved_);
    // A shift at the end of its range does not follow the variables.
    if (at_end && own_shift_ >= 0)
      A.col(std::find(solved_.begin(), solved_.end(), own_shift_) - solved_.begin()).setZero();
    const NuisanceProjection projection(rows_.asDiagonal() * A, sigma_);
    const Eigen::VectorXd deviations = projection.deviations();
    Eigen::MatrixXd J(m, n + std::ssize(fixed));
    for (Eigen::Index i = 0; i < m; ++i)
      for (Eigen::Index j = 0; j < n; ++j) J(i, j) = c.slopes[place(i * n + j)];
    J.rightCols(std::ssize(fixed)) = at.A(Eigen::all, fixed);
    Eigen::MatrixXd following = projection.following(rows_.asDiagonal() * J);
    for (Eigen::Index j = 0; j < following.rows(); ++j)
      if (at_end && solved_[place(j)] == own_shift_) following.row(j).setZero();
    J += A * following;
    for (Eigen::Index i = 0; i < m; ++i)
      for (Eigen::Index j = 0; j < n; ++j) c.slopes[place(i * n + j)] = J(i, j);
    all.by_shared = J.rightCols(std::ssize(fixed));
    all.numbers_by_shared = Eigen::MatrixXd::Zero(fixed_.size(), std::ssize(fixed));
    all.sum = at.sum;
    for (Eigen::Index k = 0; k < fixed_.size(); ++k) {
      SolvedNumber solved{number(k).kind, at.z[k], number(k).prior};
      solved.columns.assign(at.A.col(k).begin(), at.A.col(k).end());
      solved.slopes.assign(place(n), 0.0);
      c.nuisance.push_back(std::move(solved));
    }
    for (std::size_t f = 0; f < fixed.size(); ++f)
      all.numbers_by_shared(fixed[f], static_cast<Eigen::Index>(f)) = 1.0;
    for (Eigen::Index j = 0; j < following.rows(); ++j) {
      const Eigen::Index k = solved_[place(j)];
      SolvedNumber& solved = c.nuisance[place(k)];
      if (k == own_shift_) {
        solved.at_end = at_end;
        solved.lower = range.lower;
        solved.upper = range.upper;
      }
      solved.is_determined = projection.determines(j);
      solved.deviation = deviations[j];
      solved.slopes.assign(following.row(j).begin(), following.row(j).begin() + n);
      all.numbers_by_shared.row(k) = following.row(j).tail(std::ssize(fixed));
    }
    c.errors = c.differences = {at.d.begin(), at.d.end()};
    summarize(c, settings_);
    return all;
  }

 private:
  static std::size_t place(Eigen::Index k) { return static_cast<std::size_t>(k); }
  const NuisanceNumber& number(Eigen::Index k) const { return nuisance_.numbers[place(k)]; }

  /// Returns the Gauss-Newton step of the solved numbers; with the shift held, if so asked.
  Eigen::VectorXd step(const At& at, bool holds_shift) const {
    Eigen::MatrixXd A = rows_.asDiagonal() * at.A(Eigen::all, solved_);
    for (Eigen::Index j = 0; j < A.cols(); ++j)
      if (holds_shift && solved_[place(j)] == own_shift_) A.col(j).setZero();
    return NuisanceProjection(A, sigma_).step(rows_.cwiseProduct(at.d), at.z(solved_));
  }

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
      if (shift_ >= 0) at.A(i, shift_) = at.plain.by_shift[k] * (gain < 0 ? 1.0 : 1.0 + at.z[gain]);
    }
    at.sum = rows_.cwiseProduct(at.d).squaredNorm();
    for (Eigen::Index j = 0; j < sigma_.size(); ++j)
      if (std::isfinite(sigma_[j])) at.sum += std::pow(at.z[solved_[place(j)]] / sigma_[j], 2);
  }

  const Nuisance& nuisance_;
  const Observable& observable_;
  const ObjectiveSettings& settings_;
  Eigen::VectorXd rows_;              // root of the weight of each difference
  Eigen::VectorXd fixed_;             // value of each number; NaN: it is solved
  std::vector<Eigen::Index> solved_;  // positions of the numbers that are solved
  Eigen::VectorXd sigma_;             // deviations of their priors
  int shift_ = -1, own_shift_ = -1;   // position of the shift; of the shift if it is solved
};

/// Returns the comparison at the best values of the numbers that are not fixed.
Result<ComparedAtShared> solve(const NuisanceSolver& solver,
                               const Observable& observable,
                               const Channels& trial) {
  DelayRange range;
  if (solver.solves_shift()) {
    const auto found = observable.shift_range(trial);
    if (!found) return found.failure();
    range = *found;
  }
  bool at_end = false;
  auto at = solver.solved(trial, range, at_end);
  if (!at) return at.failure();
  return solver.finished(std::move(*at), range, at_end);
}

}  // namespace

Channels without_slopes(const Channels& trial) {
  Channels plain;
  for (Channel channel : trial.all()) {
    channel.slopes.clear();
    plain.add(std::move(channel));
  }
  return plain;
}

Eigen::VectorXd root_weights(const NuisanceWeights& weights, std::size_t count) {
  const auto m = static_cast<Eigen::Index>(count);
  Eigen::VectorXd rows =
      Eigen::VectorXd::Constant(m, weights.weight > 0.0 ? std::sqrt(weights.weight) : 1.0);
  for (Eigen::Index i = 0; i < m && !weights.deviations.empty(); ++i)
    rows[i] /= weights.deviations[static_cast<std::size_t>(i)];
  return rows;
}

Result<Comparison> compare_with(const Nuisance& nuisance,
                                const NuisanceWeights& weights,
                                const Observable& observable,
                                const ObjectiveSettings& settings,
                                const Channels& trial) {
  if (nuisance.empty()) return observable.compare(trial, settings);
  Eigen::VectorXd fixed = Eigen::VectorXd::Constant(std::ssize(nuisance.numbers), NAN);
  for (std::size_t k = 0; k < nuisance.held.size(); ++k)
    fixed[static_cast<Eigen::Index>(k)] = nuisance.held[k];
  auto found =
      solve(NuisanceSolver(nuisance, weights, observable, settings, fixed), observable, trial);
  if (!found) return found.failure();
  return std::move(found->comparison);
}

Result<ComparedAtShared> compare_at_shared(const Nuisance& nuisance,
                                           const NuisanceWeights& weights,
                                           const Observable& observable,
                                           const ObjectiveSettings& settings,
                                           const Channels& trial,
                                           const std::vector<double>& shared) {
  Eigen::VectorXd fixed = Eigen::VectorXd::Constant(std::ssize(nuisance.numbers), NAN);
  std::size_t next = 0;
  for (std::size_t k = 0; k < nuisance.numbers.size(); ++k)
    if (nuisance.numbers[k].is_shared()) fixed[static_cast<Eigen::Index>(k)] = shared[next++];
  return solve(NuisanceSolver(nuisance, weights, observable, settings, fixed), observable, trial);
}

}  // namespace latsch::correlation
