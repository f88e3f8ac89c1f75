// SPDX-License-Identifier: Apache-2.0
#include "optimization/identifiability/identification.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <memory>
#include <numeric>

#include "optimization/identifiability/robust_rows.h"
#include "optimization/problem/point_vector.h"

namespace latsch {
namespace {

// Tolerance of the refits and of the steps of a profile, as a share of the threshold.
constexpr double kTolerance = 0.02;
// Largest number of evaluations of the refit, to which two for each variable are added.
constexpr int kEvaluationsOfTheRefit = 30;
constexpr int kEvaluationsOfAShortRefit = 5;
/// Usual numbers of steps of a branch of a profile, and of evaluations of a step beside those for
/// derivatives. They serve the forecast of the remaining time alone.
constexpr int kUsualRungs = 9, kUsualRefitOfARung = 2;
constexpr int kMostWeakRounds = 3;
// Smallest improvement for which all rounds start again at the better point, as a share of the
// threshold. A smaller improvement moves an interval by at most a sixth of its width.
constexpr double kWorthwhile = 0.1;

std::vector<double> numbers(const Eigen::VectorXd& u) { return {u.begin(), u.end()}; }

DesignPoint moved_along(const DesignSpace& space,
                        const DesignPoint& center,
                        const Eigen::VectorXd& way,
                        double offset) {
  std::vector<double> u = space.to_unit(center);
  for (size_t i = 0; i < u.size(); ++i) u[i] += offset * way[static_cast<Eigen::Index>(i)];
  const DesignPoint there = space.from_unit(u);
  DesignPoint point = center;
  for (size_t i = 0; i < u.size(); ++i)
    if (way[static_cast<Eigen::Index>(i)] != 0.0) point.values[i] = there.values[i];
  return point;
}

}  // namespace

Identification::Identification(const DesignSpace& space,
                               const DesignPoint& point,
                               const IdentificationOptions& options)
    : space_(space), options_(options), free_(options.free) {
  if (free_.empty()) {
    free_.resize(static_cast<size_t>(space_.size()));
    std::iota(free_.begin(), free_.end(), 0);
  }
  const FeasibleRegion region(space_);
  if (region.E().rows() > 0) {
    options_.confidence.plane = EqualPlane(region.E());
    const EqualPlane plane = options_.confidence.plane.of(free_);
    const Eigen::MatrixXd N = plane.motions();
    const Eigen::MatrixXd P = N * N.transpose();
    ways_ = Eigen::MatrixXd::Zero(space_.size(), space_.size());
    ways_(free_, free_) = P;
  }
  begin_at(point);
}

/// Returns the motion of all variables for a unit motion of one of them: that variable alone, or
/// what linear equations leave of its motion, scaled so that its largest component is 1; 0 if they
/// leave nothing. `scale` is the factor.
Eigen::VectorXd Identification::way(int variable, double& scale) const {
  constexpr double kNone = 1e-9;
  scale = 1.0;
  if (ways_.size() == 0) return Eigen::VectorXd::Unit(space_.size(), variable);
  const double largest = ways_.col(variable).cwiseAbs().maxCoeff();
  if (!(largest > kNone)) return Eigen::VectorXd::Zero(space_.size());
  scale = 1.0 / largest;
  return ways_.col(variable) * scale;
}

/// Returns the point u of the unit cube, in which the variables that may not move have exactly the
/// bits of the center.
DesignPoint Identification::held_at_center(const Eigen::VectorXd& u) const {
  DesignPoint point = center_;
  const DesignPoint moved = space_.from_unit(numbers(u));
  for (const int i : free_)
    point.values[static_cast<size_t>(i)] = moved.values[static_cast<size_t>(i)];
  return point;
}

Confidence Identification::confidence_of_free(const Linearization& at) const {
  if (std::ssize(free_) == space_.size()) return latsch::confidence(at, options_.confidence);
  const Linearization part{at.u(free_), at.r, at.J(Eigen::all, free_), at.is_exact};
  ConfidenceOptions options = options_.confidence;
  options.plane = options.plane.of(free_);
  return of_all_variables(latsch::confidence(part, options), free_, at.u);
}

/// Returns the center moved by `offset` along the way of one variable; all variables that do not
/// move keep their exact bits.
DesignPoint Identification::moved(int variable, double offset) const {
  double scale = 1.0;
  return moved_along(space_, center_, way(variable, scale), offset);
}

std::vector<Identification::Term> Identification::derivative(int variable) const {
  std::vector<Term> terms;
  if (!std::binary_search(free_.begin(), free_.end(), variable)) return terms;
  double scale = 1.0;
  if (way(variable, scale).isZero(0.0)) return terms;
  for (const auto& [offset, weight] : searches_[static_cast<size_t>(variable)].terms())
    terms.push_back({offset == 0.0 ? center_ : moved(variable, offset), weight / scale});
  return terms;
}

void Identification::begin_at(const DesignPoint& center) {
  center_ = center;
  at_.reset();
  r_.reset();
  branches_.clear();
  searches_.clear();
  weak_.reset();
  weak_rounds_ = 0;
  unknown_.clear();
  const std::vector<double> u = space_.to_unit(center);
  const auto space = std::make_shared<const DesignSpace>(space_);
  for (int i = 0; i < space_.size(); ++i) {
    // `this` is not captured, because an Identification may be moved while it searches.
    double scale = 1.0;
    const auto has_room = [space, center, way = way(i, scale), at = u](double offset) {
      for (size_t k = 0; k < at.size(); ++k) {
        const double step = offset * way[static_cast<Eigen::Index>(k)];
        if (step != 0.0 && (at[k] + step < 0.0 || at[k] + step > 1.0)) return false;
      }
      return space->contains(moved_along(*space, center, way, offset));
    };
    searches_.emplace_back(has_room, options_.step);
  }
  ask_slopes();
  wanted_.insert(wanted_.begin(), center_);
}

void Identification::ask_slopes() {
  wanted_.clear();
  owners_.clear();
  for (const int i : free_) {
    double scale = 1.0;
    if (way(i, scale).isZero(0.0)) continue;  // linear equations hold it
    for (const double offset : searches_[static_cast<size_t>(i)].wanted()) {
      wanted_.push_back(moved(i, offset));
      owners_.push_back(i);
    }
  }
}

void Identification::observe(const std::vector<Result<Evaluated>>& evaluated) {
  assert(!wanted_.empty());
  assert(evaluated.size() == wanted_.size() || is_enough(evaluated.front()));
  if (!at_) {
    slopes_observed(evaluated);
    return;
  }
  look_for_better(evaluated);
  if (weak_) {
    weak_directions_observed(evaluated);
  } else if (refit_) {
    refit_observed(used(evaluated.front()));
  } else {
    for (size_t k = 0; k < asked_.size(); ++k) branches_[asked_[k]].observe(used(evaluated[k]));
    ask_branches();
  }
}

std::optional<Evaluated> Identification::used(const Result<Evaluated>& evaluated) const {
  if (!evaluated) return std::nullopt;
  Evaluated rows = evaluated->is_reduced ? *evaluated : evaluated->of(rows_);
  for (int i = 0; rows.has_slopes() && i < space_.size(); ++i)
    if (!std::binary_search(free_.begin(), free_.end(), i)) rows.J.col(i).setZero();
  return rows.r.allFinite() ? std::optional(std::move(rows)) : std::nullopt;
}

void Identification::look_for_better(const std::vector<Result<Evaluated>>& evaluated) {
  for (size_t k = 0; k < evaluated.size(); ++k) {
    const auto rows = used(evaluated[k]);
    if (!rows || rows->r.squaredNorm() >= least_) continue;
    least_ = rows->r.squaredNorm();
    least_point_ = wanted_[k];
  }
}

/// Selects the residuals used: those known at the center and at all points beside it whose
/// evaluation succeeded. Later centers use the same residuals.
Status Identification::center_observed(const std::vector<Result<Evaluated>>& evaluated) {
  if (!evaluated.front())
    return Failure{"at the point the evaluation failed: " + evaluated.front().failure().reason};
  if (centers_ == 1) {
    std::vector<Eigen::VectorXd> all;
    for (const auto& one : evaluated) {
      if (one) all.push_back(one->r);
    }
    rows_ = known_residuals(all);
    if (rows_.empty()) return Failure{"no residual is known at the point and beside it"};
    options_.confidence.traits = options_.confidence.traits.of(rows_);
    const auto& deviations = options_.confidence.traits.deviations;
    scale_ = Eigen::VectorXd::Ones(std::ssize(rows_));
    if (!deviations.empty()) {
      scale_ = to_vector(deviations);
    }
  }
  const auto rows = used(evaluated.front());
  assert(rows);  // never fails: a later center was evaluated as a trial before
  r_ = rows->r;
  least_ = r_->squaredNorm();
  least_point_ = center_;
  return {};
}

/// Returns by how much the residuals change in total at the ends of the interval of a variable, if
/// all other variables are held.
double Identification::felt() const {
  constexpr double kAsAtTheEnds = 2.0;  // standard deviations
  if (options_.confidence.sigma) return kAsAtTheEnds * *options_.confidence.sigma;
  // A value with a large residual moves the ends no more than its psi does.
  const RobustRows rows(*r_, Eigen::MatrixXd(r_->size(), 0), options_.confidence.traits);
  const Eigen::VectorXd x = rows.psi().cwiseQuotient(scale_);
  const double freedom = static_cast<double>(x.size()) - static_cast<double>(free_.size());
  return freedom > 0.0 ? kAsAtTheEnds * x.norm() / std::sqrt(freedom) : 0.0;
}

void Identification::slopes_observed(const std::vector<Result<Evaluated>>& evaluated) {
  size_t first = 0;
  if (!r_) {
    const bool is_told = is_enough(evaluated.front());
    status_ = center_observed(evaluated);
    if (!status_) {
      wanted_.clear();
      return;
    }
    if (is_told) {
      qualities_.assign(static_cast<size_t>(space_.size()), SlopeQuality::straight);
      lengths_ = Eigen::VectorXd::Constant(space_.size(), options_.step);
      linearized({to_vector(space_.to_unit(center_)), *r_, used(evaluated.front())->J, true});
      return;
    }
    first = 1;
  }
  look_for_better(evaluated);
  const Eigen::VectorXd center = r_->cwiseQuotient(scale_);
  for (int i = 0; i < space_.size(); ++i) {
    std::vector<std::optional<Eigen::VectorXd>> own;
    for (size_t k = 0; k < owners_.size(); ++k) {
      if (owners_[k] != i) continue;
      const auto rows = used(evaluated[first + k]);
      own.emplace_back();
      if (rows) own.back() = rows->r.cwiseQuotient(scale_);
    }
    if (!own.empty()) searches_[static_cast<size_t>(i)].observe(center, felt(), own);
  }
  ask_slopes();
  if (wanted_.empty()) take_slopes();
}

void Identification::take_slopes() {
  const int n = space_.size();
  Linearization at{to_vector(space_.to_unit(center_)), *r_, {}};
  at.J.resize(r_->size(), n);
  lengths_.resize(n);
  made_.curvature.resize(n);
  qualities_.clear();
  for (int i = 0; i < n; ++i) {
    const SlopeSearch& search = searches_[static_cast<size_t>(i)];
    double scale = 1.0;
    if (!std::binary_search(free_.begin(), free_.end(), i) || way(i, scale).isZero(0.0)) {
      at.J.col(i).setZero();
      lengths_[i] = options_.step;
      qualities_.push_back(SlopeQuality::straight);
      continue;
    }
    if (search.quality() == SlopeQuality::unknown) {
      status_ = Failure{"the evaluation fails on both sides of the point in " + space_[i].name +
                        ": no derivative is known"};
      return;
    }
    at.J.col(i) = scale_.cwiseProduct(search.slope()) / scale;
    lengths_[i] = search.length();
    // Derivatives of other qualities are reported.
    const bool is_straight = search.quality() == SlopeQuality::straight;
    made_.curvature[i] = is_straight ? search.bend() * search.bend() * at.J.col(i).norm() : 0.0;
    qualities_.push_back(search.quality());
  }
  made_.lengths = lengths_;
  linearized(std::move(at));
}

/// Returns the improvement of S for which all rounds start again at the better point. If neighbors
/// share noise, a threshold may exceed S itself, which must not hide that the point is no minimum.
double Identification::worthwhile() const {
  const double threshold = confidence_->threshold();
  return kWorthwhile *
         (confidence_->is_colored ? std::min(threshold, at_->sum_of_squares()) : threshold);
}

/// Completes round 1 with derivatives `at`, apart from the check of weak directions.
void Identification::linearized(Linearization at) {
  wanted_.clear();
  at_ = std::move(at);
  if (at_->is_exact && ways_.size() > 0) at_->J = at_->J * ways_;
  confidence_ = confidence_of_free(*at_);
  if (!std::isfinite(confidence_->sigma)) return;
  if (!at_->is_exact && ask_weak_directions()) return;
  after_slopes();
}

bool Identification::ask_weak_directions() {
  weak_.emplace(space_, *at_, *confidence_, made_, options_.confidence);
  for (const Eigen::VectorXd& u : weak_->wanted()) wanted_.push_back(space_.from_unit(numbers(u)));
  if (wanted_.empty()) weak_.reset();
  return weak_.has_value();
}

void Identification::weak_directions_observed(const std::vector<Result<Evaluated>>& evaluated) {
  std::vector<std::optional<Eigen::VectorXd>> residuals;
  for (const auto& one : evaluated) {
    const auto rows = used(one);
    residuals.push_back(rows ? std::optional(rows->r) : std::nullopt);
  }
  Eigen::MatrixXd J = weak_->checked(*at_, residuals);
  unknown_.insert(unknown_.end(), weak_->unknown().begin(), weak_->unknown().end());
  made_ = weak_->made();
  const bool is_other = J != at_->J;
  at_->J = std::move(J);
  wanted_.clear();
  if (is_other) confidence_ = confidence_of_free(*at_);
  // Wrong derivatives may have led to a check of other directions than the weak ones, so the check
  // is repeated.
  if (is_other && ++weak_rounds_ < kMostWeakRounds && ask_weak_directions()) return;
  weak_.reset();
  after_slopes();
}

/// Continues after round 1, when weak directions have been checked.
void Identification::after_slopes() {
  const double promised = confidence_->left_to_gain;
  const bool stays = centers_ >= options_.most_centers || !(promised > worthwhile());
  if (!options_.profiles && stays) {
    continues_at_better_point();
    return;
  }
  const int n = static_cast<int>(free_.size());
  refit_.emplace(
      *at_,
      free_,
      BroydenFitOptions{.tolerance = kTolerance * confidence_->threshold(),
                        .most_evaluations = options_.profiles ? kEvaluationsOfTheRefit + 2 * n
                                                              : kEvaluationsOfAShortRefit,
                        .differences = lengths_,
                        .region = FeasibleRegion(space_)});
  ask_for_refit();
}

bool Identification::continues_at_better_point() {
  const double gain = at_->sum_of_squares() - least_;
  if (centers_ >= options_.most_centers || !(gain > worthwhile())) return false;
  ++centers_;
  begin_at(least_point_);
  return true;
}

void Identification::refit_observed(const std::optional<Evaluated>& evaluated) {
  refit_->observe(evaluated);
  ask_for_refit();
}

/// Requests the next point of the refit, or begins the profiles if the refit has ended.
void Identification::ask_for_refit() {
  if (refit_->wanted()) {
    wanted_ = {held_at_center(*refit_->wanted())};
  } else {
    begin_profiles();
  }
}

void Identification::begin_profiles() {
  best_ = refit_->best();
  refit_.reset();
  if (continues_at_better_point()) return;
  if (!options_.profiles) {
    wanted_.clear();
    return;
  }
  const Confidence at_best = confidence_of_free(*best_);
  thresholds_ = at_best.thresholds;
  const ProfileSettings settings{FeasibleRegion(space_), lengths_, free_};
  for (const int i : free_) {
    const Interval& interval = at_best.intervals[i];
    const double half = std::min(interval.upper - best_->u[i], best_->u[i] - interval.lower);
    for (int direction : {-1, +1}) {
      branches_.emplace_back(*best_, i, direction, half, thresholds_[i], settings);
    }
  }
  ask_branches();
}

Identification::Phase Identification::phase() const {
  if (!branches_.empty()) return Phase::profiles;  // also at their end
  return refit_ ? Phase::refit : Phase::derivatives;
}

long Identification::expected_left() const {
  if (wanted_.empty()) return 0;
  const long n = std::ssize(free_);
  long left = std::ssize(wanted_);
  if (phase() == Phase::derivatives && options_.profiles) left += n;  // the refit
  if (!options_.profiles) return left;
  long rungs = 0;
  for (const ProfileBranch& branch : branches_) rungs += branch.rungs_left();
  if (branches_.empty()) rungs = 2 * n * kUsualRungs;
  // A rung recomputes derivatives of some other variables unless the model returns them.
  const long a_rung = kUsualRefitOfARung + (at_ && at_->is_exact ? 0 : (n - 1) / 2);
  return left + rungs * a_rung;
}

double Identification::share_done() const {
  double done = 0.0, left = 0.0;
  for (const ProfileBranch& branch : branches_) {
    done += static_cast<double>(branch.points().size());
    left += branch.rungs_left();
  }
  return done > 0.0 ? done / (done + left) : 0.0;
}

void Identification::ask_branches() {
  wanted_.clear();
  asked_.clear();
  for (size_t b = 0; b < branches_.size(); ++b) {
    const auto u = branches_[b].wanted();
    if (!u) continue;
    asked_.push_back(static_cast<int>(b));
    wanted_.push_back(held_at_center(*u));
  }
  if (!wanted_.empty() || continues_at_better_point()) return;
  for (size_t k = 0; k < free_.size(); ++k) {
    const int i = free_[k];
    profiles_.push_back(judge(*best_, i, branches_[2 * k], branches_[2 * k + 1], thresholds_[i]));
  }
}

}  // namespace latsch
