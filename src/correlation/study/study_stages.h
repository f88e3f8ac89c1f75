// SPDX-License-Identifier: Apache-2.0
// A fit in stages: the result of one starts the next, on a finer mesh, in tighter bounds, by
// another method.
//
//   [stage.coarse]                  # in the order of the file; any name
//   model.mesh.sectors = 30         # numbers of the model, in this stage alone
//   step_tolerance = 0.02           # keys of [optimizer] for this stage; a stage that has none is
//   max_steps = 60                  # run as [optimizer] says
//
//   [stage.curve]
//   free = ["PCY1", "PDY1"]         # the variables that move; the others stay where the stage
//                                   # before has left them
//   experiments = ["upright"]       # those that count in this stage
//
//   [stage.fine]
//   bounds = 0.25                   # width of the bounds over those of the study, around the best
//                                   # point of the stage before; 1: those of the study
//
// The result of the study is that of the last stage, with the experiments that count in it and the
// variables that it frees: intervals, too, leave the other variables where they are. An experiment
// that is then worse by more than a twentieth than an earlier stage had it is named
// in terminal, page and JSON. To keep what earlier stages had, give the experiments noise =
// "own_stage": each counts in units of the error that its own stage left.
//
// The last stage has the model as it is: what is found is found with it. A coarse mesh moves what
// the measurements hardly hold by more than a tight bound allows: choose `bounds` wide then, or
// leave it out. A stage with other numbers
// is another model and has a journal of its own, STUDY.NAME.latsch; the others share that of the
// study. Every stage can be interrupted and resumed as a fit without stages: what went before is
// read from the journals. [Hempel, Oertel, KGK 04/2016: cascades with tightened bounds]
//
// Of a study with noise = "estimated" (target/estimated_noise.h) the last stage is followed by
// itself, NAME_anew; one without stages has "alike", "weighted" and "weighted_anew".
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/document.h"
#include "correlation/study/study.h"

namespace latsch::correlation {

/// Reads every [stage.NAME] of a study that is complete but for them. Throws InputError.
std::vector<StageSettings> read_stages(const Node& root, const Document& text, const Study& study);

/// The numbers below `model` in a table that changes them, by path, SI; none where it has no such
/// key. Throws InputError, also where they make no model or are variables of the study.
std::vector<std::pair<std::string, double>> read_changed_numbers(const Node& table,
                                                                 const Document& text,
                                                                 const Study& study);

/// How many there are; a study without stages is one.
int stage_count(const Study& study);

/// The study as a stage has it: its model, optimizer and journal; from the second one on around the
/// best point of the stage before, where that is known.
Study stage(const Study& study, int k, const std::optional<DesignPoint>& best_before = {});

/// The same by its name, for a worker. Throws InputError where there is none.
Study stage_called(const Study& study, const std::string& name);

/// "coarse: mesh.sectors = 30", "fine: bounds 0.25 as wide"
std::string in_words(const StageSettings& stage);

}  // namespace latsch::correlation
