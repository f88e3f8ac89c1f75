// SPDX-License-Identifier: Apache-2.0
// Collects the present results of a study for its report page: replays the journal, and simulates
// the initial and the best point once more for the predictions and the pictures.
#pragma once

#include "base/result.h"
#include "correlation/study/study.h"
#include "evaluation/journal/journal.h"
#include "report/report.h"

namespace latsch::correlation {

/// Fails if no trial in the journal succeeded.
/// `as_read`: the study before its last stage changed weights and noise, from which its stages are
/// read; nullptr: `study` itself.
Result<report::StudyReport> study_report(
    const Study& study,
    const Journal& journal,
    experiment::Thoroughness thoroughness = experiment::Thoroughness::seconds,
    const Study* as_read = nullptr);

}  // namespace latsch::correlation
