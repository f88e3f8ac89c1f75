// SPDX-License-Identifier: Apache-2.0
// Coefficients of a Magic Formula from measured slip sweeps, stage by stage, each with its
// interval.
//
//   r_i = (y_i^mea - y(Fz_i, kappa_i, alpha_i, gamma_i, p_i)) / (rms(y^mea) sqrt N)
//
// so that |r| is the relative RMS error of the stage's channel. A stage frees some coefficients and
// keeps the others: the curve of one camber and pressure first, then what camber and pressure
// change in it, then all together. Every stage is a residual trust region with the derivatives of
// the formula (by central differences in the unit cube: 10^-7 s a state); the intervals are those
// of the least-squares fit (confidence.h).
//
// Limits: samples are taken to be independent and in steady state. A sweep of some degrees a second
// lags by its relaxation length, which shows as a loop that no coefficient closes.
#pragma once

#include <string>
#include <vector>

#include "models/magic_formula/magic_formula.h"
#include "optimization/identifiability/confidence.h"
#include "optimization/problem/design_space.h"

namespace latsch::correlation {

struct SlipRecord {
  std::vector<magic_formula::State> states;
  std::vector<double> Fy, Mz;  // N, N m; ISO-W, one a state
};

enum class SlipChannel { Fy, Mz };

struct SlipFitStage {
  std::string name;
  SlipChannel channel = SlipChannel::Fy;
  std::vector<std::string> coefficients;     // "PCY1"
  bool upright_at_nominal_pressure = false;  // of the samples, only these
};

/// The stages of a run with free rolling sweeps at several loads, camber angles and pressures.
std::vector<SlipFitStage> cornering_stages();

struct SlipFit {
  magic_formula::Parameters parameters;
  double error = 0.0;  // relative RMS of the channel over the samples of the stage
  int evaluations = 0;
  std::vector<DesignVariable> variables;  // with the values found as initial ones
  Confidence confidence;                  // in the unit cube of the variables
  /// Half the width of the interval of variable i, in its own unit; infinite where nothing holds
  /// it.
  double half_width(int i) const;
};

/// Throws InputError for a coefficient that has no range here.
SlipFit fit(const magic_formula::Parameters& start,
            const SlipRecord& record,
            const SlipFitStage& stage);

/// rms(measured - computed) / rms(measured) over the whole record.
double relative_error(const magic_formula::Parameters& tire,
                      const SlipRecord& record,
                      SlipChannel channel);

}  // namespace latsch::correlation
