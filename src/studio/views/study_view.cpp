// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <map>

#include "base/units.h"
#include "correlation/analysis/beyond_data.h"
#include "correlation/analysis/plausibility.h"
#include "correlation/search/study_method.h"
#include "correlation/study/ledgers/study_ledgers.h"
#include "correlation/study/study_experiment.h"
#include "correlation/target/compared_trial.h"
#include "correlation/target/study_trials.h"
#include "correlation/target/test_limits.h"
#include "experiment/language/usual_numbers.h"
#include "studio/views/json_values.h"
#include "studio/views/trial_hints.h"
#include "studio/views/views.h"

namespace latsch::studio {
namespace {

using correlation::Study;
using Sight = ShelvedStudy::Sight;

constexpr std::size_t kNamedTrials = 20;  // most trials named for one reason of failure
constexpr std::size_t kReasons = 50;
// share of the largest weight below which a weight counts as zero
constexpr double kNoWeight = 1e-6;

Json variables(const Study& study, const DesignPoint* best) {
  Json list = Json::array();
  for (int i = 0; i < study.space.size(); ++i) {
    const DesignVariable& v = study.space[i];
    list.push_back(
        {{"name", v.name},
         {"path", v.paths.empty() ? "" : v.paths.front()},
         {"paths", v.paths},
         {"unit", v.unit},
         {"lower", in_unit(v.lower, v.unit)},
         {"upper", in_unit(v.upper, v.unit)},
         {"initial", in_unit(v.initial, v.unit)},
         {"scale", v.scale == Scale::logarithmic ? "logarithmic" : "linear"},
         {"best",
          best ? in_unit(best->values[static_cast<std::size_t>(i)], v.unit) : Json(nullptr)}});
  }
  return list;
}

Json experiments(const Study& study, const TrialTable& table, std::optional<std::size_t> best) {
  Json list = Json::array();
  const auto weighting = table.target().weighting(table.target().weights());
  std::size_t fitted = 0;
  for (const auto& experiment : study.experiments) {
    const correlation::TargetParts* parts = best ? &*table.rows()[*best].parts : nullptr;
    Json share = nullptr, error = nullptr;
    if (experiment.fitted && parts) {
      const double target = weighting.target(*parts);
      share = target > 0.0 ? finite(weighting.share(*parts, fitted) / target) : Json(nullptr);
      error = finite(parts->errors[fitted]);
    }
    if (experiment.fitted) ++fitted;
    list.push_back({{"name", experiment.name},
                    {"kind", experiment.observable->kind()},
                    {"conditions", conditions_of(experiment, study.tests)},
                    {"compared", experiment.observable->compared(experiment.objective)},
                    {"measured_in", experiment.measured_in()},
                    {"fitted", experiment.fitted},
                    {"weight", experiment.objective.weight},
                    {"exponent", experiment.objective.exponent},
                    {"values", experiment.values()},
                    {"measure", measure_in_words(experiment)},
                    {"error", error},
                    {"share", share}});
  }
  return list;
}

Json failures(const TrialTable& table) {
  struct Reason {
    std::size_t count = 0;
    Cause cause = Cause::point;
    std::vector<std::size_t> trials;
  };
  std::map<int, Reason> reasons;
  for (std::size_t k = 0; k < table.rows().size(); ++k) {
    const TableRow& row = table.rows()[k];
    if (row.parts) continue;
    Reason& reason = reasons[row.reason];
    ++reason.count;
    reason.cause = row.cause;
    if (reason.trials.size() < kNamedTrials) reason.trials.push_back(k + 1);
  }
  std::vector<std::pair<int, Reason>> most(reasons.begin(), reasons.end());
  std::stable_sort(most.begin(), most.end(), [](const auto& a, const auto& b) {
    return a.second.count > b.second.count;
  });
  if (most.size() > kReasons) most.resize(kReasons);
  Json list = Json::array();
  for (const auto& [place, reason] : most) {
    list.push_back({{"reason", table.reasons()[static_cast<std::size_t>(place)]},
                    {"cause", words_of(reason.cause)},
                    {"count", reason.count},
                    {"trials", reason.trials},
                    {"hint", hint_for(reason.cause)}});
  }
  return list;
}

/// Returns the findings of `latsch check` about a study. If the study's file can no longer be read,
/// as while a user edits it, returns only the findings about its model.
std::vector<experiment::Finding> findings(const Study& study) {
  try {
    return correlation::implausible(study);
  } catch (const InputError&) {
    const experiment::SpecimenKind* kind = study.specimens->kind();
    if (!kind) return {};
    return experiment::findings_of_model(*kind, study.model, study.model_file);
  }
}

/// Returns the warnings about a study before or during its run.
Json warnings(const Study& study, const Sight& sight, const std::vector<Ledger>& ledgers) {
  Json list = Json::array();
  if (!sight.error.empty()) list.push_back(sight.error);
  if (!sight.no_best.empty()) list.push_back(sight.no_best);
  for (const experiment::Finding& one : findings(study)) list.push_back(experiment::in_words(one));
  for (const Ledger& ledger : ledgers)
    for (const LedgerDoubt& doubt : ledger.doubts)
      if (std::find(list.begin(), list.end(), Json(doubt.sentence)) == list.end())
        list.push_back(doubt.sentence);  // the page shows each sentence once
  for (const std::string& limit : correlation::limits_of_tests(study)) list.push_back(limit);
  for (const std::string& words : sight.spoiled) list.push_back(words);
  for (const std::string& words : correlation::untold_in_words(study)) list.push_back(words);
  double largest = 0.0;
  for (const auto& experiment : study.experiments)
    if (experiment.fitted) largest = std::max(largest, experiment.objective.weight);
  for (const auto& experiment : study.experiments) {
    if (experiment.fitted && experiment.objective.weight < kNoWeight * largest)
      list.push_back(fmt::format("experiment {} has weight {:g}: it does not count",
                                 experiment.name,
                                 experiment.objective.weight));
  }
  return list;
}

double seconds_since(std::filesystem::file_time_type time) {
  return std::chrono::duration<double>(std::filesystem::file_time_type::clock::now() - time)
      .count();
}

/// Returns the number of points of the design of experiments that are still to come; nullopt for a
/// search, whose end is not known in advance.
std::optional<double> trials_to_come(const Sight& sight, const StudyRuns::Run& run) {
  if (!run.is_alive || run.verb != RunVerb::doe || !sight.study->doe) return std::nullopt;
  const auto points = plan(*sight.study->doe, sight.study->space).points.size();
  return std::max(0.0, static_cast<double>(points) - static_cast<double>(sight.table->total()));
}

/// Returns the run in progress, or the last run that this page started.
Json run_of(const ShelvedStudy& shelved, const Sight& sight, const StudyRuns::Run& run) {
  if (!sight.holder && !run.is_ours) return nullptr;
  Json view{{"workers", sight.study->run.workers},
            {"is_ours", run.is_ours},
            {"is_starting", run.is_alive && !sight.holder},
            {"exit_code", run.exit_code ? Json(*run.exit_code) : Json(nullptr)},
            {"was_stopped", run.was_stopped},
            {"message", sight.holder ? sight.holder->words : std::string()},
            {"log_file", run_log(shelved.file()).filename().string()},
            {"log", run.log},
            {"elapsed", nullptr},
            {"rate", nullptr},
            {"eta", nullptr}};
  if (!sight.holder) return view;
  std::error_code none;
  const auto since =
      std::filesystem::last_write_time(sight.study->run.journal.string() + ".lock", none);
  if (!none) view["elapsed"] = finite(seconds_since(since));
  if (sight.run_trials < 2 || !(sight.run_seconds > 0.0)) return view;
  const double rate = static_cast<double>(sight.run_trials) / sight.run_seconds;
  view["rate"] = finite(rate);  // trials per second
  if (const auto left = trials_to_come(sight, run)) view["eta"] = finite(*left / rate);
  return view;
}

Json best_of(const Study& study, const TrialTable& table, std::size_t place) {
  const TableRow& row = table.rows()[place];
  const double target = table.target().weighting(table.target().weights()).target(*row.parts);
  Json values = Json::array(), shown = Json::array();
  for (int i = 0; i < study.space.size(); ++i) {
    const DesignVariable& v = study.space[i];
    const double value = row.point.values[static_cast<std::size_t>(i)];
    values.push_back(in_unit(value, v.unit));
    shown.push_back(format_quantity(value, v.unit, 5));
  }
  return {{"trial", place + 1},
          {"target", finite(target)},
          {"words", correlation::target_in_words(fitted_exponents(study.experiments), target)},
          {"violation", finite(row.parts->violation)},
          {"values", values},
          {"shown", shown}};
}

/// Adds the counts of trials that `latsch check --json` also gives.
void add_counts(Json& view, const Sight& sight) {
  const bool is_other = sight.of_another_study > 0;
  const correlation::TrialCounts counts = sight.table->counts_read();
  view["trials"] = is_other ? sight.of_another_study : sight.table->total();
  view["succeeded"] = is_other ? Json(nullptr) : Json(counts.succeeded());
  view["failed"] = is_other ? Json(nullptr) : Json(counts.failed);
  view["foreign"] = is_other ? sight.of_another_study : counts.foreign;
}

}  // namespace

Json study_view(const ShelvedStudy& shelved, StudyRuns& runs) {
  const StudyRuns::Run last_run = runs.of(shelved);
  return shelved.look([&](const Sight& sight) {
    Json view{{"study", shelved.id()},
              {"title", shelved.id()},
              {"file", shelved.file().string()},
              {"state", name(sight.state)},
              {"error", sight.error}};
    if (!sight.study) return view;
    const Study& study = *sight.study;
    const TrialTable& table = *sight.table;
    const auto best = table.best();
    const auto method = method_of(study);
    view["title"] = study.title;
    view["stage"] = study.stage;
    view["model"] = {{"file", study.model_file.string()},
                     {"kind",
                      study.specimens->kind() ? study.specimens->kind()->in_words()
                                              : std::string("an outside program")}};
    view["optimizer"] = {{"method", in_words(method.method)},
                         {"reason", method.reason},
                         {"max_steps", study.max_steps},
                         {"ending", sight.ending},
                         {"tests", sight.tests}};
    view["has_design"] = study.doe.has_value();
    view["workers"] = study.run.workers;
    view["run"] = run_of(shelved, sight, last_run);
    view["read"] = table.rows().size();
    add_counts(view, sight);
    view["best"] = best ? best_of(study, table, *best) : Json(nullptr);
    const auto initial = table.initial();
    view["initial"] = initial ? Json{{"trial", *initial + 1},
                                     {"target",
                                      finite(table.target()
                                                 .weighting(table.target().weights())
                                                 .target(*table.rows()[*initial].parts))}}
                              : Json(nullptr);
    view["variables"] = variables(study, best ? &table.rows()[*best].point : nullptr);
    view["experiments"] = experiments(study, table, best);
    view["constraints"] = Json::array();
    for (const auto& constraint : study.constraints)
      view["constraints"].push_back(in_words(constraint));
    view["failures"] = failures(table);
    const std::vector<Ledger> ledgers = correlation::all_ledgers_of(study);
    view["warnings"] = warnings(study, sight, ledgers);
    view["ledgers"] = Json::array();
    for (const Ledger& ledger : ledgers) view["ledgers"].push_back(correlation::json_of(ledger));
    return view;
  });
}

}  // namespace latsch::studio
