// SPDX-License-Identifier: Apache-2.0
// Samples of a study's posterior density for the page: marginals beside the linear intervals, and
// draws for a plot of pairs; bands of computed values beside the linear ones; predictive checks.
#pragma once

#include <nlohmann/json.hpp>

#include "correlation/analysis/prediction_bands.h"
#include "correlation/posterior/posterior.h"

namespace latsch::studio {

/// Returns the samples that the journal determines; null if none were drawn, or if trials are
/// missing. Takes the time of the chains, up to some seconds.
/// `linear` has the linear bands of all experiments, which stand beside those of the samples.
nlohmann::ordered_json posterior_of(const correlation::Study& study,
                                    const Journal& journal,
                                    const std::vector<correlation::ExperimentBand>& linear);

}  // namespace latsch::studio
