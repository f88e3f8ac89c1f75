// SPDX-License-Identifier: Apache-2.0
// Packs a functional mock-up unit (FMU) as a ZIP file of FMI 2.0 [2.0.5, 2.3] or 3.0 [3.0.2, 2.5].
//
//   modelDescription.xml
//   binaries/linux64/NAME.so  or  binaries/x86_64-linux/NAME.so
//   binaries/win64/NAME.dll   or  binaries/x86_64-windows/NAME.dll
//   resources/                              the unit's files, unit_folder.h
//   documentation/externalDependencies.txt  libraries that the machine has to have
//   documentation/licenses/licenses.txt     licenses of the code inside the libraries
//
// Equal content gives equal bytes, because all files have the same date.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "exchange/package/unit_folder.h"
#include "exchange/unit/model_description.h"

namespace latsch::exchange {

/// A library of a package. One with the ending ".so" is for Linux, ".dll" for Windows, both on
/// x86-64.
struct UnitLibrary {
  std::filesystem::path file;
  bool is_slim = true;  // false: it needs the shared libraries of the program
};

/// Returns the bytes of the package with these binaries, one for each system. Throws InputError if
/// one cannot be read.
std::string fmu_package(FmiVersion version,
                        const UnitTitle& title,
                        const std::vector<ExchangedVariable>& variables,
                        const std::vector<UnitLibrary>& libraries,
                        const UnitFiles& resources);

}  // namespace latsch::exchange
