// SPDX-License-Identifier: Apache-2.0
// The models of which a library can make units. A slim library makes those that need nothing but
// the machine's C library: flexible rings, rigid rings, Magic Formulas, and cars on them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/document.h"
#include "models/car/drives.h"
#include "models/tire/rolls.h"

namespace latsch::exchange {

class UnitModels {
 public:
  virtual ~UnitModels() = default;

  /// Returns the kinds of tires that tire() makes, such as "ring_tire".
  virtual std::vector<std::string> tire_kinds() const = 0;
  /// Returns true if files with any units are read, as units of format 1 contain them
  /// (unit_reading.h); false: files in SI alone.
  virtual bool reads_any_units() const = 0;
  /// Return the model of a file. Throw InputError.
  virtual RollingModel tire(const std::string& kind, const std::filesystem::path& file) const = 0;
  virtual DrivingModel car(const std::filesystem::path& file) const = 0;
};

/// Returns the kinds of tires that slim_tire() makes.
const std::vector<std::string>& slim_tire_kinds();
/// Returns the tire of these numbers. Throws InputError if the numbers make no tire, or if the kind
/// is none of slim_tire_kinds().
RollingModel slim_tire(const std::string& kind, const Document& numbers);
/// Returns the car of these numbers, with its suspensions and tires as tables. Throws InputError.
DrivingModel slim_car(const Document& numbers);

/// The models of slim_tire_kinds() and cars on them, from files in SI.
class SlimModels final : public UnitModels {
 public:
  std::vector<std::string> tire_kinds() const override { return slim_tire_kinds(); }
  bool reads_any_units() const override { return false; }
  RollingModel tire(const std::string& kind, const std::filesystem::path& file) const override;
  DrivingModel car(const std::filesystem::path& file) const override;
};

}  // namespace latsch::exchange
