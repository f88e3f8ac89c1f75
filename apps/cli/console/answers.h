// SPDX-License-Identifier: Apache-2.0
// Results of several verbs for a program: what `--json` prints. Keys stay what they are; a value
// has its unit beside it or in its key; shares are plain (0.03, not 3 %); what is not known is
// null.
#pragma once

#include <string>
#include <vector>

#include "cli/console/console.h"
#include "correlation/analysis/identifiability.h"
#include "correlation/analysis/missed_values.h"
#include "correlation/analysis/prediction_bands.h"
#include "correlation/study/study.h"
#include "measurement/channels.h"

namespace latsch::cli {

/// [{"name", "unit", "values"}], SI.
Json answer_of(const Channels& channels);

/// Channels that a verb computes: to the file, or where there is none to standard output, as CSV;
/// with --json and without a file as "channels" of the answer.
void give(const Channels& channels, const std::string& file);

/// [{"name", "value", "unit"}], in the units of the study.
Json answer_of(const DesignSpace& space, const DesignPoint& point);

/// The same with "lower", "upper", "initial", "scale", "paths".
Json answer_of(const DesignSpace& space);

/// The same as of a point with "interval": [lower, upper] at 95 %, null where nothing holds an end;
/// "refined": the number of the refined model, where the study has one.
Json answer_of(const correlation::Study& study, const correlation::Identifiability& result);

/// Bands, an experiment each: values, ends and noise in SI, null where not known; how many measured
/// values lie inside band and noise.
Json answer_of(const correlation::Study& study,
               const std::vector<correlation::ExperimentBand>& bands);

/// The fitted delays of recordings: [{"name", "value", "lower", "upper", "at_end", "unit"}], s.
Json delays_of(const correlation::Study& study,
               const std::vector<correlation::ExperimentBand>& bands);

/// [{"value", "error", "fitted", "variable", "payer", "in_words"}]; variable: null where none moves
/// it; payer: what it would be {"value", "error"} if that variable mended the other alone.
Json answer_of(const correlation::Study& study,
               const std::vector<correlation::MissedValue>& missed);

/// One experiment: measured beside simulated, errors as shares, mean and largest.
Json answer_of(const correlation::StudyExperiment& experiment, const Channels& trial);

}  // namespace latsch::cli
