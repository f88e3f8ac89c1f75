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

experiment::Specimen& RivalPredictions::specimen_at(const Eigen::VectorXd& v) const {
  // A search asks at one v and beside it by every variable, at hundreds of settings.
  constexpr std::size_t kMostRecent = 64;
  for (const Recent& one : recent_)
    if (one.v == v) return *one.specimen;
  const Study& rival = *plan_.rival;
  std::vector<double> u = rival.space.to_unit(plan_.rival_start->point);
  for (std::size_t k = 0; k < plan_.rival_start->free.size(); ++k)
    u[static_cast<std::size_t>(plan_.rival_start->free[k])] = v[static_cast<Eigen::Index>(k)];
  Recent made{v, rival.specimens->at(rival, rival.space.from_unit(u))};
  if (recent_.size() < kMostRecent) {
    recent_.push_back(std::move(made));
    return *recent_.back().specimen;
  }
  next_ = (next_ + 1) % kMostRecent;
  recent_[next_] = std::move(made);
  return *recent_[next_].specimen;
}

Eigen::VectorXd RivalPredictions::predict(const Eigen::VectorXd& place,
                                          const Eigen::VectorXd& v) const {
  const CampaignSettings& campaign = *plan_.study.campaign;
  const std::vector<int>& channels = places_.channels(place);
  // A rival that fails says nothing that could be compared.
  const Eigen::VectorXd nothing = places_.values(place);
  try {
    experiment::MovableTest moved = *campaign.movable;
    const std::vector<double> values = campaign.values_at({place.begin(), place.end()});
    for (std::size_t k = 0; k < values.size(); ++k) moved.set(campaign.settings[k].path, values[k]);
    const auto recording = moved.test()->run(specimen_at(v));
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
