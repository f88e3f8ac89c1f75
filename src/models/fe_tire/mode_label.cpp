// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/mode_label.h"

#include <fmt/format.h>

#include <array>
#include <map>
#include <utility>

namespace latsch::fe_tire {
namespace {

constexpr std::array<const char*, 4> kTypeNames = {"torsional", "lateral", "radial", "other"};
constexpr double kPairTolerance =
    1e-6;                            // relative difference of the frequencies of a degenerate pair
constexpr double kClearPhase = 0.5;  // overlap with the mirror image beyond which a phase is named

}  // namespace

std::string name(ModeType type) { return kTypeNames[static_cast<int>(type)]; }

std::optional<ModeType> mode_type(const std::string& name) {
  for (int i = 0; i < static_cast<int>(kTypeNames.size()); ++i) {
    if (name == kTypeNames[i]) return static_cast<ModeType>(i);
  }
  return std::nullopt;
}

std::string Mode::label() const {
  std::string text = fmt::format("{} n={}", name(type), n);
  if (order > 1) text += fmt::format(" ({})", order);
  if (phase != ' ') text += fmt::format(" {}", phase);
  return text;
}

ModeType type_of(int n, const Eigen::Vector3d& kinetic_energy) {
  const double around = kinetic_energy.x(), along = kinetic_energy.y(), across = kinetic_energy.z();
  if (n == 0 && around > along && around > across) return ModeType::torsional;
  return along > around + across ? ModeType::lateral : ModeType::radial;
}

void number_orders(std::vector<Mode>& modes) {
  std::map<std::pair<int, ModeType>, std::pair<int, double>> last;  // order and frequency so far
  for (Mode& mode : modes) {
    auto& [order, frequency] = last[{mode.n, mode.type}];
    const bool partner =
        order > 0 && mode.n > 0 && mode.frequency - frequency <= kPairTolerance * mode.frequency;
    if (!partner) ++order;
    frequency = mode.frequency;
    mode.order = order;
  }
}

char phase_of(const Mesh& mesh, const Eigen::Matrix3Xd& shape) {
  const int n = mesh.nodes_per_sector(), S = mesh.sectors;
  double overlap = 0.0;
  for (int s = 0; s < S; ++s) {
    const int mirror = (S - s) % S;
    for (int i = 0; i < n; ++i) {
      const auto a = shape.col(s * n + i), b = shape.col(mirror * n + i);
      overlap += -a.x() * b.x() + a.y() * b.y() + a.z() * b.z();
    }
  }
  overlap /= shape.squaredNorm();
  return overlap > kClearPhase ? 's' : overlap < -kClearPhase ? 'a' : ' ';
}

void name_after(const std::vector<Mode>& unloaded,
                const Eigen::VectorXd& nodal_mass,
                std::vector<Mode>& loaded) {
  for (Mode& mode : loaded) {
    std::map<std::tuple<int, ModeType, int>, double> energy;
    double largest = 0.0;
    for (const Mode& group : unloaded) {
      const double overlap =
          mode.shape.cwiseProduct(group.shape).colwise().sum().dot(nodal_mass.transpose());
      double& share = energy[{group.n, group.type, group.order}];
      share += overlap * overlap;
      if (share > largest) {
        largest = share;
        mode.n = group.n;
        mode.type = group.type;
        mode.order = group.order;
      }
    }
  }
}

}  // namespace latsch::fe_tire
