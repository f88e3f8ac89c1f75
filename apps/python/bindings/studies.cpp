// SPDX-License-Identifier: Apache-2.0
// Studies for Python: their variables and experiments, the objective for given channels, and the
// trials of a journal as arrays. The program runs the studies (apps/python/latsch/_study.py).
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "base/text.h"
#include "base/units.h"
#include "bindings/arrays.h"
#include "bindings/bindings.h"
#include "bindings/failures.h"
#include "bindings/long_call.h"
#include "bindings/models.h"
#include "bindings/posteriors.h"
#include "correlation/posterior/posterior.h"
#include "correlation/search/search_standing.h"
#include "correlation/search/stage_runs.h"
#include "correlation/search/study_method.h"
#include "correlation/study/ledgers/study_ledgers.h"
#include "correlation/study/study_slopes.h"
#include "correlation/study/variables.h"
#include "correlation/study_report/fitted_model.h"
#include "correlation/target/best_trial.h"
#include "correlation/target/study_trials.h"
#include "correlation/target/test_limits.h"
#include "correlation/target/trial_ownership.h"
#include "evaluation/journal/asked_trials.h"
#include "evaluation/journal/journal_lock.h"

namespace latsch::python {
namespace {

using correlation::Study;
using correlation::StudyExperiment;

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// A study with its journal. The journal's file need not exist yet.
using SharedStudy = std::shared_ptr<const Study>;

// When a run begins, its journal is incomplete for some milliseconds, so reading is tried again.
constexpr int kMostReads = 10;
constexpr std::chrono::milliseconds kBetweenReads{50};

/// Returns the study's journal; nullopt before the first run.
std::optional<Journal> journal_of(const Study& study) {
  const std::filesystem::path& file = study.run.journal;
  for (int read = 1;; ++read) {
    if (!std::filesystem::exists(file)) return std::nullopt;
    try {
      return Journal::read(file, correlation::identity(study));
    } catch (const InputError&) {
      if (read == kMostReads || !journal_holder(file)) throw;
      std::this_thread::sleep_for(kBetweenReads);
    }
  }
}

/// The trials of a journal by columns, with one entry for each trial.
struct Trials {
  std::vector<DesignPoint> points;
  std::vector<double> targets, violations, seconds;
  std::vector<bool> asked, own;
  std::vector<Status> failures;
  std::vector<std::string> channels;  // names in the order of their first appearance
  std::map<std::string, std::vector<std::vector<double>>> rows;  // empty: failed
  std::map<std::string, std::string> units;

  std::set<std::string> seen;  // names of all channels of the trials

  void add_channels(const Channels& found, const std::vector<std::string>& names, bool all) {
    for (const Channel& channel : found.all()) {
      seen.insert(channel.name);
      if (!all && std::find(names.begin(), names.end(), channel.name) == names.end()) continue;
      auto& column = rows[channel.name];
      if (column.empty()) {
        channels.push_back(channel.name);
        units[channel.name] = channel.unit;
      }
      column.resize(points.size());
      column.back() = channel.values;
    }
  }
};

Trials trials_of(const Study& as_written, const std::vector<std::string>& names, bool all) {
  const std::optional<Journal> read = journal_of(as_written);
  if (!read) return {};
  const Journal& journal = *read;
  const Study study = correlation::with_estimated_noise(as_written, journal);
  const Objective target = correlation::objective(study);
  const AskedTrials asked(journal.marks());
  const correlation::TrialOwnership ownership(study, journal.marks());
  Trials trials;
  long row = 0;
  journal.for_each([&](const Trial& trial) {
    const auto& channels = trial.outcome.result;
    const Result<Score> score =
        channels ? target(trial.point, *channels) : Result<Score>(channels.failure());
    trials.points.push_back(trial.point);
    trials.targets.push_back(score ? score->value : kUnknown);
    trials.violations.push_back(score ? violation(*score) : kUnknown);
    trials.failures.push_back(score ? Status() : score.failure());
    trials.seconds.push_back(trial.outcome.wall_time);
    trials.asked.push_back(asked.contains(row, trial.point));
    trials.own.push_back(!ownership.is_known() || ownership.is_own(row, trial.point));
    ++row;
    if (channels) trials.add_channels(*channels, names, all);
  });
  for (auto& [name, column] : trials.rows) column.resize(trials.points.size());
  const std::vector<std::string> seen(trials.seen.begin(), trials.seen.end());
  for (const std::string& name : names)
    if (!seen.empty() && !trials.seen.contains(name))
      throw InputError("no trial has a channel " + in_quotes(name) + did_you_mean(name, seen) +
                       "; there are " + list_of(seen));
  return trials;
}

/// Returns an array of shape (trials, samples) with NaN for failed trials, or a list of arrays if
/// the numbers of samples differ.
py::object column(const std::vector<std::vector<double>>& rows) {
  std::size_t samples = 0;
  for (const auto& row : rows) samples = std::max(samples, row.size());
  const bool are_alike = std::all_of(rows.begin(), rows.end(), [&](const auto& row) {
    return row.empty() || row.size() == samples;
  });
  if (!are_alike) {
    py::list all;
    for (const auto& row : rows) all.append(row.empty() ? py::none() : py::object(array(row)));
    return all;
  }
  Array all({static_cast<py::ssize_t>(rows.size()), static_cast<py::ssize_t>(samples)});
  double* to = all.mutable_data();
  for (const auto& row : rows) {
    if (row.empty()) std::fill_n(to, samples, kUnknown);
    to = row.empty() ? to + samples : std::copy(row.begin(), row.end(), to);
  }
  return all;
}

py::dict as_dict(const Trials& trials, int variables) {
  py::list failures;
  for (const Status& status : trials.failures)
    failures.append(status.ok() ? py::none() : failure_value(status.failure()));
  py::array_t<bool> asked(static_cast<py::ssize_t>(trials.asked.size()));
  std::copy(trials.asked.begin(), trials.asked.end(), asked.mutable_data());
  py::array_t<bool> own(static_cast<py::ssize_t>(trials.own.size()));
  std::copy(trials.own.begin(), trials.own.end(), own.mutable_data());
  py::dict channels, units;
  for (const std::string& name : trials.channels) {
    channels[py::str(name)] = column(trials.rows.at(name));
    units[py::str(name)] = trials.units.at(name);
  }
  py::dict all;
  all["points"] = array(trials.points, variables);
  all["targets"] = array(trials.targets);
  all["violations"] = array(trials.violations);
  all["seconds"] = array(trials.seconds);
  all["asked"] = asked;
  all["own"] = own;
  all["failures"] = failures;
  all["channels"] = channels;
  all["units"] = units;
  return all;
}

Channels channels_of(const py::dict& values) {
  Channels channels;
  for (const auto& [name, samples] : values)
    channels.add({.name = name.cast<std::string>(),
                  .unit = "1",  // an objective compares values in SI
                  .values = vector(samples.cast<Array>())});
  return channels;
}

Score target_of(const Study& study, const DesignPoint& at, const Channels& channels) {
  const auto score = correlation::objective(study)(at, channels);
  if (!score) raise(score.failure());
  return *score;
}

/// Runs a trial and returns its score for a search, with derivatives if `slopes` and if the model
/// knows them.
Result<Score> score_at(const Study& study, const DesignPoint& at, bool slopes) {
  Study asking = study;
  asking.asks_slopes = slopes;
  const Outcome outcome = evaluate(correlation::evaluator(asking), at);
  if (!outcome.result) return outcome.result.failure();
  return correlation::objective(asking)(at, *outcome.result);
}

py::tuple simulated(const SharedStudy& study, const DesignPoint& at) {
  auto found = long_call<Result<Channels>>(
      [study, at](const Abandonment&) { return correlation::simulate_all(*study, at); });
  if (!found) raise(found.failure());
  return arrays_of(found->all(), 0);
}

Score scored(const SharedStudy& study, const DesignPoint& at, const py::object& slopes) {
  const auto why_not = correlation::reason_without_slopes(*study);
  const bool asked = slopes.is_none() ? !why_not : slopes.cast<bool>();
  if (asked && why_not) throw InputError("slopes: " + *why_not);
  auto found = long_call<Result<Score>>(
      [study, at, asked](const Abandonment&) { return score_at(*study, at, asked); });
  if (!found) raise(found.failure());
  return *found;
}

/// Reads a design point of a study. A value that is not finite causes an InputError. A value
/// outside of its bounds only causes a Python warning: the model can be evaluated there, but a
/// search never does so.
DesignPoint point_of(const Study& study, const Array& at) {
  const DesignPoint read = point(at, study.space.size());
  for (int i = 0; i < study.space.size(); ++i) {
    const DesignVariable& v = study.space[i];
    const double x = read.values[static_cast<std::size_t>(i)];
    if (!std::isfinite(x))
      throw InputError("variable " + v.name + " is " + format_number(x) +
                       ", expected a finite number");
    if (x >= v.lower && x <= v.upper) continue;
    const std::string words = "variable " + v.name + " is " + format_quantity(x, v.unit) +
                              ", outside of its bounds " + format_quantity(v.lower, v.unit) +
                              " to " + format_quantity(v.upper, v.unit);
    if (PyErr_WarnEx(PyExc_UserWarning, words.c_str(), 1) < 0) throw py::error_already_set();
  }
  return read;
}

Model model_at(const Study& study, const py::object& at) {
  const auto* kind = study.specimens->kind();
  if (!kind) throw InputError({study.file.string(), 0}, "has a [simulator] instead of a model");
  if (at.is_none()) return {*kind, study.model};
  const DesignPoint p = point_of(study, at.cast<Array>());
  return {*kind, correlation::at(study.model, study.space, p)};
}

/// Returns (point, objective, constraint violation) of the best trial, or None.
py::object best_of(const Study& as_written) {
  std::optional<correlation::RatedTrial> best;
  {
    const py::gil_scoped_release others;
    if (const auto journal = journal_of(as_written)) {
      const Study study = correlation::with_estimated_noise(as_written, *journal);
      correlation::require_best(study, *journal);
      best = correlation::best_trial(study, *journal);
    }
  }
  if (!best) return py::none();
  return py::make_tuple(array(best->point.values), best->target, best->violation);
}

/// The samples of a journal, with the study in the stage that was sampled.
struct RecordedSamples {
  Study study;
  correlation::Posterior posterior;
};

std::optional<RecordedSamples> samples_of(const Study& as_written) {
  const std::optional<Journal> journal = journal_of(as_written);
  if (!journal) return std::nullopt;
  Study study = correlation::recorded_stages(as_written, *journal).study;
  correlation::require_best(study, *journal);
  auto posterior = correlation::recorded_posterior(study, *journal);
  if (!posterior) return std::nullopt;
  return RecordedSamples{std::move(study), std::move(*posterior)};
}

void bind_experiments(py::module_& module) {
  py::class_<StudyExperiment>(
      module, "Experiment", "The comparison of a test's recording with a measurement.")
      .def_readonly("name", &StudyExperiment::name)
      .def_readonly("fitted", &StudyExperiment::fitted, "False: only predicted.")
      .def_property_readonly("weight", [](const StudyExperiment& e) { return e.objective.weight; })
      .def_property_readonly("kind", [](const StudyExperiment& e) { return e.observable->kind(); })
      .def_property_readonly(
          "channels",
          [](const StudyExperiment& e) { return e.observable->asks(); },
          "Names of the compared channels of a trial.")
      .def_property_readonly(
          "measured",
          [](const StudyExperiment& e) { return array(e.observable->measured_values()); },
          "Array (values,), in `unit`; empty if spectra or levels are compared.")
      .def_property_readonly("unit", [](const StudyExperiment& e) { return e.observable->unit(); })
      .def_property_readonly("values", &StudyExperiment::values, "The number of compared values.")
      .def("__repr__", [](const StudyExperiment& e) {
        return "<latsch.Experiment " + e.name + ", " + e.observable->kind() + ", " +
               std::to_string(e.values()) + " values>";
      });
}

}  // namespace

void bind_studies(py::module_& module) {
  bind_experiments(module);
  struct Read {
    SharedStudy study;
  };
  py::class_<Read>(module, "_Study", py::dynamic_attr())
      .def(py::init([](const std::filesystem::path& file) {
             return Read{std::make_shared<const Study>(
                 correlation::read_study(file, experiment::language()))};
           }),
           py::arg("file"))
      .def_property_readonly("file", [](const Read& s) { return s.study->file; })
      .def_property_readonly("title", [](const Read& s) { return s.study->title; })
      .def_property_readonly("journal", [](const Read& s) { return s.study->run.journal; })
      .def_property_readonly("space", [](const Read& s) { return s.study->space; })
      .def_property_readonly("variables", [](const Read& s) { return s.study->space.variables(); })
      .def_property_readonly("experiments", [](const Read& s) { return s.study->experiments; })
      .def_property_readonly(
          "method",
          [](const Read& s) { return std::string(name(correlation::method_of(*s.study).method)); })
      .def_property_readonly("_ledger_json",
                             [](const Read& s) {
                               auto all = nlohmann::ordered_json::array();
                               for (const Ledger& ledger : correlation::all_ledgers_of(*s.study))
                                 all.push_back(correlation::json_of(ledger));
                               return all.dump();
                             })
      .def_property_readonly(
          "reason_without_slopes",
          [](const Read& s) { return correlation::reason_without_slopes(*s.study).value_or(""); },
          "The reason for which trials have no derivatives; empty if they have them.")
      .def(
          "target",
          [](const Read& s, const Array& at, const py::dict& channels) {
            return target_of(*s.study, point_of(*s.study, at), channels_of(channels));
          },
          py::arg("point"),
          py::arg("channels"))
      .def(
          "score",
          [](const Read& s, const Array& at, const py::object& slopes) {
            return scored(s.study, point_of(*s.study, at), slopes);
          },
          py::arg("point"),
          py::kw_only(),
          py::arg("slopes") = py::none())
      .def(
          "_simulate",
          [](const Read& s, const Array& at) { return simulated(s.study, point_of(*s.study, at)); })
      .def("_limits",
           [](const Read& s, const Array& at) {
             const DesignPoint p = point(at, s.study->space.size());
             return long_call<std::vector<std::string>>([study = s.study, p](const Abandonment&) {
               return correlation::limits_met_at(*study, p);
             });
           })
      .def(
          "model",
          [](const Read& s, const py::object& at) { return model_at(*s.study, at); },
          py::arg("point") = py::none(),
          "Returns the Model as written, or with the variables at a point (n,).")
      .def(
          "_fitted_text",
          [](const Read& s, const std::string& version, const std::string& date) {
            if (!s.study->specimens->kind())
              throw InputError({s.study->file.string(), 0}, "has a [simulator] instead of a model");
            return long_call<std::string>([study = s.study, version, date](const Abandonment&) {
              return correlation::text_of(*study,
                                          correlation::fitted_model(*study, {version, date}));
            });
          })
      .def("_best", [](const Read& s) { return best_of(*s.study); })
      .def("_samples",
           [](const Read& s) -> py::object {
             const auto found = long_call<std::optional<RecordedSamples>>(
                 [study = s.study](const Abandonment&) { return samples_of(*study); });
             if (!found) return py::none();
             return as_dict(found->study, found->posterior);
           })
      .def("_trials", [](const Read& s, const std::vector<std::string>& names, bool all) {
        const Trials trials = long_call<Trials>([study = s.study, names, all](const Abandonment&) {
          return trials_of(*study, names, all);
        });
        return as_dict(trials, s.study->space.size());
      });
}

}  // namespace latsch::python
