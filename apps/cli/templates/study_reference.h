// SPDX-License-Identifier: Apache-2.0
// The reference of all keys of a study: `latsch help study`, docs/study_reference.md.
#pragma once

#include <string>
#include <vector>

#include "experiment/language/key_section.h"
#include "formats/text/json.h"

namespace latsch::cli {

/// Returns the reference as a Markdown page: a section for each table of a study, with an example
/// and a row for each key.
std::string study_reference(const experiment::KeyTable& keys);

/// Returns the sections, in the form of the page, of a kind of test such as "rolling" or of a table
/// such as "optimizer"; if no test or table has this name, those whose headings contain the word.
/// Returns an empty text if there is none.
std::string study_reference_on(const experiment::KeyTable& keys, const std::string& word);

/// Returns the names of tests and tables: the first word in brackets or quotation marks of every
/// heading that has one.
std::vector<std::string> study_reference_words(const experiment::KeyTable& keys);

/// Returns the reference for programs: a list of sections, each with the path of its table, its
/// text and its keys. A key has its path below the table, its description, the forms of its values
/// (kind, SI units, range, choices) and its default. "*" in a path stands for a name that the user
/// chooses.
Json study_keys_json(const experiment::KeyTable& keys);

/// Returns what a form of a key accepts, in words: "a length such as `\"25 mm\"`, above 0".
std::string words_of(const experiment::KeyForm& form);

}  // namespace latsch::cli
