// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/suspension/kc_tables.h"

#include <fmt/format.h>

#include <functional>

#include "experiment/rigs/suspension/kc_compliance.h"
#include "models/suspension/axle_compliance.h"
#include "models/suspension/axle_kinematics.h"
#include "models/suspension/moved_corner.h"

namespace latsch::experiment {
namespace {

using suspension::AxleKinematics;
using suspension::KinematicAxle;
using suspension::KinematicOutput;
using suspension::Side;
using suspension::SuspensionCorner;
using suspension::TravelOf;
using suspension::WheelKinematics;
using OutputGroup = KinematicOutput::Group;

constexpr double kStandardGravity = 9.80665;  // m/s^2
constexpr const char* kTravelWords = "travel of the wheel center, upward";

/// Returns positions from -end to end in equal steps; the middle one is exactly 0.
std::vector<double> positions_of(double end, int count) {
  if (end == 0.0) return {0.0};
  std::vector<double> positions;
  const int half = count / 2;
  for (int i = -half; i <= half; ++i) positions.push_back(end * i / half);
  return positions;
}

/// A table that is filled row by row.
class TableRows {
 public:
  void add_column(std::string name, std::string unit, std::string words) {
    channels_.push_back({std::move(name), std::move(unit), {}});
    words_.push_back(std::move(words));
  }
  void add(double value) { channels_[next_++ % channels_.size()].values.push_back(value); }

  KcTable table() && {
    KcTable table;
    for (Channel& channel : channels_) table.columns.add(std::move(channel));
    table.words = std::move(words_);
    return table;
  }

 private:
  std::vector<Channel> channels_;
  std::vector<std::string> words_;
  std::size_t next_ = 0;
};

/// Moves the axle to a position. A Failure states the position.
Result<KinematicAxle::Wheels> wheels_at(KinematicAxle& axle,
                                        double left,
                                        double right,
                                        double rack) {
  auto wheels = axle.move_to(left, right, rack);
  if (!wheels)
    return Failure{fmt::format("at a travel of {:.4g} mm and a rack of {:.4g} mm: {}",
                               1e3 * left,
                               1e3 * rack,
                               wheels.failure().reason)};
  return wheels;
}

Result<KcTable> kinematics_table(const SuspensionCorner& corner,
                                 const std::vector<double>& travel,
                                 const std::vector<double>& rack) {
  TableRows rows;
  rows.add_column("travel", "m", std::string(kTravelWords) + ", of both wheels");
  rows.add_column("rack", "m", "travel of the rack, to the left");
  std::vector<const KinematicOutput*> outputs;
  for (const KinematicOutput& output : suspension::kinematic_outputs())
    if (output.group == OutputGroup::wheel) outputs.push_back(&output);
  for (const char* side : {"_L", "_R"})
    for (const KinematicOutput* output : outputs)
      rows.add_column(std::string(output->name) + side, output->unit, output->words);
  KinematicAxle axle(corner.geometry, TravelOf::wheel_center);
  for (const double z : travel)
    for (const double y : rack) {
      const auto wheels = wheels_at(axle, z, z, y);
      if (!wheels) return wheels.failure();
      rows.add(z);
      rows.add(y);
      for (const WheelKinematics* wheel : {&wheels->left, &wheels->right})
        for (const KinematicOutput* output : outputs) rows.add(wheel->*output->value);
    }
  return std::move(rows).table();
}

Result<KcTable> roll_table(const SuspensionCorner& corner, const std::vector<double>& travel) {
  constexpr double kEqualShares = 0.5;
  TableRows rows;
  rows.add_column("travel_L", "m", std::string(kTravelWords) + ", of the left wheel");
  rows.add_column("travel_R", "m", std::string(kTravelWords) + ", of the right wheel");
  rows.add_column("roll", "rad", "roll of the chassis to the ground, positive left side up");
  rows.add_column("track", "m", "distance of the contact points");
  rows.add_column(
      "roll_center_height", "m", "kinematic roll center above the contact points' line");
  rows.add_column("roll_center_y", "m", "kinematic roll center, to the left of the middle");
  rows.add_column("force_roll_center_height",
                  "m",
                  "height of the links' lateral force, equal shares of both wheels");
  KinematicAxle axle(corner.geometry, TravelOf::wheel_center);
  for (const double z : travel) {
    const auto wheels = wheels_at(axle, z, -z, 0.0);
    if (!wheels) return wheels.failure();
    const AxleKinematics a = axle_of(wheels->left, wheels->right, kEqualShares);
    for (const double value : {z,
                               -z,
                               a.roll,
                               a.track,
                               a.roll_center_height,
                               a.roll_center_y,
                               a.force_roll_center_height})
      rows.add(value);
  }
  return std::move(rows).table();
}

Result<KcTable> springs_table(const SuspensionCorner& corner, const std::vector<double>& travel) {
  TableRows rows;
  rows.add_column("travel", "m", kTravelWords);
  std::vector<const KinematicOutput*> outputs;
  for (const KinematicOutput& output : suspension::kinematic_outputs()) {
    const bool is_known = output.group == OutputGroup::spring ||
                          (output.group == OutputGroup::bar && corner.geometry.spring.blade) ||
                          (output.group == OutputGroup::rates && corner.geometry.rates);
    if (!is_known) continue;
    outputs.push_back(&output);
    rows.add_column(output.name, output.unit, output.words);
  }
  KinematicAxle axle(corner.geometry, TravelOf::wheel_center);
  for (const double z : travel) {
    const auto wheels = wheels_at(axle, z, z, 0.0);
    if (!wheels) return wheels.failure();
    rows.add(z);
    for (const KinematicOutput* output : outputs) rows.add(wheels->left.*output->value);
  }
  return std::move(rows).table();
}

/// The names of the rows and columns of the compliance matrix, left wheel first.
struct ComplianceNames {
  static constexpr std::array<const char*, 6> kMotions = {
      "dx", "dy", "dz", "about_x", "about_y", "about_z"};
  static std::string motion(int i) {
    return fmt::format("{}_{}", kMotions[static_cast<std::size_t>(i % 6)], i < 6 ? "L" : "R");
  }
  static std::string load(int i) {
    return fmt::format("{}_{}", KcTest::kLoads[static_cast<std::size_t>(i % 6)], i < 6 ? "L" : "R");
  }
  static std::string unit(int motion, int load) {
    if (motion % 6 < 3) return load % 6 < 3 ? "m/N" : "1/N";
    return load % 6 < 3 ? "rad/N" : "rad/(N m)";
  }
};

/// Returns the compliance matrix of the left wheel with its center at this travel.
Result<suspension::Matrix6d> left_compliance(const SuspensionCorner& corner, double travel) {
  const auto moved = suspension::moved_corner(corner, travel, 0.0);
  if (!moved) return moved.failure();
  KcTest unloaded;
  unloaded.loads.setZero(6, 1);
  const auto found = compliance_matrices(*moved, unloaded);
  if (!found) return found.failure();
  suspension::Matrix6d C;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j)
      C(i, j) = found->all()[static_cast<std::size_t>(6 * i + j)].values.front();
  return corner.geometry.linkage.wheel.side == Side::left ? C : suspension::mirrored_compliance(C);
}

Result<KcTable> compliance_table(const SuspensionCorner& corner,
                                 const std::vector<double>& travel) {
  constexpr int kSize = 12;
  TableRows rows;
  rows.add_column("travel", "m", std::string(kTravelWords) + ", of both wheels");
  for (int i = 0; i < kSize; ++i)
    for (int j = 0; j < kSize; ++j)
      rows.add_column(
          ComplianceNames::motion(i) + "_by_" + ComplianceNames::load(j),
          ComplianceNames::unit(i, j),
          "motion of the upright at the contact point by a load of the ground on the tire there");
  for (const double z : travel) {
    const auto left = left_compliance(corner, z);
    if (!left)
      return Failure{
          fmt::format("compliance at a travel of {:.4g} mm: {}", 1e3 * z, left.failure().reason)};
    const suspension::Matrix12d axle = suspension::uncoupled_axle(*left);
    rows.add(z);
    for (int i = 0; i < kSize; ++i)
      for (int j = 0; j < kSize; ++j) rows.add(0.0 + axle(i, j));
  }
  return std::move(rows).table();
}

/// Returns the spring's force at rest, which carries the sprung mass over the motion ratio.
Result<std::optional<double>> spring_force_at_rest(const SuspensionCorner& corner) {
  const auto& rates = corner.geometry.rates;
  if (!rates) return std::optional<double>();
  suspension::KinematicCorner wheel(corner.geometry, TravelOf::wheel_center);
  const auto rest = wheel.move_to(0.0, 0.0);
  if (!rest) return rest.failure();
  return std::optional<double>(rates->sprung_mass * kStandardGravity / rest->motion_ratio);
}

}  // namespace

Result<KcTables> kc_tables(const SuspensionCorner& corner, const KcRange& range) {
  KcTables tables;
  tables.travel = positions_of(range.travel, range.travel_positions);
  tables.rack = positions_of(range.rack, range.rack_positions);
  auto kinematics = kinematics_table(corner, tables.travel, tables.rack);
  if (!kinematics) return kinematics.failure();
  auto roll = roll_table(corner, tables.travel);
  if (!roll) return roll.failure();
  auto springs = springs_table(corner, tables.travel);
  if (!springs) return springs.failure();
  const auto force = spring_force_at_rest(corner);
  if (!force) return force.failure();
  tables.kinematics = std::move(*kinematics);
  tables.roll = std::move(*roll);
  tables.springs = std::move(*springs);
  tables.spring_force = *force;
  if (!corner.compliant) return tables;
  auto compliance = compliance_table(corner, tables.travel);
  if (!compliance) return compliance.failure();
  tables.compliance = std::move(*compliance);
  return tables;
}

}  // namespace latsch::experiment
