// SPDX-License-Identifier: Apache-2.0
// Encodes a scene as the binary buffer that docs/studio.md describes, and a tire's cross section as
// JSON.
#pragma once

#include <string>

#include "report/scene.h"
#include "studio/views/views.h"

namespace latsch::report {
struct TirePictures;
}

namespace latsch::studio {

std::string scene_buffer(const report::Scene& scene, const std::string& title);
Json section_of(const report::TirePictures& pictures, const std::string& title);

}  // namespace latsch::studio
