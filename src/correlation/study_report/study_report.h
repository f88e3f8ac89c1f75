// SPDX-License-Identifier: Apache-2.0
// What a study has found so far, gathered for its report page: the journal replayed, the initial
// and the best point simulated once more for the predictions and the pictures.
#pragma once

#include "base/result.h"
#include "correlation/study/study.h"
#include "evaluation/journal/journal.h"
#include "report/report.h"

namespace latsch::correlation {

/// A Failure where no trial in the journal succeeded.
Result<report::StudyReport> study_report(
    const Study& study,
    const Journal& journal,
    experiment::Thoroughness thoroughness = experiment::Thoroughness::seconds);

}  // namespace latsch::correlation
