// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/key_section.h"

namespace latsch::correlation {

const experiment::KeySection& posterior_keys() {
  static const experiment::KeySection section = {
      .heading = "[posterior]",
      .below = "posterior",
      .about = R"md(
Samples of the variables' posterior density, which `latsch sample` draws around a finished fit. A surrogate of all residuals learns from
the journal and from a few further trials; ten more check it. See [posterior.md](posterior.md).
)md",
      .sentences =
          {
              {"samples",
               "Number of samples that are kept. The chains run until their diagnostics are good, "
               "however many are kept."},
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
          },
  };
  return section;
}

}  // namespace latsch::correlation
