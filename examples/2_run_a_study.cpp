// SPDX-License-Identifier: Apache-2.0
// Example 2. Reads a study file and fits it inside this process: the trials run on threads, the journal keeps every outcome,
// and a second start goes on from the journal.
//
//   target_link_libraries(run PRIVATE latsch::correlation)
//
//   $ 2_run_a_study studies/compliance/study.toml /tmp/study.latsch
//   The search ended at a minimum
//   top = 8200 N/mm
//
// `latsch run` does the same with worker processes, which survive a model that crashes or hangs.
#include <latsch/base/units.h>
#include <latsch/correlation/search/stage_runs.h>
#include <latsch/correlation/target/study_trials.h>
#include <latsch/evaluation/executors/thread_executor.h>
#include <latsch/experiment/language.h>

#include <cstdio>
#include <exception>

using namespace latsch;

int main(int argc, char** argv) try {
  if (argc != 3) {
    std::fprintf(stderr, "usage: 2_run_a_study STUDY.toml JOURNAL.latsch\n");
    return 2;
  }
  correlation::Study study = correlation::read_study(argv[1], experiment::language());
  study.run.journal = argv[2];
  std::optional<Journal> journal;
  const auto fit_stage = [&](const correlation::StageRun& stage) {
    journal.reset();
    journal.emplace(Journal::open(stage.study.run.journal, correlation::identity(stage.study)));
    ThreadExecutor executor([&] { return correlation::evaluator(stage.study); }, 2);
    return correlation::StageResult{correlation::fit(stage.study, executor, *journal, {}),
                                    &*journal};
  };
  const correlation::StagesRun found = correlation::run_stages(study, fit_stage);
  const Step* best = found.has_ended ? found.fits.back().run.best() : nullptr;
  if (!best) {
    std::fprintf(stderr, "no trial succeeded\n");
    return 1;
  }
  std::printf("The search ended %s\n", found.fits.back().run.ending.c_str());
  for (int i = 0; i < study.space.size(); ++i) {
    const DesignVariable& variable = study.space[i];
    std::printf(
        "%s = %s\n",
        variable.name.c_str(),
        format_quantity(best->point.values[static_cast<std::size_t>(i)], variable.unit, 4).c_str());
  }
  return 0;
} catch (const std::exception& error) {  // the message names file, line and the expected value
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
