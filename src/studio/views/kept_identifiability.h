// SPDX-License-Identifier: Apache-2.0
// What the journal of a study tells of identifiability, computed once for every state of it: it
// takes a pass over all channels.
#pragma once

#include <memory>
#include <string>

#include "correlation/analysis/identifiability.h"
#include "studio/shelf/shelved_study.h"

namespace latsch::studio {

struct KeptIdentifiability {
  std::shared_ptr<const correlation::Study> study;
  std::shared_ptr<const correlation::Identifiability> what;  // nullptr: `why_not`
  std::string why_not;

  /// Why nothing of it holds at a point; empty where it does.
  std::string why_not_at(const DesignPoint& point) const;
};

/// Changes where trials of what is only predicted have come, which are in a journal of their own.
std::string state_of_predictions(const correlation::Study& study);

/// From any thread; who asks while it is computed waits.
KeptIdentifiability kept_identifiability(const ShelvedStudy& shelved);

}  // namespace latsch::studio
