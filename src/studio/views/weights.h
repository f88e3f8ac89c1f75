// SPDX-License-Identifier: Apache-2.0
// Parses the weights in a request: "force:2,modes:0.5" changes those of two experiments, and the
// others keep the weights of the study.
#pragma once

#include <string>

#include "correlation/target/target_parts.h"

namespace latsch::studio {

/// Throws InputError for an experiment that is not fitted or an invalid weight.
std::vector<double> weights_of(const std::string& text, const correlation::PartedTarget& target);

correlation::PartedTarget::Weighting weighting_of(const std::string& text,
                                                  const correlation::PartedTarget& target);

}  // namespace latsch::studio
