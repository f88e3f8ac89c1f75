// SPDX-License-Identifier: Apache-2.0
// Noise that nobody has stated, told by the fit itself, an experiment each: noise = "estimated".
//
// Values of one experiment have one deviation sigma_e, in units of what an error of 100 % is. Their
// likelihood is largest, at given values of the variables, where
//   sigma_e^2 = sum d^2 / n_e,       here over n_e (1 - p/N), for the p variables fitted to all N
// and so are the values of the variables where sum of d^2 / sigma_e^2 is least: one is computed
// from the other in turn, which ends where sum of n_e ln sigma_e is least [Seber, Wild 1989, 11.2].
// A study does so from stage to stage: in the first all experiments count alike, in every other one
// sigma_e is that of the best point of the stage before, and the last stage is run once more
// (study_stages.h). So a fit that is resumed has the same weights to the last bit: they follow from
// its journal.
//
// What the model cannot follow counts as noise. Intervals take sigma_e as the ratios they are, and
// the common spread from the fit.
#pragma once

#include <string>

#include "correlation/study/study.h"
#include "measurement/channels.h"

namespace latsch::correlation {

/// Whether a fitted experiment's noise is to be estimated; then that of all is.
bool estimates_noise(const Study& study);

/// By the recording at a best point; nullptr: not known yet, all experiments count alike.
void estimate_noise(Study& study, const Channels* at);

/// What a stage knows of it.
void take_noise(const Study& stage, Study& study);

/// "Fy 3.1 %, Mz 12 %"; empty where it is not known.
std::string noise_in_words(const Study& study);

}  // namespace latsch::correlation
