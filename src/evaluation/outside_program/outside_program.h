// SPDX-License-Identifier: Apache-2.0
// Runs an outside program to its end.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"

namespace latsch {

/// Runs the program given as an argument list in `folder`, in the process group of this process,
/// with an empty standard input and its output in the file `printed`. If it does not exit with code
/// 0, returns a Failure that says how it ended and what its last printed line was. After `timeout`
/// seconds (0: never) it is killed with all its descendants; this is a Failure with Cause::timeout.
Status run_program(const std::vector<std::string>& arguments,
                   const std::filesystem::path& folder,
                   const std::filesystem::path& printed,
                   double timeout = 0.0);

/// Returns the path of the program if its file is known: the first match in PATH, or an absolute
/// path that exists; nullopt otherwise.
std::optional<std::filesystem::path> file_of_program(const std::string& program);

/// True if the program is found in PATH or exists at its absolute path. A relative path counts as
/// existing, because the folder it starts from is not known yet.
bool can_be_found(const std::string& program);

}  // namespace latsch
