// SPDX-License-Identifier: Apache-2.0
// From what an importer says to an instance.
#pragma once

#include <memory>
#include <string>

#include "exchange/instance.h"

namespace latsch::exchange {

/// The folder an URI of FMI 2.0 names: "file:///tmp/a%20b" is "/tmp/a b" [RFC 3986; RFC 8089]; a
/// path is itself. InputError for another scheme, another machine.
std::string folder_of_uri(const std::string& uri);

/// nullptr, and why in the log, where the folder holds no unit or another one than `token` says.
std::unique_ptr<Instance> load_instance(const std::string& folder,
                                        const std::string& token,
                                        const Instance::Log& log);

}  // namespace latsch::exchange
