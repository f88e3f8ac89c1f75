// SPDX-License-Identifier: Apache-2.0
#include "correlation/posterior/posterior.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "correlation/analysis/identification_rounds.h"
#include "correlation/analysis/identification_start.h"
#include "correlation/analysis/in_rounds.h"
#include "correlation/posterior/posterior_frame.h"
#include "correlation/target/residuals.h"
#include "optimization/posterior/model_chains.h"
#include "optimization/problem/point_vector.h"

namespace latsch::correlation {
namespace {

constexpr const char* kPosteriorMark = "posterior";
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

/// Presents the runs of the surrogate as an analysis of design points.
class SampledPoints {
 public:
  SampledPoints(SurrogateRuns& runs, const PosteriorFrame& frame) : runs_(runs), frame_(frame) {
    take();
  }
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
  const PosteriorFrame& frame_;
  std::vector<DesignPoint> wanted_;
};

/// Presents chains on the model as an analysis of design points.
class ChainedPoints {
 public:
  ChainedPoints(ModelChains& chains, const PosteriorFrame& frame) : chains_(chains), frame_(frame) {
    take();
  }
  const std::vector<DesignPoint>& wanted() const { return wanted_; }
  void observe(const std::vector<Result<Evaluated>>& evaluated) {
    std::vector<std::optional<double>> sums;
    for (const Result<Evaluated>& one : evaluated) {
      const auto r = one ? frame_.whitened(one->r) : std::nullopt;
      sums.push_back(r ? std::optional(r->squaredNorm()) : std::nullopt);
    }
    chains_.observe(sums);
    take();
  }

 private:
  void take() {
    wanted_.clear();
    for (const Eigen::VectorXd& u : chains_.wanted()) wanted_.push_back(frame_.point(u));
  }

  ModelChains& chains_;
  const PosteriorFrame& frame_;
  std::vector<DesignPoint> wanted_;
};

/// Returns the whitened residuals that the model had at these places, one column for each; a place
/// that the journal does not know is left out.
Eigen::MatrixXd residuals_of_model(const Study& study,
                                   const PosteriorFrame& frame,
                                   const Journal& journal,
                                   const Eigen::MatrixXd& u) {
  const Objective objective = residual_objective(study);
  std::map<std::string, std::optional<Eigen::VectorXd>> found;  // keyed by the bits of the point
  for (Eigen::Index k = 0; k < u.cols(); ++k) found[frame.point(u.col(k)).bits()];
  journal.for_each([&](const Trial& trial) {
    const auto at = found.find(trial.point.bits());
    if (at == found.end() || at->second || !trial.outcome.result) return;
    const auto score = objective(trial.point, *trial.outcome.result);
    if (score) at->second = frame.whitened(to_vector(score->residuals));
  });
  Eigen::MatrixXd r(std::ssize(frame.rows()), u.cols());
  Eigen::Index known = 0;
  for (Eigen::Index k = 0; k < u.cols(); ++k)
    if (const auto& one = found[frame.point(u.col(k)).bits()]) r.col(known++) = *one;
  return r.leftCols(known);
}

/// Returns the samples, or fewer at even distance where residuals of very many rows would need too
/// much memory.
Eigen::MatrixXd evenly_taken(const Eigen::MatrixXd& u, std::size_t rows) {
  constexpr Eigen::Index kMostNumbers = 20'000'000, kFewestSamplesOfBands = 400;
  const Eigen::Index room =
      kMostNumbers / std::max<Eigen::Index>(1, static_cast<Eigen::Index>(rows));
  const Eigen::Index count = std::min(u.cols(), std::max(room, kFewestSamplesOfBands));
  Eigen::MatrixXd taken(u.rows(), count);
  for (Eigen::Index k = 0; k < count; ++k) taken.col(k) = u.col(k * u.cols() / count);
  return taken;
}

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
  const PosteriorFrame frame(study, start, identification);
  if (const std::string reason = frame.reason(); !reason.empty()) {
    fail(reason);
    return answer;
  }
  const FittedDensity density = frame.density(journal, result.remarks);
  result.noise_stated = frame.is_noise_stated();
  SurrogateRuns runs(density, {.runs = settings.runs, .seed = settings.seed});
  SampledPoints points(runs, frame);
  InRounds<SampledPoints> rounds(study.space, points);
  const auto standing = [&]() -> WorkDone {
    if (runs.wanted().empty()) return {"the surrogate is made and checked", 1.0};
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
  result.method = settings.method;
  if (settings.method == PosteriorMethod::surrogate) {
    result.samples =
        draw_samples(runs.chains(), {.samples = settings.samples, .seed = settings.seed});
  } else {
    const bool is_delayed = settings.method == PosteriorMethod::delayed;
    ModelChains chains(
        runs.chains().places(),
        density.density,
        is_delayed ? runs.log_density() : LogDensityAt{},
        {.trials = settings.chain_runs, .samples = settings.samples, .seed = settings.seed});
    ChainedPoints chained(chains, frame);
    InRounds<ChainedPoints> chain_rounds(study.space, chained);
    const auto progress = [&]() -> WorkDone {
      if (chains.wanted().empty()) return {"chains on the model", 1.0};
      return {"chains on the model", 0.0, settings.chain_runs - chains.trials()};
    };
    if (!drive(chain_rounds, nullptr, progress)) return std::nullopt;
    result.chain_trials = static_cast<int>(chains.trials());
    result.trials += result.chain_trials;
    result.failed += static_cast<int>(chains.failed());
    if (!chains.has_density()) {
      fail("the model has no density where the chains start, around the fit: its trials failed");
      return answer;
    }
    result.samples = chains.samples();
  }
  for (const int axis : result.axes) result.linear.push_back(reported_interval(study, what, axis));
  result.shapes = posterior_shapes(result.samples.u, result.linear);
  const Eigen::MatrixXd taken = evenly_taken(result.samples.u, frame.rows().size());
  const Eigen::MatrixXd whitened = settings.method == PosteriorMethod::surrogate
                                       ? runs.residuals_at(taken)
                                       : residuals_of_model(study, frame, journal, taken);
  result.bands = sampled_bands(study, frame.rows(), frame.unwhitened(whitened));
  result.checks = predictive_checks(
      study, frame.rows(), whitened, residual_sigma(study) ? std::optional(1.0) : std::nullopt);
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
      // fewer trials than planned may have been needed
      progress.planned = done.share >= 1.0 ? progress.known
                         : done.left > 0   ? progress.known + done.left
                                           : 0;
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
           "help, and so may more chain_runs if the chains are on the model.";
  if (posterior.method != PosteriorMethod::surrogate)
    return fmt::format(
        "The samples are those of the model, which decided on {} proposal{}{}, of which it "
        "accepted "
        "{:.0f} %.",
        posterior.chain_trials,
        posterior.chain_trials == 1 ? "" : "s",
        posterior.method == PosteriorMethod::delayed ? " of the surrogate" : "",
        100.0 * posterior.samples.accepted);
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
          "tenths of a deviation; more runs in [posterior] may help, and method = \"delayed\" lets "
          "the model decide.",
          check.draws,
          check.deviation);
    case SurrogateVerdict::refused:
      break;
  }
  if (check.failed > 0)
    return fmt::format(
        "The surrogate is refused: the model failed at {} of {} draws that it had not seen. The "
        "samples are not those of the model; more runs in [posterior] may help, and method = "
        "\"delayed\" lets the model decide.",
        check.failed,
        check.draws);
  return fmt::format(
      "The surrogate is refused: at {} draws that it had not seen, the logarithm of the density is "
      "off by {:.2g}, at one of them by {:.2g} (at most 1 and 3). The samples are not those of the "
      "model; more runs in [posterior] may help, and method = \"delayed\" lets the model decide.",
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
