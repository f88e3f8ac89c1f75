// SPDX-License-Identifier: Apache-2.0
// Identifiability from the journal of a study, computed once for every state of the study, because
// it takes a pass over all channels.
#pragma once

#include <memory>
#include <string>

#include "correlation/analysis/identifiability.h"
#include "studio/shelf/shelved_study.h"

namespace latsch::studio {

struct KeptIdentifiability {
  std::shared_ptr<const correlation::Study> study;
  std::shared_ptr<const correlation::Identifiability> what;  // nullptr: see `why_not`
  std::string why_not;

  /// Returns why the result does not hold at a point; empty if it does.
  std::string why_not_at(const DesignPoint& point) const;
};

/// Returns a text that changes with new trials of predicted experiments, which have a journal of
/// their own.
std::string state_of_predictions(const correlation::Study& study);

/// May be called by any thread, which waits while the result is being computed.
KeptIdentifiability kept_identifiability(const ShelvedStudy& shelved);

}  // namespace latsch::studio
