// SPDX-License-Identifier: Apache-2.0
// Orders modes of one circumferential number n whose frequencies are too close to distinguish the
// modes.
//
// Near a crossing of a lateral and a radial mode of one n, their shapes mix. A mode is named by the
// larger part of its energy, so names change with a parameter: they are exchanged, or both modes
// are called radial. A frequency compared by name would jump, or have no partner; frequencies in
// ascending order do not jump. Take two measured modes, a below b, whose simulated frequencies f_a
// > f_b are in the opposite order, at the relative distance g = 2 (f_a - f_b) / (f_a + f_b). They
// become
//
//   f_a -> f_a - s(g) (f_a - f_b)      f_b -> f_b + s(g) (f_a - f_b)
//
// with s = 1 up to a distance `alike`, below which names mean nothing, 0 from `apart` on, above
// which names are reliable, and 3 t^2 - 2 t^3 between. Several modes are treated in pairs in turn,
// which sorts those that are close. The result is continuous in the frequencies and independent of
// the names of close modes.
#pragma once

#include <string>
#include <vector>

#include "experiment/rigs/mode_record.h"

namespace latsch::correlation {

/// Relative distances of frequencies below which two modes count as close.
struct CloseModes {
  double alike = 0.01;  // below: names are not trusted
  double apart = 0.02;  // above: names are trusted
};

/// Frequency of a simulated mode, compared with that of a measured mode.
struct ComparedFrequency {
  int measured = 0;            // index of the measured mode
  double frequency = 0.0;      // Hz
  std::vector<double> slopes;  // derivatives by each variable; empty: not known
  /// index of the measured mode whose frequency contributes to this one; -1: none
  int beside = -1;
};

/// True if n and phase of two modes agree. An unknown phase agrees with any; n must be known.
bool same_waves(const experiment::ModeRecord& a, const experiment::ModeRecord& b);

/// Finds partners for measured modes that have none of their name (-1 in `partner`). A partner is
/// an unpaired simulated mode of equal n and phase, within 5 % of the measured frequency and within
/// 5 % of another simulated mode, with which it may have mixed and so lost its name. The members of
/// a double mode do not mix, so of two modes with one frequency an unpaired one is taken only if it
/// lies within 1 %.
void take_mixed(const std::vector<experiment::ModeRecord>& measured,
                const std::vector<experiment::ModeRecord>& simulated,
                std::vector<int>& partner);

/// Puts the frequencies of close modes, with their slopes, into the order of the measured ones, as
/// described above. `needs_waves` restricts this to modes with same_waves().
void order_close(const std::vector<experiment::ModeRecord>& measured,
                 const CloseModes& close,
                 bool needs_waves,
                 std::vector<ComparedFrequency>& compared);

/// Returns a sentence for each pair of modes whose order order_close() has changed.
std::vector<std::string> remarks_on_close(const std::vector<experiment::ModeRecord>& measured,
                                          const CloseModes& close,
                                          const std::vector<ComparedFrequency>& compared);
/// Returns a remark on a measured mode for which take_mixed() found a partner.
std::string remark_on_mixed(const experiment::ModeRecord& measured);

}  // namespace latsch::correlation
