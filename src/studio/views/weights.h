// SPDX-License-Identifier: Apache-2.0
// Weights as a request names them: "force:2,modes:0.5" changes those of two experiments, the others
// keep what the study has.
#pragma once

#include <string>

#include "correlation/target/target_parts.h"

namespace latsch::studio {

/// Throws InputError for an experiment that is not fitted or a weight that is none.
std::vector<double> weights_of(const std::string& text, const correlation::PartedTarget& target);

correlation::PartedTarget::Weighting weighting_of(const std::string& text,
                                                  const correlation::PartedTarget& target);

}  // namespace latsch::studio
