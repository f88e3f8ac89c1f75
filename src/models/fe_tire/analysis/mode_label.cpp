// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/analysis/mode_label.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <utility>

#include "numerics/dense/dense_products.h"

namespace latsch::fe_tire {
namespace {

constexpr std::array<const char*, 4> kTypeNames = {"torsional", "lateral", "radial", "other"};
constexpr double kPairTolerance =
    1e-6;  // largest relative difference of the frequencies of a degenerate pair
constexpr double kSamePlace = 1e-6;  // share of the largest coordinate within which nodes coincide
// Smallest overlap with the mirror image at which a mode has a phase.
constexpr double kClearPhase = 0.5;

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

Eigen::Vector3d kinetic_energy(const Eigen::VectorXcd& phi, const Eigen::VectorXcd& M_phi) {
  Eigen::Vector3d energy = Eigen::Vector3d::Zero();
  for (int k = 0; k < phi.size(); ++k) energy[k % 3] += std::real(std::conj(phi[k]) * M_phi[k]);
  return energy;
}

ModeType type_of(int n, const Eigen::Vector3d& kinetic_energy) {
  const double around = kinetic_energy.x(), along = kinetic_energy.y(), across = kinetic_energy.z();
  if (n == 0 && around > along && around > across) return ModeType::torsional;
  return along > around + across ? ModeType::lateral : ModeType::radial;
}

void number_orders(std::vector<Mode>& modes) {
  // Last order number and frequency of each kind of mode.
  std::map<std::pair<int, ModeType>, std::pair<int, double>> last;
  for (Mode& mode : modes) {
    auto& [order, frequency] = last[{mode.n, mode.type}];
    const bool partner =
        order > 0 && mode.n > 0 && mode.frequency - frequency <= kPairTolerance * mode.frequency;
    if (!partner) ++order;
    frequency = mode.frequency;
    mode.order = order;
  }
}

namespace {

/// Returns, for every node of a mesh without sectors, the node at (-x, y, z). Returns an empty list
/// if a node has none.
std::vector<int> mirror_nodes(const Eigen::Matrix3Xd& X) {
  const double near = kSamePlace * X.cwiseAbs().maxCoeff();
  std::vector<int> by_height(X.cols());
  std::iota(by_height.begin(), by_height.end(), 0);
  const auto lower = [&](int a, int b) { return X(2, a) < X(2, b); };
  std::sort(by_height.begin(), by_height.end(), lower);
  std::vector<int> images(X.cols(), -1);
  for (int k = 0; k < X.cols(); ++k) {
    const Eigen::Vector3d image(-X(0, k), X(1, k), X(2, k));
    auto it = std::partition_point(by_height.begin(), by_height.end(), [&](int other) {
      return X(2, other) < image.z() - near;
    });
    for (; it != by_height.end() && X(2, *it) <= image.z() + near && images[k] < 0; ++it) {
      if ((X.col(*it) - image).cwiseAbs().maxCoeff() <= near) images[k] = *it;
    }
    if (images[k] < 0) return {};
  }
  return images;
}

/// Returns, for every node of the ring, its mirror image in the plane x = 0. Returns an empty list
/// if the mesh is not symmetric.
std::vector<int> mirror_images(const Mesh& mesh) {
  if (mesh.sectors == 1) return mirror_nodes(mesh.X);
  const int n = mesh.nodes_per_sector(), S = mesh.sectors;
  std::vector<int> images(mesh.nodes());
  for (int k = 0; k < mesh.nodes(); ++k) images[k] = (S - k / n) % S * n + k % n;
  return images;
}

}  // namespace

char phase_of(const Mesh& mesh, const Eigen::Matrix3Xd& shape) {
  const std::vector<int> images = mirror_images(mesh);
  if (images.empty()) return ' ';
  double overlap = 0.0;
  for (int k = 0; k < shape.cols(); ++k) {
    const auto a = shape.col(k), b = shape.col(images[k]);
    overlap += -a.x() * b.x() + a.y() * b.y() + a.z() * b.z();
  }
  overlap /= shape.squaredNorm();
  return overlap > kClearPhase ? 's' : overlap < -kClearPhase ? 'a' : ' ';
}

void name_after(const std::vector<Mode>& unloaded,
                const Eigen::VectorXd& nodal_mass,
                std::vector<Mode>& loaded) {
  const Eigen::Index size = 3 * nodal_mass.size();
  Eigen::MatrixXd groups(size, unloaded.size()), momenta(size, loaded.size());
  for (std::size_t j = 0; j < unloaded.size(); ++j) groups.col(j) = unloaded[j].shape.reshaped();
  for (std::size_t i = 0; i < loaded.size(); ++i) {
    auto momentum = momenta.col(i).reshaped(3, nodal_mass.size());
    momentum = loaded[i].shape;
    momentum.array().rowwise() *= nodal_mass.transpose().array();
  }
  const Eigen::MatrixXd overlaps = numerics::overlaps<double>(groups, momenta);
  for (std::size_t i = 0; i < loaded.size(); ++i) {
    Mode& mode = loaded[i];
    std::map<std::tuple<int, ModeType, int>, double> energy;
    double largest = 0.0;
    for (std::size_t j = 0; j < unloaded.size(); ++j) {
      const Mode& group = unloaded[j];
      double& share = energy[{group.n, group.type, group.order}];
      share += overlaps(j, i) * overlaps(j, i);
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
