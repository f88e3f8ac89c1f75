// SPDX-License-Identifier: Apache-2.0
// latsch export --bus: the bushings of a suspension as property files of Adams, one a joint.
#pragma once

#include <string>

#include "experiment/language.h"

namespace latsch::cli {

/// Writes FOLDER/ubj.bus and so on. InputError, before any is written, where the model is no
/// suspension with bushings or one of them is more than such a file can say.
void write_bushings(const std::string& file,
                    const std::string& folder,
                    const experiment::Language& language);

}  // namespace latsch::cli
