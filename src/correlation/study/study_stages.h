// SPDX-License-Identifier: Apache-2.0
// A fit in stages: the result of one stage starts the next, on a finer mesh, in tighter bounds, or
// by another method.
//
// The result of the study is that of the last stage, with the experiments that it fits and the
// variables that it frees; the intervals also hold the other variables constant. Terminal, page and
// JSON name every experiment whose error is then more than a twentieth worse than after an earlier
// stage. To preserve what earlier stages reached, an experiment can have noise = "own_stage": it is
// then weighted by the error that its own stage left.
//
// The last stage uses the study's own model, so the result belongs to that model. A coarse mesh
// shifts weakly determined variables by more than a tight bound allows: `bounds` should then be
// wide, or omitted. A stage with changed parameters is another model and has a separate journal,
// STUDY.NAME.latsch; the other stages share that of the study. Every stage can be interrupted and
// resumed like a fit without stages: earlier results are read from the journals. [Hempel, Oertel,
// KGK 04/2016: cascades with tightened bounds]
//
// In a study with noise = "estimated" (target/estimated_noise.h), the last stage is repeated as
// NAME_anew. A study without stages gets the stages "alike", "weighted" and "weighted_anew". The
// keys are in correlation/study/keys/stage_keys.cpp.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/document.h"
#include "correlation/study/study.h"

namespace latsch::correlation {

/// Reads all tables [stage.NAME] of a study that is otherwise complete. Throws InputError.
std::vector<StageSettings> read_stages(const Node& root, const Document& text, const Study& study);

/// Reads changed parameters of the model, the keys below `model` in a table, by path, SI; empty if
/// there is no such key. Throws InputError, also if the changed parameters make no valid model or
/// are variables of the study.
std::vector<std::pair<std::string, double>> read_changed_numbers(const Node& table,
                                                                 const Document& text,
                                                                 const Study& study);

/// Returns the study with the model, optimizer and journal of a stage. From the second stage on,
/// its bounds lie around the best point of the stage before, if that is known.
Study stage(const Study& study, int k, const std::optional<DesignPoint>& best_before = {});

/// Returns all stages of a study, each with the bounds of the study; for a study without stages,
/// the study itself.
std::vector<Study> stages_of(const Study& study);

/// Returns the stage of the given name, for a worker. Throws InputError if there is none.
Study stage_called(const Study& study, const std::string& name);

/// Returns a stage in words: "coarse: mesh.sectors = 30" or "fine: bounds 0.25 as wide".
std::string in_words(const StageSettings& stage);

}  // namespace latsch::correlation
