// SPDX-License-Identifier: Apache-2.0
// A program that reads TOML files of any kind and prints what their readers request, for
// tools/schemas.py.
//
//   recorded_keys --samples FOLDER   writes the samples of the reference into a folder and prints a
//                                    line `KIND<tab>FILE` for each
//   recorded_keys --sections         prints the sections of the reference as JSON
//   recorded_keys                    reads such lines and answers each with a line of JSON: the
//                                    keys of the file by their paths, or why it was refused
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <exception>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>

#include "base/file.h"
#include "cli/console/console.h"
#include "cli/templates/study_reference.h"
#include "correlation/study_keys.h"

namespace latsch::cli {
namespace {

/// Names of DeclaredKey::Kind, in its order.
constexpr const char* kKinds[] = {"presence",
                                  "table",
                                  "tables",
                                  "quantity",
                                  "quantities",
                                  "one_or_more",
                                  "rows",
                                  "integer",
                                  "flag",
                                  "text",
                                  "choice",
                                  "texts"};

Json declaration(const DeclaredKey& key) {
  const experiment::KeyForm form{key.kind, key.units, key.range, key.choices, key.expected};
  Json json = {{"kind", kKinds[static_cast<int>(key.kind)]},
               {"words", words_of(form)},
               {"is_there", key.is_there},
               {"may_be_missing", key.may_be_missing || key.fallback.has_value()},
               {"is_measurable", key.is_measurable}};
  if (!key.units.empty()) json["units"] = key.units;
  if (!key.choices.empty()) json["choices"] = key.choices;
  if (!key.expected.empty()) json["expected"] = key.expected;
  if (key.fallback) json["fallback"] = *key.fallback;
  if (std::isfinite(key.range.lower)) json["lower"] = key.range.lower;
  if (std::isfinite(key.range.upper)) json["upper"] = key.range.upper;
  json["lower_excluded"] = key.range.lower_excluded;
  return json;
}

Json answer_on(const std::string& line) {
  const std::size_t tab = line.find('\t');
  try {
    Json keys = Json::object();
    for (const auto& [path, key] : correlation::keys_of_file(
             line.substr(0, tab), line.substr(tab + 1), experiment::language()))
      keys[path] = declaration(key);
    return {{"keys", std::move(keys)}};
  } catch (const std::exception& error) {
    return {{"error", error.what()}};
  }
}

void write_samples(const std::filesystem::path& folder) {
  correlation::write_files_of_samples(folder);
  int number = 0;
  for (const auto& [kind, text] : correlation::sampled_files(experiment::language())) {
    const auto file = folder / fmt::format("sample_{:03}.toml", ++number);
    write_text_file(file, text);
    put(fmt::format("{}\t{}\n", kind, file.string()));
  }
}

void print_sections() {
  const auto keys = correlation::read_study_keys(experiment::language());
  Json sections = study_keys_json(keys);
  for (std::size_t i = 0; i < sections.size(); ++i)
    sections[i]["refused"] = keys.sections()[i].section->refused;
  put(sections.dump() + "\n");
}

}  // namespace
}  // namespace latsch::cli

int main(int argc, char** argv) {
  const std::string option = argc > 1 ? argv[1] : "";
  if (option == "--samples" && argc == 3) {
    latsch::cli::write_samples(argv[2]);
    return 0;
  }
  if (option == "--sections") {
    latsch::cli::print_sections();
    return 0;
  }
  for (std::string line; std::getline(std::cin, line);) {
    latsch::cli::put(latsch::cli::answer_on(line).dump() + "\n");
    std::fflush(stdout);  // the other program waits for the answer
  }
  return 0;
}
