// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/rig_slopes.h"

#include <algorithm>
#include <cassert>

namespace latsch::experiment {

std::string SlopesBy::unit_of(const std::string& moved) const {
  if (moved == unit) return "1";
  if (unit == "N m" && moved == "m") return "1/N";
  if (unit == "N m" && moved == "N") return "1/m";
  return moved + "/" + (unit == "N m" ? "(N m)" : unit);
}

Eigen::VectorXd SlopesBy::weights(const std::vector<double>& x) const {
  const Eigen::Map<const Eigen::VectorXd> load(x.data(), static_cast<Eigen::Index>(x.size()));
  const Eigen::VectorXd inside =
      (load.array() >= from && load.array() <= to).cast<double>().matrix();
  if (inside.sum() < 2.0) return {};
  const Eigen::VectorXd from_mean =
      inside.cwiseProduct((load.array() - load.dot(inside) / inside.sum()).matrix());
  const double square = from_mean.squaredNorm();
  if (!(square > 1e-12 * load.squaredNorm())) return {};
  return from_mean / square;
}

void add_slopes(const SlopesBy& slopes, const std::vector<std::string>& moved, Channels& channels) {
  const Eigen::VectorXd w = slopes.weights(channels[slopes.by]);
  assert(w.size() > 0);
  const auto states = w.size();
  for (const std::string& name : moved) {
    const Channel& of = *channels.find(name);
    Channel slope{slopes.name(name), slopes.unit_of(of.unit), {}, {}};
    slope.values = {w.dot(Eigen::Map<const Eigen::VectorXd>(of.values.data(), states))};
    for (auto k = std::size_t{0}; k < of.slopes.size(); k += of.values.size())
      slope.slopes.push_back(w.dot(Eigen::Map<const Eigen::VectorXd>(&of.slopes[k], states)));
    channels.add(std::move(slope));
  }
}

Channels with_slopes_of(const std::vector<std::string>& asked, const Channels& channels) {
  Channels told;
  for (Channel channel : channels.all()) {
    if (std::find(asked.begin(), asked.end(), channel.name) == asked.end()) channel.slopes.clear();
    told.add(std::move(channel));
  }
  return told;
}

}  // namespace latsch::experiment
