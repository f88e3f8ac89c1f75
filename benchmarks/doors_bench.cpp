// SPDX-License-Identifier: Apache-2.0
// Changes good input files in some 25 ways and checks that no reader misreads a change silently.
//
//   ./bench.sh doors [--named] [--smoke]
//
// The files are the tables of measurements and the Magic Formula tires of the repository, one for
// each header. A changed file counts as
//   same      if its numbers equal those of the good file to 1e-12 and the change keeps its meaning
//   refused   if the reader ends with an error that names the file
//   told      if the reader names the change in a warning, an unknown name or a note
//   rest      if the changed column is no longer a channel of its name and dimension: users of that
//             channel are refused, and all other channels have the same numbers
//   silent    otherwise: --named lists these files
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>

#include "base/error.h"
#include "base/file.h"
#include "base/scratch_folder_testing.h"
#include "correlation/laboratory/measurement.h"
#include "formats/tables/measurement_file.h"
#include "formats/tire/tir_file.h"
#include "mutants.h"
#include "table.h"

namespace latsch::benchmarks {
namespace {

namespace fs = std::filesystem;

constexpr double kSame = 1e-12;
constexpr int kFewestFiles = 40;

/// Result of reading a file: the numbers by name, and every message in which the reader names
/// something.
struct Reading {
  std::map<std::string, std::vector<double>> numbers;
  std::vector<std::string> told;
};

Reading read_table(const fs::path& file) {
  const auto read = correlation::read_measured_file(file);
  Reading reading;
  for (const Channel& channel : read.channels.all())
    reading.numbers[channel.name + " [" + channel.unit + "]"] = channel.values;
  for (const LedgerDoubt& doubt : read.ledger.doubts)
    reading.told.push_back(doubt.name + ": " + doubt.sentence);
  for (const LedgerRow& row : read.ledger.rows)
    if (row.taken_as.empty() || row.state == LedgerState::doubtful)
      reading.told.push_back(row.written + ": not known");
  return reading;
}

/// Reads a table of deflections, or radii, and forces with the reader for load-deflection curves.
Reading read_forces(const fs::path& file) {
  const LoadDeflectionCurve curve = formats::read_load_deflection(file);
  return {{{"position", curve.position}, {"force", curve.force}}, {}};
}

/// Reads a table of modes with the reader for mode tables.
Reading read_mode_table(const fs::path& file) {
  Reading reading;
  for (const auto& mode : formats::read_modes(file).modes)
    reading.numbers["frequency"].push_back(mode.frequency);
  return reading;
}

Reading read_tire(const fs::path& file) {
  const formats::TirFile tire = formats::read_tir(file);
  Reading reading;
  for (const auto& field : magic_formula::parameter_fields())
    reading.numbers[std::string(field.name)] = {tire.parameters.*field.member};
  reading.numbers["version"] = {static_cast<double>(tire.parameters.version)};
  reading.numbers["side"] = {static_cast<double>(tire.parameters.side)};
  reading.told = tire.notes;
  for (const LedgerDoubt& doubt : tire.doubts)
    reading.told.push_back(doubt.name + ": " + doubt.sentence);
  return reading;
}

bool is_same(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i] == b[i] || (std::isnan(a[i]) && std::isnan(b[i]))) continue;
    if (!(std::abs(a[i] - b[i]) <= kSame * std::max(1.0, std::abs(a[i])))) return false;
  }
  return true;
}

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// Compares the numbers by name without regard to case, because unknown names in a file written in
/// capitals may keep their spelling.
bool is_same(const Reading& a, const Reading& b) {
  std::map<std::string, const std::vector<double>*> there;
  for (const auto& [name, values] : b.numbers) there[lower(name)] = &values;
  if (there.size() != a.numbers.size()) return false;
  for (const auto& [name, values] : a.numbers) {
    const auto found = there.find(lower(name));
    if (found == there.end() || !is_same(values, *found->second)) return false;
  }
  return true;
}

/// True if the changed file lacks a channel of the unchanged file, and all channels that both files
/// contain are equal.
bool is_rest(const Reading& good, const Reading& read) {
  bool one_is_gone = false;
  for (const auto& [name, values] : good.numbers) {
    const auto found = read.numbers.find(name);
    one_is_gone = one_is_gone || found == read.numbers.end();
    if (found != read.numbers.end() && !is_same(values, found->second)) return false;
  }
  return one_is_gone;
}

/// True if the reader reports something that it does not report for the unchanged file, or mentions
/// the changed name.
bool tells(const Mutant& mutant, const Reading& good, const Reading& read) {
  const std::set<std::string> usual(good.told.begin(), good.told.end());
  for (const std::string& sentence : read.told)
    if (!usual.contains(sentence)) return true;
  return !mutant.touched.empty() &&
         std::any_of(read.told.begin(), read.told.end(), [&](const std::string& sentence) {
           return sentence.find(mutant.touched) != std::string::npos;
         });
}

struct Counts {
  int files = 0, mutants = 0, same = 0, rest = 0, refused = 0, told = 0, silent = 0,
      wrong_errors = 0;
  std::vector<std::string> named = {};
};

class Doors {
 public:
  using Reader = Reading (*)(const fs::path&);

  /// Reads the good file, then every changed version of it. Each version is written to a file with
  /// the ending of the good one.
  void go_through(const fs::path& file, const std::vector<Mutant>& mutants, Reader reader) {
    const fs::path copy = folder_ / ("changed" + file.extension().string());
    write_text_file(copy, read_text_file(file));
    // all versions of the file have the same name, because messages contain the name
    const Reading good = reader(copy);
    ++counts.files;
    for (const Mutant& mutant : mutants) {
      const fs::path changed = folder_ / ("changed" + file.extension().string());
      write_text_file(changed, mutant.text);
      ++counts.mutants;
      judge(file, mutant, good, changed, reader);
    }
  }

  Counts counts;

 private:
  void judge(const fs::path& file,
             const Mutant& mutant,
             const Reading& good,
             const fs::path& changed,
             Reader reader) {
    try {
      const Reading read = reader(changed);
      if (is_same(good, read) && mutant.allowed == Allowed::same_numbers) {
        ++counts.same;
      } else if (tells(mutant, good, read)) {
        ++counts.told;
      } else if (mutant.allowed == Allowed::the_rest && is_rest(good, read)) {
        ++counts.rest;
      } else if (is_same(good, read)) {
        ++counts.same;  // the change has no effect on the numbers read
      } else {
        ++counts.silent;
        counts.named.push_back(file.string() + ": " + mutant.change + " (" + mutant.touched + ")");
      }
    } catch (const InputError& error) {
      ++counts.refused;
      if (std::string(error.what()).find(changed.filename().string()) != std::string::npos) return;
      ++counts.wrong_errors;
      counts.named.push_back(file.string() + ": " + mutant.change + ": " + error.what());
    }
  }

  ScratchFolder folder_;
};

/// Returns the unchanged files: the measured tables of the repository, one for each header, and its
/// tires.
std::vector<fs::path> good_files() {
  const fs::path tree = LATSCH_SOURCE_DIR;
  std::vector<fs::path> files;
  for (const char* folder : {"studies", "verification/old_journals", "verification/simbody"})
    for (const auto& entry : fs::recursive_directory_iterator(tree / folder)) {
      const std::string ending = entry.path().extension().string();
      if (ending == ".csv" || ending == ".tir") files.push_back(entry.path());
    }
  std::sort(files.begin(), files.end());
  return files;
}

/// Returns the reader for a table: the special reader of its kind if there is one.
Doors::Reader reader_of(const TableText& table) {
  const auto has = [&](const char* name) {
    return std::find(table.names.begin(), table.names.end(), name) != table.names.end();
  };
  if (has("force") && (has("deflection") || has("loaded_radius"))) return read_forces;
  return has("frequency") ? read_mode_table : read_table;
}

int run(const Options& options) {
  const bool smoke = options.is_smoke();
  Doors doors;
  std::set<std::string> heads;
  for (const fs::path& file : good_files()) {
    const std::string text = read_text_file(file);
    if (smoke && doors.counts.files >= 4) break;
    if (file.extension() == ".tir") {
      doors.go_through(file, mutants_of_sections(text), read_tire);
      continue;
    }
    auto table = table_text(text);
    // mode shapes are read together with the modes, so a table of shapes is not read alone
    if (!table || table->names.front() == "mode") continue;
    constexpr std::size_t kMostRows = 200;
    if (table->rows.size() > kMostRows) table->rows.resize(kMostRows);
    const bool is_new_head = heads.insert(fmt::format("{}", table->text().substr(0, 400))).second;
    if (!is_new_head) continue;
    ScratchFolder folder;
    const fs::path good = folder / file.filename();
    write_text_file(good, table->text());
    doors.go_through(good, mutants_of_table(*table), reader_of(*table));
  }
  const Counts& c = doors.counts;
  if (options.has("--named"))
    for (const std::string& one : c.named) fmt::print("{}\n", one);
  Table table("doors", options);
  table.row("good files",
            fmt::format("{}", c.files),
            smoke ? ">= 4" : ">= 40",
            c.files >= (smoke ? 4 : kFewestFiles));
  table.note("mutants", fmt::format("{}", c.mutants));
  table.note("read to the same numbers", fmt::format("{}", c.same));
  table.note("the rest read to the same numbers", fmt::format("{}", c.rest));
  table.note("refused", fmt::format("{}", c.refused));
  table.note("told by name", fmt::format("{}", c.told));
  table.row("errors that do not name the file",
            fmt::format("{}", c.wrong_errors),
            "0",
            c.wrong_errors == 0);
  table.row("silent", fmt::format("{}", c.silent), "0", c.silent == 0);
  return table.exit_code();
}

}  // namespace
}  // namespace latsch::benchmarks

int main(int argc, char** argv) {
  return latsch::benchmarks::run_benchmark(
      argc, argv, {{"--named", "", "lists the silent ones"}}, latsch::benchmarks::run);
}
