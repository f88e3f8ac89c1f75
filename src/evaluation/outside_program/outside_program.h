// SPDX-License-Identifier: Apache-2.0
// Runs a program of somebody else to its end.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"

namespace latsch {

/// Runs the program of that argument list in that folder, with nothing on its standard input and
/// what it prints in `printed`, in the process group of this process. The Failure says how it ended
/// unless with exit code 0, and the last line it printed. After `timeout` seconds (0: never) it is
/// killed with all that descends from it; that is a Failure with Cause::timeout.
std::optional<Failure> run_program(const std::vector<std::string>& arguments,
                                   const std::filesystem::path& folder,
                                   const std::filesystem::path& printed,
                                   double timeout = 0.0);

/// The file of such a program, where it is known: in PATH or, with a path from the root, there.
std::optional<std::filesystem::path> file_of_program(const std::string& program);

/// Whether there is such a program: in PATH or, with a path from the root, there. Of another path
/// it is not known before there is a folder it starts from: true.
bool can_be_found(const std::string& program);

}  // namespace latsch
