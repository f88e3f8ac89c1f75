// SPDX-License-Identifier: Apache-2.0
// A study contains everything that is needed to repeat a correlation: a model, its variables, the
// experiments with their measurements, and the optimizer. The keys are in
// correlation/study/keys/study_keys.cpp.
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
#include "correlation/study/settings/campaign_settings.h"
#include "correlation/study/settings/posterior_settings.h"
#include "correlation/study/settings/selection_settings.h"
#include "correlation/study/specimens.h"
#include "correlation/study/study_design.h"
#include "correlation/study/study_experiment.h"
#include "correlation/study/study_optimizer.h"
#include "evaluation/journal/journal.h"
#include "optimization/problem/design_space.h"

namespace latsch::correlation {

/// Settings for the start of a search; see study_start.h.
struct StartSettings {
  /// Start points: the initial values of the study, the best trial of a journal, or the minima of
  /// the study's design of experiments.
  enum class From { values, journal, basins };
  From from = From::values;  // start of the search
  /// number of minima of the design from which searches start, beginning with the lowest
  int starts = 1;
  std::filesystem::path journal = {};  // another journal to start from; empty: the study's own
};

/// A table [stage.NAME]; see study_stages.h.
struct StageSettings {
  std::string name;             // NAME of the table
  OptimizerSettings optimizer;  // method and its options in this stage
  long max_steps = 1000;        // number of steps after which the stage ends
  StartSettings start = {};     // start of the stage's search
  /// width of the bounds in this stage over their width in the study
  double bounds = 1.0;
  /// changed parameters of the model: path and value, SI
  std::vector<std::pair<std::string, double>> numbers = {};
  /// Indices of the variables that are free; empty: all.
  std::vector<int> free = {};
  std::vector<std::string> experiments = {};  // names of the fitted experiments; empty: all
};

/// The table [refined] of a study; see refinement.h.
struct Refinement {
  /// changed parameters of the model: path and value, SI
  std::vector<std::pair<std::string, double>> numbers;
  std::vector<StudyTest> tests = {};                // tests that replace those with the same names
  std::shared_ptr<const Specimens> specimens = {};  // set for an outside program
};

/// Largest max_steps that a study may state.
constexpr long kMostSteps = 1'000'000;

/// A study file with everything that it names, ready to run. All numbers are in SI.
struct Study {
  std::filesystem::path file;        // the study file
  std::string title;                 // for people
  std::filesystem::path model_file;  // empty: the study has an outside program in place of a model
  /// content of the model's file; at(model, space, point) inserts the values of the variables
  Document model;
  DesignSpace space;                         // the variables with their bounds and initial values
  std::vector<StudyExperiment> experiments;  // in the order of the file
  OptimizerSettings optimizer;               // method and its options
  long max_steps = 1000;                     // number of steps after which the search ends
  std::optional<StudyDesign> doe;            // design of experiments; none without [doe]
  RunSettings run;  // workers, time limits and journal; they do not change results
  /// create specimens from `model` or an outside program
  std::shared_ptr<const Specimens> specimens = {};
  std::vector<StudyTest> tests = {};  // the study's own tests and those stated in experiments
  /// Constraints on channels; linear constraints belong to `space`.
  std::vector<ChannelConstraint> constraints = {};

  Laboratory laboratory = {};        // every [measurement.NAME], for their ledgers
  StartSettings start = {};          // start of the search
  PosteriorSettings posterior = {};  // for latsch sample
  /// for latsch select; nullopt: the study does not state it
  std::optional<SelectionSettings> selection = {};
  /// for latsch design; nullopt: the study does not state it
  std::optional<CampaignSettings> campaign = {};
  std::vector<StageSettings> stages = {};     // empty: one run, as [optimizer] says
  std::optional<Refinement> refinement = {};  // none without [refined]
  std::string stage = {};                     // name of the stage that this study is; empty: none
  /// Indices of the variables that are free in this stage; empty: all.
  std::vector<int> free = {};
  /// values of the variables that this stage holds constant, if known
  std::optional<DesignPoint> held_at = {};
  bool asks_slopes = false;  // true if trials must record slopes: study_slopes.h
  /// Text of everything on which a search depends, for the marks in the journal.
  std::string search_key = {};
  /// The part of search_key on which the targets of trials and the choice of the best trial depend.
  std::string target_key = {};
};

/// Returns the tests that fitted experiments and constraints need.
std::vector<std::string> tests_asked_for(const Study& study);

/// Reads a study, its model and its measurements. Throws InputError naming file, line, found and
/// expected. With Measurements::not_yet, measurement files need not exist, so that they can be
/// written from the model.
Study read_study(const std::filesystem::path& file,
                 const experiment::Language& language,
                 Measurements measurements = Measurements::required);

/// Returns the identity of everything on which the channels of a trial depend, for the journal:
/// model, varied paths, load cases. Objectives are not part of it, because they can be changed and
/// recomputed from the stored channels.
StudyIdentity identity(const Study& study);

}  // namespace latsch::correlation
