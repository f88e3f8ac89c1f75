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
// noise = "own_stage" takes sigma_e from the stage that left experiment e the least error instead
// (search/own_stages.h), so a last stage in which all experiments count gains nothing by spoiling
// one of them: an error that grows by the factor q adds n_e (q^2 - 1) to the sum of squares. An
// experiment that counted in no earlier stage has the error at the end of the stage before.
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

/// Whether that noise is what an earlier stage left of each experiment.
bool has_noise_of_own_stages(const Study& study);

/// Root mean square of the differences of an experiment, 1 for an error of 100 %. Throws InputError
/// where the recording leaves nothing to compare.
double rms_error(const StudyExperiment& experiment, const Channels& at);

/// By the recording at a best point; nullptr: not known yet, all experiments count alike.
/// `own_stages`: the least rms_error() an experiment each, infinite where no stage left one.
void estimate_noise(Study& study, const Channels* at, const std::vector<double>& own_stages = {});

/// Takes over what a stage knows of the noise.
void take_noise(const Study& stage, Study& study);

/// Takes over the noise, which experiments count, and the variables that move: the result of a
/// study is that of its last stage.
void take_stage(const Study& stage, Study& study);

/// "Fy 3.1 %, Mz 12 %"; empty where it is not known.
std::string noise_in_words(const Study& study);

}  // namespace latsch::correlation
