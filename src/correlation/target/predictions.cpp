// SPDX-License-Identifier: Apache-2.0
#include "correlation/target/predictions.h"

#include <algorithm>
#include <filesystem>
#include <map>

#include "evaluation/journal/journal.h"
#include "evaluation/schedule/scheduler.h"

namespace latsch::correlation {

bool has_predictions(const Study& study) {
  return std::any_of(
      study.experiments.begin(), study.experiments.end(), [](const auto& e) { return !e.fitted; });
}

Study with_predictions(const Study& study) {
  Study all = study;
  for (StudyExperiment& experiment : all.experiments) experiment.fitted = true;
  all.run.journal.replace_extension(".predictions.latsch");
  return all;
}

bool evaluate_points(const Study& study,
                     const std::vector<DesignPoint>& points,
                     Executor& executor,
                     const RunOptions& options) {
  Journal journal = Journal::open(study.run.journal, identity(study));
  return run_doe({points}, executor, journal, options) != RunEnd::stopped;
}

std::optional<std::vector<Channels>> recorded_channels(const Study& study,
                                                       const std::vector<DesignPoint>& points) {
  if (!std::filesystem::exists(study.run.journal)) return std::nullopt;
  const Journal journal = Journal::read(study.run.journal);
  if (journal.identity() != identity(study))
    // the journal belongs to an earlier version of the model
    return std::nullopt;
  std::map<std::string, Channels> known;
  journal.for_each([&](const Trial& trial) {
    if (trial.outcome.result) known.emplace(trial.point.bits(), *trial.outcome.result);
  });
  std::vector<Channels> channels;
  for (const DesignPoint& point : points) {
    const auto at = known.find(point.bits());
    if (at == known.end()) return std::nullopt;
    channels.push_back(at->second);
  }
  return channels;
}

bool predict(const Study& study,
             const std::vector<DesignPoint>& points,
             Executor& executor,
             const RunOptions& options) {
  return evaluate_points(with_predictions(study), points, executor, options);
}

std::optional<std::vector<Channels>> predicted_channels(const Study& study,
                                                        const std::vector<DesignPoint>& points) {
  return recorded_channels(with_predictions(study), points);
}

}  // namespace latsch::correlation
