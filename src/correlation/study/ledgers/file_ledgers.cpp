// SPDX-License-Identifier: Apache-2.0
#include "correlation/study/ledgers/file_ledgers.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "base/document_record.h"
#include "base/file.h"
#include "base/text.h"
#include "base/unit_reading.h"
#include "correlation/laboratory/measurement.h"
#include "formats/car/bus_file.h"
#include "formats/car/car_file_doubts.h"
#include "formats/deck/inp_doubts.h"
#include "formats/road/road_file.h"
#include "formats/tables/csv_table.h"
#include "formats/text/letter_case.h"
#include "formats/tire/tir_file.h"
#include "formats/tire/tir_ledger.h"

namespace latsch::correlation {
namespace {

namespace fs = std::filesystem;

std::string ending_of_file(const fs::path& file) {
  return formats::lower(file.extension().string());
}

fs::path settled(const fs::path& file) {
  std::error_code none;
  const fs::path path = fs::weakly_canonical(file, none);
  return none ? file.lexically_normal() : path;
}

/// Returns the kind of file that a name's extension stands for; empty if it is not known.
std::string kind_by_ending(const std::string& ending) {
  static const std::map<std::string, std::string> kKinds = {{".bus", "bushing"},
                                                            {".inp", "finite-element deck"},
                                                            {".rdf", "road"},
                                                            {".crg", "road"},
                                                            {".xml", "FMI description"},
                                                            {".py", "outside program"}};
  const auto known = kKinds.find(ending);
  return known == kKinds.end() ? "file" : known->second;
}

LedgerRow row_of_file(const fs::path& file, const std::string& by) {
  LedgerRow row;
  row.written = file.filename().string();
  row.taken_as = kind_by_ending(ending_of_file(file));
  Ledger::use(row, by);
  return row;
}

/// Returns the rows of a document: one for each key, in the order of the file.
class DocumentRows {
 public:
  DocumentRows(const fs::path& file, std::string by)
      : folder_(file.parent_path()), by_(std::move(by)) {
    ledger.file = file.string();
    const Document document = Document::read(file);
    take_lines(read_text_file(file));
    take_values(document);
    walk(document.root());
    ledger.doubts = formats::doubts_of_car_file(document.root());
  }

  Ledger ledger;
  std::vector<fs::path> named;  // files that the document names

 private:
  void take_lines(std::string_view text) {
    while (!text.empty()) {
      const std::size_t end = text.find('\n');
      lines_.emplace_back(text.substr(0, end));
      text = end == text.npos ? std::string_view() : text.substr(end + 1);
    }
  }

  void take_values(const Document& document) {
    const std::string all = canonical_text(document);
    for (std::string_view text = all; !text.empty();) {
      const std::size_t end = text.find('\n');
      const std::string_view line = text.substr(0, end);
      const std::size_t equals = line.find(" = ");
      if (equals != line.npos)
        values_[std::string(line.substr(0, equals))] = line.substr(equals + 3);
      text = end == text.npos ? std::string_view() : text.substr(end + 1);
    }
  }

  void walk(const Node& node) {
    for (const std::string& key : node.keys()) {
      if (const auto table = as_table(node, key))
        walk(*table);
      else
        add(node, key);
    }
  }

  static std::optional<Node> as_table(const Node& node, const std::string& key) {
    try {
      return node.table(key);
    } catch (const InputError&) {
      return std::nullopt;
    }
  }

  void add(const Node& node, const std::string& key) {
    LedgerRow row;
    row.written = node.path().empty() ? key : node.path() + "." + key;
    row.taken_as = row.written;
    row.line = node.place(key).line;
    take_unit(row);
    const auto value = values_.find(row.written);
    if (value != values_.end()) row.meaning = shortened(value->second);
    Ledger::use(row, by_);
    ledger.rows.push_back(std::move(row));
    take_file(node, key);
  }

  static std::string shortened(std::string text) {
    constexpr std::size_t kLongest = 60;  // bytes of a value in a table
    if (text.size() <= kLongest) return text;
    text.resize(kLongest);
    while (!text.empty() && (static_cast<unsigned char>(text.back()) & 0x80)) text.pop_back();
    return text + " ...";
  }

  /// Returns the unit of a quantity as written in the line of its key.
  void take_unit(LedgerRow& row) {
    if (row.line < 1 || row.line > static_cast<int>(lines_.size())) return;
    const std::string& line = lines_[static_cast<std::size_t>(row.line - 1)];
    const std::size_t equals = line.find('=');
    if (equals == line.npos) return;
    std::string_view text = trimmed(std::string_view(line).substr(equals + 1));
    if (text.size() < 2 || text.front() != '"') return;
    text = text.substr(1, text.find('"', 1) - 1);
    const auto parts = split_number(text);
    if (!parts || parts->rest.empty()) return;
    const auto unit = Unit::find(parts->rest);
    if (!unit) return;
    row.unit_written = parts->rest;
    row.unit = si_unit(unit->dimension());
    row.offset = unit->to_si(0.0L);
    row.factor = unit->to_si(1.0L) - row.offset;
  }

  void take_file(const Node& node, const std::string& key) {
    std::vector<std::string> texts;
    try {
      texts = {node.text(key)};
    } catch (const InputError&) {
      try {
        texts = node.texts(key);
      } catch (const InputError&) {
      }
    }
    for (std::string text : texts) {
      std::error_code none;
      if (text.starts_with("{study}/")) text.erase(0, 8);  // script of an external program
      if (!text.empty() && fs::is_regular_file(folder_ / text, none))
        named.push_back(folder_ / text);
    }
  }

  fs::path folder_;
  std::string by_;
  std::vector<std::string> lines_;
  std::map<std::string, std::string> values_;
};

/// Returns the ledger of a road file: its kind, the parts that are used, and the parts that are
/// not.
Ledger ledger_of_road(const fs::path& file, const std::string& by) {
  const formats::RoadFile road = formats::read_road_file(file);
  Ledger ledger{file.string()};
  LedgerRow row = row_of_file(file, by);
  row.meaning = road.kind;
  ledger.rows.push_back(std::move(row));
  for (const std::string& fact : road.facts) {
    LedgerRow about;
    about.written = fact;
    about.taken_as = "surface";
    Ledger::use(about, by);
    ledger.rows.push_back(std::move(about));
  }
  for (const formats::TeimOrbitPart& part : road.unused) {
    LedgerRow unused;
    unused.written = part.name;
    unused.line = part.line;
    unused.remark = "is not used";
    ledger.rows.push_back(std::move(unused));
  }
  for (const std::string& name : road.kept) {
    LedgerRow unused;
    unused.written = name;
    unused.remark = "does not concern the surface";
    ledger.rows.push_back(std::move(unused));
  }
  ledger.doubts = road.doubts;
  for (const std::string& warning : road.warnings) ledger.doubts.push_back({"", warning, {}});
  return ledger;
}

/// Returns the ledger of a finite-element deck: its units, and its doubtful statements.
Ledger ledger_of_deck(const fs::path& file, const std::string& by) {
  const formats::InpDeck deck = formats::read_inp(file);
  Ledger ledger{file.string()};
  ledger.rows.push_back(row_of_file(file, by));
  if (!deck.are_units_stated) {
    LedgerRow units;
    units.taken_as = "units";
    units.state = LedgerState::assumed;
    units.remark = formats::in_words(deck.units) + ", by the size of the mesh";
    ledger.rows.push_back(std::move(units));
  }
  ledger.doubts = formats::doubts_of_deck(deck);
  return ledger;
}

/// Returns the ledger of a bushing file: how the reader interpreted each part.
Ledger ledger_of_bushing(const fs::path& file, const std::string& by) {
  Ledger ledger = formats::read_bus_file(file).ledger;
  for (LedgerRow& row : ledger.rows)
    if (row.state == LedgerState::used) row.used_by = {by};
  return ledger;
}

/// Returns the ledger of a table of which only the reader is known.
Ledger ledger_of_table(const fs::path& file, const std::string& by) {
  const auto table = formats::CsvTable::read(file);
  Ledger ledger{file.string()};
  for (const formats::TableColumn& column : table.header()) {
    LedgerRow row;
    row.written = row.taken_as = column.name;
    row.line = column.line;
    row.column = column.place;
    row.unit_written = column.unit;
    if (const auto unit = Unit::find(column.unit); unit && !column.unit.empty()) {
      row.unit = si_unit(unit->dimension());
      row.offset = unit->to_si(0.0L);
      row.factor = unit->to_si(1.0L) - row.offset;
    }
    Ledger::use(row, by);
    ledger.rows.push_back(std::move(row));
  }
  return ledger;
}

class Following {
 public:
  explicit Following(std::vector<Ledger>& all) : all_(all) {}

  void skip(const fs::path& file) { seen_.insert(settled(file)); }

  void follow(const fs::path& file, const std::string& by) {
    if (file.empty() || !seen_.insert(settled(file)).second) return;
    try {
      add(file, by);
    } catch (const InputError& error) {
      Ledger ledger{file.string()};
      ledger.rows.push_back(row_of_file(file, by));
      ledger.rows.back().remark = error.what();
      all_.push_back(std::move(ledger));
    }
  }

 private:
  void add(const fs::path& file, const std::string& by) {
    const std::string ending = ending_of_file(file);
    if (ending == ".toml") {
      DocumentRows rows(file, by);
      all_.push_back(std::move(rows.ledger));
      for (const fs::path& named : rows.named) follow(named, by + ", " + file.filename().string());
    } else if (ending == ".tir") {
      all_.push_back(formats::ledger_of(formats::read_tir(file)));
    } else if (ending == ".csv" || ending == ".txt") {
      all_.push_back(ledger_of_table(file, by));
    } else if (ending == ".inp") {
      all_.push_back(ledger_of_deck(file, by));
    } else if (ending == ".bus") {
      all_.push_back(ledger_of_bushing(file, by));
    } else if (ending == ".rdf" || ending == ".crg") {
      all_.push_back(ledger_of_road(file, by));
      for (const fs::path& named : formats::files_of_road(file)) follow(named, by);
    } else {
      Ledger ledger{file.string()};
      ledger.rows.push_back(row_of_file(file, by));
      all_.push_back(std::move(ledger));
    }
  }

  std::vector<Ledger>& all_;
  std::set<fs::path> seen_;
};

}  // namespace

std::vector<Ledger> ledgers_of_file(const fs::path& file, const std::string& by) {
  std::vector<Ledger> all;
  Following(all).follow(file, by);
  return all;
}

std::vector<Ledger> ledgers_of_named_files(const fs::path& document,
                                           const std::string& by,
                                           const std::vector<Ledger>& known) {
  std::vector<Ledger> all;
  Following following(all);
  for (const Ledger& ledger : known) following.skip(ledger.file);
  following.skip(document);
  for (const fs::path& file : DocumentRows(document, "").named) following.follow(file, by);
  return all;
}

std::vector<Ledger> ledgers_of_opened_files(const Study& study, const std::vector<Ledger>& known) {
  std::vector<Ledger> all;
  Following following(all);
  for (const Ledger& ledger : known) following.skip(ledger.file);
  following.skip(study.file);
  following.skip(study.run.journal);
  following.follow(study.model_file, "the model");
  for (const StudyTest& test : study.tests)
    for (const fs::path& file : test.files) following.follow(file, test.in_words());
  if (study.refinement)
    for (const StudyTest& test : study.refinement->tests)
      for (const fs::path& file : test.files)
        following.follow(file, "[refined] " + test.in_words());
  for (const StudyExperiment& experiment : study.experiments)
    for (const auto* file : {&experiment.measurement_file, &experiment.shapes_file})
      if (!experiment.read_from && fs::is_regular_file(*file))
        following.follow(*file, "experiment " + experiment.name);
  // Lists the inputs of an outside program, and the other files that the study names.
  if (fs::is_regular_file(study.file))
    for (const fs::path& file : DocumentRows(study.file, "").named)
      following.follow(file, "the study");
  return all;
}

}  // namespace latsch::correlation
