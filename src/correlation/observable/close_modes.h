// SPDX-License-Identifier: Apache-2.0
// Modes of one circumferential number that lie too close to be told apart.
//
// Near a crossing of a lateral and a radial mode of one n their shapes mix. The name of each, by
// the larger part of its energy, then changes with a parameter: names are exchanged, or both modes
// are called radial. A frequency compared by its name would leap, or have no partner. Frequencies
// in their order do not leap. So of two measured modes a below b, whose simulated frequencies
// f_a > f_b stand in the other order at a distance g = 2 (f_a - f_b) / (f_a + f_b),
//
//   f_a -> f_a - s(g) (f_a - f_b)      f_b -> f_b + s(g) (f_a - f_b)
//
// s = 1 up to a distance `alike`, where names mean nothing, 0 from `apart` on, where they hold, and
// 3 t^2 - 2 t^3 between. Of several modes each two are taken in turn, which sorts those that are
// alike: the result is continuous in the frequencies, and does not ask for names among them.
#pragma once

#include <string>
#include <vector>

#include "experiment/rigs/mode_record.h"

namespace latsch::correlation {

/// Relative distances of frequencies.
struct CloseModes {
  double alike = 0.01;  // names are not trusted
  double apart = 0.02;  // names are trusted
};

/// What is compared with a measured mode.
struct ComparedFrequency {
  int measured = 0;            // index
  double frequency = 0.0;      // Hz
  std::vector<double> slopes;  // by each variable; empty: not known
  int beside = -1;             // the measured mode whose frequency has its share in this one
};

/// Whether n and phase of two modes agree, as far as they are known; n has to be.
bool same_waves(const experiment::ModeRecord& a, const experiment::ModeRecord& b);

/// Finds partners for measured modes that have none by name, -1 in `partner`: a simulated mode that
/// is free, of the same n and phase, within 5 % of the measured one and of another simulated mode
/// from which mixing may have taken its name. One of a double mode has not, so of two modes at one
/// frequency a free one is taken within 1 % alone.
void take_mixed(const std::vector<experiment::ModeRecord>& measured,
                const std::vector<experiment::ModeRecord>& simulated,
                std::vector<int>& partner);

/// Puts the frequencies of close modes into the order of the measured ones, as above, with their
/// slopes. `needs_waves`: of same_waves() alone.
void order_close(const std::vector<experiment::ModeRecord>& measured,
                 const CloseModes& close,
                 bool needs_waves,
                 std::vector<ComparedFrequency>& compared);

/// A sentence for every two modes of which order_close() took the order.
std::vector<std::string> remarks_on_close(const std::vector<experiment::ModeRecord>& measured,
                                          const CloseModes& close,
                                          const std::vector<ComparedFrequency>& compared);
/// Of a measured mode that take_mixed() found a partner for.
std::string remark_on_mixed(const experiment::ModeRecord& measured);

}  // namespace latsch::correlation
