// SPDX-License-Identifier: Apache-2.0
// Reads the finite-element tire of a model's or a study's file. The tire is described either by its
// cross section or by a mesh of the user.
#pragma once

#include <optional>
#include <string>

#include "experiment/language.h"
#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/description/tire_description.h"

namespace latsch::cli {

struct MeshedTire {
  std::string name, size;  // `size` is empty for a mesh of the user
  double pressure = 0.0;   // Pa, inflation pressure that the tire's file states
  fe_tire::Mesh mesh;
  fe_tire::Materials materials;
  fe_tire::SolverSettings settings;
  std::optional<fe_tire::TireDescription> description;  // none for a mesh of the user
};

/// Throws InputError if the file contains no finite-element tire.
MeshedTire meshed_tire(const std::string& file, const experiment::Language& language);

}  // namespace latsch::cli
