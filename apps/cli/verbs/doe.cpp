// SPDX-License-Identifier: Apache-2.0
// Implements `latsch doe`: runs a design of experiments on the worker processes and stores all
// channels in the journal.

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "cli/console/answers.h"
#include "cli/console/console.h"
#include "cli/console/implausible.h"
#include "cli/console/parsed.h"
#include "cli/console/tables.h"
#include "cli/run/interrupt.h"
#include "cli/run/trials.h"
#include "cli/run/workers.h"
#include "cli/verbs/verbs.h"
#include "correlation/doe/doe_basins.h"
#include "correlation/doe/doe_conflict.h"
#include "correlation/doe/doe_effects.h"
#include "correlation/doe/doe_extent.h"
#include "correlation/doe/doe_shares.h"
#include "correlation/target/best_trial.h"
#include "correlation/target/trial_ownership.h"
#include "evaluation/schedule/retried_failures.h"

namespace latsch::cli {
namespace {

using correlation::RatedTrial;
using correlation::Study;
using correlation::StudyDesign;

constexpr size_t kShownPoints = 5;
// Largest ratio of an objective to the least one for a point to count as near the optimum, unless
// the user gives a level.
constexpr double kNear = 2.0;
// share of a variable's range from which on its whole range counts as covered
constexpr double kWhole = 0.999;

/// Returns the study's design of experiments, or a grid with `levels` levels of every variable if
/// `levels` is above 0.
StudyDesign design_of(const Study& study, int levels) {
  if (levels > 0) return {.levels = std::vector<int>(study.space.size(), levels)};
  if (study.doe) return *study.doe;
  throw InputError(study.file.string() +
                   " has no [doe]; add one with levels = 5, or use --levels 5");
}

// Target of each successful trial, by the bits of its point.
using Targets = std::map<std::string, double>;

Targets targets_of(const Study& study, const Journal& journal) {
  Targets targets;
  for (const RatedTrial& trial : correlation::rated_trials(study, journal)) {
    targets.emplace(trial.point.bits(), trial.target);
  }
  return targets;
}

/// Returns the points of the design that have an objective, in ascending order of it.
std::vector<RatedTrial> rated(const SamplingPlan& plan, const Targets& targets) {
  std::vector<RatedTrial> points;
  for (const DesignPoint& point : plan.points) {
    const auto target = targets.find(point.bits());
    if (target != targets.end()) points.push_back({point, target->second});
  }
  std::stable_sort(points.begin(), points.end(), [](const auto& a, const auto& b) {
    return a.target < b.target;
  });
  return points;
}

void print_basins(const Study& study, const StudyDesign& design, const Journal& journal) {
  const auto found =
      correlation::doe_basins(study, design, correlation::rated_trials(study, journal));
  if (!found) return;
  say("\n{} minim{} among the points:\n",
      found->basins.size(),
      found->basins.size() == 1 ? "um" : "a");
  for (const auto& basin : found->basins)
    answer()["minima"].push_back({{"target", basin.target},
                                  {"points", basin.points},
                                  {"variables", answer_of(study.space, basin.lowest)}});
  for (size_t k = 0; k < std::min(kShownPoints, found->basins.size()); ++k) {
    say("target {:.4f} %, {} points lead there\n",
        found->basins[k].target * 100.0,
        found->basins[k].points);
    print_point(study.space, found->basins[k].lowest);
  }
  if (!found->doubt.empty()) say("Too coarse to trust: {}.\n", found->doubt);
}

/// Prints the extent of a valley of the objective: the box around the points whose objective is at
/// most the level.
void print_extent(const DesignSpace& space, const std::vector<RatedTrial>& points, double level) {
  const auto found = correlation::doe_extent(space, points, level);
  if (!found) {
    say("\nNo point has a target of at most {:.4g} %\n", 100.0 * level);
    return;
  }
  answer()["extent"] = {{"level", level},
                        {"points", found->points},
                        {"lower", answer_of(space, found->lower)},
                        {"upper", answer_of(space, found->upper)},
                        {"share", found->share}};
  say("\nTargets of at most {:.4g} %: {} point{}, from\n",
      100.0 * level,
      found->points,
      found->points == 1 ? "" : "s");
  print_point(space, found->lower);
  say("to\n");
  print_point(space, found->upper);
  for (int i = 0; i < space.size(); ++i)
    if (found->share[i] > kWhole)
      say("{} extends over its whole range: the target does not determine it\n", space[i].name);
}

void print_effects(const Study& study, const StudyDesign& design, const Journal& journal) {
  const auto effects =
      correlation::doe_effects(study, design, correlation::rated_trials(study, journal));
  if (effects.empty()) return;
  say("\nMorris' elementary effects: change of the target over a variable's whole range, "
      "in points of %\n  {:<16} {:>10} {:>10} {:>10} {:>8}\n",
      "variable",
      "mu*",
      "mu",
      "sigma",
      "effects");
  for (int i = 0; i < study.space.size(); ++i) {
    answer()["effects"].push_back({{"name", study.space[i].name},
                                   {"mu_star", effects[i].mu_star},
                                   {"mu", effects[i].mu},
                                   {"sigma", effects[i].sigma},
                                   {"effects", effects[i].effects}});
    say("  {:<16} {:10.3f} {:10.3f} {:10.3f} {:8}\n",
        study.space[i].name,
        100.0 * effects[i].mu_star,
        100.0 * effects[i].mu,
        100.0 * effects[i].sigma,
        effects[i].effects);
  }
}

void print_shares(const Study& study, const StudyDesign& design, const Journal& journal) {
  if (!design.asks_shares) return;
  const correlation::DoeShares found = correlation::doe_shares(study, design, journal);
  if (!found.refusal.empty()) {
    answer()["shares_refused"] = found.refusal;
    say("\nNo shares of the variance: {}\n", found.refusal);
    return;
  }
  say("\nSobol's indices from {} points: share of the variance that a variable causes, alone "
      "(first) and with others (total), with 95 % intervals\n",
      found.points);
  if (found.missing > 0)
    say("{} of the points have no target: what happens there is not in the shares\n",
        found.missing);
  answer()["shares_missing_points"] = found.missing;
  for (const correlation::ResponseShares& one : found.responses) {
    nlohmann::ordered_json told{{"response", one.response}, {"constant", one.shares.is_constant()}};
    if (one.shares.is_constant()) {
      say("{}: does not vary\n", one.response);
      answer()["shares"].push_back(told);
      continue;
    }
    told["explained"] = one.shares.explained;
    told["trusted"] = one.shares.is_trusted();
    say("{}: the points explain {:.0f} %{}\n",
        one.response,
        100.0 * one.shares.explained,
        one.shares.is_trusted() ? "" : "; not to be trusted: raise points of [doe]");
    for (int i = 0; i < study.space.size(); ++i) {
      const auto &first = one.shares.first[i], &total = one.shares.total[i];
      const auto in_words = [](const VarianceShare& share) {
        return fmt::format("{:.0f} % ({:.0f} .. {:.0f})",
                           100.0 * share.value,
                           100.0 * share.lower,
                           100.0 * share.upper);
      };
      say("  {:<16} first {:<20} total {}\n",
          study.space[i].name,
          in_words(first),
          in_words(total));
      told["variables"].push_back({{"name", study.space[i].name},
                                   {"first", first.value},
                                   {"first_interval", {first.lower, first.upper}},
                                   {"total", total.value},
                                   {"total_interval", {total.lower, total.upper}}});
    }
    answer()["shares"].push_back(told);
  }
}

/// Prints the measured values that no point of the design reaches, unless the design is of another
/// kind than one that covers the space.
void print_conflict(const Study& study,
                    const std::vector<DesignPoint>& points,
                    const Journal& journal) {
  const correlation::DoeConflict found = correlation::doe_conflict(study, points, journal);
  say("\nMeasured values that no point comes near, by three deviations\n");
  if (!found.refusal.empty()) {
    answer()["conflict_refused"] = found.refusal;
    say("  not told: {}\n", found.refusal);
    return;
  }
  for (const correlation::UnreachedValues& row : found.rows) {
    answer()["conflict"].push_back(answer_of(study, row));
    say("  {:<{}} {}\n",
        study.experiments[static_cast<size_t>(row.experiment)].name,
        name_width(study.experiments),
        correlation::in_words(study, row));
  }
}

std::optional<Trial> first_failure(const Journal& journal) {
  std::optional<Trial> first;
  journal.for_each([&](const Trial& trial) {
    if (!first && !trial.outcome.result) first = trial;
  });
  return first;
}

/// Failed points are only listed: a value that replaces a failure for an optimizer would have no
/// meaning in a design of experiments.
void print_policy_of_designs(const FailurePolicy& policy) {
  using Then = FailurePolicy::Then;
  if (policy.then != Then::recover && policy.then != Then::continuation) return;
  say("on_failure = \"{}\" is an answer to an optimizer; in a design a failed point just "
      "stays failed\n",
      policy.then == Then::recover ? "recover" : "continuation");
}

int doe(const std::string& file,
        const experiment::Language& language,
        int levels,
        int workers,
        double level,
        bool retries_failed) {
  Study study = correlation::read_study(file, language);
  study.asks_slopes = false;  // a design of experiments uses no derivatives
  if (workers > 0) study.run.workers = workers;
  const StudyDesign design = design_of(study, levels);
  const SamplingPlan plan = correlation::plan(design, study.space);
  Workers workers_of_study(study);
  if (workers_of_study.served(study)) return kDone;
  reject_implausible(study);
  Journal journal = open_for_trials(study, retries_failed);
  say_kind_of_journal(study);
  say("{}, {} points; {} finished trials in {}\n",
      design.name(),
      plan.points.size(),
      journal.size(),
      study.run.journal.string());
  print_policy_of_designs(study.run.on_failure);

  catch_interrupts();
  const TrialsRun trials(workers_of_study, study);
  Executor& executor = workers_of_study.start(study);
  TrialsThatCount counting(journal);
  const RunEnd end = run_doe(plan, executor, counting, run_options(study, /*length_known=*/true));
  if (end == RunEnd::stopped) {
    say("Interrupted; {} trials are safe. The same command continues.\n", journal.size());
    return kStopped;
  }
  if (end == RunEnd::aborted) {
    if (const auto trial = first_failure(journal)) {
      print_aborted(study, trial->point, trial->outcome.result.failure());
    }
    return kFailed;
  }
  correlation::mark_design(study, plan.points, journal);
  const auto points = rated(plan, targets_of(study, journal));
  if (points.empty()) {
    const auto trial = first_failure(journal);
    print_no_success(
        study,
        journal,
        trial ? trial->outcome.result.failure().reason : "its channels give no target");
    return kFailed;
  }
  answer()["design"] = design.name();
  for (const RatedTrial& trial : points)
    answer()["points"].push_back(
        {{"target", trial.target}, {"variables", answer_of(study.space, trial.point)}});
  say("\n{} of {} points succeeded; the best:\n", points.size(), plan.points.size());
  for (size_t i = 0; i < std::min(kShownPoints, points.size()); ++i) {
    say("target {:.4f} %\n", points[i].target * 100.0);
    print_point(study.space, points[i].point);
  }
  print_basins(study, design, journal);
  print_extent(study.space, points, level > 0.0 ? level : kNear * points.front().target);
  print_effects(study, design, journal);
  print_shares(study, design, journal);
  print_conflict(study, plan.points, journal);
  workers_of_study.end();
  return write_report_of_run(study, study, journal, language);
}

}  // namespace

void add_doe(CommandLine& app, Program& program) {
  Verb verb = app.add_subcommand(
      "doe", "Evaluates a design of experiments: sees local minima, chooses where to start");
  verb.footer(
      "Example:\n  latsch doe studies/tire_b_twin/study.toml --levels 5 --workers 2\n\n"
      "[doe] in the study names the design: full_factorial, latin_hypercube, sobol or morris.\n"
      "effects = \"sobol\" there tells which share of the variance each variable causes.\n"
      "A later `latsch run` of the same study reuses what the design evaluated.");
  auto file = std::make_shared<std::string>();
  auto levels = std::make_shared<int>(0);
  auto workers = std::make_shared<int>(0);
  verb.add_option("study", *file, "Study file (TOML)").required();
  verb.add_option("--levels",
                  *levels,
                  "A grid with this number of values of every variable, instead of the study's "
                  "[doe]")
      .between(2, 1000);
  verb.add_option("--workers", *workers, "Worker processes, instead of the study's")
      .between(1, 1024);
  auto level = std::make_shared<std::string>();
  verb.add_option("--level",
                  *level,
                  "Reports the extent of the points whose target is at most this, as \"2 %\"; "
                  "twice the "
                  "least target unless given");
  auto retries_failed = std::make_shared<bool>(false);
  verb.add_flag("--retry-failed",
                *retries_failed,
                "Tries the points that failed so far again, once the cause is fixed");
  verb.callback([=, &program] {
    program.exit_code = doe(*file,
                            program.language,
                            *levels,
                            *workers,
                            level->empty() ? 0.0 : parse_share_option("--level", *level),
                            *retries_failed);
  });
}

}  // namespace latsch::cli
