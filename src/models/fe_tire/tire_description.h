// SPDX-License-Identifier: Apache-2.0
// A tire as its maker describes it: size, contour, thicknesses, cord layers, rubber regions.
#pragma once

#include <string>
#include <vector>

#include "base/document.h"
#include "models/fe_tire/hex8.h"
#include "models/fe_tire/materials.h"
#include "models/fe_tire/mesh.h"

namespace latsch::fe_tire {

struct TireDescription;  // completed with its fields by the section builder

}  // namespace latsch::fe_tire
