// SPDX-License-Identifier: Apache-2.0
// The tire's surface and its displacements, packed for the page's viewer (viewer_script).
//
// Lengths are 16-bit integers times a scale, shapes of modes 8-bit ones, in base64.
#pragma once

#include <string>

#include "report/report.h"

namespace latsch::report {

/// JSON with the surface and every state to be drawn: {"points", "faces", "scale", "states":
/// [...]}.
///   loaded state:  displaced as it is, colored by the displacement from the inflated tire
///   modes:         around the state they belong to, amplitude enlarged, colored by it
std::string scene_json(const TirePictures& pictures);

/// How many modes the page shows.
int shown_modes(const TirePictures& pictures);

/// For tests: bytes as base64. [RFC 4648, section 4]
std::string base64(std::string_view bytes);

}  // namespace latsch::report
