// SPDX-License-Identifier: Apache-2.0
// A comparison of models as one HTML page that opens anywhere, without a network: distances,
// what they depend on, pictures of one run, and the spectra of every case with their bands.
#pragma once

#include <string>
#include <vector>

#include "correlation/comparison/model_comparison.h"

namespace latsch::correlation {

std::string model_comparison_page(const ModelComparisonFile& file,
                                  const ModelComparison& comparison);

/// What its bands contain and what not.
std::string bands_in_words(const ModelComparisonFile& file);

/// What came out, a sentence each.
std::vector<std::string> findings(const ModelComparisonFile& file,
                                  const ModelComparison& comparison);

}  // namespace latsch::correlation
