// SPDX-License-Identifier: Apache-2.0
#include "correlation/laboratory/measurement_twin.h"

#include <fmt/format.h>

#include <cassert>

#include "base/file.h"
#include "base/text.h"
#include "base/units.h"
#include "formats/tables/csv_table.h"
#include "formats/text/lab_units.h"
#include "measurement/axes.h"

namespace latsch::correlation {
namespace {

void refuse_what_cannot_be_undone(const Measurement& measurement) {
  const auto refuse = [&](const std::string& why) {
    throw InputError(measurement.place(),
                     "measurement." + measurement.name() + " cannot be written by a twin: " + why);
  };
  if (!measurement.one_way().empty())
    refuse("it has " + list_of(measurement.one_way()) +
           ", which cannot be undone; write into a [measurement.NAME] without");
  if (measurement.files().size() != 1) refuse("it stands in several files");
  if (measurement.files()[0].extension() != ".csv")
    refuse(in_quotes(measurement.files()[0].filename().string()) + " is no .csv");
}

}  // namespace

std::filesystem::path write_twin(const Measurement& measurement,
                                 const std::map<std::string, std::vector<double>>& values,
                                 const std::string& comment) {
  refuse_what_cannot_be_undone(measurement);
  const std::filesystem::path& file = measurement.files()[0];
  const auto table = formats::CsvTable::read(file);
  std::map<std::string, std::vector<std::string>> cells;
  for (const auto& [channel, si] : values) {
    assert(static_cast<int>(si.size()) == table.rows());
    const StatedColumn& column = measurement.written(channel);
    Channels turned;
    turned.add({measurement.name_of(channel), "", si});
    turned = to_iso(turned, measurement.axes());  // its own inverse
    const Unit unit = *formats::find_lab_unit(column.unit);
    for (const double value : turned.all()[0].values)
      cells[column.column].push_back(unit.exact_number(value));
  }
  const auto names = table.columns();
  std::string text = "# " + comment + "\n";
  for (std::size_t k = 0; k < names.size(); ++k) {
    const std::string& unit = table.unit(names[k]);
    const std::string head = unit.empty() ? names[k] : fmt::format("{} [{}]", names[k], unit);
    text += (k == 0 ? "" : ",") + formats::csv_field(head);
    if (!cells.contains(names[k])) cells[names[k]] = table.texts(names[k]);
  }
  text += '\n';
  for (int row = 0; row < table.rows(); ++row) {
    for (std::size_t k = 0; k < names.size(); ++k) {
      const std::string& cell = cells[names[k]][static_cast<std::size_t>(row)];
      text += (k == 0 ? "" : ",") + (cell.empty() ? "" : formats::csv_field(cell));
    }
    text += '\n';
  }
  write_text_file(file, text);
  return file;
}

}  // namespace latsch::correlation
