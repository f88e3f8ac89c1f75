// SPDX-License-Identifier: Apache-2.0
// A trial with its channels, and its experiments drawn: what several views begin with.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "correlation/analysis/identifiability.h"
#include "report/report.h"
#include "studio/shelf/shelved_study.h"

namespace latsch::studio {

struct RecordedTrial {
  std::shared_ptr<const correlation::Study> study;
  long trial = 0;  // from 1
  DesignPoint point;
  Channels channels;
  std::optional<long> initial_trial;
  std::optional<Channels> initial;
};

/// `trial`: "best" or a number. Throws InputError where there is none, or it failed, with its
/// reason.
RecordedTrial recorded_trial(const ShelvedStudy& shelved, const std::string& trial);

struct Drawn {
  report::StudyReport page;                                 // forces, curves, modes, values
  std::vector<std::pair<std::string, std::string>> absent;  // experiment and why
};

/// Every experiment at that trial beside the initial point. Those that are only predicted are
/// simulated, where the model may be: as long as a trial takes. With `what`, where it belongs to
/// that point, also how uncertain the computed values are.
Drawn draw(const RecordedTrial& recorded,
           const std::shared_ptr<const correlation::Identifiability>& what = nullptr);

}  // namespace latsch::studio
