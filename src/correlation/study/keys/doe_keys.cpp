// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/key_section.h"

namespace latsch::correlation {

const experiment::KeySection& doe_keys() {
  static const experiment::KeySection section = {
      .heading = "[doe]",
      .below = "doe",
      .about = R"md(
The design of experiments of a study: the points that `latsch doe` evaluates before a fit.
)md",
      .sentences =
          {
              {"design",
               "\"full_factorial\" is a grid, which shows the target as a surface, for up to three "
               "variables. \"latin_hypercube\" spreads few points well; \"sobol\" can be enlarged "
               "later. \"morris\" shows which variables matter, by points / (variables + 1) "
               "trajectories."},
              {"levels", "Number of values of every variable in a grid."},
              {"levels_of",
               "Table of numbers of values of single variables: `levels_of = {belt = 1}`."},
              {"levels_of.*",
               "Number of values of this variable; 1: it keeps its initial value.",
               "`levels`"},
              {"points",
               "Number of points of the other designs.",
               "",
               "2 to 100000, of a Latin hypercube fewer"},
              {"seed", "Number that selects the points."},
              {"effects",
               "\"sobol\" computes which share of the variance of the target and of each "
               "experiment "
               "a variable causes, alone (first) and with others (total), from the points of a "
               "Latin hypercube or a Sobol sequence: Sobol's indices. How much of the variance the "
               "points explain is told beside them; below 80 % the shares are not to be trusted. "
               "Needs 20 points at least.",
               "none"},
          },
      .samples =
          {
              R"toml([doe]
design = "full_factorial"
levels = 5
levels_of = {radial = 1}
)toml",
              R"toml([doe]
design = "latin_hypercube"
points = 40
seed = 0
effects = "sobol"
)toml",
              R"toml([doe]
design = "morris"
points = 40
)toml",
          },
  };
  return section;
}

}  // namespace latsch::correlation
