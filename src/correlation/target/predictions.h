// SPDX-License-Identifier: Apache-2.0
// Trials of all experiments of a study, the predicted ones included. They are kept in a journal of
// their own beside the study's, because its trials hold the fitted experiments alone.
#pragma once

#include <optional>
#include <vector>

#include "correlation/study/study.h"
#include "evaluation/executors/executor.h"
#include "evaluation/schedule/run_options.h"

namespace latsch::correlation {

/// Whether there are experiments with use = "predict".
bool has_predictions(const Study& study);

/// The study as if all its experiments were fitted, with the journal "study.predictions.latsch".
Study with_predictions(const Study& study);

/// Evaluates the points of a study, with an executor of it, into its journal; false where that was
/// stopped.
bool evaluate_points(const Study& study,
                     const std::vector<DesignPoint>& points,
                     Executor& executor,
                     const RunOptions& options);

/// Their channels, from its journal; nullopt where one is missing or failed.
std::optional<std::vector<Channels>> recorded_channels(const Study& study,
                                                       const std::vector<DesignPoint>& points);

/// Evaluates the points with an executor of with_predictions(study); false where that was stopped.
bool predict(const Study& study,
             const std::vector<DesignPoint>& points,
             Executor& executor,
             const RunOptions& options);

/// The channels of the points, from that journal; nullopt where one is missing or failed.
std::optional<std::vector<Channels>> predicted_channels(const Study& study,
                                                        const std::vector<DesignPoint>& points);

}  // namespace latsch::correlation
