// SPDX-License-Identifier: Apache-2.0
#include "correlation/posterior/posterior.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "correlation/analysis/identification_rounds.h"
#include "correlation/analysis/identification_start.h"
#include "correlation/analysis/in_rounds.h"
#include "correlation/target/residuals.h"
#include "evaluation/journal/asked_trials.h"
#include "optimization/problem/feasible_region.h"
#include "optimization/problem/point_vector.h"

namespace latsch::correlation {
namespace {

constexpr const char* kPosteriorMark = "posterior";
/// Residuals of this size, relative to the data, are rounding errors and tell no noise.
constexpr double kExactFit = 1e-6;

/// The start of a sampling: the fit, and the number of trials known then.
struct SamplingStart {
  DesignPoint center;
  long trials = 0;
};

std::string key_of_mark(const Study& study) { return study.target_key + " "; }

/// Returns the latest start of a sampling of the present study, unless a search has ended since.
std::optional<SamplingStart> marked_start(const Study& study, const Journal& journal) {
  std::optional<SamplingStart> start;
  const std::string key = key_of_mark(study);
  for (const JournalMark& mark : journal.marks()) {
    if (mark.kind == "ended") start.reset();
    if (mark.kind != kPosteriorMark || !mark.text.starts_with(key)) continue;
    if (const auto point = point_of_text(study, mark.text.substr(key.size())))
      start = SamplingStart{*point, mark.trials};
  }
  return start;
}

SamplingStart start_of(const Study& study, const Journal& journal, const DesignPoint& best) {
  if (const auto marked = marked_start(study, journal)) return *marked;
  const auto recorded = recorded_identifiability(study, journal);
  return {recorded ? recorded->point : best, journal.size()};
}

/// The density around one fit in the coordinates of the sampled variables.
class FitFrame {
 public:
  FitFrame(const Study& study, const SamplingStart& start, const Identification& identification)
      : study_(study),
        start_(start),
        identification_(identification),
        axes_(study.free),
        whole_(to_vector(study.space.to_unit(start.center))) {
    if (axes_.empty())
      for (int i = 0; i < study.space.size(); ++i) axes_.push_back(i);
    const std::vector<ResidualRow> all = residual_rows(study);
    for (const Eigen::Index row : identification.residuals_used())
      if (all[static_cast<std::size_t>(row)].experiment >= 0) rows_.push_back(row);
    const Linearization& at = identification.linearization();
    std::vector<Eigen::Index> places;  // places of these rows among the used ones; priors come last
    for (Eigen::Index k = 0; k < std::ssize(rows_); ++k) places.push_back(k);
    const Eigen::MatrixXd J = at.J(places, axes_);
    const Eigen::VectorXd r = at.r(places);
    const IdentificationOptions options = options_for(study, Depth::at_the_point);
    noise_.emplace(r,
                   J,
                   options.confidence.traits.of(rows_),
                   options.confidence.sigma ? 0.0 : options.confidence.least_noise);
    r_ = noise_->whitened(r);
    J_ = noise_->whitened(J);
  }

  const std::vector<int>& axes() const { return axes_; }
  Eigen::VectorXd center() const { return whole_(axes_); }

  /// Returns the reason why the density does not exist, or an empty text.
  std::string reason() const {
    if (residual_sigma(study_)) return "";
    if (std::ssize(rows_) <= std::ssize(axes_))
      return "there are no more measured values than variables, so nothing tells how large their "
             "noise is: state the noise of the experiments";
    if (r_.norm() <= kExactFit * std::sqrt(static_cast<double>(r_.size())))
      return fmt::format(
          "the model fits to {:.1g}, which is no noise of a measurement: state the noise of the "
          "experiments",
          r_.norm() / std::sqrt(static_cast<double>(r_.size())));
    return "";
  }

  FittedDensity density(const Journal& journal, Posterior& result) const {
    FittedDensity fit;
    fit.r_c = r_;
    fit.J = J_;
    fit.slopes_exact = identification_.linearization().is_exact;
    const Confidence& c = identification_.confidence();
    double s = noise_->sigma();
    if (noise_->is_pattern()) {
      fit.density.s = s;
      result.remarks.emplace_back(
          "The residuals are a systematic misfit and no noise: the samples take them for noise of "
          "their size, and do not say how far the values are from those of a model that fits.");
    } else if (residual_sigma(study_) && c.excess == 1.0) {
      fit.density.s = s = 1.0;
      result.noise_stated = true;
    } else {
      fit.density.s = std::nullopt;
      if (c.excess > 1.0)
        result.remarks.push_back(fmt::format(
            "The residuals are {:.2g} times their stated noise: its size counts as unknown.",
            c.excess));
    }
    if (!noise_->is_white() && !noise_->is_pattern())
      result.remarks.emplace_back(
          "Neighboring values seem to share noise, as estimated at the fit. The density weighs the "
          "values "
          "by "
          "it and the fit does not, so medians may lie beside the fit; and the samples do not know "
          "how uncertain the estimate is.");
    fit.density.values = r_.size();
    fit.density.log_prior = log_prior();
    fit.frame = whitened_frame(center(), with_priors(J_ / s));
    fit.known = known_samples(journal);
    return fit;
  }

  DesignPoint point(const Eigen::VectorXd& u) const {
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

  /// Returns the whitened residuals; nullopt if the trial failed, or if a value has no partner.
  std::optional<Eigen::VectorXd> whitened(const Eigen::VectorXd& residuals) const {
    const Eigen::VectorXd own = residuals(rows_);
    if (!own.allFinite()) return std::nullopt;
    return Eigen::VectorXd(noise_->whitened(own));
  }

 private:
  /// Returns the rows of J with those of the priors below, by differences of the prior's residual
  /// over a short way of the cube.
  Eigen::MatrixXd with_priors(const Eigen::MatrixXd& J) const {
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

  LogDensityAt log_prior() const {
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
  std::vector<KnownSample> known_samples(const Journal& journal) const {
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

  const Study& study_;
  SamplingStart start_;
  const Identification& identification_;
  std::vector<int> axes_;
  Eigen::VectorXd whole_;  // the fit in the unit cube of all variables
  std::vector<Eigen::Index> rows_;
  std::optional<ResidualNoise> noise_;
  Eigen::VectorXd r_;
  Eigen::MatrixXd J_;
};

/// Presents the runs of the surrogate as an analysis of design points.
class SampledPoints {
 public:
  SampledPoints(SurrogateRuns& runs, const FitFrame& frame) : runs_(runs), frame_(frame) { take(); }
  const std::vector<DesignPoint>& wanted() const { return wanted_; }
  void observe(const std::vector<Result<Evaluated>>& evaluated) {
    std::vector<std::optional<Eigen::VectorXd>> outcomes;
    for (const Result<Evaluated>& one : evaluated)
      outcomes.push_back(one ? frame_.whitened(one->r) : std::nullopt);
    runs_.observe(outcomes);
    take();
  }

 private:
  void take() {
    wanted_.clear();
    for (const Eigen::VectorXd& u : runs_.wanted()) wanted_.push_back(frame_.point(u));
  }

  SurrogateRuns& runs_;
  const FitFrame& frame_;
  std::vector<DesignPoint> wanted_;
};

/// Runs or reads all trials; nullopt if some are missing.
std::optional<Result<Posterior>> sampled(const Study& study,
                                         const SamplingStart& start,
                                         const Journal& journal,
                                         const Drive& drive) {
  const PosteriorSettings& settings = study.posterior;
  IdentificationOptions options = options_for(study, Depth::at_the_point);
  Identifiability what{
      start.center, Identification(study.space, start.center, options), std::nullopt};
  if (!analyze({study, journal, nullptr, drive}, what)) return std::nullopt;
  std::optional<Result<Posterior>> answer;
  const auto fail = [&](const std::string& reason) { (void)answer.emplace(Failure{reason}); };
  const Identification& identification = what.identification;
  if (!identification.status()) {
    fail(identification.status().failure().reason);
    return answer;
  }
  what.best = start.center;
  Posterior result;
  result.center = start.center;
  const FitFrame frame(study, start, identification);
  if (const std::string reason = frame.reason(); !reason.empty()) {
    fail(reason);
    return answer;
  }
  SurrogateRuns runs(frame.density(journal, result),
                     {.runs = settings.runs, .seed = settings.seed});
  SampledPoints points(runs, frame);
  InRounds<SampledPoints> rounds(study.space, points);
  const auto standing = [&]() -> WorkDone {
    return {runs.is_checking() ? "check of the surrogate by ten draws" : "trials of the surrogate",
            0.0,
            runs.is_checking() ? 0 : settings.runs - runs.trials()};
  };
  if (!points.wanted().empty() && !drive(rounds, nullptr, standing)) return std::nullopt;
  result.axes = frame.axes();
  result.check = runs.check();
  result.trials = runs.trials();
  result.failed = runs.failed();
  result.learned_from = static_cast<int>(runs.learned_from());
  result.settled = runs.settled();
  if (!runs.has_density()) {
    fail("the density is 0 at the fit itself: constraints exclude it");
    return answer;
  }
  result.samples =
      draw_samples(runs.chains(), {.samples = settings.samples, .seed = settings.seed});
  for (const int axis : result.axes) result.linear.push_back(reported_interval(study, what, axis));
  result.shapes = posterior_shapes(result.samples.u, result.linear);
  answer.emplace(std::move(result));
  return answer;
}

}  // namespace

DesignPoint Posterior::point(const DesignSpace& space, Eigen::Index k) const {
  std::vector<double> u = space.to_unit(center);
  for (std::size_t a = 0; a < axes.size(); ++a)
    u[static_cast<std::size_t>(axes[a])] = samples.u(static_cast<Eigen::Index>(a), k);
  DesignPoint moved = space.from_unit(u);
  for (int i = 0; i < space.size(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    if (std::find(axes.begin(), axes.end(), i) == axes.end()) moved.values[at] = center.values[at];
  }
  return moved;
}

double Posterior::value_at(const DesignSpace& space, std::size_t axis, double u) const {
  std::vector<double> all = space.to_unit(center);
  const auto i = static_cast<std::size_t>(axes[axis]);
  all[i] = u;
  return space.from_unit(all).values[i];
}

std::string why_no_posterior(const Study& study) {
  for (const StudyExperiment& experiment : study.experiments)
    if (experiment.objective.weight > 0.0 && experiment.loss.loss != Loss::squares)
      return "experiment." + experiment.name +
             " has a robust loss, which is no density: its weight of far values is no probability. "
             "Remove loss, and state the noise, to draw samples";
  if (!study.constraints.empty())
    return "a [constraint] on recorded values is known only where the model is run, and the "
           "surrogate does not learn it: remove it to draw samples";
  for (const LinearConstraint& constraint : study.space.constraints())
    if (constraint.is_equation())
      return "linear_constraint." + constraint.name +
             " is an equation, on which no density in all variables exists: replace one of its "
             "variables by a [tie]";
  return "";
}

std::optional<Result<Posterior>> sample_posterior(const Study& study,
                                                  const DesignPoint& best,
                                                  Executor& executor,
                                                  Journal& journal,
                                                  const RunOptions& options) {
  RunOptions enough = options;
  enough.max_steps = kMostIdentificationTrials;
  enough.on_failure.then = FailurePolicy::Then::proceed;  // a failure has density 0
  const Objective residuals = residual_objective(study);
  long before = 0, known = 0;
  const Drive run = [&](Optimizer& optimizer, RefitTrials*, const AsksWorkDone& standing) {
    enough.on_progress = [&](RunProgress progress) {
      const WorkDone done = standing();
      known = progress.known;
      progress.known += before;
      progress.planned = done.left > 0 ? progress.known + done.left : 0;
      progress.work = done.work;
      if (options.on_progress) options.on_progress(progress);
    };
    const bool converged =
        run_optimizer(optimizer, residuals, executor, &journal, enough).end == RunEnd::converged;
    before += known;
    return converged;
  };
  SamplingStart start = start_of(study, journal, best);
  if (!marked_start(study, journal)) {
    journal.mark(kPosteriorMark, key_of_mark(study) + text_of_point(start.center));
    start.trials = journal.size();
  }
  return sampled(study, start, journal, run);
}

std::optional<Posterior> recorded_posterior(const Study& study, const Journal& journal) {
  const auto start = marked_start(study, journal);
  if (!start || !why_no_posterior(study).empty()) return std::nullopt;
  const auto found = sampled(study, *start, journal, reading(study, journal));
  if (!found || !*found) return std::nullopt;
  return **found;
}

std::string verdict_text(const Posterior& posterior) {
  const SurrogateCheck& check = posterior.check;
  if (!posterior.is_mixed())
    return "The chains do not mix, so neither the ends nor the shapes of the samples are those of "
           "the "
           "posterior, whatever the surrogate is worth; another seed or more runs in [posterior] "
           "may "
           "help.";
  switch (check.verdict) {
    case SurrogateVerdict::unchecked:
      return "The surrogate was not checked: the samples are those of what the trials of the fit "
             "show.";
    case SurrogateVerdict::stands:
      return fmt::format(
          "The surrogate stands for the model: at {} draws that it had not seen, the logarithm of "
          "the density is off by {:.2g} (at most 0.3).",
          check.draws,
          check.deviation);
    case SurrogateVerdict::doubtful:
      return fmt::format(
          "The surrogate is doubtful: at {} draws that it had not seen, the logarithm of the "
          "density is off by {:.2g} (at most 0.3 is good). Ends of intervals may be off by some "
          "tenths of a deviation; more runs in [posterior] may help.",
          check.draws,
          check.deviation);
    case SurrogateVerdict::refused:
      break;
  }
  if (check.failed > 0)
    return fmt::format(
        "The surrogate is refused: the model failed at {} of {} draws that it had not seen. The "
        "samples are not those of the model; more runs in [posterior] may help.",
        check.failed,
        check.draws);
  return fmt::format(
      "The surrogate is refused: at {} draws that it had not seen, the logarithm of the density is "
      "off by {:.2g}, at one of them by {:.2g} (at most 1 and 3). The samples are not those of the "
      "model; more runs in [posterior] may help.",
      check.draws,
      check.deviation,
      check.largest);
}

std::vector<std::string> axis_names(const Study& study, const Posterior& posterior) {
  std::vector<std::string> names;
  for (const int axis : posterior.axes) names.push_back(study.space[axis].name);
  return names;
}

}  // namespace latsch::correlation
