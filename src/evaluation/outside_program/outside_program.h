// SPDX-License-Identifier: Apache-2.0
// Runs an outside program to its end.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"

namespace latsch {

/// Runs the program of that argument list in `folder`, in the process group of this process, with
/// an empty standard input and its output in the file `printed`. Unless it exits with code 0, the
/// Failure says how it ended and the last line it printed. After `timeout` seconds (0: never) it is
/// killed with all its descendants; that is a Failure with Cause::timeout.
Status run_program(const std::vector<std::string>& arguments,
                   const std::filesystem::path& folder,
                   const std::filesystem::path& printed,
                   double timeout = 0.0);

/// Returns the file of such a program if it is known: found in PATH, or existing if the path is
/// absolute.
std::optional<std::filesystem::path> file_of_program(const std::string& program);

/// True if the program exists: in PATH, or at its absolute path. A relative path counts as
/// existing, because the folder it starts from is not known yet.
bool can_be_found(const std::string& program);

}  // namespace latsch
