// SPDX-License-Identifier: Apache-2.0
// A trial with its channels and its experiments prepared for drawing; several views use it.
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
  long trial = 0;  // counted from 1
  DesignPoint point;
  Channels channels;
  std::optional<long> initial_trial;
  std::optional<Channels> initial;
};

/// Reads a trial; `trial` is "best" or a number. Throws InputError if there is no such trial, or
/// with the reason if it failed.
RecordedTrial recorded_trial(const ShelvedStudy& shelved, const std::string& trial);

struct Drawn {
  report::StudyReport page;  // experiments, forces, curves, modes and values
  /// experiments that cannot be drawn, with the reason
  std::vector<std::pair<std::string, std::string>> absent;
};

/// Prepares every experiment at that trial, with the values at the initial point. Predicted
/// experiments are simulated if the model allows it, which takes the time of a trial. If `what`
/// belongs to that point, the uncertainty of the computed values is included.
Drawn draw(const RecordedTrial& recorded,
           const std::shared_ptr<const correlation::Identifiability>& what = nullptr);

}  // namespace latsch::studio
