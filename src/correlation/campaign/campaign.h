// SPDX-License-Identifier: Apache-2.0
// The next tests of a study: applies continuous_design.h and model_discrimination.h to its
// variables, the settings of a test and the limits of a rig.
//
// Settings are chosen by the slopes at the fit or, if samples of the posterior density are there,
// by the mean of the criterion over 50 of them. Then they are rounded to a hundredth of their
// ranges, and values nearer than 2 % of a range become one; dear settings take the values of other
// tests if that costs little. Tests are put into the order with the fewest changes of these.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "correlation/campaign/campaign_start.h"
#include "correlation/campaign/test_slopes.h"
#include "correlation/study/study.h"

namespace latsch::correlation {

/// Number of draws of the posterior density over which the criterion is averaged.
constexpr int kCampaignDraws = 50;

/// One test of a campaign.
struct CampaignTest {
  std::vector<double> values;  // settings, SI
  int rank = 1;                // place in the order of gain, from 1
  int replicate_of = -1;       // index of an equal test before it; -1: none
};

/// Knowledge after the first tests of the campaign.
struct CampaignStanding {
  int tests = 0;
  Eigen::VectorXd deviations;  // standard deviations of the free variables, in ranges
  double T = 0.0;              // sum of squares that the rival cannot fit; 0 without a rival
};

/// The grid that a person would run, as far as the limits admit it.
struct CampaignGrid {
  std::vector<int> levels;  // number of levels of each setting
  int points = 0;           // admitted points; 0: none
  /// Mean over the variables of the deviation after the campaign over that after equally many tests
  /// of the grid.
  double interval_ratio = 1.0;
  /// Criterion after the grid over that after the campaign, or T of the campaign over that of the
  /// grid: above 1 the campaign is better.
  double criterion_ratio = 1.0;
};

struct Campaign {
  std::vector<CampaignTest> tests;          // in the order of the campaign
  std::vector<CampaignStanding> standings;  // none, then 4, 8, .. all
  std::vector<int> changes;                 // number of changes of each setting, in this order
  std::vector<int> changes_by_rank;         // number of changes in the order of gain
  CampaignGrid grid;
  double rounding = 1.0;        // criterion with rounded settings over that before
  int draws = 0;                // draws of the posterior density; 0: the fit alone
  int ends = 0, ends_kept = 0;  // ends of intervals looked at, and where the first three stay
  std::string why_no_ends;      // why no ends were looked at; empty: they were
  std::vector<std::string> untouched;  // directions that nothing determines but the bounds
  std::vector<std::string> idle;       // settings that change nothing that is measured
  int failed = 0;                      // places at which the model failed
  std::string first_failure;
  std::vector<double> largest;     // largest value of each channel, SI; 0 if no noise is a share
  std::vector<double> deviations;  // noise of each measured channel, SI
};

/// Everything from which a campaign is planned.
struct CampaignPlan {
  const Study& study;
  CampaignStart start;
  std::unique_ptr<TestSlopes> slopes;  // at the point of the start, then at its draws
  bool computes_slopes = true;         // false: slopes are kriged
  /// Study of the rival model, at its best point; nullptr: none.
  const Study* rival = nullptr;
  std::optional<CampaignStart> rival_start = {};
};

/// Chooses `count` tests. Returns a Failure that says why none can be chosen.
Result<Campaign> plan_campaign(const CampaignPlan& plan, int count);

/// Returns a reason why the rival cannot run the test; empty if it can.
std::string why_no_rival(const Study& study,
                         const Study& rival,
                         const experiment::Language& language);

}  // namespace latsch::correlation
