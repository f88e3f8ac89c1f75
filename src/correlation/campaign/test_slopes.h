// SPDX-License-Identifier: Apache-2.0
// Values of a test at any settings, and their derivatives by the variables of a study.
//
// A quick model that computes its slopes is asked at every setting. For another one, or with `runs`
// in the study, trials at a few settings are made and their slopes are kriged over the settings
// (field_kriging.h): one trial at the fit and one beside it for each variable, in each of which the
// model runs all these tests. They are stored in STUDY.design.latsch, a cache from which the same
// command continues.
#pragma once

#include <Eigen/Core>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "correlation/study/study.h"
#include "evaluation/schedule/run_options.h"
#include "optimization/surrogate/field_kriging.h"

namespace latsch::correlation {

/// Values of the measured channels of a test, SI, channel by channel, and their slopes.
struct TestValues {
  Eigen::VectorXd y;         // m values at the first point
  Eigen::MatrixXd J;         // m x (n points): by the n variables of the unit cube, for each point
  std::vector<int> channel;  // index of the channel of each value, in CampaignSettings::measures
};

class TestSlopes {
 public:
  virtual ~TestSlopes() = default;
  /// Returns the values at settings, SI; a Failure if the model fails there.
  virtual Result<TestValues> at(const std::vector<double>& settings) const = 0;
};

/// Returns a sentence on why the model computes no slopes of the measured channels; empty if it
/// does.
std::string why_no_test_slopes(const Study& study);

/// True if the model takes so long for a test that its slopes are interpolated between few
/// settings unless the study states otherwise.
bool takes_long(const Study& study);

/// Returns slopes that the model computes at each of these points. Throws InputError if the model
/// accepts a point not.
std::unique_ptr<TestSlopes> computed_slopes(const Study& study,
                                            const std::vector<DesignPoint>& points);

/// Slopes that were kriged over settings.
struct KrigedSlopes {
  std::unique_ptr<TestSlopes> slopes;
  int runs = 0;                      // settings at which the model ran
  long trials = 0;                   // trials
  double least_values = 1.0;         // least Q^2 of a value
  std::vector<double> least_slopes;  // least Q^2 of a slope by each variable
};

/// Runs the trials and interpolates. `lengths` are those of the differences by each variable in the
/// unit cube, if the model computes no slopes. Returns nullopt if a stop was requested, a Failure
/// if a trial failed.
std::optional<Result<KrigedSlopes>> kriged_slopes(const Study& study,
                                                  const DesignPoint& point,
                                                  const Eigen::VectorXd& lengths,
                                                  const RunOptions& options);

}  // namespace latsch::correlation
