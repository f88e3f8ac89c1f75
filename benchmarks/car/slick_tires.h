// SPDX-License-Identifier: Apache-2.0
// Tires of cars in benchmarks: one spring and damper each, or the shipped slick, a Magic Formula
// whose slips follow the motion over its relaxation lengths, 0.41 m along and 0.65 m across.
#pragma once

#include <filesystem>
#include <memory>

#include "formats/tire/tir_file.h"
#include "models/car/race_car_testing.h"
#include "models/magic_formula/magic_formula_tire.h"
#include "models/tire/mirrored_tire.h"

namespace latsch::benchmarks {

enum class TiresOfCar { springs, relaxing };

inline car::Tires tires_of_car(TiresOfCar kind) {
  if (kind == TiresOfCar::springs) return car::spring_tires();
  const auto parameters =
      formats::read_tir(std::filesystem::path(LATSCH_SOURCE_DIR) / "studies/kerb/slick.tir")
          .parameters;
  car::Tires tires;
  for (std::size_t i = 0; i < tires.size(); ++i)
    tires[i] = mounted(std::make_unique<magic_formula::MagicFormulaTire>(
                           parameters, magic_formula::MagicFormulaTireSettings{}),
                       TireSide::left,
                       i % 2 == 0 ? TireSide::left : TireSide::right);
  return tires;
}

inline const char* in_words(TiresOfCar kind) {
  return kind == TiresOfCar::springs ? "springs" : "tires with relaxation";
}

}  // namespace latsch::benchmarks
