// SPDX-License-Identifier: Apache-2.0
// Files that a script reads from its own folder: modules it imports, tables it opens. They are
// found by their names in its text, because the outside program itself does not report which files
// it opens.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace latsch {

/// Returns the files beside a script that its text names, and those that these name, sorted by
/// name: `import helper` names helper.py beside a .py file, "table.csv" names table.csv. The script
/// itself, journals, reports and files called as in `without` are left out, and so is everything in
/// other folders. Files that are no text name nothing.
std::vector<std::filesystem::path> files_named_beside(const std::filesystem::path& script,
                                                      const std::set<std::string>& without);

}  // namespace latsch
