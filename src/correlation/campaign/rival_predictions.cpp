// SPDX-License-Identifier: Apache-2.0
#include "correlation/campaign/rival_predictions.h"

#include <limits>

#include "correlation/campaign/campaign_places.h"
#include "optimization/problem/point_vector.h"

namespace latsch::correlation {

RivalPredictions::RivalPredictions(const CampaignPlan& plan, const CampaignPlaces& places)
    : plan_(plan), places_(places) {
  const CampaignStart& start = *plan.rival_start;
  const Eigen::VectorXd u = to_vector(plan.rival->space.to_unit(start.point));
  problem_.settings = static_cast<int>(plan.study.campaign->settings.size());
  problem_.truth = [this](const Eigen::VectorXd& s) { return places_.values(s); };
  problem_.rival = [this](const Eigen::VectorXd& s, const Eigen::VectorXd& v) {
    return predict(s, v);
  };
  problem_.admits = [this](const Eigen::VectorXd& s) { return places_.admits(s); };
  problem_.start = u(start.free);
  problem_.present = present_information(start);
  problem_.finest = 1e-3;
}

Eigen::VectorXd RivalPredictions::predict(const Eigen::VectorXd& place,
                                          const Eigen::VectorXd& v) const {
  const Study& rival = *plan_.rival;
  const CampaignSettings& campaign = *plan_.study.campaign;
  const std::vector<int>& channels = places_.channels(place);
  // A rival that fails says nothing that could be compared.
  const Eigen::VectorXd nothing = places_.values(place);
  try {
    if (!specimen_ || last_ != v) {
      std::vector<double> u = rival.space.to_unit(plan_.rival_start->point);
      for (std::size_t k = 0; k < plan_.rival_start->free.size(); ++k)
        u[static_cast<std::size_t>(plan_.rival_start->free[k])] = v[static_cast<Eigen::Index>(k)];
      specimen_ = rival.specimens->at(rival, rival.space.from_unit(u), std::move(specimen_));
      last_ = v;
    }
    experiment::MovableTest moved = *campaign.movable;
    const std::vector<double> values = campaign.values_at({place.begin(), place.end()});
    for (std::size_t k = 0; k < values.size(); ++k) moved.set(campaign.settings[k].path, values[k]);
    const auto recording = moved.test()->run(*specimen_);
    if (!recording) return nothing;
    std::vector<double> z;
    for (std::size_t c = 0; c < campaign.measures.size(); ++c) {
      const Channel* channel = recording->find(campaign.measures[c]);
      if (!channel) return nothing;
      for (const double value : channel->values) z.push_back(value / places_.deviations()[c]);
    }
    if (z.size() != channels.size()) return nothing;
    return to_vector(z);
  } catch (const InputError&) {
    return nothing;
  }
}

}  // namespace latsch::correlation
