// SPDX-License-Identifier: Apache-2.0
// The predictions of a rival model for the test of a campaign, in units of the noise.
#pragma once

#include <Eigen/Core>

#include "correlation/campaign/campaign.h"
#include "optimization/design/model_discrimination.h"

namespace latsch::correlation {

class CampaignPlaces;

class RivalPredictions {
 public:
  RivalPredictions(const CampaignPlan& plan, const CampaignPlaces& places);
  RivalPredictions(const RivalPredictions&) = delete;
  RivalPredictions& operator=(const RivalPredictions&) = delete;

  const RivalProblem& problem() const { return problem_; }

 private:
  Eigen::VectorXd predict(const Eigen::VectorXd& place, const Eigen::VectorXd& v) const;

  const CampaignPlan& plan_;
  const CampaignPlaces& places_;
  RivalProblem problem_;
  /// The specimen at the last variables, which is asked at many settings.
  mutable Eigen::VectorXd last_;
  mutable std::unique_ptr<experiment::Specimen> specimen_;
};

}  // namespace latsch::correlation
