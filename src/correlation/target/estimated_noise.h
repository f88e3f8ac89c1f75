// SPDX-License-Identifier: Apache-2.0
// Noise that is not stated but estimated by the fit, one number for each experiment: noise =
// "estimated".
//
// Values of one experiment have one deviation sigma_e, in units of an error of 100 %. At given
// values of the variables, the likelihood is largest for
//   sigma_e^2 = sum d^2 / n_e,       here over n_e (1 - p/N), for the p variables fitted to all N
// and at given sigma_e it is largest at the least sum of d^2 / sigma_e^2. The two are computed from
// each other in turn until the sum of n_e ln sigma_e is least [Seber, Wild 1989, 11.2]. A study
// does so from stage to stage. In the first stage all experiments count alike; in every later one
// sigma_e is that of the best point of the stage before; and the last stage is run once more
// (study_stages.h). A resumed fit has the same weights to the last bit, because they follow from
// its journal.
//
// noise = "own_stage" takes sigma_e from the stage that left experiment e the least error instead
// (search/own_stages.h). A last stage in which all experiments count then gains nothing by spoiling
// one of them: an error that grows by the factor q adds n_e (q^2 - 1) to the sum of squares. An
// experiment that counted in no earlier stage gets the error at the end of the stage before.
//
// Model errors count as noise. Intervals use the ratios of the sigma_e and estimate the common
// spread from the fit.
#pragma once

#include <string>

#include "correlation/study/study.h"
#include "measurement/channels.h"

namespace latsch::correlation {

/// True if the noise of any fitted experiment is estimated; the noise of all experiments is then
/// estimated.
bool estimates_noise(const Study& study);

/// True if the noise is the error that an earlier stage left in each experiment.
bool has_noise_of_own_stages(const Study& study);

/// Returns the root mean square of the differences of an experiment, 1 for an error of 100 %.
/// Throws InputError if the recording leaves nothing to compare.
double rms_error(const StudyExperiment& experiment,
                 const std::vector<StudyExperiment>& experiments,
                 const Channels& at);

/// Sets the noise from the recording at a best point; nullptr: not known yet, so all experiments
/// count alike. `own_stages` holds the least rms_error() of each experiment, infinite if no stage
/// left one.
void estimate_noise(Study& study, const Channels* at, const std::vector<double>& own_stages = {});

/// Copies the noise from a stage to the study.
void take_noise(const Study& stage, Study& study);

/// Copies the noise, the fitted experiments and the free variables from a stage to the study,
/// because the result of a study is that of its last stage.
void take_stage(const Study& stage, Study& study);

/// Returns for example "Fy 3.1 %, Mz 12 %"; empty if the noise is not known.
std::string noise_in_words(const Study& study);

}  // namespace latsch::correlation
