// SPDX-License-Identifier: Apache-2.0
// Creates the instance of an FMU from the arguments that an importing program passes.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "exchange/instance.h"
#include "exchange/unit/unit_models.h"
#include "exchange/unit/unit_reading.h"

namespace latsch::exchange {

/// Returns the folder of the resource URI of FMI 2.0: "file:///tmp/a%20b" is "/tmp/a b", and
/// "file:///C:/a" is "C:/a" [RFC 3986; RFC 8089]. A path is returned unchanged, also one of Windows
/// with a drive or a server. Throws InputError for another scheme or another machine.
std::string folder_of_uri(const std::string& uri);

/// Returns the models of which this library makes units: all of them (full_models.cpp), or those of
/// a slim library (slim/slim_models.cpp).
const UnitModels& models_of_library();

/// Returns the tire of a file of any rolling tire, with any units. A slim library throws
/// InputError, which names the command that makes a file for it.
TireFromFolder tire_as_written(const std::filesystem::path& file);

/// Creates the instance from the folder. Returns nullptr, with the reason in the log, if the folder
/// contains no unit or one with another token.
std::unique_ptr<Instance> load_instance(const std::string& folder,
                                        const std::string& token,
                                        const Instance::Log& log);

}  // namespace latsch::exchange
