// SPDX-License-Identifier: Apache-2.0
#include "formats/text/pipe.h"

#include "base/error.h"

namespace latsch::formats {

void expect_no_pipe(const std::filesystem::path& file) {
  std::error_code ignored;
  const auto status = std::filesystem::status(file, ignored);
  if (!std::filesystem::is_fifo(status) && !std::filesystem::is_socket(status)) return;
  throw InputError({file.string(), 0},
                   "is a pipe, which can be read only once; expected a file: write what comes "
                   "through the pipe into one");
}

}  // namespace latsch::formats
