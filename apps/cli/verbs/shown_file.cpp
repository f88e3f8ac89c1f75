// SPDX-License-Identifier: Apache-2.0
#include "cli/verbs/shown_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "base/document.h"
#include "base/text.h"
#include "cli/verbs/plot_units.h"
#include "correlation/laboratory/measurement.h"
#include "experiment/kinds/inp_numbers.h"
#include "formats/deck/inp_deck.h"
#include "formats/recorders/recorded_file.h"
#include "formats/tables/csv_table.h"
#include "formats/tables/lab_table.h"
#include "formats/tables/mat_file.h"
#include "formats/tables/tydex_file.h"
#include "formats/text/file_marks.h"
#include "models/road/road_reader.h"

namespace latsch::cli {
namespace {

using formats::TydexFile;

constexpr int kDigits = 6;
constexpr int kMostRows = 100;  // largest number of rows shown of a table without channels

std::string titled(const std::string& name, const std::string& unit) {
  return unit.empty() || unit == "1" ? name : fmt::format("{} [{}]", name, unit);
}

/// Shows the channels of a recording as a study reads them: under the names in the file and in the
/// units of a study. The table and the ledger come from the same reading. Returns false if a study
/// cannot read the file, omits a column, or finds no number in one.
bool show_as_read(const std::filesystem::path& path, AxisConvention axes, ShownFile& shown) {
  try {
    const auto measurement = correlation::read_measurement(path, axes);
    Channels channels;
    for (const Channel& channel : measurement.channels().all())
      channels.add({measurement.written(channel.name).column, channel.unit, channel.values});
    const Ledger ledger = measurement.ledgers().front();
    const bool is_whole = std::none_of(ledger.rows.begin(), ledger.rows.end(), [](const auto& row) {
      return row.state == LedgerState::doubtful && row.unit.empty();
    });
    const bool has_texts =
        std::any_of(channels.all().begin(), channels.all().end(), [](const Channel& channel) {
          return std::none_of(channel.values.begin(), channel.values.end(), [](double value) {
            return std::isfinite(value);
          });
        });
    if (channels.empty() || !is_whole || has_texts) return false;
    show_channels(channels, false, shown);
    return true;
  } catch (const InputError&) {
    // `latsch show` adds the reason when it reads the ledger (show_ledger_of).
    return false;
  }
}

ShownTable entries_table(const std::string& title, const std::vector<TydexFile::Entry>& entries) {
  ShownTable table{title, {"name", "as written", "in SI", "comment"}, {}};
  for (const TydexFile::Entry& entry : entries) {
    const std::string si =
        entry.number ? format_number(*entry.number, kDigits) + " " + entry.si_unit : "";
    table.rows.push_back(
        {entry.name, entry.text + (entry.unit.empty() ? "" : " " + entry.unit), si, entry.comment});
  }
  return table;
}

ShownFile show_tydex(const std::filesystem::path& path, AxisConvention axes) {
  const TydexFile file = TydexFile::read(path);
  ShownFile shown;
  shown.kind = "TYDEX 1.3";
  shown.facts = file.comments;
  for (const auto& [name, why] : file.left_out)
    shown.facts.push_back(name + " is left out: it " + why);
  shown.tables.push_back(entries_table("Header", file.header));
  shown.tables.push_back(entries_table("Constants", file.constants));
  for (const auto& section : file.model) {
    shown.tables.push_back(entries_table(section.keyword, section.entries));
  }
  ShownTable written{
      "Channels as written", {"channel", "unit", "axes", "factor", "offsets", "comment"}, {}};
  for (std::size_t i = 0; i < file.descriptions.size(); ++i) {
    const auto& about = file.descriptions[i];
    const std::string& name = file.channels.all()[i].name;
    const auto* known = formats::find_tydex_name(name);
    written.rows.push_back(
        {name,
         about.unit,
         known ? std::string(known->axes) : "unknown name",
         format_number(about.factor),
         format_number(about.measured_offset) + ", " + format_number(about.physical_offset),
         about.comment});
  }
  shown.tables.push_back(std::move(written));
  if (!show_as_read(path, axes, shown)) show_channels(to_iso(file.channels, axes), false, shown);
  return shown;
}

ShownFile show_csv(const std::filesystem::path& path, AxisConvention axes) {
  const auto table = formats::CsvTable::read(path);
  ShownFile shown;
  shown.kind = "Table (CSV)";
  shown.facts.push_back(fmt::format("{} rows", table.rows()));
  if (show_as_read(path, axes, shown)) return shown;
  try {
    show_channels(to_iso(table.channels(), axes), false, shown);
  } catch (const InputError& error) {  // texts or an unknown unit: the table is shown as it stands
    shown.facts.push_back(std::string("no channels: ") + error.what());
    ShownTable rows{"As written", table.columns(), {}};
    for (int row = 0; row < std::min(table.rows(), kMostRows); ++row) {
      rows.rows.emplace_back();
      for (const std::string& column : rows.heads) {
        rows.rows.back().push_back(table.text(column, row));
      }
    }
    shown.tables.push_back(std::move(rows));
  }
  return shown;
}

ShownFile show_mat(const std::filesystem::path& path, AxisConvention axes) {
  const auto file = formats::MatFile::read(path);
  ShownFile shown;
  shown.kind = "MAT file";
  for (const std::string& name : file.left_out) shown.facts.push_back("not read: " + name);
  ShownTable table{"Variables", {"name", "size", "value"}, {}};
  bool vectors = false;
  for (const auto& variable : file.variables) {
    std::string value = variable.text;
    if (!variable.is_text && variable.values.size() == 1) {
      value = format_number(variable.values[0], kDigits);
    }
    table.rows.push_back(
        {variable.name, fmt::format("{}", fmt::join(variable.size, " x ")), value});
    vectors = vectors || variable.is_vector();
  }
  shown.tables.push_back(std::move(table));
  if (!vectors || show_as_read(path, axes, shown)) return shown;
  const auto named = file.named_channels();
  for (const auto& [name, why] : named.left_out)
    shown.facts.push_back(name + " is left out: it " + why);
  show_channels(to_iso(named.channels, axes), false, shown);
  return shown;
}

/// Returns the rate of a group with equal steps in time as text, such as "2000 Hz".
std::string rate_of(const formats::RecordedGroup& group) {
  if (!group.has_abscissa || group.samples() < 2 || group.channels.front().name != "time")
    return "-";
  const std::vector<double>& time = group.channels.front().values;
  const auto unit = Unit::find(group.channels.front().unit);
  const double length = time.back() - time.front();
  if (!unit || !(length > 0.0)) return "-";
  const double step = unit->to_si(length / static_cast<double>(time.size() - 1));
  return format_number(1.0 / step, 4) + " Hz";
}

/// Shows the groups of a recorder's file and the channels of the one that a study would read.
ShownFile show_groups(const std::filesystem::path& path, AxisConvention axes) {
  ShownFile shown;
  ShownTable groups{"Groups", {"group", "samples", "rate", "from", "to", "channels"}, {}};
  {
    const formats::RecordedFile file = formats::read_recorded_file(path);
    shown.kind = file.kind;
    shown.facts = file.facts;
    for (const formats::RecordedGroup& group : file.groups) {
      std::vector<std::string> names;
      for (const formats::RecordedChannel& channel : group.channels)
        names.push_back(titled(channel.name, channel.unit));
      const auto end_of = [&](double value) {
        return group.has_abscissa
                   ? format_number(value, kDigits) + " " + group.channels.front().unit
                   : std::string("-");
      };
      groups.rows.push_back({group.name,
                             std::to_string(group.samples()),
                             rate_of(group),
                             end_of(group.channels.front().values.front()),
                             end_of(group.channels.front().values.back()),
                             fmt::format("{}", fmt::join(names, ", "))});
    }
  }
  shown.tables.push_back(std::move(groups));
  const auto measurement = correlation::read_measurement(path, axes);
  Channels channels;
  for (const Channel& channel : measurement.channels().all())
    channels.add({measurement.written(channel.name).column, channel.unit, channel.values});
  show_channels(channels, false, shown);
  return shown;
}

/// Shows a recording of a kind without a special view.
ShownFile show_recording(const std::filesystem::path& path, AxisConvention axes) {
  const auto measurement = correlation::read_measurement(path, axes);
  ShownFile shown;
  shown.kind = "Recording (" + path.extension().string() + ")";
  shown.facts = measurement.words();
  show_channels(measurement.channels(), false, shown);
  return shown;
}

ShownFile show_document(const std::filesystem::path& path) {
  const Document document = Document::read(path);
  const Node root = document.root();
  if (root.has("kind") && road::is_road(root)) return shown_road(path);
  if (root.has("measurement") && root.has("experiment")) return shown_measurements(path);
  ShownFile shown;
  shown.kind = "Document (TOML)";
  ShownTable table{"Numbers, in SI", {"path", "value", "unit"}, {}};
  for (const std::string& name : document.paths()) {
    table.rows.push_back({name, format_number(document.get(name), kDigits), document.unit(name)});
  }
  shown.tables.push_back(std::move(table));
  return shown;
}

/// Shows a finite-element deck and, if it is a tire, the parameters that a study may vary.
ShownFile show_inp(const std::filesystem::path& path) {
  const formats::InpDeck deck = formats::read_inp(path);
  ShownFile shown;
  shown.kind = "Finite-element deck (.inp)";
  shown.facts.push_back(fmt::format("{} nodes, {} elements, {} surface elements",
                                    deck.nodes.size(),
                                    deck.elements.size(),
                                    deck.surface_elements.size()));
  ShownTable table{"Numbers, in SI", {"path", "value", "unit", "as written"}, {}};
  try {
    const Document numbers = experiment::read_inp_numbers(path);
    for (const std::string& note : experiment::inp_notes(path)) shown.facts.push_back(note);
    for (const formats::InpNumber& number : deck.numbers)
      table.rows.push_back({number.path,
                            format_number(numbers.get(number.path), kDigits),
                            numbers.unit(number.path),
                            format_number(number.value, kDigits)});
  } catch (const InputError& error) {  // the deck is not that of a tire
    shown.facts.push_back(std::string("no tire: ") + error.what());
    for (const formats::InpNumber& number : deck.numbers)
      table.rows.push_back({number.path, "", "", format_number(number.value, kDigits)});
  }
  shown.tables.push_back(std::move(table));
  return shown;
}

}  // namespace

namespace {

/// Returns the channel that serves as abscissa of the plots: the first that varies, or the first of
/// all.
const Channel* first_that_varies(const Channels& channels) {
  for (const Channel& channel : channels.all())
    if (std::any_of(channel.values.begin(), channel.values.end(), [&](double value) {
          return value != channel.values.front();
        }))
      return &channel;
  return channels.all().empty() ? nullptr : &channels.all().front();
}

/// True if the values differ by no more than the tolerance of a solver that holds them, such as the
/// load of a tire that rolls.
bool is_constant(const std::vector<double>& values) {
  constexpr double kHeld = 1e-6;  // relative
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return *high - *low <= kHeld * std::max(std::abs(*low), std::abs(*high));
}

}  // namespace

void show_channels(const Channels& channels, bool over_first, ShownFile& shown) {
  ShownTable table{
      "Channels, in SI", {"channel", "unit", "samples", "gaps", "smallest", "mean", "largest"}, {}};
  const Channel* over = nullptr;
  for (const Channel& channel : channels.all()) {
    table.rows.push_back(statistics(channel));
    if (!over && channel.unit == "s") over = &channel;
  }
  if (!over && over_first) over = first_that_varies(channels);
  shown.tables.push_back(std::move(table));
  // Plots of a file have the units of the file, plots of a test those that people expect
  // (plot_units.h).
  const auto unit_of = [&](const Channel& channel) {
    return over_first ? plot_unit(channel.unit, channel.values) : PlotUnit{channel.unit};
  };
  std::vector<std::string> constant;
  for (const Channel& channel : channels.all()) {
    // channels with a single value are only in the table
    if (&channel == over || channel.values.size() < 2) continue;
    if (over_first && is_constant(channel.values)) {
      constant.push_back(channel.name);
      continue;
    }
    const PlotUnit y = unit_of(channel), x = over ? unit_of(*over) : PlotUnit{};
    report::PlotLine line{"",
                          over ? in_plot_unit(over->values, x) : std::vector<double>(),
                          in_plot_unit(channel.values, y),
                          0,
                          {}};
    for (std::size_t i = line.x.size(); i < line.y.size(); ++i) {
      line.x.push_back(static_cast<double>(i + 1));
    }
    const std::string x_title = over ? titled(over->name, x.unit) : "sample";
    const std::string y_title = titled(channel.name, y.unit);
    shown.plots.push_back({y_title + " over " + x_title, x_title, y_title, {std::move(line)}});
  }
  if (!constant.empty())
    shown.facts.push_back(
        fmt::format("not drawn, because constant: {}", fmt::join(constant, ", ")));
}

std::vector<std::string> statistics(const Channel& channel) {
  double low = 0.0, high = 0.0, sum = 0.0;
  std::size_t count = 0;
  for (const double value : channel.values) {
    if (!std::isfinite(value)) continue;
    low = count == 0 ? value : std::min(low, value);
    high = count == 0 ? value : std::max(high, value);
    sum += value;
    ++count;
  }
  const auto number = [&](double value) {
    return count == 0 ? std::string("-") : format_number(value, kDigits);
  };
  return {channel.name,
          channel.unit,
          std::to_string(channel.values.size()),
          std::to_string(channel.values.size() - count),
          number(low),
          number(sum / static_cast<double>(std::max<std::size_t>(count, 1))),
          number(high)};
}

ShownFile shown_file(const std::filesystem::path& file, AxisConvention axes) {
  using Path = std::filesystem::path;
  std::map<std::string, std::function<ShownFile(const Path&)>> readers = {
      {".tdx", [&](const Path& path) { return show_tydex(path, axes); }},
      {".tydex", [&](const Path& path) { return show_tydex(path, axes); }},
      {".tda", [&](const Path& path) { return show_tydex(path, axes); }},
      {".tdb", [&](const Path& path) { return show_tydex(path, axes); }},
      {".csv", [&](const Path& path) { return show_csv(path, axes); }},
      {".txt", [&](const Path& path) { return show_csv(path, axes); }},
      {".mat", [&](const Path& path) { return show_mat(path, axes); }},
      {".tir", shown_tire},
      {".bus", shown_bushing},
      {".crg", shown_road},
      {".rdf", shown_road},
      {".toml", show_document},
      {".inp", show_inp}};
  for (const std::string& ending : formats::recorder_endings())
    readers[ending] = [&](const Path& path) { return show_groups(path, axes); };
  for (const std::string& lab : formats::lab_endings())
    readers.try_emplace(lab, [&](const Path& path) { return show_recording(path, axes); });
  std::string ending = file.extension().string();
  for (char& c : ending)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  const auto reader = readers.find(ending);
  if (reader != readers.end()) return reader->second(file);
  formats::expect_content_of_ending(file);
  std::vector<std::string> endings;
  for (const auto& [known, action] : readers) endings.push_back(known);
  throw InputError({file.string(), 0},
                   "ends in " + in_quotes(ending) + ", expected " + list_of(endings));
}

}  // namespace latsch::cli
