// SPDX-License-Identifier: Apache-2.0
#include "formats/tables/mat_runs.h"

#include <algorithm>

#include "base/error.h"
#include "base/text.h"
#include "measurement/meaning/channel_words.h"

namespace latsch::formats {
namespace {

/// Splits the path of a channel into that of its struct and the channel's name: "run" and "Fz" for
/// "run.Fz".
std::pair<std::string, std::string> parted(const std::string& channel) {
  const std::size_t dot = channel.rfind('.');
  if (dot == channel.npos) return {"", channel};
  return {channel.substr(0, dot), channel.substr(dot + 1)};
}

}  // namespace

std::vector<std::string> runs_in(const MatFile& file) {
  constexpr std::size_t kFewest = 2;  // least number of known vectors in a recording
  // names of the known channels by the path of their struct
  std::vector<std::pair<std::string, std::set<std::string>>> found;
  const auto written = file.written_units();
  for (const MatVariable& variable : file.variables) {
    if (!variable.is_vector()) continue;
    const auto [path, name] = parted(MatFile::channel_of(variable, written));
    const auto known = recognized(name);
    if (!known) continue;
    auto at = std::find_if(
        found.begin(), found.end(), [&path = path](const auto& one) { return one.first == path; });
    if (at == found.end()) at = found.insert(found.end(), {path, {}});
    at->second.insert(known->channel);
  }
  std::vector<std::string> runs;
  for (const auto& [path, channels] : found)
    if (channels.size() >= kFewest) runs.push_back(path);
  return runs;
}

MatFile run_of(const MatFile& file, const std::string& path) {
  MatFile run;
  run.file = file.file;
  const std::string stem = path + ".";
  for (MatVariable variable : file.variables) {
    if (!variable.name.starts_with(stem)) continue;
    variable.name.erase(0, stem.size());
    run.variables.push_back(std::move(variable));
  }
  if (!run.variables.empty()) return run;
  std::vector<std::string> there = runs_in(file);
  std::erase(there, "");
  throw InputError({file.file, 0},
                   "has no struct " + in_quotes(path) + did_you_mean(path, there) +
                       (there.empty() ? ", nor any other with known channels"
                                      : " (structs with known channels: " + list_of(there) + ")"));
}

std::set<std::string> spread_constants(const std::map<std::string, std::string>& units,
                                       MatFile& file) {
  auto written = file.written_units();
  written.insert(units.begin(), units.end());
  const auto counts = [&](const std::string& name) {
    return units.contains(name) || recognized(name).has_value();
  };
  std::set<std::size_t> lengths;
  std::vector<std::string> vectors;
  for (const MatVariable& variable : file.variables) {
    const std::string name = MatFile::channel_of(variable, written);
    if (!variable.is_vector() || !counts(name)) continue;
    lengths.insert(variable.values.size());
    vectors.push_back(name);
  }
  std::set<std::string> constants;
  if (lengths.size() != 1) return constants;
  for (MatVariable& variable : file.variables) {
    if (variable.is_text || variable.values.size() != 1) continue;
    const std::string name = MatFile::channel_of(variable, written);
    const auto unit = written.find(name);
    const bool has_unit = units.contains(name) || (unit != written.end() && !unit->second.empty());
    const bool is_there = std::any_of(vectors.begin(), vectors.end(), [&](const auto& other) {
      return same_channel(other, name);
    });
    if (!has_unit || is_there || !counts(name)) continue;
    variable.values.assign(*lengths.begin(), variable.values.front());
    variable.size = {*lengths.begin(), 1};
    constants.insert(name);
  }
  return constants;
}

}  // namespace latsch::formats
