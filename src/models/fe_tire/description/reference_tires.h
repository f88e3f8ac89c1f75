// SPDX-License-Identifier: Apache-2.0
// Two passenger tires with smeared cords, for which an independent program has computed inflation,
// load-deflection curve and modes. Their sizes and numbers of elements are those of tires A and B
// of [Hempel & Oertel 2016]; contours and moduli are assumed.
#pragma once

#include "models/fe_tire/description/tire_description.h"

namespace latsch::fe_tire {

TireDescription reference_tire_a();  // 235/45R20, 7,020 HEX8, 27,000 free degrees of freedom
TireDescription reference_tire_b();  // 225/50R16, 3,480 HEX8, 15,480 free degrees of freedom

}  // namespace latsch::fe_tire
