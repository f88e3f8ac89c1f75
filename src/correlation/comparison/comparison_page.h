// SPDX-License-Identifier: Apache-2.0
// Writes a tire comparison as one HTML page that opens without a network: the verdicts, the table
// of what each tire can do and needs, errors by frequency, and every test in time and frequency.
#pragma once

#include <string>

#include "correlation/comparison/tire_comparison.h"

namespace latsch::correlation {

std::string comparison_page(const ComparisonFile& file, const TireComparison& comparison);

}  // namespace latsch::correlation
