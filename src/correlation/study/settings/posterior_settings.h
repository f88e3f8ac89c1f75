// SPDX-License-Identifier: Apache-2.0
// The table [posterior] of a study: how `latsch sample` draws samples of the variables' posterior
// density.
//
// The keys are in correlation/study/keys/posterior_keys.cpp.
#pragma once

#include <cstdint>

#include "base/document.h"

namespace latsch::correlation {

/// Decides what the samples are those of: the surrogate; the model, to which the surrogate proposes
/// (delayed acceptance); or the model alone.
enum class PosteriorMethod { surrogate, delayed, model };

/// Returns the name of the method in a study, "delayed".
const char* name(PosteriorMethod method);

constexpr long kDelayedRuns = 4000, kModelRuns = 40'000;  // chain_runs unless given

struct PosteriorSettings {
  PosteriorMethod method = PosteriorMethod::surrogate;
  int samples = 2000;      // number of samples that are kept
  int runs = 50;           // most trials beyond the fit; 0: none
  long chain_runs = 0;     // most trials of the chains on the model; 0 for method surrogate
  std::uint64_t seed = 0;  // selects the random numbers
};

/// Reads [posterior]. Throws InputError.
PosteriorSettings read_posterior(const Node& table);

}  // namespace latsch::correlation
