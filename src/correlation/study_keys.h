// SPDX-License-Identifier: Apache-2.0
// All keys of a study: the table from which `latsch help study` and docs/study_reference.md are
// written. The keys of every other kind of TOML file, from which docs/schemas is written.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "experiment/language.h"
#include "experiment/language/key_section.h"

namespace latsch::correlation {

/// Reads the samples of all sections in a temporary folder and returns what their readers declare,
/// in the order of the reference. Tests are those of the language. Throws InputError if a sample is
/// refused.
experiment::KeyTable read_study_keys(const experiment::Language& language);

/// A sample of a section as a whole file.
struct SampledFile {
  std::string kind;  // "study", "suite", "test" or "road"
  std::string text;  // TOML
};

/// Returns the samples of all sections as whole files.
std::vector<SampledFile> sampled_files(const experiment::Language& language);

/// Writes the files that samples name into a folder. Throws InputError if that fails.
void write_files_of_samples(const std::filesystem::path& folder);

/// Returns the kinds of TOML files that the program reads: "study", "test", "car" ...
const std::vector<std::string>& kinds_of_files();

/// Reads a file and returns every key that its readers request, by its path. A study may use the
/// model of the samples, and its measurements have to be there. Throws InputError for a wrong file,
/// or if `kind` is none of kinds_of_files().
std::map<std::string, DeclaredKey> keys_of_file(const std::string& kind,
                                                const std::filesystem::path& file,
                                                const experiment::Language& language);

}  // namespace latsch::correlation
