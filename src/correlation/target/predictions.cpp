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

bool predict(const Study& study,
             const std::vector<DesignPoint>& points,
             Executor& executor,
             const RunOptions& options) {
  const Study all = with_predictions(study);
  Journal journal = Journal::open(all.run.journal, identity(all));
  return run_doe({points}, executor, journal, options) != RunEnd::stopped;
}

std::optional<std::vector<Channels>> predicted_channels(const Study& study,
                                                        const std::vector<DesignPoint>& points) {
  const Study all = with_predictions(study);
  if (!std::filesystem::exists(all.run.journal)) return std::nullopt;
  const Journal journal = Journal::read(all.run.journal);
  if (journal.identity() != identity(all)) return std::nullopt;  // of an older model
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

}  // namespace latsch::correlation
