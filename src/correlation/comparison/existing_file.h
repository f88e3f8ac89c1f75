// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "base/document.h"
#include "base/text.h"

namespace latsch::correlation {

/// Returns the file that `table` names under `key`, relative to `folder`. Throws InputError if it
/// does not exist.
inline std::filesystem::path existing_file(const Node& table,
                                           const char* key,
                                           const std::filesystem::path& folder) {
  std::filesystem::path file = (folder / table.text(key)).lexically_normal();
  if (!std::filesystem::exists(file))
    table.reject(key, "is " + in_quotes(file.string()) + ", which does not exist");
  return file;
}

}  // namespace latsch::correlation
