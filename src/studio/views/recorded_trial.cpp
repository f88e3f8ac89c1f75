// SPDX-License-Identifier: Apache-2.0
#include "studio/views/recorded_trial.h"

#include <charconv>

#include "base/error.h"
#include "correlation/analysis/prediction_bands.h"
#include "correlation/study/study_experiment.h"
#include "correlation/target/compared_trial.h"
#include "correlation/target/predictions.h"
#include "correlation/target/study_trials.h"
#include "studio/views/kept_answers.h"
#include "studio/views/kept_identifiability.h"

namespace latsch::studio {

using correlation::Study;

namespace {

// number of stored points with their predictions, and with their bands
constexpr std::size_t kKept = 16;

std::size_t place_of(const ShelvedStudy::Sight& sight, const std::string& trial) {
  const auto count = static_cast<long>(sight.table->rows().size());
  if (trial.empty() || trial == "best") {
    if (const auto best = sight.table->best()) return *best;
    if (!sight.error.empty()) throw InputError(sight.error);
    if (!sight.no_best.empty()) throw InputError(sight.no_best);
    throw InputError(sight.table->total() == 0 ? "no trial has been run yet: start the study"
                                               : "no trial has succeeded yet");
  }
  long number = 0;
  const auto [end, error] = std::from_chars(trial.data(), trial.data() + trial.size(), number);
  if (error != std::errc{} || end != trial.data() + trial.size() || number < 1 || number > count)
    throw InputError("there is no trial \"" + trial + "\"; they are numbered 1 to " +
                     std::to_string(count) + ", or \"best\"");
  return static_cast<std::size_t>(number - 1);
}

/// Key of a stored answer: a study, a point of the study and, if it matters, the identifiability at
/// that time.
struct Known {
  std::shared_ptr<const Study> study;
  std::string point;
  std::shared_ptr<const correlation::Identifiability> what = nullptr;
  std::string predictions = {};  // text that changes with new trials of predictions
  bool operator==(const Known&) const = default;
};

/// Returns the recordings of all experiments at a point, including the predicted ones. If two pages
/// request the same point, both wait for one simulation.
std::shared_ptr<const Result<Channels>> with_predicted(const std::shared_ptr<const Study>& study,
                                                       const DesignPoint& point) {
  static KeptAnswers<Known, Result<Channels>> kept(kKept);
  return kept.get({study, point.bits()}, [&]() -> Result<Channels> {
    if (const auto recorded =
            correlation::recorded_channels(correlation::with_predictions(*study), {point}))
      return recorded->front();
    return correlation::simulate_all(*study, point);
  });
}

}  // namespace

RecordedTrial recorded_trial(const ShelvedStudy& shelved, const std::string& trial) {
  bool is_kept = false;
  RecordedTrial recorded = shelved.look([&](const ShelvedStudy::Sight& sight) {
    if (!sight.study) throw InputError(shelved.id() + " cannot be read: " + sight.error);
    const TrialTable& table = *sight.table;
    const std::size_t place = place_of(sight, trial);
    const TableRow& row = table.rows()[place];
    if (!row.parts)
      throw InputError("trial " + std::to_string(place + 1) +
                       " failed: " + table.reasons()[static_cast<std::size_t>(row.reason)]);
    RecordedTrial found{sight.study, static_cast<long>(place + 1), row.point, {}, {}, {}};
    if (const Channels* kept = table.kept_channels(place)) {
      is_kept = true;
      found.channels = *kept;
    }
    if (const auto initial = table.initial(); initial && *initial != place) {
      found.initial_trial = static_cast<long>(*initial + 1);
      found.initial = *table.kept_channels(*initial);
    }
    return found;
  });
  if (is_kept) return recorded;
  // Reads without holding the lock, so that other users of the journal do not wait.
  auto channels =
      read_channels(recorded.study->run.journal, static_cast<std::size_t>(recorded.trial - 1));
  if (!channels) throw InputError(channels.failure().reason);
  recorded.channels = std::move(*channels);
  return recorded;
}

namespace {

using Bands = std::vector<correlation::ExperimentBand>;

/// Returns one uncertainty band for every experiment, or none. Reads the whole journal.
std::shared_ptr<const Bands> bands_of(
    const RecordedTrial& recorded,
    const std::shared_ptr<const correlation::Identifiability>& what) {
  static const auto none = std::make_shared<const Bands>();
  static KeptAnswers<Known, Bands> kept(kKept);
  if (!what || what->best != recorded.point) return none;
  const std::string predictions = state_of_predictions(*recorded.study);
  return kept.get({recorded.study, recorded.point.bits(), what, predictions}, [&] {
    const Study& study = *recorded.study;
    std::vector<correlation::KnownTrial> others;
    if (correlation::has_predictions(study) && study.specimens->may_repeat()) {
      const auto all = with_predicted(recorded.study, recorded.point);
      if (all->ok()) others.push_back({recorded.point, **all});
    }
    return correlation::prediction_bands(study, *what, Journal::read(study.run.journal), others);
  });
}

}  // namespace

Drawn draw(const RecordedTrial& recorded,
           const std::shared_ptr<const correlation::Identifiability>& what) {
  const Study& study = *recorded.study;
  const auto known_bands = bands_of(recorded, what);
  const Bands& bands = *known_bands;
  Drawn drawn;
  std::shared_ptr<const Result<Channels>> all;
  for (std::size_t e = 0; e < study.experiments.size(); ++e) {
    const auto& experiment = study.experiments[e];
    const bool has_band = e < bands.size() && bands[e].is_known();
    const report::Band band =
        has_band ? report::Band{bands[e].lower, bands[e].upper, inside_text(bands[e])}
                 : report::Band{};
    const Channels* found = &recorded.channels;
    const Channels* initial = recorded.initial ? &*recorded.initial : nullptr;
    if (!experiment.fitted) {
      if (!study.specimens->may_repeat()) {
        drawn.absent.emplace_back(
            experiment.name,
            "it is only predicted, and an outside program is not run again for "
            "a page");
        continue;
      }
      if (!all) all = with_predicted(recorded.study, recorded.point);
      if (!all->ok()) {
        drawn.absent.emplace_back(experiment.name, all->failure().reason);
        continue;
      }
      found = &**all;
      initial = nullptr;
    }
    const auto comparison = correlation::comparison_of(experiment, study.experiments, *found);
    if (!comparison) {
      drawn.absent.emplace_back(experiment.name, comparison.failure().reason);
      continue;
    }
    std::optional<correlation::Comparison> at_start;
    if (initial) {
      auto start = correlation::comparison_of(experiment, study.experiments, *initial);
      if (start) at_start = std::move(*start);
      if (!start) initial = nullptr;
    }
    report::ExperimentRow row;
    row.name = experiment.name;
    row.fitted = experiment.fitted;
    row.error = own_measure(experiment, *comparison);
    row.measure = measure_in_words(experiment);
    if (at_start) row.initial_error = own_measure(experiment, *at_start);
    drawn.page.experiments.push_back(std::move(row));
    experiment.observable->draw({experiment.name,
                                 conditions_of(experiment, study.tests),
                                 experiment.fitted,
                                 false,
                                 *found,
                                 *comparison,
                                 initial,
                                 at_start ? &*at_start : nullptr,
                                 has_band ? &band : nullptr,
                                 experiment.objective.weight},
                                drawn.page);
  }
  return drawn;
}

}  // namespace latsch::studio
