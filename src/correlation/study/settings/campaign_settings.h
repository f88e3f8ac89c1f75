// SPDX-License-Identifier: Apache-2.0
// The table [design] of a study: which test a laboratory could make next, over which settings, and
// what it is for; for `latsch design`.
//
// The keys are in correlation/study/keys/campaign_keys.cpp.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "base/document.h"
#include "correlation/laboratory/measurement_noise.h"
#include "correlation/study/settings/rig_limit.h"
#include "experiment/movable_test.h"

namespace latsch::correlation {

struct Study;

/// Largest number of tests of a campaign.
constexpr int kMostCampaignTests = 200;
constexpr int kMostCampaignSettings = 8;

/// A number of the test that the laboratory can set.
struct CampaignSetting {
  std::string name;                 // name in the study
  std::string path;                 // path of the number in the test
  double lower = 0.0, upper = 1.0;  // SI
  std::string unit = "1";           // unit in which people write it
  double cost = 0.0;                // cost of a change, in tests
  int grid = 3;                     // levels in the grid that a person would run

  /// Returns the value, SI, at a place from 0 to 1, and the place of a value.
  double at(double place) const { return lower + place * (upper - lower); }
  double place(double value) const { return (value - lower) / (upper - lower); }
};

enum class CampaignAim {
  volume,       // D: volume of the confidence ellipsoid
  mean,         // A: mean variance of the variables, in ranges
  prediction,   // I: mean variance of the values of an experiment
  distinction,  // T: sum of squares that a rival model cannot fit
  variable,     // c: variance of one variable
};

/// Returns the name of the aim in words: "the volume of the confidence region (D)".
std::string in_words(CampaignAim aim);

struct CampaignSettings {
  std::string test;                                        // name of the test
  std::shared_ptr<const experiment::MovableTest> movable;  // the test with its numbers
  std::vector<CampaignSetting> settings;                   // in the order of the study
  std::vector<RigLimit> limits;                            // all hold
  std::vector<std::string> measures;                       // channels of the test
  std::map<std::string, MeasurementNoise> noise;           // stated, by channel
  CampaignAim aim = CampaignAim::volume;                   // number that becomes least
  std::string of;                                          // experiment (I) or variable (c)
  std::filesystem::path against;                           // study of the rival model (T)
  bool has_costs = false;                                  // false: no setting is dear
  int count = 12;                                          // number of tests
  int runs = 0;  // settings at which slopes are computed and kriged; 0: at every setting asked for

  /// Returns the settings, SI, at places from 0 to 1.
  std::vector<double> values_at(const std::vector<double>& places) const;
  /// True if the settings, SI, fulfill all limits.
  bool admits(const std::vector<double>& values) const;
};

/// Reads [design] of a study whose tests and experiments have been read. `root` is the root of the
/// study. Throws InputError.
CampaignSettings read_campaign(const Node& table,
                               const Node& root,
                               const Study& study,
                               const experiment::Language& language);

}  // namespace latsch::correlation
