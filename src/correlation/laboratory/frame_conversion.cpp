// SPDX-License-Identifier: Apache-2.0
#include "correlation/laboratory/frame_conversion.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>

#include "base/text.h"
#include "correlation/laboratory/channel_names.h"
#include "correlation/laboratory/record_ledger.h"

namespace latsch::correlation {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

constexpr std::array<const char*, 6> kForcesAndMoments = {"Fx", "Fy", "Fz", "Mx", "My", "Mz"};

Vector6 turned(const Vector6& v, AxisFrame from, AxisFrame to, double gamma, double R_l) {
  const Wrench wrench = in_frame({v.head<3>(), v.tail<3>()}, from, to, gamma, R_l);
  return (Vector6() << wrench.force, wrench.moment).finished();
}

Matrix6 matrix_of(AxisFrame from, AxisFrame to, double gamma, double R_l) {
  Matrix6 T;
  for (int j = 0; j < 6; ++j) T.col(j) = turned(Vector6::Unit(j), from, to, gamma, R_l);
  return T;
}

/// Returns the other channels that are needed to convert a component between the frames, determined
/// for an inclined wheel.
std::vector<std::string> what_takes(int row, AxisFrame from, AxisFrame to) {
  constexpr double gamma = 0.4, R_l = 0.3;
  const Matrix6 T = matrix_of(from, to, gamma, R_l);
  std::vector<std::string> names;
  for (int j = 0; j < 6; ++j)
    if (T(row, j) != 0.0) names.emplace_back(kForcesAndMoments[j]);
  if (T.row(row) != matrix_of(from, to, 0.5 * gamma, R_l).row(row)) names.emplace_back("gamma");
  if (T.row(row) != matrix_of(from, to, gamma, 2.0 * R_l).row(row))
    names.emplace_back("loaded_radius");
  return names;
}

const char* formulas(AxisFrame from, AxisFrame to) {
  constexpr const char* kFormulas[3][3] = {
      {"", "F_H = F_W, M_H = M_W + r x F_W", "F_C = A' F_W, M_C = A' (M_W + r x F_W)"},
      {"F_W = F_H, M_W = M_H - r x F_H", "", "F_C = A' F_H, M_C = A' M_H"},
      {"F_W = A F_C, M_W = A M_C - r x F_W", "F_H = A F_C, M_H = A M_C", ""}};
  return kFormulas[static_cast<int>(from)][static_cast<int>(to)];
}

std::string what_letters_mean(AxisFrame from, AxisFrame to) {
  const bool turns = from == AxisFrame::C || to == AxisFrame::C;
  const bool moves = from == AxisFrame::W || to == AxisFrame::W;
  return std::string(moves ? ", r = R_l (0, sin gamma, -cos gamma), R_l the loaded_radius along "
                             "the wheel plane"
                           : "") +
         (turns ? ", A the turn about x by gamma" : "");
}

/// Returns the six channels of a frame, nullptr for those not recorded. A name without a frame
/// counts for the stated frame.
std::array<const Channel*, 6> forces_in(const LabRecord& record,
                                        const std::string& stated,
                                        AxisFrame frame) {
  std::array<const Channel*, 6> found{};
  for (const Channel& channel : record.channels)
    for (std::size_t k = 0; k < 6; ++k)
      if (channel.name == kForcesAndMoments[k] + name_of(frame) ||
          (channel.name == kForcesAndMoments[k] && stated == name_of(frame)))
        found[k] = &channel;
  return found;
}

/// Converts the forces of one frame. Adds the converted ones to `done`, and those that it cannot
/// convert to the record's left_out.
void turn(LabRecord& record,
          const std::string& stated,
          AxisFrame from,
          AxisFrame to,
          std::vector<std::string>& done) {
  const auto sources = forces_in(record, stated, from);
  const auto there = forces_in(record, stated, to);
  const Channel *gamma = record.find("gamma"), *R_l = record.find("loaded_radius");
  std::vector<Channel> results;
  std::vector<std::string> gone;
  for (int row = 0; row < 6; ++row) {
    const Channel* source = sources[row];
    if (!source) continue;
    gone.push_back(source->name);
    if (there[row]) continue;  // recorded in both frames
    const std::vector<std::string> taken = what_takes(row, from, to);
    std::vector<std::string> lacks = taken;
    std::erase_if(lacks, [&](const std::string& name) {
      const auto force = std::find(kForcesAndMoments.begin(), kForcesAndMoments.end(), name);
      return force != kForcesAndMoments.end()
                 ? sources[force - kForcesAndMoments.begin()] != nullptr
                 : record.find(name) != nullptr;
    });
    if (!lacks.empty()) {
      record.left_out[kForcesAndMoments[row]] =
          fmt::format("cannot be turned from axes {} into {} without {}",
                      name_of(from),
                      name_of(to),
                      fmt::join(lacks, " and "));
      continue;
    }
    for (const std::string& name : taken)
      if (const auto force = std::find(kForcesAndMoments.begin(), kForcesAndMoments.end(), name);
          force == kForcesAndMoments.end() || sources[force - kForcesAndMoments.begin()] != source)
        note_use(record,
                 force == kForcesAndMoments.end()
                     ? name
                     : sources[force - kForcesAndMoments.begin()]->name,
                 "in_frame");
    const bool is_plain = source->name == kForcesAndMoments[row];
    Channel result{
        is_plain ? kForcesAndMoments[row] : kForcesAndMoments[row] + name_of(to), source->unit, {}};
    for (std::size_t i = 0; i < record.samples(); ++i) {
      Vector6 v = Vector6::Zero();  // unrecorded components have factor 0
      for (int j = 0; j < 6; ++j)
        if (sources[j]) v[j] = sources[j]->values[i];
      result.values.push_back(
          turned(v, from, to, gamma ? gamma->values[i] : 0.0, R_l ? R_l->values[i] : 0.0)[row]);
    }
    record.written[result.name] = record.written[source->name];
    record.turned_from[result.name] = from;
    done.emplace_back(kForcesAndMoments[row]);
    results.push_back(std::move(result));
  }
  std::erase_if(record.channels, [&](const Channel& channel) {
    return std::find(gone.begin(), gone.end(), channel.name) != gone.end();
  });
  for (Channel& result : results) record.channels.push_back(std::move(result));
}

}  // namespace

std::string turn_into_frame(LabRecord& record,
                            const std::string& stated,
                            AxisFrame to,
                            std::vector<std::string>& words) {
  bool is_told = false;
  std::vector<std::string> lacks;
  for (const AxisFrame from : {AxisFrame::W, AxisFrame::H, AxisFrame::C}) {
    const auto sources = forces_in(record, stated, from);
    const bool is_there = std::any_of(
        sources.begin(), sources.end(), [](const Channel* channel) { return channel != nullptr; });
    is_told = is_told || is_there;
    if (!is_there || from == to) continue;
    std::vector<std::string> done;
    turn(record, stated, from, to, done);
    if (!done.empty())
      words.push_back(fmt::format("{} turned from axes {} into {}: {}{}",
                                  fmt::join(done, ", "),
                                  name_of(from),
                                  name_of(to),
                                  formulas(from, to),
                                  what_letters_mean(from, to)));
  }
  if (!is_told)
    return stated.empty() ? "the axes of the recorded forces are not stated; add frame = "
                            "\"H\", or \"W\" or \"C\""
                          : "no force or moment was recorded";
  const auto left = forces_in(record, name_of(to), to);
  if (std::any_of(left.begin(), left.end(), [](const Channel* channel) { return channel; }))
    return "";
  std::string reasons;
  for (const char* force : kForcesAndMoments)
    if (const auto reason = record.left_out.find(force); reason != record.left_out.end())
      reasons += fmt::format("{}{} {}", reasons.empty() ? "" : "; ", force, reason->second);
  return reasons;
}

}  // namespace latsch::correlation
