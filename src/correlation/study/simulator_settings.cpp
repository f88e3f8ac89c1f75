// SPDX-License-Identifier: Apache-2.0
#include "correlation/study/simulator_settings.h"

#include <algorithm>
#include <regex>

#include "base/file.h"
#include "base/text.h"
#include "base/unit_reading.h"
#include "correlation/study/variables.h"

namespace latsch::correlation {
namespace {

namespace fs = std::filesystem;

constexpr long kMostColumns = 10'000;
constexpr long kMostSamples = 10'000'000;

/// Reads "uz [mm]": a name and its unit in the file.
OutputReader::Quantity parse_quantity_name(const Node& table, const std::string& text) {
  const std::size_t open = text.find('[');
  OutputReader::Quantity quantity{std::string(trimmed(text.substr(0, open))), "1"};
  if (open != std::string::npos) {
    const std::size_t close = text.find(']', open);
    quantity.unit = text.substr(open + 1, close - open - 1);
    const UnitReading reading = reading_of_unit(quantity.unit);
    if (close == std::string::npos || !reading.unit) {
      table.reject("quantities",
                   "has " + in_quotes(text) +
                       R"(, expected a name and a unit such as "force [N]")" +
                       (reading.unit ? "" : " (" + reading.fault + ")"));
    }
  }
  if (quantity.name.empty()) table.reject("quantities", "has a quantity without a name");
  return quantity;
}

std::vector<int> read_numbers_of_columns(const Node& table) {
  std::vector<int> columns;
  for (const double column : table.quantities("columns", "1", Range::between(1, kMostColumns))) {
    columns.push_back(static_cast<int>(column));
    if (columns.back() != column) table.reject("columns", "are positions, expected whole numbers");
  }
  return columns;
}

void read_pattern(const Node& table, OutputReader& reader) {
  reader.pattern = table.text("pattern");
  reader.after = table.text("after", "");
  std::size_t groups = 0;
  try {
    groups = std::regex(reader.pattern).mark_count();
  } catch (const std::regex_error& error) {
    table.reject("pattern", std::string("is not a regular expression: ") + error.what());
  }
  if (groups != reader.quantities.size()) {
    table.reject("pattern",
                 "has " + std::to_string(groups) +
                     " groups in brackets, expected one for each of " +
                     std::to_string(reader.quantities.size()) + " quantities");
  }
}

void expect_as_many(const Node& table, const char* key, std::size_t found, std::size_t expected) {
  if (found == expected) return;
  table.reject(key,
               "are " + std::to_string(found) + ", expected one for each of " +
                   std::to_string(expected) + " quantities");
}

OutputReader read_reader(const Node& table) {
  OutputReader reader{table.name(), table.text("file"), {}, {}};
  for (const std::string& text : table.texts("quantities")) {
    reader.quantities.push_back(parse_quantity_name(table, text));
  }
  if (reader.quantities.empty()) table.reject("quantities", "is empty, expected at least one");
  reader.samples = static_cast<int>(table.integer("samples", 1, kMostSamples, 0));
  const std::string kind = table.choice("reader", {"table", "columns", "keys", "pattern", "tydex"});
  if (kind == "columns") {
    reader.kind = OutputReader::Kind::columns;
    reader.columns = read_numbers_of_columns(table);
    expect_as_many(table, "columns", reader.columns.size(), reader.quantities.size());
  } else if (kind == "keys") {
    reader.kind = OutputReader::Kind::keys;
    if (table.has("keys")) {
      reader.keys = table.texts("keys");
    } else {
      for (const auto& quantity : reader.quantities) reader.keys.push_back(quantity.name);
    }
    expect_as_many(table, "keys", reader.keys.size(), reader.quantities.size());
  } else if (kind == "pattern") {
    reader.kind = OutputReader::Kind::pattern;
    read_pattern(table, reader);
  } else if (kind == "tydex") {
    reader.kind = OutputReader::Kind::tydex;
  }
  return reader;
}

fs::path existing(const Node& table,
                  const char* key,
                  const fs::path& folder,
                  const fs::path& name) {
  const fs::path file = folder / name;
  if (!fs::exists(file)) {
    table.reject(key, "names " + in_quotes(file.string()) + ", which does not exist");
  }
  return file;
}

void expect_holes(const Node& table, const Simulator& simulator, const DesignSpace& space) {
  for (int i = 0; i < space.size(); ++i) {
    const auto uses = [&](const Simulator::Input& input) { return input.text.uses(i); };
    if (std::any_of(simulator.inputs.begin(), simulator.inputs.end(), uses)) continue;
    table.reject("inputs",
                 "have no hole {" + space[i].name +
                     "} for that variable; write the hole in place of its value");
  }
}

/// Returns the unit in which the initial value is written; a plain number has none.
std::string written_unit(const Node& table) {
  try {
    const auto written = parse_quantity(table.text("initial"));
    return written ? written->unit.text() : "1";
  } catch (const InputError&) {
    return "1";
  }
}

}  // namespace

DesignVariable read_free_variable(const Node& table) {
  DesignVariable variable;
  variable.name = table.name();
  variable.place = table.place();
  variable.unit = table.has("unit") ? table.text("unit") : written_unit(table);
  const UnitReading reading = reading_of_unit(variable.unit);
  if (!reading.unit) table.reject("unit", "is " + reading.fault);
  const std::string si = si_unit(Unit::of(variable.unit).dimension());
  variable.lower = table.quantity("lower", si);
  variable.upper = table.quantity("upper", si);
  variable.initial = table.quantity("initial", si);
  variable.scale = table.choice("scale", {"linear", "logarithmic"}, "linear") == "linear"
                       ? Scale::linear
                       : Scale::logarithmic;
  read_prior(table, si, variable);
  return variable;
}

Simulator read_simulator(const Node& table, const fs::path& study, const DesignSpace& space) {
  Simulator simulator;
  simulator.study_folder = study.has_parent_path() ? study.parent_path() : fs::path(".");
  simulator.scratch = fs::absolute(simulator.study_folder / (study.stem().string() + ".scratch"));
  simulator.arguments = table.texts("command");
  if (simulator.arguments.empty()) table.reject("command", "is empty, expected a program");
  for (const std::string& name : table.texts("inputs")) {
    const fs::path file = existing(table, "inputs", simulator.study_folder, name);
    simulator.inputs.push_back({fs::path(name).filename().string(),
                                InputTemplate(read_text_file(file), file.string(), space)});
  }
  if (table.has("files")) {
    for (const std::string& name : table.texts("files")) {
      existing(table, "files", simulator.study_folder, name);
      simulator.copied.push_back(name);
    }
  }
  expect_holes(table, simulator, space);
  for (const Node& output : table.named_tables("output")) {
    simulator.outputs.push_back(read_reader(output));
  }
  if (simulator.outputs.empty()) {
    table.reject("output", "is missing, expected at least one [simulator.output.NAME]");
  }
  if (table.has("timeout")) {
    simulator.timeout = table.quantity("timeout", "s", Range::positive(), simulator.timeout);
  }
  simulator.keep_failed = table.flag("keep_failed", false);
  return simulator;
}

}  // namespace latsch::correlation
