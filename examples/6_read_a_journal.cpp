// SPDX-License-Identifier: Apache-2.0
// Example 6. Reads the journal of a study, also while a run writes it, and prints a table of its trials: the variables of each in
// SI units and the target, or the reason of the failure.
//
//   target_link_libraries(read PRIVATE latsch::correlation)
//
//   $ 6_read_a_journal studies/compliance/study.toml /tmp/study.latsch | head -3
//
// Targets are computed from the kept channels, so the study may have other weights now than when it ran.
#include <latsch/correlation/study/study.h>
#include <latsch/correlation/target/study_trials.h>
#include <latsch/evaluation/journal/journal.h>
#include <latsch/experiment/language.h>

#include <cstdio>
#include <exception>

using namespace latsch;

int main(int argc, char** argv) try {
  if (argc != 3) {
    std::fprintf(stderr, "usage: 6_read_a_journal STUDY.toml JOURNAL.latsch\n");
    return 2;
  }
  const correlation::Study study = correlation::read_study(argv[1], experiment::language());
  // The journal throws if the model or the tests of the study have changed since its trials were
  // run.
  const Journal journal = Journal::read(argv[2], correlation::identity(study));
  const Objective objective = correlation::objective(study);
  for (const DesignVariable& variable : study.space.variables())
    std::printf("%s,", variable.name.c_str());
  std::printf("target\n");
  journal.for_each([&](const Trial& trial) {
    for (const double value : trial.point.values) std::printf("%.9g,", value);
    if (!trial.outcome.result) {
      std::printf("failed: %s\n", trial.outcome.result.failure().reason.c_str());
      return;
    }
    const Result<Score> score = objective(trial.point, *trial.outcome.result);
    score ? std::printf("%.9g\n", score->value)
          : std::printf("not compared: %s\n", score.failure().reason.c_str());
  });
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
