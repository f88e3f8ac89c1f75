// SPDX-License-Identifier: Apache-2.0
// The file of the samples, STUDY.samples.csv beside the study: one sample a row, values in the
// units of the variables.
//
//   radial [MN/m^2],damping [1],log density,chain,density
//   0.5531,0.0213,-11.72,17,surrogate
//
// The logarithm of the density has an arbitrary zero. `density` is "surrogate", or "unchecked
// surrogate", "doubtful surrogate" or "refused surrogate" by the verdict of the check, and "model"
// if the model itself decided.
#pragma once

#include <filesystem>

#include "correlation/posterior/posterior.h"

namespace latsch::correlation {

/// Returns what the samples are those of: "surrogate", "doubtful surrogate".
const char* density_word(const Posterior& posterior);

/// Returns STUDY.samples.csv.
std::filesystem::path samples_file(const Study& study);

/// Writes the file; a crash leaves the old one or the new one. Throws InputError.
void write_samples(const Study& study,
                   const Posterior& posterior,
                   const std::filesystem::path& file);

}  // namespace latsch::correlation
