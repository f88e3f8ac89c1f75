// SPDX-License-Identifier: Apache-2.0
#include "experiment/keys_of_tests.h"

#include <algorithm>

#include "base/file.h"
#include "experiment/tests/keys/sample_files.h"
#include "models/road/road_reader.h"

namespace latsch::experiment {

const KeySection& roads_keys();

namespace {

/// True for keys of the table by which a condition is taken from a measurement, {from =
/// "measurement.NAME"}.
bool is_below_measured(const std::string& path, const std::map<std::string, DeclaredKey>& keys) {
  const std::size_t dot = path.rfind('.');
  if (dot == path.npos) return false;
  const auto table = keys.find(path.substr(0, dot));
  return table != keys.end() && table->second.is_measurable;
}

}  // namespace

void add_section(const KeySection& section, std::vector<const KeySection*>& sections) {
  if (std::find(sections.begin(), sections.end(), &section) != sections.end()) return;
  sections.push_back(&section);
  for (const SharedKeys& shared : section.shared) add_section(shared.section(), sections);
}

std::vector<const KeySection*> test_sections(const Language& language) {
  std::vector<const KeySection*> sections;
  for (const TestKind* test : language.tests)
    if (test->keys) add_section(test->keys(), sections);
  return sections;
}

void write_sample_files(const std::filesystem::path& folder) {
  for (const SampleFile& file : sample_files()) write_text_file(folder / file.name, file.text);
}

std::map<std::string, DeclaredKey> keys_of_test(const Language& language,
                                                const std::string& sample,
                                                const std::filesystem::path& folder) {
  const Document document = Document::parse(sample, "sample.toml");
  const DocumentRecord record(document.root());
  language.read_test(record.node(), source_of_samples(folder));
  std::map<std::string, DeclaredKey> keys = record.keys();
  std::erase_if(keys, [all = record.keys()](const auto& key) {
    return key.first == "kind" || is_below_measured(key.first, all);
  });
  return keys;
}

std::map<std::string, DeclaredKey> keys_of_test_file(const Language& language,
                                                     const std::filesystem::path& file) {
  const Document document = Document::read(file);
  const DocumentRecord record(document.root());
  language.read_test(record.node(), source_of_samples(file.parent_path()));
  return record.keys();
}

std::map<std::string, DeclaredKey> keys_of_road_file(const std::filesystem::path& file) {
  const Document document = Document::read(file);
  const DocumentRecord record(document.root());
  road::read_road(record.node());
  return record.keys();
}

void add_keys_of_tests(const Language& language,
                       const std::filesystem::path& folder,
                       KeyTable& table) {
  for (const TestKind* test : language.tests) {
    if (!test->keys) continue;
    for (const std::string& sample : test->keys().samples)
      table.add(test->keys(), keys_of_test(language, sample, folder));
  }
  const auto& sections = table.sections();
  const bool has_roads = std::any_of(sections.begin(), sections.end(), [](const auto& one) {
    return one.section == &roads_keys();
  });
  for (const std::string& sample : roads_keys().samples) {
    if (!has_roads) break;
    const Document document = Document::parse(sample, "sample.toml");
    const DocumentRecord record(document.root());
    road::read_road(record.node());
    table.add(roads_keys(), record.keys());
  }
}

}  // namespace latsch::experiment
