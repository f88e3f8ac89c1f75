// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/key_section.h"

namespace latsch::correlation {

const experiment::KeySection& model_keys() {
  static const experiment::KeySection section = {
      .heading = "model, [model]",
      .below = "model",
      .about = R"md(
Model of a study, whose file holds the varied numbers. `model = "tire.toml"` names the file: it
says what it is, and a .tir is a Magic Formula. The table `[model]` serves a file that can be
read as several kinds. In place of a model there may be a `[simulator]`, an outside program.
)md",
      .sentences =
          {
              {"kind",
               "Kind of model as which the file is read, such as rigid_ring, ring_tire, "
               "magic_formula or fe_tire."},
              {"file", "File beside the study."},
          },
      .samples =
          {
              R"toml([model]
kind = "rigid_ring"
file = "model.toml"
)toml",
          },
  };
  return section;
}

}  // namespace latsch::correlation
