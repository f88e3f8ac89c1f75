// SPDX-License-Identifier: Apache-2.0
// The answers of the studio's views for one study, contained in a report: a JSON object from
// requests to answers, read by apps/web/src/lib/answers.ts. A view with nothing to show is left
// out.
#pragma once

#include <filesystem>
#include <string>

#include "experiment/language.h"
#include "report/report.h"

namespace latsch::studio {

/// `drawn` has the pictures of the report, which are not computed again.
std::string report_answers(const std::filesystem::path& study,
                           const experiment::Language& language,
                           const report::StudyReport& drawn);

}  // namespace latsch::studio
