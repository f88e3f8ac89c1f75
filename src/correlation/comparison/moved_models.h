// SPDX-License-Identifier: Apache-2.0
// Creates models whose parameters are changed within their uncertainty. The bands of a prediction
// follow from their results.
#pragma once

#include <vector>

#include "base/document.h"
#include "correlation/comparison/fit_posterior.h"
#include "correlation/comparison/model_comparison_file.h"

namespace latsch::correlation {

/// A model whose parameters were moved.
struct MovedModel {
  Document numbers;
  double count = 1.0;  // factor to a full standard deviation: bounds may allow only a part of one
};

/// Returns the moved models that are run for the bands: one for each direction, or the samples that
/// the file asks for; empty if nothing of the model is uncertain. Models that share a fit share its
/// random draws.
std::vector<MovedModel> band_models(const ModelComparisonFile& file,
                                    const ComparedModel& model,
                                    const std::vector<FitPosterior>& fits);

}  // namespace latsch::correlation
