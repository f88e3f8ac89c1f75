// SPDX-License-Identifier: Apache-2.0
// Reads a co-simulation unit from its folder, which is the folder `resources` of an FMI package.
//
//   unit.toml    kind = "tire" or "car", format = 2, token = "{...}"   # hash of the files below
//                [tire] or [car]
//                model_kind, model, road                   # the last two: names of files beside it
//
// In format 2 model and road state every quantity in coherent SI units, so that a slim library
// needs no list of units (apps/exchange/slim). In format 1, which states no format, they are files
// with any units.
//
// A car is one file, with its suspensions and tires as tables (base/document_parts.h).
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "exchange/unit/unit.h"
#include "exchange/unit/unit_models.h"
#include "models/road/road.h"

namespace latsch::exchange {

/// Name of the file that describes a unit.
inline constexpr const char* kUnitFile = "unit.toml";
/// Largest format that read_unit() reads.
inline constexpr long kUnitFormat = 2;

struct UnitFromFolder {
  std::unique_ptr<ExchangedModel> unit;
  std::string token;
};

/// Reads a unit. Throws InputError that names the file and its error.
UnitFromFolder read_unit(const std::filesystem::path& folder, const UnitModels& models);

struct TireFromFolder {
  RollingModel tire;
  std::string kind;  // "ring_tire", or a description
};
/// Reads the tire alone of a unit. Throws InputError as read_unit() does, and for a car.
TireFromFolder read_tire_of_unit(const std::filesystem::path& folder, const UnitModels& models);

/// Reads the road of a file (.toml, .crg, .rdf); empty: a flat road at height 0. Throws InputError.
std::shared_ptr<const road::Road> road_of_unit(const std::filesystem::path& file);

}  // namespace latsch::exchange
