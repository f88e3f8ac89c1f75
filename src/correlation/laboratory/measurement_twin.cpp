// SPDX-License-Identifier: Apache-2.0
#include "correlation/laboratory/measurement_twin.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/file.h"
#include "base/text.h"
#include "base/unit_reading.h"
#include "correlation/laboratory/frame_conversion.h"
#include "formats/tables/csv_table.h"
#include "measurement/axes.h"
#include "measurement/meaning/channel_words.h"

namespace latsch::correlation {
namespace {

void refuse_what_cannot_be_undone(const Measurement& measurement) {
  const auto refuse = [&](const std::string& why) {
    throw InputError(measurement.place(),
                     "measurement." + measurement.name() + " cannot be written by a twin: " + why);
  };
  if (!measurement.one_way().empty())
    refuse("it has " + list_of(measurement.one_way()) +
           ", which cannot be undone; use a [measurement.NAME] without it");
  if (measurement.files().size() != 1) refuse("it consists of several files");
  if (measurement.files()[0].extension() != ".csv")
    refuse(in_quotes(measurement.files()[0].filename().string()) + " is no .csv");
}

using Values = std::map<std::string, std::vector<double>>;

/// Turns forces and moments back into the frames of the file, under the names of the measurement.
Values turned_back(const Measurement& measurement, const Values& values) {
  LabRecord record;
  std::string frame;
  const auto add = [&](const std::string& name, const std::string& unit, const auto& si) {
    record.channels.push_back({name, unit, si});
    record.places.resize(si.size());
  };
  for (const auto& [name, si] : values) {
    frame = measurement.frame(name);
    add(force_without_frame(name), "", si);
  }
  for (const auto& [name, unit] : {std::pair{"gamma", "rad"}, std::pair{"loaded_radius", "m"}})
    if (measurement.has(name)) add(name, unit, measurement.values(name, unit));
  const auto recorded = record.names();
  Values back;
  for (const auto& [name, from] : measurement.turned_from()) {
    LabRecord turned = record;
    std::vector<std::string> words;
    turn_into_frame(turned, frame, from, words);
    const std::string force = force_without_frame(name);
    const Channel* found = turned.find(force);
    const bool is_recorded = std::find(recorded.begin(), recorded.end(), force) != recorded.end();
    if (!found)
      throw InputError(
          measurement.place(),
          fmt::format("measurement.{} cannot be written by a twin: {} {}",
                      measurement.name(),
                      force,
                      is_recorded ? turned.left_out[force] : "is not recorded by the test"));
    back[name] = found->values;
  }
  return back;
}

/// Returns the values of a channel as its column means them: a loaded radius as the height of the
/// wheel center, if the column is that height.
std::vector<double> in_file(const Measurement& measurement,
                            const std::string& channel,
                            std::vector<double> si) {
  if (!same_channel(channel, "loaded_radius") || !measurement.has("gamma") ||
      !is_height_of_center(measurement.written(channel).column) ||
      measurement.stated_columns().contains(measurement.name_of(channel)))
    return si;
  const std::vector<double>& gamma = measurement.values("gamma", "rad");
  for (std::size_t i = 0; i < si.size(); ++i) si[i] *= std::cos(gamma[i]);
  return si;
}

}  // namespace

std::filesystem::path write_twin(const Measurement& measurement,
                                 const std::map<std::string, std::vector<double>>& values,
                                 const std::string& comment) {
  refuse_what_cannot_be_undone(measurement);
  const bool is_turned = std::any_of(values.begin(), values.end(), [&](const auto& value) {
    return measurement.is_turned(value.first);
  });
  const std::filesystem::path& file = measurement.files()[0];
  const auto table = formats::CsvTable::read(file);
  std::map<std::string, std::vector<std::string>> cells;
  for (const auto& [channel, si] : is_turned ? turned_back(measurement, values) : values) {
    assert(static_cast<int>(si.size()) == table.rows());
    const StatedColumn& column = measurement.written(channel);
    Channels turned;
    turned.add({measurement.name_of(channel), "", in_file(measurement, channel, si)});
    turned = to_iso(turned, measurement.axes());  // the conversion is its own inverse
    const Unit unit = *reading_of_unit(column.unit).unit;
    for (const double value : turned.all()[0].values)
      cells[column.column].push_back(unit.exact_number(column.sign * value));
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
