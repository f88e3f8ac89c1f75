// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "base/toml/toml_text.h"
#include "base/units.h"
#include "experiment/movable_test.h"
#include "experiment/rigs/slip/slip_states.h"
#include "experiment/table_text.h"
#include "measurement/meaning/natural_unit.h"

namespace latsch::experiment {
namespace {

// Digits of a median that stands in for the values of a table.
constexpr int kMedianDigits = 4;

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Returns the entry `states` with the medians of a table, and adds them to a sentence.
std::string median_states(const Test& test, std::string& assumed) {
  std::string entries, words;
  for (const MeasuredCondition& state : measured_states()) {
    const std::vector<double> values = test.driven_at(state.channel);
    if (values.empty()) continue;
    const std::string unit = natural_unit(state.unit);
    const std::string number =
        format_number(Unit::of(unit).from_si(median_of(values)), kMedianDigits);
    const bool is_plain = unit == "1";
    entries += (entries.empty() ? "" : ", ") + state.channel + " = " +
               (is_plain ? number : toml_text(number + " " + unit));
    words +=
        (words.empty() ? "" : ", ") + state.channel + " " + number + (is_plain ? "" : " " + unit);
  }
  assumed = "one state of the table, with its medians where no setting moves them: " + words;
  return "states = {" + entries + "}\n";
}

bool is_table(const Node& keys, const std::string& key) {
  try {
    return keys.find_table(key).has_value();
  } catch (const InputError&) {
    return false;
  }
}

/// Throws for a condition from a measurement of the study, which a test in a file cannot name.
void refuse_measured(const Node& keys, const std::string& without) {
  for (const std::string& key : keys.keys()) {
    if (key == without || !is_table(keys, key)) continue;
    const Node table = *keys.find_table(key);
    if (table.has("from"))
      table.reject("from",
                   "takes a condition of the test from a measurement, which has no number that a "
                   "design could move or a laboratory could set; write the number, such as " +
                       key + " = \"...\"");
  }
}

}  // namespace

MovableTest::MovableTest(const TestKeys& keys, const Test& test, const Language& language)
    : language_(&language),
      keys_(Document::parse("", keys.keys.place().file)),
      folder_(keys.folder) {
  constexpr const char* kStates = "states";
  const bool has_table = !test.driven_at("Fz").empty() && keys.keys.has(kStates);
  const bool is_stated =
      has_table && is_table(keys.keys, kStates) && !keys.keys.table(kStates).has("from");
  refuse_measured(keys.keys, has_table ? kStates : "");
  std::string text = text_of_table(
      keys.keys,
      has_table && !is_stated ? std::vector<std::string>{kStates} : std::vector<std::string>());
  if (has_table && !is_stated) text += median_states(test, assumed_);
  if (is_stated && test.samples().value_or(1) > 1)
    keys.keys.reject(kStates,
                     fmt::format("has {} states, expected a single one in a test whose settings "
                                 "are designed",
                                 *test.samples()));
  const std::string table = keys.keys.path();
  keys_ = Document::parse(text, keys.keys.place().file + (table.empty() ? "" : " [" + table + "]"));
}

std::vector<std::string> MovableTest::names() const {
  const std::vector<std::string> paths = keys_.paths();
  const auto last = [](const std::string& path) { return path.substr(path.rfind('.') + 1); };
  std::vector<std::string> names;
  for (const std::string& path : paths) {
    const auto alike = std::count_if(
        paths.begin(), paths.end(), [&](const auto& one) { return last(one) == last(path); });
    const bool is_index = last(path).find_first_not_of("0123456789") == std::string::npos;
    names.push_back(alike == 1 && !is_index ? last(path) : path);
  }
  return names;
}

std::optional<std::string> MovableTest::find(const std::string& name) const {
  const std::vector<std::string> paths = keys_.paths(), all = names();
  for (std::size_t k = 0; k < paths.size(); ++k)
    if (paths[k] == name || all[k] == name) return paths[k];
  return std::nullopt;
}

std::unique_ptr<Test> MovableTest::test() const {
  return language_->read_test(keys_.root(), {folder_, nullptr});
}

ReadTest MovableTest::identified() const {
  return language_->read_identified_test(keys_.root(), {folder_, nullptr});
}

std::string MovableTest::text(const std::filesystem::path& folder) const {
  namespace fs = std::filesystem;
  Document document = keys_;
  std::string text = text_of_table(document.root());
  for (const fs::path& file : identified().files) {
    // The reader found the file from the folder of the keys; the text names it from another one.
    const std::string before = toml_text(fs::relative(file, folder_).generic_string());
    const std::string after =
        toml_text(fs::proximate(fs::absolute(file), fs::absolute(folder)).generic_string());
    for (std::size_t at = text.find(before); at != std::string::npos;
         at = text.find(before, at + after.size()))
      text.replace(at, before.size(), after);
  }
  return text;
}

}  // namespace latsch::experiment
