// SPDX-License-Identifier: Apache-2.0
#include "correlation/nuisance/shared_numbers.h"

#include <algorithm>
#include <cmath>

#include "correlation/nuisance/nuisance_projection.h"

namespace latsch::correlation {
namespace {

constexpr int kFirstSharedShifts = 21;  // shifts from which a free one starts
constexpr int kMostSharedSteps = 12;    // Gauss-Newton steps; one to four are usual
constexpr int kMostSharedHalvings = 8;
/// Share of the sum of squares below which a step promises nothing that rounding would not.
constexpr double kSettledSum = 1e-24;

/// Priors of the own numbers of a recording as rows below its differences.
Eigen::MatrixXd with_priors(const SharingRecording& recording,
                            const Eigen::MatrixXd& differences,
                            const Eigen::MatrixXd& numbers) {
  const Eigen::VectorXd rows =
      root_weights(recording.weights, static_cast<std::size_t>(differences.rows()));
  const auto& own = recording.nuisance.numbers;
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(rows.size() + std::ssize(own), differences.cols());
  all.topRows(rows.size()) = rows.asDiagonal() * differences;
  for (Eigen::Index k = 0; k < std::ssize(own); ++k) {
    const NuisanceNumber& number = own[static_cast<std::size_t>(k)];
    if (!number.is_shared() && !number.is_free())
      all.row(rows.size() + k) = numbers.row(k) / number.prior;
  }
  return all;
}

class SharedSolver {
 public:
  SharedSolver(const std::vector<SharingRecording>& recordings, const Channels& trial)
      : recordings_(recordings), trial_(trial) {
    for (const SharingRecording& recording : recordings) {
      std::vector<Eigen::Index>& own = places_.emplace_back();
      for (const NuisanceNumber& number : recording.nuisance.numbers) {
        if (!number.is_shared()) continue;
        const auto known = std::find_if(numbers_.begin(), numbers_.end(), [&](const auto& one) {
          return one.is_one_with(number);
        });
        own.push_back(known - numbers_.begin());
        if (known == numbers_.end()) numbers_.push_back(number);
      }
    }
    sigma_.resize(std::ssize(numbers_));
    for (Eigen::Index k = 0; k < sigma_.size(); ++k)
      sigma_[k] = numbers_[static_cast<std::size_t>(k)].prior;
  }

  Result<std::vector<Comparison>> solved() {
    if (const Status known = find_ranges(); !known) return known.failure();
    const Channels plain = without_slopes(trial_);
    auto best = at(plain, Eigen::VectorXd::Zero(sigma_.size()).cwiseMax(lower_).cwiseMin(upper_));
    if (!best) return best.failure();
    for (Eigen::Index k = 0; k < sigma_.size(); ++k)
      if (is_shift(k) && numbers_[static_cast<std::size_t>(k)].is_free())
        try_shifts(k, plain, *best);
    for (int pass = 0; pass < kMostSharedSteps; ++pass) {
      Eigen::VectorXd step = NuisanceProjection(best->b, sigma_).step(best->r, best->c);
      if ((best->b * step).squaredNorm() <= kSettledSum * best->sum) break;
      bool is_better = false;
      for (int halving = 0; halving < kMostSharedHalvings && !is_better; ++halving, step *= 0.5) {
        auto one = at(plain, (best->c + step).cwiseMax(lower_).cwiseMin(upper_));
        if (!one || !(one->sum < best->sum)) continue;
        is_better = true;
        best = std::move(one);
      }
      if (!is_better) break;
    }
    auto found = at(trial_, best->c);
    if (!found) return found.failure();
    return finished(std::move(*found));
  }

 private:
  /// All recordings at the numbers c.
  struct At {
    Eigen::VectorXd c;
    std::vector<ComparedAtShared> all;
    Eigen::VectorXd r;  // weighted differences and priors of own numbers of those that choose
    Eigen::MatrixXd b;  // dr/dc
    Eigen::MatrixXd J;  // dr/d variable at constant c
    double sum = 0.0;
  };

  bool is_shift(Eigen::Index k) const {
    const NuisanceKind kind = numbers_[static_cast<std::size_t>(k)].kind;
    return kind == NuisanceKind::delay || kind == NuisanceKind::x_offset;
  }

  bool is_at_end(Eigen::Index k, const Eigen::VectorXd& c) const {
    return is_shift(k) && (c[k] <= lower_[k] || c[k] >= upper_[k]);
  }

  /// Finds the shifts that all recordings of a shared shift allow.
  Status find_ranges() {
    lower_ = Eigen::VectorXd::Constant(sigma_.size(), -INFINITY);
    upper_ = Eigen::VectorXd::Constant(sigma_.size(), INFINITY);
    for (std::size_t i = 0; i < recordings_.size(); ++i) {
      for (const Eigen::Index k : places_[i]) {
        if (!is_shift(k)) continue;
        const auto range = recordings_[i].observable.shift_range(trial_);
        if (!range) return range.failure();
        lower_[k] = std::max(lower_[k], range->lower);
        upper_[k] = std::min(upper_[k], range->upper);
        if (!(lower_[k] <= upper_[k]))
          return Failure{"no " + numbers_[static_cast<std::size_t>(k)].name() +
                         " lets the simulation cover all recordings that share it"};
      }
    }
    return {};
  }

  Result<At> at(const Channels& trial, const Eigen::VectorXd& c) const {
    At at;
    at.c = c;
    std::vector<Eigen::MatrixXd> r, b, J;
    Eigen::Index rows = 0;
    for (std::size_t i = 0; i < recordings_.size(); ++i) {
      const SharingRecording& one = recordings_[i];
      std::vector<double> shared;
      for (const Eigen::Index k : places_[i]) shared.push_back(c[k]);
      auto found =
          compare_at_shared(one.nuisance, one.weights, one.observable, one.settings, trial, shared);
      if (!found) return found.failure();
      at.all.push_back(std::move(*found));
      if (!one.chooses) continue;
      const ComparedAtShared& its = at.all.back();
      const auto m = std::ssize(its.comparison.differences);
      const auto n = std::ssize(its.comparison.slopes) / m;
      Eigen::MatrixXd values(std::ssize(its.comparison.nuisance), 1 + n);
      for (Eigen::Index k = 0; k < values.rows(); ++k) {
        const SolvedNumber& number = its.comparison.nuisance[static_cast<std::size_t>(k)];
        values(k, 0) = number.value;
        for (Eigen::Index j = 0; j < n; ++j)
          values(k, 1 + j) = number.slopes[static_cast<std::size_t>(j)];
      }
      Eigen::MatrixXd differences(m, 1 + n);
      for (Eigen::Index d = 0; d < m; ++d) {
        differences(d, 0) = its.comparison.differences[static_cast<std::size_t>(d)];
        for (Eigen::Index j = 0; j < n; ++j)
          differences(d, 1 + j) = its.comparison.slopes[static_cast<std::size_t>(d * n + j)];
      }
      const Eigen::MatrixXd all = with_priors(one, differences, values);
      const Eigen::MatrixXd own = with_priors(one, its.by_shared, its.numbers_by_shared);
      Eigen::MatrixXd by_all = Eigen::MatrixXd::Zero(own.rows(), sigma_.size());
      for (std::size_t j = 0; j < places_[i].size(); ++j)
        by_all.col(places_[i][j]) = own.col(static_cast<Eigen::Index>(j));
      r.emplace_back(all.leftCols(1));
      J.emplace_back(all.rightCols(n));
      b.push_back(std::move(by_all));
      rows += all.rows();
      at.sum += its.sum;
    }
    const auto stacked = [&](const std::vector<Eigen::MatrixXd>& parts, Eigen::Index columns) {
      Eigen::MatrixXd all(rows, columns);
      Eigen::Index row = 0;
      for (const Eigen::MatrixXd& part : parts) {
        all.middleRows(row, part.rows()) = part;
        row += part.rows();
      }
      return all;
    };
    const Comparison& first = at.all.front().comparison;
    at.r = stacked(r, 1).col(0);
    at.b = stacked(b, sigma_.size());
    at.J = stacked(J, std::ssize(first.slopes) / std::ssize(first.differences));
    for (Eigen::Index k = 0; k < sigma_.size(); ++k)
      if (std::isfinite(sigma_[k])) at.sum += std::pow(c[k] / sigma_[k], 2);
    return at;
  }

  /// Returns the projection on the numbers. A shift at an end of its range does not move.
  NuisanceProjection projection(const At& at) const {
    Eigen::MatrixXd b = at.b;
    for (Eigen::Index k = 0; k < sigma_.size(); ++k)
      if (is_at_end(k, at.c)) b.col(k).setZero();
    return {b, sigma_};
  }

  void try_shifts(Eigen::Index k, const Channels& plain, At& best) const {
    Eigen::VectorXd c = best.c;
    for (int i = 0; i < kFirstSharedShifts; ++i) {
      c[k] = lower_[k] + (upper_[k] - lower_[k]) * i / (kFirstSharedShifts - 1);
      auto one = at(plain, c);
      if (one && one->sum < best.sum) best = std::move(*one);
    }
  }

  std::vector<Comparison> finished(At at) const {
    const NuisanceProjection p = projection(at);
    const Eigen::MatrixXd covariance = p.covariance();
    Eigen::MatrixXd following = p.following(at.J);
    for (Eigen::Index k = 0; k < sigma_.size(); ++k)
      if (is_at_end(k, at.c)) following.row(k).setZero();
    std::vector<Comparison> comparisons;
    for (std::size_t i = 0; i < recordings_.size(); ++i) {
      ComparedAtShared& its = at.all[i];
      Comparison& c = its.comparison;
      const Eigen::MatrixXd own = following(places_[i], Eigen::all);
      const Eigen::MatrixXd spread = covariance(places_[i], places_[i]);
      const auto n = std::ssize(c.slopes) / std::ssize(c.differences);
      const Eigen::MatrixXd more = n > 0 ? Eigen::MatrixXd(its.by_shared * own) : Eigen::MatrixXd();
      for (Eigen::Index d = 0; d < more.rows(); ++d)
        for (Eigen::Index j = 0; j < n; ++j)
          c.slopes[static_cast<std::size_t>(d * n + j)] += more(d, j);
      std::size_t next = 0;
      for (std::size_t k = 0; k < c.nuisance.size(); ++k) {
        SolvedNumber& number = c.nuisance[k];
        const Eigen::RowVectorXd by = its.numbers_by_shared.row(static_cast<Eigen::Index>(k));
        for (Eigen::Index j = 0; j < n; ++j)
          number.slopes[static_cast<std::size_t>(j)] += by.dot(own.col(j));
        number.deviation = std::sqrt(number.deviation * number.deviation + by.dot(by * spread));
        if (!recordings_[i].nuisance.numbers[k].is_shared()) continue;
        const Eigen::Index place = places_[i][next++];
        number.is_determined = p.determines(place);
        if (!is_shift(place)) continue;
        number.at_end = is_at_end(place, at.c);
        number.lower = lower_[place];
        number.upper = upper_[place];
      }
      comparisons.push_back(std::move(c));
    }
    return comparisons;
  }

  const std::vector<SharingRecording>& recordings_;
  const Channels& trial_;
  std::vector<NuisanceNumber> numbers_;            // shared numbers, each once
  std::vector<std::vector<Eigen::Index>> places_;  // those of each recording
  Eigen::VectorXd sigma_, lower_, upper_;
};

}  // namespace

Result<std::vector<Comparison>> compare_together(const std::vector<SharingRecording>& recordings,
                                                 const Channels& trial) {
  return SharedSolver(recordings, trial).solved();
}

}  // namespace latsch::correlation
