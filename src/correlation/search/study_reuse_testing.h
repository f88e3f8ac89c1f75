// SPDX-License-Identifier: Apache-2.0
// Test support: a study of a Magic Formula, whose measurement is computed by the model itself, run
// and resumed in this process and in a temporary folder.
#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <fstream>
#include <string>

#include "base/scratch_folder_testing.h"
#include "correlation/search/stage_runs.h"
#include "correlation/study/study.h"
#include "correlation/study/study_stages.h"
#include "correlation/target/study_trials.h"
#include "evaluation/executors/inline_executor.h"
#include "evaluation/executors/thread_executor.h"
#include "experiment/kinds/sparse_tir_testing.h"
#include "formats/tables/csv_table.h"

namespace latsch::correlation {

class FittedStudy : public testing::Test {
 protected:
  static inline const std::string kHead = R"(
[model]
kind = "magic_formula"
file = "tire.tir"
[test.steady]
file = "steady.toml"
[variable.grip]
path = "PDY1"
lower = 0.5
upper = 2
initial = 0.7
[variable.stiffness]
path = "PKY1"
lower = -60
upper = -5
initial = -10
[experiment.light]
kind = "curve"
y = "steady/Fy"
measurement = "measured.csv"
)";

  FittedStudy() {
    write("tire.tir", experiment::sparse_tir(experiment::kSideForce));
    std::string states = "Fz [N],alpha [deg]\n", unmeasured = "Fy [N]\n";
    for (int i = -12; i <= 12; ++i) {
      states += std::to_string(3000 + 500 * (i % 3)) + "," + std::to_string(i) + "\n";
      unmeasured += std::to_string(-10 * i) + "\n";
    }
    write("states.csv", states);
    write("steady.toml", "kind = \"steady_states\"\nstates = \"states.csv\"\n");
    write("measured.csv", unmeasured);
    const Study study = read("");
    Channels measured;
    measured.add({"Fy", "N", (*evaluator(study)({{1.3, -22.0}}))["steady/Fy"]});
    write("measured.csv", formats::csv_text(measured));
  }

  void write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
  }
  /// Reads a study made of the head and further text.
  Study read(const std::string& more, const std::string& name = "study.toml") {
    write(name, kHead + more);
    return read_study(folder_ / name, experiment::language());
  }

  /// Runs all stages to their end, or stops after a number of trials, as if the run had been
  /// killed.
  std::vector<Fit> fit_all(const Study& study, int workers = 1, long killed_after = 1'000'000) {
    std::vector<Fit> fits;
    std::optional<Journal> journal;
    const auto run_stage = [&](const StageRun& stage) {
      const Study& part = stage.study;
      journal.reset();
      journal.emplace(Journal::open(part.run.journal, identity(part)));
      RunOptions options{.max_steps = part.max_steps};
      options.stop_patience = 0.0;
      options.stop_requested = [&] { return evaluated_ >= killed_after; };
      const Evaluator model = evaluator(part);
      const Evaluator counted = [&, model](const DesignPoint& point) {
        ++evaluated_;
        return model(point);
      };
      ThreadExecutor executor([&] { return counted; }, workers);
      fits.push_back(fit(part, executor, *journal, options));
      return StageResult{fits.back(), &*journal};
    };
    run_stages(study, run_stage);
    return fits;
  }

  static void expect_same(const std::vector<Fit>& a, const std::vector<Fit>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k) {
      ASSERT_EQ(a[k].run.steps.size(), b[k].run.steps.size());
      for (std::size_t i = 0; i < a[k].run.steps.size(); ++i) {
        EXPECT_EQ(a[k].run.steps[i].point.bits(), b[k].run.steps[i].point.bits()) << k << ", " << i;
      }
    }
  }

  ScratchFolder folder_;
  std::atomic<long> evaluated_ = 0;
};

}  // namespace latsch::correlation
