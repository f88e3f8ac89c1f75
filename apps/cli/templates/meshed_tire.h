// SPDX-License-Identifier: Apache-2.0
// The tire of finite elements that a file or a study has.
#pragma once

#include <string>

#include "experiment/language.h"
#include "models/fe_tire/description/tire_description.h"

namespace latsch::cli {

/// As model_source(); InputError where it has another model, which has no mesh.
fe_tire::TireDescription meshed_tire(const std::string& file, const experiment::Language& language);

}  // namespace latsch::cli
