// SPDX-License-Identifier: Apache-2.0
// The point at which an identification begins, so that one that was interrupted goes on.
//
// An identification begins at the best trial of a journal and may find a better one. If it were
// begun there after an interruption, it would want other trials than those it had run. So a mark in
// the journal keeps where it began. The mark holds as long as the best trial is that point, or one
// that the identification from there has found itself; after a better trial from elsewhere, a
// search with more steps for example, an identification begins anew.
#pragma once

#include "correlation/analysis/identifiability.h"

namespace latsch::correlation {

/// Tells whether the journal knows where an identification of that depth began.
bool has_begun(const Journal& journal, Depth depth);

/// Returns where an identification begins, `best` being the best trial: there, or at the mark if it
/// holds.
DesignPoint identification_start(const Study& study,
                                 const Journal& journal,
                                 const DesignPoint& best,
                                 Depth depth);

/// Returns the same point and marks it. Returns `best` for Depth::at_the_point, without a mark.
DesignPoint begin_identification(const Study& study,
                                 Journal& journal,
                                 const DesignPoint& best,
                                 Depth depth);

}  // namespace latsch::correlation
