// SPDX-License-Identifier: Apache-2.0
#include "correlation/posterior/posterior_frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "correlation/analysis/identification_rounds.h"
#include "correlation/target/residuals.h"
#include "evaluation/journal/asked_trials.h"
#include "optimization/problem/feasible_region.h"
#include "optimization/problem/point_vector.h"

namespace latsch::correlation {
namespace {

/// Residuals of this size, relative to the data, are rounding errors and tell no noise.
constexpr double kExactFit = 1e-6;

}  // namespace

PosteriorFrame::PosteriorFrame(const Study& study,
                               const SamplingStart& start,
                               const Identification& identification)
    : study_(study),
      start_(start),
      identification_(identification),
      axes_(study.free),
      whole_(to_vector(study.space.to_unit(start.center))) {
  if (axes_.empty())
    for (int i = 0; i < study.space.size(); ++i) axes_.push_back(i);
  const std::vector<ResidualRow> all = residual_rows(study);
  for (const Eigen::Index row : identification.residuals_used())
    if (all[static_cast<std::size_t>(row)].owner() >= 0) rows_.push_back(row);
  const Linearization& at = identification.linearization();
  std::vector<Eigen::Index> places;  // places of these rows among the used ones; priors come last
  for (Eigen::Index k = 0; k < std::ssize(rows_); ++k) places.push_back(k);
  const Eigen::MatrixXd J = at.J(places, axes_);
  const Eigen::VectorXd r = at.r(places);
  const IdentificationOptions options = options_for(study, Depth::at_the_point);
  const ResidualTraits traits = options.confidence.traits.of(rows_);
  solved_ = static_cast<int>(traits.solved.size());
  noise_.emplace(r, J, traits, options.confidence.sigma ? 0.0 : options.confidence.least_noise);
  r_ = noise_->whitened(r);
  J_ = noise_->whitened(J);
}

std::string PosteriorFrame::reason() const {
  if (residual_sigma(study_)) return "";
  if (std::ssize(rows_) - solved_ <= std::ssize(axes_))
    return "there are no more measured values than variables, so nothing tells how large their "
           "noise is: state the noise of the experiments";
  if (r_.norm() <= kExactFit * std::sqrt(static_cast<double>(r_.size())))
    return fmt::format(
        "the model fits to {:.1g}, which is no noise of a measurement: state the noise of the "
        "experiments",
        r_.norm() / std::sqrt(static_cast<double>(r_.size())));
  return "";
}

bool PosteriorFrame::is_noise_stated() const {
  return !noise_->is_pattern() && residual_sigma(study_) &&
         identification_.confidence().excess == 1.0;
}

FittedDensity PosteriorFrame::density(const Journal& journal,
                                      std::vector<std::string>& remarks) const {
  FittedDensity fit;
  fit.r_c = r_;
  fit.J = J_;
  fit.slopes_exact = identification_.linearization().is_exact;
  const Confidence& c = identification_.confidence();
  double s = noise_->sigma();
  if (noise_->is_pattern()) {
    fit.density.s = s;
    remarks.emplace_back(
        "The residuals are a systematic misfit and no noise: the samples take them for noise of "
        "their size, and do not say how far the values are from those of a model that fits.");
  } else if (is_noise_stated()) {
    fit.density.s = s = 1.0;
  } else {
    fit.density.s = std::nullopt;
    if (c.excess > 1.0)
      remarks.push_back(fmt::format(
          "The residuals are {:.2g} times their stated noise: its size counts as unknown.",
          c.excess));
  }
  if (!noise_->is_white() && !noise_->is_pattern())
    remarks.emplace_back(
        "Neighboring values seem to share noise, as estimated at the fit. The density weighs the "
        "values "
        "by "
        "it and the fit does not, so medians may lie beside the fit; and the samples do not know "
        "how uncertain the estimate is.");
  fit.density.values = r_.size() - solved_;
  fit.density.log_prior = log_prior();
  fit.frame = whitened_frame(center(), with_priors(J_ / s));
  fit.known = known_samples(journal);
  return fit;
}

DesignPoint PosteriorFrame::point(const Eigen::VectorXd& u) const {
  Eigen::VectorXd all = whole_;
  all(axes_) = u;
  DesignPoint moved = study_.space.from_unit({all.begin(), all.end()});
  for (int i = 0; i < study_.space.size(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    if (std::find(axes_.begin(), axes_.end(), i) == axes_.end())
      moved.values[at] = start_.center.values[at];
  }
  return moved;
}

std::optional<Eigen::VectorXd> PosteriorFrame::whitened(const Eigen::VectorXd& residuals) const {
  const Eigen::VectorXd own = residuals(rows_);
  if (!own.allFinite()) return std::nullopt;
  return Eigen::VectorXd(noise_->whitened(own));
}

Eigen::MatrixXd PosteriorFrame::unwhitened(const Eigen::MatrixXd& whitened) const {
  return noise_->unwhitened(whitened);
}

/// Returns the rows of J with those of the priors below, by differences of the prior's residual
/// over a short way of the cube.
Eigen::MatrixXd PosteriorFrame::with_priors(const Eigen::MatrixXd& J) const {
  constexpr double kWay = 1e-4;
  Eigen::MatrixXd all = J;
  for (Eigen::Index k = 0; k < std::ssize(axes_); ++k) {
    const auto i = static_cast<std::size_t>(axes_[static_cast<std::size_t>(k)]);
    const auto& prior = study_.space.variables()[i].prior;
    if (!prior) continue;
    Eigen::VectorXd u = center();
    const double way = u[k] < 0.5 ? kWay : -kWay;
    const double before = prior->residual(point(u).values[i]);
    u[k] += way;
    const double after = prior->residual(point(u).values[i]);
    all.conservativeResize(all.rows() + 1, Eigen::NoChange);
    all.bottomRows(1).setZero();
    all(all.rows() - 1, k) = (after - before) / way;
  }
  return all;
}

LogDensityAt PosteriorFrame::log_prior() const {
  const auto& variables = study_.space.variables();
  const bool has_priors =
      std::any_of(variables.begin(), variables.end(), [](const auto& v) { return v.prior; });
  const auto region = std::make_shared<FeasibleRegion>(study_.space);
  if (!has_priors && region->is_cube()) return {};
  return [this, has_priors, region](const Eigen::VectorXd& u) {
    if (!region->is_cube()) {
      Eigen::VectorXd all = whole_;
      all(axes_) = u;
      if (!region->contains(all)) return kNoDensity;
    }
    if (!has_priors) return 0.0;
    const DesignPoint at = point(u);
    double sum = 0.0;
    for (const int axis : axes_) {
      const auto i = static_cast<std::size_t>(axis);
      if (const auto& prior = study_.space.variables()[i].prior)
        sum -= 0.5 * std::pow(prior->residual(at.values[i]), 2);
    }
    return sum;
  };
}

/// Returns the trials from which the surrogate may learn: those requested before the sampling
/// began, at which the variables that are not sampled have the values of the fit.
std::vector<KnownSample> PosteriorFrame::known_samples(const Journal& journal) const {
  const Objective objective = residual_objective(study_);
  const AskedTrials asked(journal.marks());
  std::vector<KnownSample> known;
  long row = 0;
  journal.for_each([&](const Trial& trial) {
    const long at = row++;
    if (at >= start_.trials || !asked.contains(at, trial.point) ||
        !study_.space.contains(trial.point))
      return;
    const Eigen::VectorXd u = to_vector(study_.space.to_unit(trial.point));
    const Eigen::VectorXd own = u(axes_);
    if (point(own).values != trial.point.values) {
      // values of the axes may differ by rounding; those of the others must not
      for (int i = 0; i < study_.space.size(); ++i)
        if (std::find(axes_.begin(), axes_.end(), i) == axes_.end() && u[i] != whole_[i]) return;
    }
    KnownSample sample{own, std::nullopt};
    if (trial.outcome.result) {
      if (const auto score = objective(trial.point, *trial.outcome.result))
        sample.r = whitened(to_vector(score->residuals));
    }
    known.push_back(std::move(sample));
  });
  return known;
}

}  // namespace latsch::correlation
