// SPDX-License-Identifier: Apache-2.0
// Bands of predicted spectra, and how a run with its bands compares with the reference. The
// equations are at the head of model_comparison.h.
#pragma once

#include <vector>

#include "correlation/comparison/model_comparison.h"

namespace latsch::correlation {

/// Spectra of a moved model, by channel.
struct MovedDensities {
  std::vector<numerics::Density> densities;
  double count = 1.0;  // factor to a full standard deviation, copied from MovedModel::count
};

/// Sets `lower` and `upper` of the run from the spectra of the moved models; leaves both empty if
/// there are no moved models.
void add_bands(const ModelComparisonFile& file,
               const ComparedModel& model,
               const std::vector<FitPosterior>& fits,
               const std::vector<MovedDensities>& others,
               ModelRun& run);

/// Sets the run's distances from the reference and, if it has bands, their coverage and reach.
void compare_run(const ModelComparisonFile& file, const CaseComparison& compared, ModelRun& run);

}  // namespace latsch::correlation
