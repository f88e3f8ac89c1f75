// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/key_section.h"

namespace latsch::correlation {

const experiment::KeySection& posterior_keys() {
  static const experiment::KeySection section = {
      .heading = "[posterior]",
      .below = "posterior",
      .about = R"md(
Samples of the variables' posterior density, which `latsch sample` draws around a finished fit. A surrogate of all residuals learns from
the journal and from a few further trials; ten more check it. Where the check refuses it, chains on the model itself take several thousand
trials: `method = "delayed"`, or `"model"` for a model that answers in milliseconds. See [posterior.md](posterior.md).
)md",
      .sentences =
          {
              {"samples",
               "Number of samples that are kept. The chains run until their diagnostics are good, "
               "however many are kept."},
              {"method",
               "\"surrogate\": samples of a surrogate that ten trials check. \"delayed\": the "
               "surrogate proposes and the model decides, so that the samples are those of the "
               "model. \"model\": the model decides on moves without a surrogate."},
              {"chain_runs",
               "Most trials of the chains on the model, beyond `runs`.",
               "4000 for \"delayed\", 40000 for \"model\""},
              {"runs",
               "Most trials beyond the fit, the ten of the check included. 0: the surrogate "
               "knows the trials of the fit alone and is not checked.",
               "",
               "0, or 22 to 1000"},
              {"seed", "Number that selects the random numbers."},
          },
      .samples =
          {
              R"toml([posterior]
samples = 2000
runs = 50
seed = 0
)toml",
              R"toml([posterior]
runs = 0
)toml",
              R"toml([posterior]
method = "delayed"
chain_runs = 4000
)toml",
          },
  };
  return section;
}

}  // namespace latsch::correlation
