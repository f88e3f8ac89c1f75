// SPDX-License-Identifier: Apache-2.0
// Trials of all experiments of a study, including the predicted ones. They are stored in a separate
// journal, because the trials in the study's journal contain only the fitted experiments.
#pragma once

#include <optional>
#include <vector>

#include "correlation/study/study.h"
#include "evaluation/executors/executor.h"
#include "evaluation/schedule/run_options.h"

namespace latsch::correlation {

/// True if the study has experiments with use = "predict".
bool has_predictions(const Study& study);

/// Returns the study with all its experiments fitted and the journal "study.predictions.latsch".
Study with_predictions(const Study& study);

/// Evaluates points with an executor of the study and adds them to its journal. Returns false if
/// the user stopped it.
bool evaluate_points(const Study& study,
                     const std::vector<DesignPoint>& points,
                     Executor& executor,
                     const RunOptions& options);

/// Returns the channels of the points from the study's journal; nullopt if a trial is missing or
/// failed.
std::optional<std::vector<Channels>> recorded_channels(const Study& study,
                                                       const std::vector<DesignPoint>& points);

/// Evaluates the points with an executor that runs with_predictions(study). Returns false if the
/// user stopped it.
bool predict(const Study& study,
             const std::vector<DesignPoint>& points,
             Executor& executor,
             const RunOptions& options);

/// Returns the channels of the points from that journal; nullopt if a trial is missing or failed.
std::optional<std::vector<Channels>> predicted_channels(const Study& study,
                                                        const std::vector<DesignPoint>& points);

}  // namespace latsch::correlation
