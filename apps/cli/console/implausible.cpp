// SPDX-License-Identifier: Apache-2.0
#include "cli/console/implausible.h"

#include <algorithm>

#include "cli/console/console.h"
#include "cli/console/tire_faults.h"
#include "correlation/analysis/plausibility.h"
#include "correlation/target/test_limits.h"

namespace latsch::cli {

void reject_impossible(const std::vector<experiment::Finding>& found) {
  const experiment::Finding* worst = nullptr;
  for (const experiment::Finding& finding : found) {
    if (finding.impossible && !worst) {
      worst = &finding;
      continue;
    }
    const char* prefix = finding.is_note ? "" : finding.impossible ? "also wrong: " : "warning: ";
    warn(prefix + experiment::in_words(finding), finding.place);
  }
  if (worst) throw InputError(worst->place, worst->sentence);
}

void reject_implausible(const correlation::Study& study) {
  reject_impossible(correlation::implausible(study));
}

void warn_of_implausible(const correlation::Study& study) {
  for (const experiment::Finding& finding : correlation::implausible(study))
    warn((finding.is_note ? "" : "warning: ") + experiment::in_words(finding), finding.place);
}

void warn_of_limits_met(const correlation::Study& study, const std::vector<std::string>& limits) {
  const std::vector<std::string> told = correlation::limits_of_tests(study);
  for (const std::string& limit : limits)
    if (std::find(told.begin(), told.end(), limit) == told.end()) warn(limit);
}

void examine_model(const experiment::SpecimenKind& kind,
                   const Document& numbers,
                   const std::string& file) {
  reject_impossible(experiment::findings_of_model(kind, numbers, file));
  warn_beyond_data(kind, numbers, file);
}

}  // namespace latsch::cli
