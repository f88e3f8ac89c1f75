// SPDX-License-Identifier: Apache-2.0
// Answers of all views of one study, for a report in one file: a JSON object from requests to
// answers, read by apps/web/src/lib/answers.ts. A view with nothing to show is left out.
#pragma once

#include <filesystem>
#include <string>

#include "experiment/language.h"
#include "report/report.h"

namespace latsch::studio {

/// `drawn` are the report's own pictures, which are not computed again.
std::string report_answers(const std::filesystem::path& study,
                           const experiment::Language& language,
                           const report::StudyReport& drawn);

}  // namespace latsch::studio
