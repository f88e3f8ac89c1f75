// SPDX-License-Identifier: Apache-2.0
#include "cli/shown_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "base/document.h"
#include "base/text.h"
#include "formats/csv_table.h"
#include "formats/inp_deck.h"
#include "formats/mat_file.h"
#include "formats/road_file.h"
#include "formats/tir_file.h"
#include "formats/tydex_file.h"

namespace latsch::cli {
namespace {

using formats::TydexFile;

constexpr int kDigits = 6;
constexpr int kRoadPoints = 2000;  // of a curve along a road
constexpr int kRoadLines = 7;
constexpr int kMostRows = 100;  // of a table that is no channels

std::string titled(const std::string& name, const std::string& unit) {
  return unit.empty() || unit == "1" ? name : fmt::format("{} [{}]", name, unit);
}

/// name, unit, samples, gaps, smallest, mean, largest
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

/// Every channel over the one that is the time, or over the number of the sample.
void add_channels(const Channels& written, AxisConvention axes, ShownFile& shown) {
  const Channels channels = to_iso(written, axes);
  ShownTable table{
      "Channels, in SI", {"channel", "unit", "samples", "gaps", "smallest", "mean", "largest"}, {}};
  const Channel* time = nullptr;
  for (const Channel& channel : channels.all()) {
    table.rows.push_back(statistics(channel));
    if (!time && channel.unit == "s") time = &channel;
  }
  shown.tables.push_back(std::move(table));
  for (const Channel& channel : channels.all()) {
    if (&channel == time) continue;
    ShownCurve curve{time ? titled(time->name, time->unit) : "sample",
                     titled(channel.name, channel.unit),
                     time ? time->values : std::vector<double>(),
                     channel.values};
    for (std::size_t i = curve.x.size(); i < curve.y.size(); ++i) {
      curve.x.push_back(static_cast<double>(i + 1));
    }
    shown.curves.push_back(std::move(curve));
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
  add_channels(file.channels, axes, shown);
  return shown;
}

ShownFile show_csv(const std::filesystem::path& path, AxisConvention axes) {
  const auto table = formats::CsvTable::read(path);
  ShownFile shown;
  shown.kind = "Table (CSV)";
  shown.facts.push_back(fmt::format("{} rows", table.rows()));
  try {
    add_channels(table.channels(), axes, shown);
  } catch (const InputError& error) {  // texts, or a unit that is none: shown as it stands
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
  if (vectors) add_channels(file.channels(), axes, shown);
  return shown;
}

ShownFile show_tir(const std::filesystem::path& path) {
  const formats::TirFile file = formats::read_tir(path);
  ShownFile shown;
  shown.kind = "Magic Formula tire (.tir)";
  shown.facts = file.notes;
  ShownTable table{"As written", {"section", "key", "value", "comment"}, {}};
  for (const auto& section : file.source.sections()) {
    for (const auto& entry : section.entries()) {
      table.rows.push_back({section.name(), entry.key, entry.value, entry.comment});
    }
  }
  shown.tables.push_back(std::move(table));
  return shown;
}

/// Heights along lines of equal y, or of equal v where the road is a curved grid.
void add_road_curves(const formats::RoadFile& file, ShownFile& shown) {
  double from = -5.0, to = 5.0, right = -0.5, left = 0.5;
  if (file.crg) {
    from = file.crg->grid().u_begin;
    to = file.crg->grid().u_end();
    right = file.crg->grid().v.front();
    left = file.crg->grid().v.back();
  } else if (file.triangles) {
    from = file.triangles->low().x();
    to = file.triangles->high().x();
    right = file.triangles->low().y();
    left = file.triangles->high().y();
  }
  ShownTable table{"Heights", {"line", "smallest [m]", "mean [m]", "largest [m]"}, {}};
  for (int k = 0; k < kRoadLines; ++k) {
    const double aside = (right * (kRoadLines - 1 - k) + left * k) / (kRoadLines - 1);
    const char* letter = file.crg ? "v" : "y";
    ShownCurve curve{file.crg ? "u [m]" : "x [m]",
                     fmt::format("z [m] at {} = {} m", letter, format_number(aside, 4)),
                     {},
                     {}};
    for (int i = 0; i <= kRoadPoints; ++i) {
      const double along = from + (to - from) * i / kRoadPoints;
      curve.x.push_back(along);
      curve.y.push_back(file.crg ? file.crg->elevation({along, aside}).value_or(std::nan(""))
                                 : file.road->height(along, aside, 0.0));
    }
    const auto row = statistics({"", "m", curve.y});
    table.rows.push_back(
        {fmt::format("{} = {} m", letter, format_number(aside, 4)), row[4], row[5], row[6]});
    shown.curves.push_back(std::move(curve));
  }
  shown.tables.push_back(std::move(table));
}

ShownFile show_road(const std::filesystem::path& path) {
  const formats::RoadFile file = formats::read_road_file(path);
  ShownFile shown;
  shown.kind = "Road (" + file.kind + ")";
  shown.facts = file.facts;
  for (const std::string& key : file.unused) shown.facts.push_back("not used: " + key);
  add_road_curves(file, shown);
  return shown;
}

ShownFile show_document(const std::filesystem::path& path) {
  const Document document = Document::read(path);
  const Node root = document.root();
  if (root.has("kind") && !root.has("section")) return show_road(path);
  ShownFile shown;
  shown.kind = "Document (TOML)";
  ShownTable table{"Numbers, in SI", {"path", "value", "unit"}, {}};
  for (const std::string& name : document.paths()) {
    table.rows.push_back({name, format_number(document.get(name), kDigits), document.unit(name)});
  }
  shown.tables.push_back(std::move(table));
  return shown;
}

ShownFile show_inp(const std::filesystem::path& path) {
  const formats::InpDeck deck = formats::read_inp(path);
  ShownFile shown;
  shown.kind = "Finite-element deck (.inp), own units";
  shown.facts.push_back(
      fmt::format("{} nodes, {} elements", deck.nodes.size(), deck.elements.size()));
  ShownTable table{"Materials", {"material", "density"}, {}};
  for (const auto& [name, material] : deck.materials) {
    table.rows.push_back(
        {name, material.density ? format_number(*material.density, kDigits) : "-"});
  }
  shown.tables.push_back(std::move(table));
  return shown;
}

}  // namespace

ShownFile shown_file(const std::filesystem::path& file, AxisConvention axes) {
  using Path = std::filesystem::path;
  const std::map<std::string, std::function<ShownFile(const Path&)>> readers = {
      {".tdx", [&](const Path& path) { return show_tydex(path, axes); }},
      {".tydex", [&](const Path& path) { return show_tydex(path, axes); }},
      {".csv", [&](const Path& path) { return show_csv(path, axes); }},
      {".mat", [&](const Path& path) { return show_mat(path, axes); }},
      {".tir", show_tir},
      {".crg", show_road},
      {".rdf", show_road},
      {".toml", show_document},
      {".inp", show_inp}};
  std::string ending = file.extension().string();
  for (char& c : ending)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  const auto reader = readers.find(ending);
  if (reader != readers.end()) return reader->second(file);
  std::vector<std::string> endings;
  for (const auto& [known, action] : readers) endings.push_back(known);
  throw InputError({file.string(), 0},
                   "ends in " + in_quotes(ending) + ", expected " + list_of(endings));
}

}  // namespace latsch::cli
