// SPDX-License-Identifier: Apache-2.0
// A car of a tree of numbers as a model that drives. The tree holds suspensions and tires as tables
// (base/document_parts.h). A function of the caller makes the tires, so the car knows no kind of
// tire.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "base/document.h"
#include "models/car/car_reader.h"
#include "models/car/drives.h"
#include "models/tire/mirrored_tire.h"

namespace latsch::car {

inline constexpr std::array<const char*, 2> kAxles = {"front", "rear"};

/// Returns the key of the tire of an axle (0: front) and a side (0: left): "front_tire",
/// "front_tire_right". The right one is needed only if the right tire is not the mirror image of
/// the left.
std::string tire_key(std::size_t axle, std::size_t side);

/// Returns true if a tire that states no kind is described by a section, as a finite-element tire.
bool is_elements(const Document& tire);

/// Returns the kind of rolling tire that its numbers state: "ring_tire", "rigid_ring",
/// "magic_formula" or "fe_tire"; for a .tir, which states none, the car's table decides. `part` is
/// the tire's key. Throws InputError for a kind that does not roll.
std::string tire_kind_name(const Node& car, const Document& tire, const std::string& part);

/// Returns the side for which a tire was measured; the left if the tire states no side.
TireSide side_of(const Document& tire);

/// Makes the tire of a kind from its numbers. `key` is that of the tire in the car's tree; `is_own`
/// is false if the tire is that of the left side, on the right. Throws InputError.
using TireMaker = std::function<RollingModel(
    const std::string& kind, const Document& tire, const std::string& key, bool is_own)>;

class RollingCar final : public Drives, public MeetsLimits {
 public:
  /// Throws InputError if the numbers make no car.
  RollingCar(const Document& numbers, const TireMaker& make);

  Result<std::unique_ptr<Car>> car(const CarInputs& at_rest) const override;
  /// Returns the limits that its tires have met and what they assume, each with the tire's key and
  /// side.
  std::vector<std::string> limits_met() const override;
  /// Throws InputError if a tire does not fit under its wheel center.
  void check_tires() const;

  const CarFile& file() const { return file_; }

 private:
  Document numbers_;
  CarFile file_;
  Tires tires_;
  /// The models of the tires that are no springs, by their key in the tree and their side.
  std::vector<std::pair<std::string, RollingModel>> models_;
};

}  // namespace latsch::car
