// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/mode_record.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/error.h"
#include "base/text.h"

namespace latsch::experiment {
namespace {

constexpr double kUnknown = -1.0;
constexpr const char* kPhases = " sa";  // characters of the codes 0, 1, 2

double phase_code(char phase) { return phase == 's' ? 1.0 : phase == 'a' ? 2.0 : 0.0; }

}  // namespace

std::string ModeRecord::label() const {
  std::string text = type ? fe_tire::name(*type) : "?";
  text += n ? " n=" + std::to_string(*n) : " n=?";
  return phase == ' ' ? text : text + ' ' + phase;
}

std::optional<ModeRecord> mode_of_label(const std::string& label) {
  const size_t type_end = label.find(" n=");
  if (type_end == std::string::npos) return std::nullopt;
  ModeRecord mode;
  mode.type = fe_tire::mode_type(label.substr(0, type_end));
  const size_t n_end = std::min(label.find(' ', type_end + 1), label.size());
  const auto n = parse_number(label.substr(type_end + 3, n_end - type_end - 3));
  if (n) mode.n = static_cast<int>(*n);
  if (label.ends_with(" s") || label.ends_with(" a")) mode.phase = label.back();
  return mode.type && mode.n.value_or(-1) >= 0 && mode.label() == label ? std::optional(mode)
                                                                        : std::nullopt;
}

int find_mode(const std::vector<ModeRecord>& modes, const ModeRecord& named) {
  int lowest = -1;
  for (int i = 0; i < static_cast<int>(modes.size()); ++i) {
    const ModeRecord& mode = modes[i];
    const bool is_meant = mode.n == named.n && mode.type == named.type &&
                          (named.phase == ' ' || mode.phase == named.phase);
    if (is_meant && (lowest < 0 || mode.frequency < modes[lowest].frequency)) lowest = i;
  }
  return lowest;
}

Channels to_channels(const std::vector<ModeRecord>& modes) {
  Channel frequency{"frequency", "Hz", {}}, n{"n", "1", {}}, type{"type", "1", {}};
  Channel phase{"phase", "1", {}}, shape{"shape", "1", {}};
  for (const ModeRecord& mode : modes) {
    frequency.values.push_back(mode.frequency);
    n.values.push_back(mode.n ? *mode.n : kUnknown);
    type.values.push_back(mode.type ? static_cast<double>(*mode.type) : kUnknown);
    phase.values.push_back(phase_code(mode.phase));
    shape.values.insert(shape.values.end(), mode.shape.begin(), mode.shape.end());
  }
  Channels channels;
  for (Channel* channel : {&frequency, &n, &type, &phase}) channels.add(std::move(*channel));
  if (!shape.values.empty()) channels.add(std::move(shape));
  return channels;
}

std::vector<ModeRecord> mode_records(const Channels& channels) {
  const auto& frequency = channels["frequency"];
  const auto& n = channels["n"];
  const auto& type = channels["type"];
  const auto& phase = channels["phase"];
  const Channel* shape = channels.find("shape");
  std::vector<ModeRecord> modes(frequency.size());
  if (modes.empty()) return modes;

  const size_t length = shape ? shape->values.size() / modes.size() : 0;
  assert(!shape || length * modes.size() == shape->values.size());
  for (size_t i = 0; i < modes.size(); ++i) {
    ModeRecord& mode = modes[i];
    mode.frequency = frequency[i];
    if (n[i] != kUnknown) mode.n = static_cast<int>(std::lround(n[i]));
    if (type[i] != kUnknown) mode.type = static_cast<fe_tire::ModeType>(std::lround(type[i]));
    mode.phase = kPhases[std::lround(phase[i])];
    if (shape) {
      mode.shape = Eigen::Map<const Eigen::VectorXd>(shape->values.data() + i * length,
                                                     static_cast<Eigen::Index>(length));
    }
  }
  return modes;
}

std::vector<ModeRecord> mode_records(const ModeTable& table) {
  std::vector<ModeRecord> modes;
  for (const MeasuredMode& measured : table.modes) {
    ModeRecord mode{measured.frequency, measured.n, std::nullopt, measured.phase, {}};
    if (!measured.type.empty()) {
      mode.type = fe_tire::mode_type(measured.type);
      if (!mode.type) {
        throw InputError("mode type " + in_quotes(measured.type) +
                         " is unknown, expected torsional, lateral, radial or nothing");
      }
    }
    mode.shape = Eigen::Map<const Eigen::VectorXd>(
        measured.shape.data(), static_cast<Eigen::Index>(measured.shape.size()));
    modes.push_back(std::move(mode));
  }
  return modes;
}

Eigen::Matrix3Xd sensor_points(const ModeTable& table) {
  Eigen::Matrix3Xd points(3, table.points.size());
  for (size_t i = 0; i < table.points.size(); ++i) {
    points.col(static_cast<Eigen::Index>(i)) =
        Eigen::Map<const Eigen::Vector3d>(table.points[i].data());
  }
  return points;
}

ModeTable mode_table(const std::vector<ModeRecord>& modes, const Eigen::Matrix3Xd& points) {
  ModeTable table;
  for (const ModeRecord& mode : modes) {
    MeasuredMode measured{mode.frequency, mode.n, "", mode.phase, {}};
    const bool named = mode.type && *mode.type != fe_tire::ModeType::other;
    if (named) measured.type = fe_tire::name(*mode.type);
    measured.shape.assign(mode.shape.begin(), mode.shape.end());
    table.modes.push_back(std::move(measured));
  }
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    table.points.push_back({points(0, i), points(1, i), points(2, i)});
  }
  return table;
}

}  // namespace latsch::experiment
