// SPDX-License-Identifier: Apache-2.0
// Computes the identifiability of a study from its journal once for every state of the study,
// because this takes a pass over all channels.
#pragma once

#include <memory>
#include <string>

#include "correlation/analysis/identifiability.h"
#include "studio/shelf/shelved_study.h"

namespace latsch::studio {

struct KeptIdentifiability {
  std::shared_ptr<const correlation::Study> study;
  /// nullptr if there is none; `why_not` then has the reason
  std::shared_ptr<const correlation::Identifiability> what;
  std::string why_not;

  /// Returns the reason why the result does not hold at a point; empty if it does.
  std::string why_not_at(const DesignPoint& point) const;
};

/// Returns a text that changes with new trials of predicted experiments; these trials have a
/// separate journal.
std::string state_of_predictions(const correlation::Study& study);

/// Returns the identifiability of the study. May be called by any thread; it waits while the result
/// is being computed.
KeptIdentifiability kept_identifiability(const ShelvedStudy& shelved);

}  // namespace latsch::studio
