// SPDX-License-Identifier: Apache-2.0
// The tire of finite elements that a model's or a study's file holds: described by its section, or
// on a mesh of its owner.
#pragma once

#include <optional>
#include <string>

#include "experiment/language.h"
#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/description/tire_description.h"

namespace latsch::cli {

struct MeshedTire {
  std::string name, size;  // no size where the mesh is its owner's
  double pressure = 0.0;   // Pa, its own
  fe_tire::Mesh mesh;
  fe_tire::Materials materials;
  fe_tire::SolverSettings settings;
  std::optional<fe_tire::TireDescription> description;  // none where the mesh is its owner's
};

/// Throws InputError where the file holds no such tire.
MeshedTire meshed_tire(const std::string& file, const experiment::Language& language);

}  // namespace latsch::cli
