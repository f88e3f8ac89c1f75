// SPDX-License-Identifier: Apache-2.0
// The answers of all views of one study, for a report that is one file: a JSON object from requests
// to answers, as apps/web/src/lib/answers.ts reads it. A view that has nothing to show is left out.
#pragma once

#include <filesystem>
#include <string>

#include "experiment/language.h"
#include "report/report.h"

namespace latsch::studio {

/// `drawn`: the report's own pictures, which are not computed again.
std::string report_answers(const std::filesystem::path& study,
                           const experiment::Language& language,
                           const report::StudyReport& drawn);

}  // namespace latsch::studio
