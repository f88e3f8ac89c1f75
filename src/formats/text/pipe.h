// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace latsch::formats {

/// Throws InputError if the path leads to a pipe or a socket. Its contents can be read only once,
/// but a study, a model and a comparison are read several times, also by workers.
void expect_no_pipe(const std::filesystem::path& file);

}  // namespace latsch::formats
