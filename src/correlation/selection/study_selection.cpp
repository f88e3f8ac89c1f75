// SPDX-License-Identifier: Apache-2.0
#include "correlation/selection/study_selection.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/random.h"
#include "correlation/analysis/identification_rounds.h"
#include "correlation/analysis/in_rounds.h"
#include "correlation/target/residuals.h"
#include "optimization/identifiability/d_optimality.h"
#include "optimization/problem/point_vector.h"

namespace latsch::correlation {
namespace {

bool is_fitted(const StudyExperiment& experiment) {
  return experiment.fitted && experiment.objective.weight > 0.0;
}

/// Returns the recording of an experiment. Values that stand in the study itself are recordings of
/// their own.
std::string recording_of(const StudyExperiment& experiment) {
  const std::string source = experiment.measured_in();
  return source == "the study" ? "experiment " + experiment.name : source;
}

/// Returns the recording of each residual as in SelectionProblem.
std::vector<int> recordings_of_rows(const Study& study) {
  const std::vector<std::string> names = fitted_recordings(study);
  std::vector<int> recordings;
  for (const ResidualRow& row : residual_rows(study)) {
    if (row.owner() < 0) {
      recordings.push_back(-1);
      continue;
    }
    const StudyExperiment& experiment = study.experiments[static_cast<std::size_t>(row.owner())];
    const auto k = static_cast<int>(
        std::find(names.begin(), names.end(), recording_of(experiment)) - names.begin());
    recordings.push_back(row.experiment < 0 ? -2 - k : k);
  }
  return recordings;
}

/// Returns the halves of the recordings: the first chooses. If their number is odd, the first is
/// the larger one.
std::pair<std::vector<int>, std::vector<int>> halves(std::size_t count, std::uint64_t seed) {
  std::vector<int> order;
  for (std::size_t k = 0; k < count; ++k) order.push_back(static_cast<int>(k));
  RandomStream random(seed, 1);
  for (std::size_t k = count; k > 1; --k)
    std::swap(order[k - 1],
              order[std::min(k - 1,
                             static_cast<std::size_t>(random.uniform() * static_cast<double>(k)))]);
  const auto middle = order.begin() + static_cast<std::ptrdiff_t>((count + 1) / 2);
  std::vector<int> first(order.begin(), middle), second(middle, order.end());
  std::sort(first.begin(), first.end());
  std::sort(second.begin(), second.end());
  return {first, second};
}

/// Converts points of the unit cube into points of the study, in which values that are held have
/// their exact bits.
class SelectionPlaces {
 public:
  SelectionPlaces(const DesignSpace& space,
                  const SelectionSettings& settings,
                  const DesignPoint& start)
      : space_(space), start_(start), toward_(settings.toward) {
    u_toward_ = space.to_unit({toward_});
    u_start_ = space.to_unit(start);
  }

  Eigen::VectorXd toward() const { return to_vector(u_toward_); }
  DesignPoint point(const Eigen::VectorXd& u) const {
    DesignPoint point = space_.from_unit({u.begin(), u.end()});
    for (std::size_t i = 0; i < toward_.size(); ++i) {
      const double place = u[static_cast<Eigen::Index>(i)];
      if (place == u_toward_[i])
        point.values[i] = toward_[i];
      else if (place == u_start_[i])
        point.values[i] = start_.values[i];
    }
    return point;
  }

 private:
  const DesignSpace& space_;
  DesignPoint start_;
  std::vector<double> toward_, u_toward_, u_start_;
};

/// Presents a selection as an analysis of design points, each of which is asked for once a round.
class SelectionPoints {
 public:
  SelectionPoints(CoefficientSelection& selection, const SelectionPlaces& places)
      : selection_(selection), places_(places) {
    take();
  }
  const std::vector<DesignPoint>& wanted() const { return wanted_; }
  bool is_enough(const Result<Evaluated>& first) const { return selection_.is_enough(first); }
  void observe(const std::vector<Result<Evaluated>>& evaluated) {
    trials_ += std::ssize(evaluated);
    if (evaluated.size() < wanted_.size()) {
      selection_.observe(evaluated);
    } else {
      std::vector<Result<Evaluated>> all;
      for (const std::size_t k : index_) all.push_back(evaluated[k]);
      selection_.observe(all);
    }
    take();
  }
  long trials() const { return trials_; }

 private:
  void take() {
    wanted_.clear();
    index_.clear();
    std::map<std::string, std::size_t> known;
    for (const Eigen::VectorXd& u : selection_.wanted()) {
      const DesignPoint point = places_.point(u);
      const auto [at, is_new] = known.emplace(point.bits(), wanted_.size());
      if (is_new) wanted_.push_back(point);
      index_.push_back(at->second);
    }
  }

  CoefficientSelection& selection_;
  const SelectionPlaces& places_;
  std::vector<DesignPoint> wanted_;
  std::vector<std::size_t> index_;  // place in wanted_ of each point that the selection wants
  long trials_ = 0;
};

std::string work_of(const CoefficientSelection& selection) {
  switch (selection.phase()) {
    case CoefficientSelection::Phase::start:
    case CoefficientSelection::Phase::full_fit:
      return "fit of all candidates";
    case CoefficientSelection::Phase::testing:
      return "fits without candidates at their bounds";
    case CoefficientSelection::Phase::restart_points:
    case CoefficientSelection::Phase::restarts:
      return "best models from the start values";
    case CoefficientSelection::Phase::leaving_out:
      return "fits that omit one recording";
    case CoefficientSelection::Phase::dropping:
    case CoefficientSelection::Phase::done:
      break;
  }
  return fmt::format("refit {}", selection.refits());
}

bool moves(const Study& study, int variable) {
  return study.free.empty() || std::binary_search(study.free.begin(), study.free.end(), variable);
}

/// Returns the settings without the candidates that do not vary in the last stage of the study.
SelectionSettings moving_part(const Study& study) {
  SelectionSettings settings = study.selection.value_or(selection_of_all(study.space));
  for (SelectionUnit& unit : settings.units)
    std::erase_if(unit.variables, [&](int i) { return !moves(study, i); });
  std::erase_if(settings.units, [](const SelectionUnit& unit) { return unit.variables.empty(); });
  return settings;
}

std::vector<std::string> chosen_names(const std::vector<std::string>& names,
                                      const std::vector<int>& indices) {
  std::vector<std::string> some;
  for (const int k : indices) some.push_back(names[static_cast<std::size_t>(k)]);
  return some;
}

}  // namespace

DesignPoint StudySelection::point(const DesignSpace& space, const SelectedModel& model) const {
  return SelectionPlaces(space, settings, start).point(model.at.u);
}

std::vector<std::string> fitted_recordings(const Study& study) {
  std::vector<std::string> names;
  for (const StudyExperiment& experiment : study.experiments) {
    if (!is_fitted(experiment)) continue;
    const std::string name = recording_of(experiment);
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  return names;
}

std::string why_no_selection(const Study& study) {
  for (const StudyExperiment& experiment : study.experiments)
    if (is_fitted(experiment) && experiment.loss.loss != Loss::squares)
      return "experiment." + experiment.name +
             " has a robust loss, which is no likelihood, so models cannot be rated by it: remove "
             "loss, and state the noise, to select";
  if (!study.constraints.empty())
    return "a [constraint] on recorded values is not known by the refits of a selection: remove it "
           "to select";
  if (!study.space.constraints().empty())
    return "linear_constraint." + study.space.constraints().front().name +
           " may forbid the value of a dropped variable: remove it to select";
  const SelectionSettings settings = study.selection.value_or(selection_of_all(study.space));
  const auto recordings = fitted_recordings(study);
  if (recordings.size() > 1) return "";
  if (settings.criterion == SelectionCriterion::cross_validation)
    return "criterion = \"cross_validation\" leaves out one recording after the other, but all "
           "values of the study are of one, " +
           recordings.front() +
           ": split it into several [measurement.NAME], such as one for each load, or use \"bic\"";
  if (settings.honest)
    return "honest = true needs recordings that choose and others that are refitted, but all "
           "values "
           "of the study are of one, " +
           recordings.front() +
           ": split it into several [measurement.NAME], such as one for each load";
  return "";
}

Study with_selection_journal(const Study& study) {
  Study own = study;
  own.run.journal.replace_extension(".selection.latsch");
  return own;
}

std::optional<Result<StudySelection>> select_coefficients(const Study& study,
                                                          const DesignPoint& start,
                                                          Executor& executor,
                                                          Journal& journal,
                                                          const RunOptions& options) {
  RunOptions enough = options;
  enough.max_steps = kMostIdentificationTrials;
  enough.on_failure.then = FailurePolicy::Then::proceed;  // such a model cannot be fitted
  const Objective residuals = residual_objective(study);
  const SelectionSettings settings = moving_part(study);
  std::optional<Result<StudySelection>> answer;
  if (settings.units.empty()) {
    answer.emplace(Failure{"the last stage of the study moves none of the candidates"});
    return answer;
  }
  const SelectionPlaces places(study.space, settings, start);
  long before = 0, trials = 0;
  const auto run = [&](CoefficientSelection& selection) {
    SelectionPoints points(selection, places);
    InRounds<SelectionPoints> rounds(study.space, points);
    long known = 0;
    enough.on_progress = [&](RunProgress progress) {
      known = progress.known;
      progress.known += before;
      progress.planned = 0;
      progress.work = work_of(selection);
      if (options.on_progress) options.on_progress(progress);
    };
    const bool converged =
        run_optimizer(rounds, residuals, executor, &journal, enough).end == RunEnd::converged;
    before += known;
    trials += points.trials();
    return converged;
  };
  SelectionProblem problem;
  problem.start = to_vector(study.space.to_unit(start));
  problem.restart = to_vector(study.space.to_unit(study.space.initial()));
  problem.toward = places.toward();
  problem.free = study.free;
  for (const SelectionUnit& unit : settings.units) problem.units.push_back(unit.variables);
  problem.sigma = residual_sigma(study);
  problem.traits = residual_traits(study);
  problem.recordings = recordings_of_rows(study);
  for (int i = 0; i < study.space.size(); ++i)
    if (!moves(study, i)) problem.restart[i] = problem.start[i];
  const std::vector<std::string> recordings = fitted_recordings(study);
  const auto [first, second] = halves(recordings.size(), settings.seed);
  if (settings.honest) problem.fitted = first;
  StudySelection selected{
      settings, start, CoefficientSelection(problem, {settings.criterion, settings.refits})};
  if (!run(selected.selection)) return std::nullopt;
  if (!selected.selection.status()) {
    answer.emplace(selected.selection.status().failure());
    return answer;
  }
  selected.choosing = settings.honest ? chosen_names(recordings, first) : recordings;
  if (settings.honest) {
    SelectionProblem again = problem;
    again.fitted = second;
    again.start = again.restart = selected.chosen().at.u;
    again.units.clear();
    again.free = selected.selection.free_variables(selected.chosen());
    selected.refit.emplace(again, SelectionOptions{});
    selected.refitted = chosen_names(recordings, second);
    if (!run(*selected.refit)) return std::nullopt;
    if (!selected.refit->status()) {
      answer.emplace(
          Failure{"the chosen variables cannot be fitted to the other half of the "
                  "recordings: " +
                  selected.refit->status().failure().reason});
      return answer;
    }
  }
  selected.trials = trials;
  answer.emplace(std::move(selected));
  return answer;
}

std::vector<std::optional<HoldingRecording>> holding_recordings(const Study& study,
                                                                const StudySelection& selected) {
  const SelectedModel& full = selected.selection.path().front();
  const CountedValues& counted = selected.selection.rows().counted();
  const double s =
      counted.noise_known
          ? 1.0
          : std::sqrt(full.at.sum_of_squares() / std::max(1.0, counted.values - full.coefficients));
  const std::vector<int> recordings = selected.selection.rows().recordings();
  const std::vector<int> free = selected.selection.free_variables(full);
  const Eigen::MatrixXd J = full.at.J(Eigen::all, free) / s;
  const Eigen::VectorXd before = deviations_with_bounds(J);
  std::vector<Candidate> candidates;
  for (std::size_t k = 0; k < selected.choosing.size(); ++k) {
    const auto names = fitted_recordings(study);
    const auto own = static_cast<int>(std::find(names.begin(), names.end(), selected.choosing[k]) -
                                      names.begin());
    std::vector<int> rows;
    for (std::size_t row = 0; row < recordings.size(); ++row)
      if (recordings[row] == own) rows.push_back(static_cast<int>(row));
    candidates.push_back({selected.choosing[k], J(rows, Eigen::all)});
  }
  const std::vector<DOptimality> gains = d_optimality(J, candidates);
  std::vector<std::optional<HoldingRecording>> holding;
  for (const SelectionUnit& unit : selected.settings.units) {
    holding.emplace_back();
    Eigen::Index place = -1;  // place of the least known variable of the unit
    for (const int i : unit.variables) {
      const auto at = std::find(free.begin(), free.end(), i) - free.begin();
      if (at < std::ssize(free) && (place < 0 || before[at] > before[place])) place = at;
    }
    if (place < 0) continue;
    for (const DOptimality& gain : gains) {
      const double after = gain.deviations[place];
      if (holding.back() && holding.back()->after <= after) continue;
      holding.back() = HoldingRecording{
          candidates[static_cast<std::size_t>(gain.candidate)].name, before[place], after};
    }
    // a fall by less than this share is no help
    constexpr double kHelps = 0.98;
    if (holding.back() && !(holding.back()->after < kHelps * before[place])) holding.back().reset();
  }
  return holding;
}

}  // namespace latsch::correlation
