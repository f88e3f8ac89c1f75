// SPDX-License-Identifier: Apache-2.0
// A study contains everything that reproduces a correlation: a model, its variables, the
// experiments with their measurements, and the optimizer.
//
// The keys are in correlation/study/keys/study_keys.cpp.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/document.h"
#include "correlation/study/channel_constraint.h"
#include "correlation/study/run_settings.h"
#include "correlation/study/specimens.h"
#include "correlation/study/study_design.h"
#include "correlation/study/study_experiment.h"
#include "correlation/study/study_optimizer.h"
#include "evaluation/journal/journal.h"
#include "optimization/problem/design_space.h"

namespace latsch::correlation {

/// Start of a search: study_start.h.
struct StartSettings {
  /// The values of the study, the best trial of a journal, or the minima of the study's design.
  enum class From { values, journal, basins };
  From from = From::values;  // start of the search
  int starts = 1;            // number of minima of the design to begin at, from the lowest
  std::filesystem::path journal = {};  // another journal to start from; empty: the study's own
};

/// One [stage.NAME]: study_stages.h.
struct StageSettings {
  std::string name;             // NAME of the table
  OptimizerSettings optimizer;  // method and its options in this stage
  long max_steps = 1000;        // number of steps after which the stage ends
  StartSettings start = {};     // start of the stage's search
  /// width of the bounds over that of the study's
  double bounds = 1.0;
  std::vector<std::pair<std::string, double>> numbers = {};  // numbers of the model by path, SI
  /// indices of the variables that move; empty: all
  std::vector<int> free = {};
  std::vector<std::string> experiments = {};  // experiments that count; empty: all
};

/// Table [refined]: refinement.h.
struct Refinement {
  std::vector<std::pair<std::string, double>> numbers;  // numbers of the model by path, SI
  std::vector<StudyTest> tests = {};                    // replace the tests with the same names
  std::shared_ptr<const Specimens> specimens = {};      // set for an outside program
};

/// Largest max_steps that a study may state.
constexpr long kMostSteps = 1'000'000;

/// A study file with everything that it names, ready to run. All numbers are in SI.
struct Study {
  std::filesystem::path file;        // the study file
  std::string title;                 // for people
  std::filesystem::path model_file;  // empty: the study has an outside program in place of a model
  Document model;     // file's content; at(model, space, point) inserts the variables
  DesignSpace space;  // the variables with their bounds and initial values
  std::vector<StudyExperiment> experiments;  // in the order of the file
  OptimizerSettings optimizer;               // method and its options
  long max_steps = 1000;                     // number of steps after which the search ends
  std::optional<StudyDesign> doe;            // design of experiments; none without [doe]
  RunSettings run;  // workers, time limits and journal; they do not change results
  std::shared_ptr<const Specimens> specimens = {};  // made from `model` or an outside program
  std::vector<StudyTest> tests = {};                // tests of the study and the experiments' own
  /// on channels; linear constraints belong to the space
  std::vector<ChannelConstraint> constraints = {};

  Laboratory laboratory = {};                 // every [measurement.NAME], for their ledgers
  StartSettings start = {};                   // start of the search
  std::vector<StageSettings> stages = {};     // empty: one run, as [optimizer] says
  std::optional<Refinement> refinement = {};  // none without [refined]
  std::string stage = {};                     // name of the stage that this study is; empty: none
  /// indices of the variables that this stage moves; empty: all
  std::vector<int> free = {};
  std::optional<DesignPoint> held_at = {};  // values of the held variables in this stage, if known
  bool asks_slopes = false;                 // true if trials must record slopes: study_slopes.h
  /// everything a search depends on, for the journal's marks
  std::string search_key = {};
  /// the part of it on which the targets of trials and the choice of the best one depend
  std::string target_key = {};
};

/// Returns the tests that fitted experiments and constraints name.
std::vector<std::string> tests_asked_for(const Study& study);

/// Reads a study, its model and its measurements. Throws InputError naming file, line, found and
/// expected. With Measurements::not_yet, measurement files need not exist, so that they can be
/// written from the model.
Study read_study(const std::filesystem::path& file,
                 const experiment::Language& language,
                 Measurements measurements = Measurements::required);

/// Returns what the channels of a trial depend on, for the journal: model, varied paths, load
/// cases. Objectives are not part of the identity, because they can be changed and recomputed from
/// stored channels.
StudyIdentity identity(const Study& study);

}  // namespace latsch::correlation
