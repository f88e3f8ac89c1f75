// SPDX-License-Identifier: Apache-2.0
// Implements `latsch export --bus`: writes the bushings of a suspension as property files of Adams,
// one for each joint.
#pragma once

#include <string>

#include "experiment/language.h"

namespace latsch::cli {

/// Writes one file for each joint, FOLDER/ubj.bus and so on. Throws InputError, before any file is
/// written, if the model is no suspension with bushings or if a bushing cannot be expressed in such
/// a file.
void write_bushings(const std::string& file,
                    const std::string& folder,
                    const experiment::Language& language);

}  // namespace latsch::cli
