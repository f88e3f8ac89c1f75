// SPDX-License-Identifier: Apache-2.0
// How a process ended, in words.
#pragma once

#include <string>
#include <string_view>

namespace latsch {

/// `status` of waitpid: "exited with code 3; it last printed "no license"", from the last line of
/// `printed` that is not blank.
std::string how_it_ended(int status, std::string_view printed);

}  // namespace latsch
