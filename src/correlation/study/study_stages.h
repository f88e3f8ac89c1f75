// SPDX-License-Identifier: Apache-2.0
// A fit in stages: the result of one stage starts the next, on a finer mesh, in tighter bounds, or
// by another method.
//
// The result of the study is that of the last stage, with the experiments that count in it and the
// variables that it frees. The intervals also leave the other variables fixed. Terminal, page and
// JSON name every experiment whose error is then more than a twentieth worse than after an earlier
// stage. To keep what earlier stages reached, give the experiments noise = "own_stage": each counts
// in units of the error that its own stage left.
//
// The last stage uses the study's own model, so the result belongs to that model. A coarse mesh
// moves weakly determined variables by more than a tight bound allows: then choose `bounds` wide,
// or omit it. A stage with other numbers is another model and has a journal of its own,
// STUDY.NAME.latsch; the other stages share that of the study. Every stage can be interrupted and
// resumed like a fit without stages: earlier results are read from the journals. [Hempel, Oertel,
// KGK 04/2016: cascades with tightened bounds]
//
// In a study with noise = "estimated" (target/estimated_noise.h), the last stage is repeated as
// NAME_anew. A study without stages gets the stages "alike", "weighted" and "weighted_anew".
//
// The keys are in correlation/study/keys/stage_keys.cpp.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/document.h"
#include "correlation/study/study.h"

namespace latsch::correlation {

/// Reads every [stage.NAME] of a study that is otherwise complete. Throws InputError.
std::vector<StageSettings> read_stages(const Node& root, const Document& text, const Study& study);

/// Reads the numbers below `model` in a table that changes them, by path, SI; empty if it has no
/// such key. Throws InputError, also if the numbers make no model or are variables of the study.
std::vector<std::pair<std::string, double>> read_changed_numbers(const Node& table,
                                                                 const Document& text,
                                                                 const Study& study);

/// Returns the study with the model, optimizer and journal of a stage. From the second stage on,
/// its bounds lie around the best point of the stage before, if that is known.
Study stage(const Study& study, int k, const std::optional<DesignPoint>& best_before = {});

/// Returns all stages of a study, with its own bounds; a study without stages is its only one.
std::vector<Study> stages_of(const Study& study);

/// Returns the stage of the given name, for a worker. Throws InputError if there is none.
Study stage_called(const Study& study, const std::string& name);

/// Returns "coarse: mesh.sectors = 30" or "fine: bounds 0.25 as wide".
std::string in_words(const StageSettings& stage);

}  // namespace latsch::correlation
