// SPDX-License-Identifier: Apache-2.0
#include "correlation/observable/mode_pairing.h"

#include <algorithm>
#include <cmath>

#include "correlation/observable/mac.h"
#include "numerics/assignment.h"

namespace latsch::correlation {
namespace {

// Weight of the relative frequency difference in addition to the likeness. It is so small that it
// decides only between equal likenesses.
constexpr double kTieBreak = 0.01;

struct Group {
  int first = 0, count = 0;  // consecutive modes in ascending frequency
};

/// Returns for every mode the group of modes with equal frequency to which it belongs.
std::vector<Group> groups_of(const std::vector<ModeRecord>& modes, double same_frequency) {
  std::vector<Group> group(modes.size());
  for (size_t first = 0, next = 0; first < modes.size(); first = next) {
    next = first + 1;
    while (next < modes.size() && modes[next].frequency - modes[next - 1].frequency <=
                                      same_frequency * modes[next].frequency) {
      ++next;
    }
    for (size_t i = first; i < next; ++i) {
      group[i] = {static_cast<int>(first), static_cast<int>(next - first)};
    }
  }
  return group;
}

Eigen::MatrixXd shapes(const std::vector<ModeRecord>& modes, const Group& group) {
  Eigen::MatrixXd columns(modes[group.first].shape.size(), group.count);
  for (int i = 0; i < group.count; ++i) columns.col(i) = modes[group.first + i].shape;
  return columns;
}

double label_likeness(const ModeRecord& a, const ModeRecord& b) {
  const bool same_n = !a.n || !b.n || *a.n == *b.n;
  const bool same_type = !a.type || !b.type || *a.type == *b.type;
  const bool same_phase = a.phase == ' ' || b.phase == ' ' || a.phase == b.phase;
  return same_n && same_type && same_phase ? 1.0 : 0.0;
}

bool have_shapes(const std::vector<ModeRecord>& modes) {
  return std::all_of(
      modes.begin(), modes.end(), [](const ModeRecord& mode) { return mode.shape.size() > 0; });
}

Eigen::MatrixXd likeness_matrix(const std::vector<ModeRecord>& measured,
                                const std::vector<ModeRecord>& simulated,
                                bool by_shape,
                                double same_frequency) {
  Eigen::MatrixXd likeness(measured.size(), simulated.size());
  const auto measured_group = groups_of(measured, same_frequency);
  const auto simulated_group = groups_of(simulated, same_frequency);
  for (Eigen::Index i = 0; i < likeness.rows(); ++i) {
    for (Eigen::Index j = 0; j < likeness.cols(); ++j) {
      likeness(i, j) =
          by_shape ? mac(shapes(measured, measured_group[i]), shapes(simulated, simulated_group[j]))
                   : label_likeness(measured[i], simulated[j]);
    }
  }
  return likeness;
}

double relative_difference(double measured, double simulated) {
  return std::min(1.0, std::abs(measured - simulated) / measured);
}

std::vector<int> ascending_frequency(const std::vector<ModeRecord>& modes) {
  std::vector<int> order(modes.size());
  for (size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return modes[a].frequency < modes[b].frequency;
  });
  return order;
}

std::vector<ModeRecord> reordered(const std::vector<ModeRecord>& modes,
                                  const std::vector<int>& order) {
  std::vector<ModeRecord> sorted;
  for (int i : order) sorted.push_back(modes[i]);
  return sorted;
}

}  // namespace

ModePairing pair_modes(const std::vector<ModeRecord>& measured_modes,
                       const std::vector<ModeRecord>& simulated_modes,
                       const PairingSettings& settings) {
  const auto measured_order = ascending_frequency(measured_modes);
  const auto simulated_order = ascending_frequency(simulated_modes);
  const auto measured = reordered(measured_modes, measured_order);
  const auto simulated = reordered(simulated_modes, simulated_order);

  ModePairing pairing;
  pairing.is_by_shape = have_shapes(measured) && have_shapes(simulated);
  // Modes of equal frequency in one group are all alike, so their order already pairs them.
  if (pairing.is_by_shape) pairing.close = {settings.same_frequency, 2.0 * settings.same_frequency};
  const Eigen::MatrixXd likeness =
      likeness_matrix(measured, simulated, pairing.is_by_shape, settings.same_frequency);
  Eigen::MatrixXd cost(likeness.rows(), likeness.cols());
  for (Eigen::Index i = 0; i < cost.rows(); ++i) {
    for (Eigen::Index j = 0; j < cost.cols(); ++j) {
      const double difference = relative_difference(measured[i].frequency, simulated[j].frequency);
      const bool alike = likeness(i, j) >= settings.min_likeness;
      cost(i, j) = alike ? 1.0 - likeness(i, j) + kTieBreak * difference : numerics::kForbidden;
    }
  }

  std::vector<bool> used(simulated.size(), false);
  std::vector<int> partner = numerics::assign(cost);
  if (!pairing.is_by_shape) take_mixed(measured, simulated, partner);
  for (size_t i = 0; i < measured.size(); ++i) {
    const int j = partner[i];
    if (j < 0) {
      pairing.missing.push_back(measured_order[i]);
      continue;
    }
    used[j] = true;
    pairing.pairs.push_back(
        {measured_order[i], simulated_order[j], likeness(static_cast<Eigen::Index>(i), j)});
  }
  for (size_t j = 0; j < simulated.size(); ++j) {
    if (!used[j]) pairing.extra.push_back(simulated_order[j]);
  }
  std::sort(pairing.pairs.begin(), pairing.pairs.end(), [](const ModePair& a, const ModePair& b) {
    return a.measured < b.measured;
  });
  std::sort(pairing.missing.begin(), pairing.missing.end());
  std::sort(pairing.extra.begin(), pairing.extra.end());
  return pairing;
}

}  // namespace latsch::correlation
