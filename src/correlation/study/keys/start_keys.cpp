// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/key_section.h"

namespace latsch::correlation {

const experiment::KeySection& optimizer_keys();

const experiment::KeySection& start_keys() {
  static const experiment::KeySection section = {
      .heading = "[optimizer] start: where a search begins",
      .below = "optimizer",
      .about = R"md(
Start point and initial knowledge of a study's search.

With several starts, a run receives no points better than its own start, because it would then
leave its basin. It receives the points nearest to the start, as many as two quadratic models
need.

A journal grows while a search runs, so a mark stores the number of trials at the beginning of
the search. Resuming, and drawing the report, begin with the same trials. The mark belongs to the
study as written, without [run]: a changed study begins anew with all trials. The order in which
trials came does not matter.
)md",
      .sentences =
          {
              {"start",
               "\"values\" starts at the initial values, knowing nothing; \"journal\" at the best "
               "point of all earlier trials, which the method observes; \"basins\" at the lowest "
               "minimum of the study's `[doe]`, whose points the method observes: missing points "
               "are evaluated first."},
              {"starts",
               "Number of minima to begin at, from the lowest to the highest, idle workers with "
               "the next; the best of all is the result."},
              {"start_journal",
               "Another journal of the same model, whose trials are taken over too, with "
               "\"journal\".",
               "none"},
          },
      .samples =
          {
              R"toml([optimizer]
start = "journal"
start_journal = "old.latsch"
starts = 2
)toml",
          },
      .shared = {{"", optimizer_keys}},
  };
  return section;
}

}  // namespace latsch::correlation
