// SPDX-License-Identifier: Apache-2.0
// The tires of studies/tires, and the value of what a simulation of one gives.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <utility>

#include "base/document.h"
#include "base/result.h"
#include "models/fe_tire/description/tire_description.h"

namespace latsch::benchmarks {

/// Of "passenger_225_50R16", without the ending of the file.
inline std::filesystem::path tire_file(const std::string& name) {
  return std::filesystem::path(LATSCH_SOURCE_DIR) / "studies/tires" / (name + ".toml");
}

inline fe_tire::TireDescription shipped_tire(const std::string& name) {
  return fe_tire::read_tire(Document::read(tire_file(name)).root());
}

/// Throws the reason where there is none: the benchmark then ends (table.h, guarded).
template <class T>
T value_of(Result<T> result) {
  if (!result) throw std::runtime_error(result.failure().reason);
  return *std::move(result);
}

}  // namespace latsch::benchmarks
