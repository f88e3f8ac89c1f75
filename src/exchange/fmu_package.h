// SPDX-License-Identifier: Apache-2.0
// Packs a functional mock-up unit (FMU) as a ZIP file of FMI 2.0 [2.0.5, 2.3] or 3.0 [3.0.2, 2.5].
//
//   modelDescription.xml
//   binaries/linux64/NAME.so  or  binaries/x86_64-linux/NAME.so
//   resources/                              the unit's files, unit_folder.h
//   documentation/externalDependencies.txt  libraries that the machine has to have
//
// Equal content gives equal bytes, because all files have the same date. The binary is for Linux on
// x86-64 only.
#pragma once

#include <filesystem>
#include <string>

#include "exchange/model_description.h"
#include "exchange/unit_folder.h"

namespace latsch::exchange {

/// Returns the bytes of the package. `library` is the file that becomes the binary. Throws
/// InputError if it cannot be read.
std::string fmu_package(FmiVersion version,
                        const UnitTitle& title,
                        const std::vector<ExchangedVariable>& variables,
                        const std::filesystem::path& library,
                        const UnitFiles& resources);

}  // namespace latsch::exchange
