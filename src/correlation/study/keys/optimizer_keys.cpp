// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/key_section.h"
#include "optimization/strategy/method_kinds.h"

namespace latsch::correlation {

const experiment::KeySection& start_keys();
const experiment::KeySection& optimizer_keys();

namespace {

/// Adds the descriptions of keys that only one method has, and for every method a sample of all its
/// keys.
experiment::KeySection with_methods(experiment::KeySection section) {
  for (const MethodKind& kind : method_kinds()) {
    std::string sample = "[optimizer]\nmethod = \"" + std::string(kind.name) + "\"\n";
    for (const MethodKey& key : kind.keys) {
      sample += key.name + " = " + key.example + "\n";
      if (!key.sentence.empty())
        section.sentences.push_back({key.name, key.sentence, key.otherwise, key.range});
    }
    if (kind.read) section.samples.push_back(std::move(sample));
  }
  return section;
}

}  // namespace

const experiment::KeySection& optimizer_keys() {
  static const experiment::KeySection section = with_methods({
      .heading = "[optimizer]",
      .below = "optimizer",
      .about = R"md(
The optimizer of a study.

residual_trust_region, levenberg_marquardt and sqp minimize the sum of the squared relative
errors, whatever exponent the objectives have; the other methods minimize the target itself.
Every method supports linear constraints. gss_nlc and sqp support
constraints on channels. An ensemble supports what all its members
support.

Several methods can run at once and see each other's points:

```toml
[optimizer]
method = "ensemble"
ends_with = "all"

[optimizer.member.wide]       # any name; keys as above, but no other ensemble
method = "genetic"
priority = 1                  # share of the steps

[optimizer.member.fine]
method = "gss"
priority = 2
```
)md",
      .sentences =
          {
              {"method",
               "Method of the search. \"auto\", which is also what a study without `[optimizer]` "
               "gets, is sqp where there are constraints on channels, else levenberg_marquardt "
               "where "
               "trials bring the derivatives of their residuals, else residual_trust_region."},
              {"initial_step",
               "First step, as a share of the range of a variable.",
               "0.1; of levenberg_marquardt 0.5"},
              {"step_tolerance",
               "Step at which a search ends, as a share of the range of a variable.",
               "0.001; of levenberg_marquardt 0.000001"},
              {"batch",
               "Points under way at a time: gss, gss_nlc, residual_trust_region. The search "
               "chooses "
               "them before it knows the outcome of the first, so its steps depend on this number "
               "and never on the number of workers; \"workers\" is refused for that reason. 1 "
               "needs the "
               "fewest trials; the number of workers needs the least time.",
               "1; of gss and gss_nlc 2"},
              {"outstanding", "Former name of batch.", "that of batch"},
              {"max_steps",
               "Outcomes that the optimizer may observe; of `[optimizer]` itself and of stages, "
               "not of members."},
              {"contraction", "Contraction of the step: gss, gss_nlc.", "0.25; of gss_nlc 0.5"},
              {"sufficient_decrease", "Sufficient decrease: gss, gss_nlc."},
              {"global",
               "With \"basins\" the method searches for one minimum after the other, from points "
               "spread over the ranges, until few further basins are expected: "
               "residual_trust_region, levenberg_marquardt. It says which basins it found."},
              {"budget", "Most trials of global = \"basins\", in number of variables + 1."},
              {"seed",
               "Number that selects random points: residual_trust_region, genetic, and global = "
               "\"basins\"."},
              {"ends_with", "ensemble: with \"first\" it ends with the first member that ends."},
              {"member", "ensemble: tables `[optimizer.member.NAME]`, each an optimizer."},
              {"priority", "Share of a member in the steps of an ensemble."},
          },
      .samples =
          {
              R"toml([optimizer]
method = "auto"
max_steps = 1000
step_tolerance = 0.001
initial_step = 0.1
batch = 1
restarts = 4
seed = 1
)toml",
              R"toml([optimizer]
method = "ensemble"
ends_with = "all"
[optimizer.member.wide]
method = "genetic"
priority = 1
population = 40
generations = 50
seed = 1
[optimizer.member.fine]
method = "gss"
priority = 2
)toml",
          },
      .shared = {{"", start_keys}, {"member.*", optimizer_keys}},
      .refused =
          {"workers", "timeout", "memory", "on_failure", "journal", "stragglers", "look_ahead"},
  });
  return section;
}

}  // namespace latsch::correlation
