// SPDX-License-Identifier: Apache-2.0
// The table [posterior] of a study: how `latsch sample` draws samples of the variables' posterior
// density.
//
// The keys are in correlation/study/keys/posterior_keys.cpp.
#pragma once

#include <cstdint>

#include "base/document.h"

namespace latsch::correlation {

struct PosteriorSettings {
  int samples = 2000;      // number of samples that are kept
  int runs = 50;           // most trials beyond the fit; 0: none
  std::uint64_t seed = 0;  // selects the random numbers
};

/// Reads [posterior]. Throws InputError.
PosteriorSettings read_posterior(const Node& table);

}  // namespace latsch::correlation
