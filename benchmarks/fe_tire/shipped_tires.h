// SPDX-License-Identifier: Apache-2.0
// Functions that benchmarks share: reading the tires of studies/tires, and taking the value out of
// a simulation's result.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <utility>

#include "base/document.h"
#include "base/file.h"
#include "base/result.h"
#include "coarse_mesh.h"
#include "models/fe_tire/description/tire_description.h"
#include "options.h"

namespace latsch::benchmarks {

/// Returns the path of a tire's file by its name without ending, for example "passenger_225_50R16".
inline std::filesystem::path tire_file(const std::string& name) {
  return std::filesystem::path(LATSCH_SOURCE_DIR) / "studies/tires" / (name + ".toml");
}

inline fe_tire::TireDescription shipped_tire(const std::string& name) {
  return fe_tire::read_tire(Document::read(tire_file(name)).root());
}

/// Returns the tire on a coarse mesh, for smoke runs.
inline fe_tire::TireDescription coarse_tire(const std::string& name, const CoarseMesh& mesh = {}) {
  const std::string text = with_coarse_mesh(read_text_file(tire_file(name)), mesh);
  return fe_tire::read_tire(Document::parse(text, name).root());
}

/// Returns the shipped tire, or in a smoke run the coarse one.
inline fe_tire::TireDescription tire_for(const Options& options, const std::string& name) {
  return options.is_smoke() ? coarse_tire(name) : shipped_tire(name);
}

/// Returns the value. Throws the reason if the result is a failure; run_benchmark (options.h) then
/// prints the reason and ends.
template <class T>
T value_of(Result<T> result) {
  if (!result) throw std::runtime_error(result.failure().reason);
  return *std::move(result);
}

}  // namespace latsch::benchmarks
