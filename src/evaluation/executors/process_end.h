// SPDX-License-Identifier: Apache-2.0
// Describes in words how a process ended.
#pragma once

#include <string>
#include <string_view>

namespace latsch {

/// Describes the `status` returned by waitpid(2), for example "exited with code 3; it last printed
/// "no license"", with the last line of `printed` that is not blank.
std::string how_it_ended(int status, std::string_view printed);

}  // namespace latsch
