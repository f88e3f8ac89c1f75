// SPDX-License-Identifier: Apache-2.0
// Reads the finite-element tire of a model's or a study's file: described by its section, or on a
// mesh of the user.
#pragma once

#include <optional>
#include <string>

#include "experiment/language.h"
#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/description/tire_description.h"

namespace latsch::cli {

struct MeshedTire {
  std::string name, size;  // no size if the mesh is the user's
  double pressure = 0.0;   // Pa, the tire's own
  fe_tire::Mesh mesh;
  fe_tire::Materials materials;
  fe_tire::SolverSettings settings;
  std::optional<fe_tire::TireDescription> description;  // none if the mesh is the user's
};

/// Throws InputError if the file contains no such tire.
MeshedTire meshed_tire(const std::string& file, const experiment::Language& language);

}  // namespace latsch::cli
