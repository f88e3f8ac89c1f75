// SPDX-License-Identifier: Apache-2.0
// The keys of every kind of test, as reading their samples declares them.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "base/document_record.h"
#include "experiment/language.h"
#include "experiment/language/key_section.h"

namespace latsch::experiment {

/// Adds a section and, after it, those of the keys that it shares, unless they have been added
/// before.
void add_section(const KeySection& section, std::vector<const KeySection*>& sections);

/// Returns the sections of the language's tests, in its order: each section once, followed by those
/// of keys that it shares.
std::vector<const KeySection*> test_sections(const Language& language);

/// Writes the files that samples of tests name into a folder. Throws InputError if that fails.
void write_sample_files(const std::filesystem::path& folder);

/// Returns the keys that the reading of a test's sample declares, without `kind`. The folder holds
/// the files of the samples.
std::map<std::string, DeclaredKey> keys_of_test(const Language& language,
                                                const std::string& sample,
                                                const std::filesystem::path& folder);

/// Reads a file of a test and returns every key that its readers request. Conditions from a
/// measurement are those of a sample. Throws InputError for a wrong file.
std::map<std::string, DeclaredKey> keys_of_test_file(const Language& language,
                                                     const std::filesystem::path& file);

/// Reads a road in a TOML file and returns every key that its reader requests. Throws InputError
/// for a wrong file.
std::map<std::string, DeclaredKey> keys_of_road_file(const std::filesystem::path& file);

/// Adds the keys of all these tests and of roads to a table that contains their sections.
void add_keys_of_tests(const Language& language,
                       const std::filesystem::path& folder,
                       KeyTable& table);

}  // namespace latsch::experiment
