// SPDX-License-Identifier: Apache-2.0
#include "formats/tables/measurement_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <type_traits>

#include "base/document.h"
#include "base/file.h"
#include "base/text.h"
#include "base/units.h"
#include "formats/tables/csv_table.h"
#include "formats/text/letter_case.h"

namespace latsch::formats {
namespace {

const std::vector<std::string> kModeTypes = {"torsional", "lateral", "radial"};
/// Largest number of waves around the tire. Rigs find about fifteen; forty waves would be shorter
/// than a contact patch.
constexpr long kMostWaves = 40;

template <class Measurement>
void check(const Measurement& measurement, const CsvTable& table) {
  const auto fault = find_fault(measurement);
  if (!fault) return;
  std::string way_out;
  if constexpr (std::is_same_v<Measurement, LoadDeflectionCurve>)
    way_out = way_out_of(measurement, *fault);
  throw InputError(fault->point < 0 ? Place{table.file(), 0} : table.place(fault->point),
                   fault->message + way_out);
}

/// Names that the columns of a table of modes have in the file; empty for a column that is absent.
struct ModeColumns {
  std::string frequency, n, type, phase;
};

/// Finds the columns of a table of modes by Latsch's names and other usual ones; letter case does
/// not matter. Throws InputError for any other column.
ModeColumns mode_columns(const CsvTable& table) {
  ModeColumns columns;
  const std::vector<std::pair<std::string*, std::vector<std::string>>> known = {
      {&columns.frequency, {"frequency", "f", "freq", "frequenz", "eigenfrequenz"}},
      {&columns.n, {"n", "order", "mode_order", "ordnung"}},
      {&columns.type, {"type", "typ"}},
      {&columns.phase, {"phase"}}};
  for (const std::string& column : table.columns()) {
    const auto found = std::find_if(known.begin(), known.end(), [&](const auto& one) {
      return one.first->empty() &&
             std::find(one.second.begin(), one.second.end(), lower(column)) != one.second.end();
    });
    if (found == known.end())
      throw InputError(table.header_place(),
                       "unknown column " + in_quotes(column) +
                           did_you_mean(column, {"frequency", "n", "type", "phase"}) +
                           "; a table of modes has frequency, n (the number of waves), type and "
                           "phase: give the column one of these names or cut it off");
    *found->first = column;
  }
  return columns;
}

/// Reads the labels of a mode from a row of the table; an empty cell means not known.
MeasuredMode read_label(const CsvTable& table, const ModeColumns& columns, int row) {
  MeasuredMode mode;
  const auto cell = [&](const std::string& column) {
    return column.empty() ? std::string() : table.text(column, row);
  };
  const auto reject = [&](const std::string& column, const std::string& expected) {
    throw InputError(
        table.place(row),
        fmt::format("{} is {}, expected {}", column, in_quotes(cell(column)), expected));
  };
  if (const std::string n = cell(columns.n); !n.empty()) {
    const auto waves = parse_number(n);
    if (!waves || !(*waves >= 0.0 && *waves <= kMostWaves) || *waves != static_cast<int>(*waves))
      reject(columns.n,
             fmt::format("a number of waves around the tire, 0 to {}, or nothing", kMostWaves));
    mode.n = static_cast<int>(*waves);
  }
  mode.type = cell(columns.type);
  if (!mode.type.empty() &&
      std::find(kModeTypes.begin(), kModeTypes.end(), mode.type) == kModeTypes.end())
    reject(columns.type, list_of(kModeTypes) + " or nothing" + did_you_mean(mode.type, kModeTypes));
  const std::string phase = cell(columns.phase);
  if (!phase.empty() && phase != "s" && phase != "a") reject(columns.phase, "s, a or nothing");
  if (!phase.empty()) mode.phase = phase[0];
  return mode;
}

ModeTable read_mode_csv(const std::filesystem::path& file) {
  const CsvTable csv = CsvTable::read(file);
  const ModeColumns columns = mode_columns(csv);
  const std::vector<double> frequencies =
      csv.numbers(columns.frequency.empty() ? "frequency" : columns.frequency, "Hz");
  ModeTable table;
  for (int row = 0; row < csv.rows(); ++row) {
    table.modes.push_back(read_label(csv, columns, row));
    table.modes.back().frequency = frequencies[row];
  }
  check(table, csv);
  return table;
}

ModeTable read_mode_tables(const Node& root) {
  ModeTable table;
  for (const Node& node : root.named_tables("mode")) {
    MeasuredMode mode;
    mode.frequency = node.quantity("frequency", "Hz", Range::positive());
    if (node.has("n")) mode.n = static_cast<int>(node.integer("n", 0, kMostWaves));
    if (node.has("type")) mode.type = node.choice("type", kModeTypes);
    if (node.has("phase")) mode.phase = node.choice("phase", {"s", "a"})[0];
    table.modes.push_back(mode);
  }
  root.close();
  if (const auto fault = find_fault(table)) throw InputError(root.place(), fault->message);
  return table;
}

ModeTable read_mode_toml(const std::filesystem::path& file) {
  return read_mode_tables(Document::read(file).root());
}

std::string mode_csv(const ModeTable& table) {
  std::string text = "frequency [Hz],n,type,phase\n";
  for (const MeasuredMode& mode : table.modes)
    text += fmt::format("{},{},{},{}\n",
                        mode.frequency,
                        mode.n ? std::to_string(*mode.n) : "",
                        mode.type.empty() ? "" : csv_field(mode.type),
                        mode.phase == ' ' ? "" : std::string(1, mode.phase));
  return text;
}

std::string mode_toml(const ModeTable& table) {
  std::string text;
  for (const MeasuredMode& mode : table.modes) {
    text += fmt::format("\n[[mode]]\nfrequency = \"{} Hz\"\n", mode.frequency);
    if (mode.n) text += fmt::format("n = {}\n", *mode.n);
    if (!mode.type.empty()) text += fmt::format("type = \"{}\"\n", mode.type);
    if (mode.phase != ' ') text += fmt::format("phase = \"{}\"\n", mode.phase);
  }
  return text;
}

/// Returns the text as one line, for a comment.
std::string comment_line(std::string comment) {
  std::replace(comment.begin(), comment.end(), '\n', ' ');
  return comment.empty() ? "" : fmt::format("# {}\n", comment);
}

bool is_toml(const std::filesystem::path& file) { return file.extension() == ".toml"; }

}  // namespace

namespace {

const std::vector<std::string> kLoadColumns = {"deflection", "loaded_radius", "force", "spread"};

}  // namespace

bool is_load_deflection_table(const std::filesystem::path& file) {
  if (lower(file.extension().string()) != ".csv") return false;
  const std::vector<std::string> columns = CsvTable::read(file).columns();
  return std::all_of(columns.begin(), columns.end(), [](const std::string& column) {
    return std::find(kLoadColumns.begin(), kLoadColumns.end(), column) != kLoadColumns.end();
  });
}

LoadDeflectionCurve read_load_deflection(const std::filesystem::path& file) {
  const CsvTable csv = CsvTable::read(file);
  csv.expect_only(kLoadColumns);
  if (csv.has("deflection") && csv.has("loaded_radius"))
    throw InputError(csv.header_place(),
                     "has both deflection and loaded_radius, expected one of them");
  LoadDeflectionCurve curve;
  curve.abscissa = csv.has("loaded_radius") ? Abscissa::loaded_radius : Abscissa::deflection;
  curve.position = csv.numbers(csv.has("loaded_radius") ? "loaded_radius" : "deflection", "m");
  curve.force = csv.numbers("force", "N");
  if (csv.has("spread")) curve.spread = csv.numbers("spread", "N");
  check(curve, csv);
  return curve;
}

ModeTable read_modes(const std::filesystem::path& file) {
  return is_toml(file) ? read_mode_toml(file) : read_mode_csv(file);
}

void read_shapes(const std::filesystem::path& file, ModeTable& table) {
  const CsvTable csv = CsvTable::read(file);
  csv.expect_only({"mode", "x", "y", "z", "ux", "uy", "uz"});
  const std::vector<int> mode = csv.integers("mode");
  const std::array<std::vector<double>, 3> place = {
      csv.numbers("x", "m"), csv.numbers("y", "m"), csv.numbers("z", "m")};
  const std::array<std::vector<double>, 3> u = {
      csv.numbers("ux", "1"), csv.numbers("uy", "1"), csv.numbers("uz", "1")};
  const std::size_t modes = table.modes.size(), points = modes == 0 ? 0 : mode.size() / modes;
  if (points == 0 || points * modes != mode.size())
    throw InputError(
        {csv.file(), 0},
        fmt::format(
            "has {} rows for {} modes, expected the same points for each", mode.size(), modes));
  ModeTable with_shapes = table;
  with_shapes.points.assign(points, {});
  for (std::size_t row = 0; row < mode.size(); ++row) {
    const std::size_t m = row / points, p = row % points;
    const Place here = csv.place(static_cast<int>(row));
    if (mode[row] != static_cast<int>(m) + 1)
      throw InputError(
          here, fmt::format("mode is {}, expected {}: {} points a mode", mode[row], m + 1, points));
    const std::array<double, 3> point = {place[0][row], place[1][row], place[2][row]};
    if (m == 0) with_shapes.points[p] = point;
    if (point != with_shapes.points[p])
      throw InputError(here, fmt::format("x, y, z are not those of point {} of mode 1", p + 1));
    if (p == 0) with_shapes.modes[m].shape.clear();
    for (int i = 0; i < 3; ++i) with_shapes.modes[m].shape.push_back(u[i][row]);
  }
  if (const auto fault = find_fault(with_shapes))
    throw InputError(fault->point < 0 ? Place{csv.file(), 0}
                                      : csv.place(fault->point * static_cast<int>(points)),
                     fault->message);
  table = std::move(with_shapes);
}

void write_load_deflection(const std::filesystem::path& file,
                           const LoadDeflectionCurve& curve,
                           const std::string& comment) {
  Channels channels;
  const bool by_radius = curve.abscissa == Abscissa::loaded_radius;
  channels.add({by_radius ? "loaded_radius" : "deflection", "m", curve.position});
  channels.add({"force", "N", curve.force});
  std::vector<std::string> units = {"mm", "N"};
  if (!curve.spread.empty()) {
    channels.add({"spread", "N", curve.spread});
    units.push_back("N");
  }
  write_text_file(file, comment_line(comment) + csv_text(channels, units));
}

void write_modes(const std::filesystem::path& file,
                 const ModeTable& table,
                 const std::string& comment) {
  write_text_file(file,
                  comment_line(comment) + (is_toml(file) ? mode_toml(table) : mode_csv(table)));
}

void write_shapes(const std::filesystem::path& file,
                  const ModeTable& table,
                  const std::string& comment) {
  std::string text = comment_line(comment) + "mode,x [mm],y [mm],z [mm],ux,uy,uz\n";
  const Unit mm = Unit::of("mm");
  for (std::size_t m = 0; m < table.modes.size(); ++m)
    for (std::size_t p = 0; p < table.points.size(); ++p) {
      text += std::to_string(m + 1);
      for (const double x : table.points[p]) text += fmt::format(",{}", mm.exact_number(x));
      for (int i = 0; i < 3; ++i)
        text += fmt::format(",{}", table.modes[m].shape[3 * p + static_cast<std::size_t>(i)]);
      text += '\n';
    }
  write_text_file(file, text);
}

std::map<std::string, DeclaredKey> keys_of_modes(const std::filesystem::path& file) {
  const Document document = Document::read(file);
  const DocumentRecord record(document.root());
  read_mode_tables(record.node());
  return record.keys();
}

}  // namespace latsch::formats
