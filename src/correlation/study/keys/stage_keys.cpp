// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/key_section.h"

namespace latsch::correlation {

const experiment::KeySection& optimizer_keys();

const experiment::KeySection& stage_keys() {
  static const experiment::KeySection section = {
      .heading = "[stage.NAME]: one fit after the other",
      .below = "stage.*",
      .about = R"md(
A fit in stages: the result of one stage starts the next, on a finer mesh, in tighter bounds, or
by another method.

The result of the study is that of the last stage, with the experiments that count in it and the
variables that it frees. The intervals also leave the other variables fixed. Terminal, page and
JSON name every experiment whose error is then more than a twentieth worse than after an earlier
stage. To keep what earlier stages reached, give the experiments noise = "own_stage": each counts
in units of the error that its own stage left.

The last stage uses the study's own model, so the result belongs to that model. A coarse mesh
moves weakly determined variables by more than a tight bound allows: then choose `bounds` wide,
or omit it. A stage with other numbers is another model and has a journal of its own,
STUDY.NAME.latsch; the other stages share that of the study. Every stage can be interrupted and
resumed like a fit without stages: earlier results are read from the journals. [Hempel, Oertel,
KGK 04/2016: cascades with tightened bounds]

In a study with noise = "estimated", the last stage is repeated as
NAME_anew. A study without stages gets the stages "alike", "weighted" and "weighted_anew".

The keys of [optimizer] belong to the stage in which they stand; a stage that has none is run as
[optimizer] says. Stages are run in the order of the file, under any names.
)md",
      .sentences =
          {
              {"model.*", "Numbers of the model, only in this stage: `model.mesh.sectors = 30`."},
              {"free",
               "Variables that move; the others stay where the stage before has left them.",
               "all of them"},
              {"experiments", "Experiments that count in this stage.", "all of them"},
              {"bounds",
               "Width of the bounds over those of the study, around the best point of the stage "
               "before; 1: those of the study."},
              {"max_steps",
               "Outcomes that the optimizer may observe in this stage.",
               "that of `[optimizer]`"},
          },
      .samples =
          {
              R"toml([stage.coarse]
model.belt.nodes = 60
step_tolerance = 0.02
max_steps = 60
[stage.curve]
free = ["radial"]
experiments = ["force"]
[stage.fine]
bounds = 0.25
)toml",
          },
      .shared = {{"", optimizer_keys}},
  };
  return section;
}

}  // namespace latsch::correlation
