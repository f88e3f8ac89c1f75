// SPDX-License-Identifier: Apache-2.0
// The JSON schemas of the files that Latsch reads, for editors: docs/schemas in the sources,
// share/latsch/schemas in an installation. A file names its schema in its first line, a comment.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiment/language.h"

namespace latsch::cli {

/// Returns the schema of a kind of file, such as "study" or "car". Throws InputError that lists the
/// kinds if there is none of this kind, or if the program was copied without its schemas.
std::string schema_of(const std::string& kind);

/// Returns the TOML text of a study, a model, a test, a road or a rig behind a line that names its
/// schema. A program installed in /usr names the schema there, which is the same on every machine
/// with that package: `#:schema file:///usr/share/latsch/schemas/latsch-study.json`. Any other
/// program names a copy beside the file, `#:schema ./latsch-study.json`. Returns the text unchanged
/// if it is of another kind or if the program was copied without its schemas.
std::string with_schema(const std::string& text, const experiment::Language& language);

/// Copies the schemas that the TOML files of a folder name as ./latsch-KIND.json into the folder,
/// unless they are there. Returns the files written.
std::vector<std::filesystem::path> place_schemas(const std::filesystem::path& folder);

}  // namespace latsch::cli
