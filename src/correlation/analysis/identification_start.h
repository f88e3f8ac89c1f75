// SPDX-License-Identifier: Apache-2.0
// Finds the point at which an identification begins, so that an interrupted identification can
// continue.
//
// An identification begins at the best trial of a journal and may find a better one. If it began at
// that better trial after an interruption, it would need other trials than those that have run.
// Therefore a mark in the journal stores where it began. The mark is valid as long as the best
// trial is that point, or one that the identification itself has found; after a better trial from
// elsewhere, for example from a search with more steps, an identification begins anew.
#pragma once

#include <optional>
#include <string>

#include "correlation/analysis/identifiability.h"

namespace latsch::correlation {

/// Returns a point as the text of a mark; its hexadecimal numbers keep every bit.
std::string text_of_point(const DesignPoint& point);
/// Returns the point that such a text describes; nullopt if the design space of the study does not
/// contain it.
std::optional<DesignPoint> point_of_text(const Study& study, const std::string& text);

/// True if the journal contains the mark of an identification of that depth.
bool has_begun(const Journal& journal, Depth depth);

/// Returns the point at which an identification begins: `best`, the best trial, or the marked point
/// if the mark is valid.
DesignPoint identification_start(const Study& study,
                                 const Journal& journal,
                                 const DesignPoint& best,
                                 Depth depth);

/// Returns the point of identification_start() and marks it. Returns `best`, without a mark, for
/// Depth::at_the_point.
DesignPoint begin_identification(const Study& study,
                                 Journal& journal,
                                 const DesignPoint& best,
                                 Depth depth);

}  // namespace latsch::correlation
