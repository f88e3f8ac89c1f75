// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/fe_tire/loaded_limits.h"

#include <algorithm>
#include <cmath>

#include "numerics/richardson.h"

namespace latsch {
namespace {

// error that remains after halving the elements over the change by halving, for second order
constexpr double kSecondOrder = 1.0 / 3.0;

RoughLimit of_few(const std::vector<double>& v) {
  const double around = v[1] - v[0];
  return {v[2] + kSecondOrder * around, v[2] - v[1], around, 0.0};
}

RoughLimit of_thorough(const std::vector<double>& v) {
  const MeshLimit limit = mesh_limit({1, 2, 4}, {v[0], v[2], v[3]});
  const double through = v[4] - v[2];
  return {limit.value + through, through, 0.0, limit.uncertainty};
}

/// Returns the label of a mode without rank and phase, which both modes of the loaded tire share
/// that come from one mode of the unloaded tire.
std::string label_of(const std::string& row) {
  std::string label = row.substr(0, row.find(" #"));
  if (label.ends_with(" s") || label.ends_with(" a")) label.resize(label.size() - 2);
  return label;
}

/// Order of convergence by which the change from the first mesh to the one refined twice falls
/// short of the limit; 0 if there is none.
double order_of(double way, double left) {
  constexpr double kLowest = 0.5, kHighest = 4.0;
  const double order = std::log2(1.0 + way / left);
  return order >= kLowest && order <= kHighest ? order : 0.0;
}

}  // namespace

const FewMeshes& few_meshes() {
  static const FewMeshes meshes = {{1, {2, 1, 1}, 2}, of_few};
  return meshes;
}

const FewMeshes& thorough_meshes() {
  static const FewMeshes meshes = {{1, {2, 1, 1}, {2, 2, 1}, {4, 4, 1}, 2}, of_thorough};
  return meshes;
}

std::vector<MeshQuantities> few_of_thorough(const std::vector<MeshQuantities>& meshes) {
  return {meshes[0], meshes[1], meshes[4]};
}

Missed::Missed(const std::vector<DiscretizationRow>& limits,
               const std::vector<DiscretizationRow>& few,
               const FewMeshes& meshes)
    : meshes_(meshes), part_(kSecondOrder) {
  for (const DiscretizationRow& row : few) {
    const auto limit = std::ranges::find(limits, row.name, &DiscretizationRow::name);
    if (row.unit != "Hz" || !row.paired || limit == limits.end() || !limit->paired) continue;
    const RoughLimit rough = meshes_.extrapolate(row.values);
    const double value = row.values.front();
    of_.emplace(label_of(row.name),
                Of{(limit->converged - rough.value) / value,
                   rough.section / value,
                   rough.around / value,
                   limit->uncertainty / value});
  }
  if (of_.empty()) return;
  double product = 0.0, square = 0.0;
  for (const auto& [label, of] : of_) {
    product += of.missed * of.section;
    square += of.section * of.section;
  }
  if (square > 0.0) part_ = product / square;
  for (const auto& [label, of] : of_) {
    all_.missed += std::pow(of.missed - part_ * of.section, 2);
    all_.uncertainty += of.uncertainty * of.uncertainty;
  }
  const double count = static_cast<double>(of_.size());
  all_.missed = std::sqrt(all_.missed / count);
  all_.uncertainty = std::sqrt(all_.uncertainty / count);
}

void Missed::extrapolate(DiscretizationRow& row) const {
  constexpr double kUnlike = 0.5;
  const RoughLimit rough = meshes_.extrapolate(row.values);
  const double value = row.values.front();
  const auto found = of_.find(label_of(row.name));
  double unsure = kUnlike * std::abs(rough.around);
  if (found != of_.end()) {
    const Of& of = found->second;
    row.converged = rough.value + of.missed * value;
    unsure += kUnlike * (std::abs(rough.section - of.section * value) +
                         std::abs(rough.around - of.around * value));
    unsure += of.uncertainty * std::abs(value);
  } else {
    row.converged = rough.value + part_ * rough.section;
    unsure += (all_.missed + all_.uncertainty) * std::abs(value);
    if (of_.empty()) unsure += std::abs(rough.section);
  }
  row.uncertainty = unsure + rough.unsure;
  row.order =
      of_.empty() ? 0.0 : order_of(row.values.back() - value, row.converged - row.values.back());
}

}  // namespace latsch
