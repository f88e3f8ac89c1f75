// SPDX-License-Identifier: Apache-2.0
#include "experiment/mode_record.h"

#include <cassert>
#include <cmath>

namespace latsch::experiment {
namespace {

constexpr double kUnknown = -1.0;
constexpr const char* kPhases = " sa";  // code 0, 1, 2

double phase_code(char phase) { return phase == 's' ? 1.0 : phase == 'a' ? 2.0 : 0.0; }

}  // namespace

std::string ModeRecord::label() const {
  std::string text = type ? fe_tire::name(*type) : "?";
  text += n ? " n=" + std::to_string(*n) : " n=?";
  return phase == ' ' ? text : text + ' ' + phase;
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

}  // namespace latsch::experiment
