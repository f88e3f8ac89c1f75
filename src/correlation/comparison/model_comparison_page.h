// SPDX-License-Identifier: Apache-2.0
// Writes a comparison of models as one HTML page that opens without a network: distances, what they
// depend on, pictures of one run, and the spectra of every case with their bands.
#pragma once

#include <string>
#include <vector>

#include "correlation/comparison/model_comparison.h"

namespace latsch::correlation {

std::string model_comparison_page(const ModelComparisonFile& file,
                                  const ModelComparison& comparison);

/// Returns a text that says what the bands contain and what they omit.
std::string bands_in_words(const ModelComparisonFile& file);

/// Returns the results in words, one sentence each.
std::vector<std::string> findings(const ModelComparisonFile& file,
                                  const ModelComparison& comparison);

}  // namespace latsch::correlation
