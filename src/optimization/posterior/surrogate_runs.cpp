// SPDX-License-Identifier: Apache-2.0
#include "optimization/posterior/surrogate_runs.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <utility>

#include "numerics/dense/self_adjoint_eigen.h"

namespace latsch {
namespace {

constexpr double kFarthest = 6.0;  // linear deviations within which earlier trials are used
// Linear deviations from the fit below which a trial is not used if the slopes are exact. It would
// tell the curvature alone, from a difference that is as small as the rounding errors of the model:
// at this distance an error of 1e-6 deviations of the noise is one of 0.005 two deviations away.
// The last steps of a search are nearer, and one of them made a surrogate wild everywhere.
constexpr double kNearest = 0.04;
constexpr int kPlainDraws = 3, kSpreadDraws = 3, kBatch = kPlainDraws + kSpreadDraws;
constexpr Eigen::Index kCandidates = 40;  // draws among which those of large variance are chosen
constexpr double kGoodBatch = 0.3;        // root mean square error of the log density, plain draws
constexpr double kGoodSpread = 1.0;       // limit for the draws with the largest variance
constexpr int kGoodInARow = 2;
constexpr int kCheckDraws = 10;
// Climbs of walkers that a new surrogate leaves without a noticeable density: damping of the normal
// equations relative to their mean diagonal, its change, and the number of steps.
constexpr double kFirstDamping = 1e-3, kMostDamping = 1e6, kMoreDamping = 4.0;
constexpr int kUphillSteps = 60;
constexpr double kHeld = 1.0;  // eigenvalue above which data hold a direction; see straighten()
// Number of variables above which no coordinates are straightened: a move in them costs some n^3
// operations, and there are 4 n walkers.
constexpr Eigen::Index kMostStraightened = 12;
constexpr double kStands = 0.3, kRefused = 1.0, kOneTooFar = 3.0;
// Steps of the chains between batches; the first three quarters of them are the way to the new
// density, the last quarter is the way from the candidates to the plain draws.
constexpr long kBatchSteps = 200, kBatchStepsOfVariable = 40;
constexpr std::uint64_t kStreamOfChoice = 2'000'000;

bool is_close(const FittedDensity& fit, const Eigen::VectorXd& u) {
  return fit.frame.deviations(u) <= kFarthest;
}

double root_mean_square(const std::vector<double>& errors) {
  double sum = 0.0;
  for (const double e : errors) sum += e * e;
  return std::sqrt(sum / static_cast<double>(errors.size()));
}

/// Returns the indices of `count` candidates, one after the other that with the largest variance
/// given the points before `first` and those already chosen. C is the covariance of all points.
std::vector<Eigen::Index> largest_variances(Eigen::MatrixXd C, Eigen::Index first, int count) {
  const auto learn_from = [&C](Eigen::Index k) {
    const double own = C(k, k);
    if (!(own > 0.0)) return;
    const Eigen::VectorXd column = C.col(k);
    C.noalias() -= column * column.transpose() / own;
  };
  for (Eigen::Index k = 0; k < first; ++k) learn_from(k);
  std::vector<Eigen::Index> chosen;
  while (std::ssize(chosen) < count) {
    Eigen::Index best = first;
    for (Eigen::Index k = first; k < C.rows(); ++k) {
      const bool is_new = std::find(chosen.begin(), chosen.end(), k) == chosen.end();
      const bool best_is_new = std::find(chosen.begin(), chosen.end(), best) == chosen.end();
      if (is_new && (!best_is_new || C(k, k) > C(best, best))) best = k;
    }
    chosen.push_back(best);
    learn_from(best);
  }
  return chosen;
}

}  // namespace

const char* name(SurrogateVerdict verdict) {
  switch (verdict) {
    case SurrogateVerdict::unchecked:
      return "unchecked";
    case SurrogateVerdict::stands:
      return "stands";
    case SurrogateVerdict::doubtful:
      return "doubtful";
    case SurrogateVerdict::refused:
      break;
  }
  return "refused";
}

/// The surrogate with the samples from which it is made.
struct SurrogateRuns::Model {
  FittedDensity const* fit;
  ResidualSurrogate surrogate;
  Eigen::MatrixXd succeeded, failed;  // samples in whitened coordinates, one in each column

  double at(const Eigen::VectorXd& u) const {
    const Eigen::VectorXd y = fit->frame.whitened(u);
    if (failed.cols() > 0) {
      // the fit itself, at y = 0, is a sample that succeeded
      double good = y.squaredNorm();
      if (succeeded.cols() > 0)
        good = std::min(good, (succeeded.colwise() - y).colwise().squaredNorm().minCoeff());
      if ((failed.colwise() - y).colwise().squaredNorm().minCoeff() < good) return kNoDensity;
    }
    return fit->density.at(surrogate.sum_of_squares(y), u);
  }

  // Coordinates in which a valley is straight. With the eigenvectors v of w J'J at the fit,
  // w the information of a residual, those with an eigenvalue above 1 (data that hold the direction
  // twice as well as the cube does) stand for products of residuals, q = (J v)' r(y); the others
  // for themselves, q = v' y.
  Eigen::MatrixXd of_weights = {}, of_place = {};

  void straighten() {
    const Eigen::VectorXd center = Eigen::VectorXd::Zero(fit->frame.center.size());
    const Eigen::MatrixXd J = surrogate.reduced() * surrogate.weight_slopes(center);
    const double S = fit->r_c.squaredNorm();
    const double weight =
        fit->density.s ? std::pow(*fit->density.s, -2) : static_cast<double>(fit->r_c.size()) / S;
    const Eigen::MatrixXd information = weight * J.transpose() * J;
    const auto eigen = numerics::self_adjoint_eigen(information);
    const Eigen::Index held = (eigen.values.array() > kHeld).count(), free = center.size() - held;
    const Eigen::VectorXd lengths = (eigen.values.tail(held) / weight).cwiseSqrt();
    const Eigen::MatrixXd products =
        lengths.cwiseInverse().asDiagonal() * (J * eigen.vectors.rightCols(held)).transpose();
    of_weights = products * surrogate.reduced();
    of_place = eigen.vectors.leftCols(free).transpose();
  }
  Eigen::VectorXd coordinates(const Eigen::VectorXd& u) const {
    const Eigen::VectorXd y = fit->frame.whitened(u);
    Eigen::VectorXd q(y.size());
    q << of_weights * surrogate.weights(y), of_place * y;
    return q;
  }
  Eigen::MatrixXd slopes(const Eigen::VectorXd& u) const {
    const Eigen::VectorXd y = fit->frame.whitened(u);
    Eigen::MatrixXd slopes(y.size(), y.size());  // dq/dy
    slopes << of_weights * surrogate.weight_slopes(y), of_place;
    const Eigen::MatrixXd of_y = slopes.transpose();
    const Eigen::MatrixXd of_u = fit->frame.T.triangularView<Eigen::Lower>().adjoint().solve(of_y);
    return of_u.transpose();
  }

  /// Returns a place of larger density, by damped steps of least squares on the surrogate that are
  /// cut off at the bounds.
  Eigen::VectorXd uphill(Eigen::VectorXd u) const {
    double value = at(u), damping = kFirstDamping;
    for (int step = 0; step < kUphillSteps; ++step) {
      const Eigen::VectorXd y = fit->frame.whitened(u);
      const Eigen::MatrixXd J = surrogate.reduced() * surrogate.weight_slopes(y);
      const Eigen::MatrixXd JJ = J.transpose() * J;
      const Eigen::VectorXd Jr = J.transpose() * (surrogate.reduced() * surrogate.weights(y));
      const double length = JJ.trace() / static_cast<double>(y.size());
      for (; damping < kMostDamping; damping *= kMoreDamping) {
        Eigen::MatrixXd A = JJ;
        A.diagonal().array() += damping * length;
        const numerics::Cholesky factor(A);
        if (!factor.is_positive_definite()) continue;
        const Eigen::VectorXd tried =
            fit->frame.place(y - factor.solve(Jr)).cwiseMax(0.0).cwiseMin(1.0);
        const double there = at(tried);
        if (!(there > value)) continue;
        u = tried;
        value = there;
        damping /= kMoreDamping * kMoreDamping;
        break;
      }
    }
    return u;
  }
};

SurrogateRuns::SurrogateRuns(FittedDensity fit, const SurrogateRunOptions& options)
    : fit_(std::move(fit)), options_(options), choice_(options.seed, kStreamOfChoice) {
  std::erase_if(fit_.known, [this](const KnownSample& s) { return !is_close(fit_, s.u); });
  learn();
  ask();
}

void SurrogateRuns::learn() {
  const Eigen::Index n = fit_.frame.center.size();
  std::vector<const KnownSample*> good, bad;
  for (const KnownSample& sample : fit_.known) {
    const bool is_apart = fit_.slopes_exact ? fit_.frame.deviations(sample.u) >= kNearest
                                            : sample.u != fit_.frame.center;  // known by r_c
    if (sample.r && is_apart) good.push_back(&sample);
    if (!sample.r) bad.push_back(&sample);
  }
  SurrogateSamples samples{Eigen::MatrixXd(std::ssize(good), n),
                           Eigen::MatrixXd(std::ssize(good), fit_.r_c.size()),
                           fit_.r_c,
                           fit_.J * fit_.frame.T,
                           fit_.slopes_exact};
  for (Eigen::Index k = 0; k < std::ssize(good); ++k) {
    const KnownSample& sample = *good[static_cast<std::size_t>(k)];
    samples.Y.row(k) = fit_.frame.whitened(sample.u).transpose();
    samples.R.row(k) = sample.r->transpose();
  }
  Eigen::MatrixXd failed(n, std::ssize(bad));
  for (Eigen::Index k = 0; k < std::ssize(bad); ++k)
    failed.col(k) = fit_.frame.whitened(bad[static_cast<std::size_t>(k)]->u);
  samples_used_ = std::ssize(good) + 1;
  // a copy of the fit belongs to the model, which may outlive this object in a density
  struct Owned {
    FittedDensity fit;
    Model model;
  };
  FittedDensity plain = fit_;
  plain.known.clear();
  auto owned = std::make_shared<Owned>(
      Owned{std::move(plain),
            Model{nullptr, ResidualSurrogate(samples), samples.Y.transpose(), std::move(failed)}});
  owned->model.fit = &owned->fit;
  owned->model.straighten();
  model_ = std::shared_ptr<const Model>(owned, &owned->model);
}

LogDensityAt SurrogateRuns::log_density() const {
  return [model = model_](const Eigen::VectorXd& u) { return model->at(u); };
}

Eigen::MatrixXd SurrogateRuns::residuals_at(const Eigen::MatrixXd& u) const {
  Eigen::MatrixXd points(u.rows(), u.cols());
  for (Eigen::Index k = 0; k < u.cols(); ++k) points.col(k) = fit_.frame.whitened(u.col(k));
  return model_->surrogate.residuals_at(points);
}

Straightening SurrogateRuns::straightening() const {
  if (fit_.frame.center.size() > kMostStraightened) return {};
  return {[model = model_](const Eigen::VectorXd& u) { return model->coordinates(u); },
          [model = model_](const Eigen::VectorXd& u) { return model->slopes(u); }};
}

void SurrogateRuns::ask() {
  wanted_.clear();
  expected_.clear();
  const LogDensityAt density = log_density();
  if (!chains_ || !chains_->change_density(density, straightening())) {
    const auto starts = walker_starts(fit_.frame, {}, density, options_.seed);
    if (!starts) {  // the fit itself has no density: its constraints exclude it
      phase_ = Phase::done;
      return;
    }
    chains_.emplace(density, *starts, options_.seed, straightening());
  }
  chains_->raise([this](const Eigen::VectorXd& u) { return model_->uphill(u); });
  if (phase_ == Phase::batches && trials_ + kBatch + kCheckDraws > options_.runs)
    phase_ = Phase::check;
  if (phase_ == Phase::batches) {
    ask_batch();
  } else if (options_.runs >= kCheckDraws) {
    ask_check();
  } else {
    phase_ = Phase::done;
  }
}

std::vector<int> SurrogateRuns::drawn_walkers(int count) {
  std::vector<int> walkers(static_cast<std::size_t>(chains_->walkers()));
  std::iota(walkers.begin(), walkers.end(), 0);
  for (int k = 0; k < count; ++k) {
    const auto rest = static_cast<std::uint64_t>(std::ssize(walkers) - k);
    std::swap(walkers[static_cast<std::size_t>(k)],
              walkers[static_cast<std::size_t>(k) + choice_.below(rest)]);
  }
  walkers.resize(static_cast<std::size_t>(count));
  return walkers;
}

void SurrogateRuns::ask_batch() {
  const Eigen::Index n = fit_.frame.center.size();
  const long steps = kBatchSteps + kBatchStepsOfVariable * n;
  chains_->forget();
  chains_->advance(steps / 2, options_.threads);
  chains_->release_stuck();
  chains_->advance(steps / 4, options_.threads);
  const Eigen::MatrixXd candidates = chains_->places().leftCols(kCandidates);
  const Eigen::VectorXd of_candidates = chains_->log_densities().head(kCandidates);
  chains_->advance(steps - steps / 2 - steps / 4, options_.threads);
  for (const int walker : drawn_walkers(kPlainDraws)) {
    wanted_.emplace_back(chains_->places().col(walker));
    expected_.push_back(chains_->log_densities()[walker]);
  }
  Eigen::MatrixXd points(kPlainDraws + candidates.cols(), n);
  for (int k = 0; k < kPlainDraws; ++k)
    points.row(k) = fit_.frame.whitened(wanted_[static_cast<std::size_t>(k)]).transpose();
  for (Eigen::Index k = 0; k < candidates.cols(); ++k)
    points.row(kPlainDraws + k) = fit_.frame.whitened(candidates.col(k)).transpose();
  for (const Eigen::Index k :
       largest_variances(model_->surrogate.covariance(points), kPlainDraws, kSpreadDraws)) {
    wanted_.emplace_back(candidates.col(k - kPlainDraws));
    expected_.push_back(of_candidates[k - kPlainDraws]);
  }
}

void SurrogateRuns::ask_check() {
  const long steps = kBatchSteps + kBatchStepsOfVariable * fit_.frame.center.size();
  chains_->forget();
  chains_->advance(steps, options_.threads);
  chains_->release_stuck();
  chains_->advance(steps, options_.threads);
  for (const int walker : drawn_walkers(kCheckDraws)) {
    wanted_.emplace_back(chains_->places().col(walker));
    expected_.push_back(chains_->log_densities()[walker]);
  }
}

double SurrogateRuns::model_density(const KnownSample& sample) const {
  return sample.r ? fit_.density.at(sample.r->squaredNorm(), sample.u) : kNoDensity;
}

void SurrogateRuns::observe(const std::vector<std::optional<Eigen::VectorXd>>& outcomes) {
  std::vector<double> errors;
  std::vector<KnownSample> seen;
  for (std::size_t k = 0; k < outcomes.size(); ++k) {
    seen.push_back({wanted_[k], outcomes[k]});
    ++trials_;
    if (!outcomes[k]) ++failed_;
    errors.push_back(model_density(seen.back()) - expected_[k]);
  }
  if (phase_ == Phase::check) {
    judge(errors);
    phase_ = Phase::done;
    wanted_.clear();
    return;
  }
  const auto middle = errors.begin() + kPlainDraws;
  batch_errors_.push_back(root_mean_square({errors.begin(), middle}));
  const bool is_good =
      batch_errors_.back() < kGoodBatch && root_mean_square({middle, errors.end()}) < kGoodSpread;
  good_in_a_row_ = is_good ? good_in_a_row_ + 1 : 0;
  for (KnownSample& sample : seen) fit_.known.push_back(std::move(sample));
  learn();
  if (good_in_a_row_ >= kGoodInARow) {
    settled_ = true;
    phase_ = Phase::check;
  }
  ask();
}

void SurrogateRuns::judge(const std::vector<double>& errors) {
  check_.draws = static_cast<int>(std::ssize(errors));
  double sum = 0.0;
  std::vector<double> finite;
  for (const double e : errors) {
    if (!std::isfinite(e)) {
      ++check_.failed;
      continue;
    }
    finite.push_back(e);
    sum += e;
  }
  const auto count = static_cast<double>(finite.size());
  double squares = 0.0;
  for (const double e : finite) {
    const double own = e - sum / count;
    squares += own * own;
    check_.largest = std::max(check_.largest, std::abs(own));
  }
  check_.deviation = finite.size() > 1 ? std::sqrt(squares / (count - 1.0)) : 0.0;
  if (check_.failed > 0 || check_.deviation > kRefused || check_.largest > kOneTooFar)
    check_.verdict = SurrogateVerdict::refused;
  else
    check_.verdict =
        check_.deviation <= kStands ? SurrogateVerdict::stands : SurrogateVerdict::doubtful;
}

}  // namespace latsch
