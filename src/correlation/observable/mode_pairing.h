// SPDX-License-Identifier: Apache-2.0
// Pairs simulated modes with measured modes.
//
// A changed stiffness can exchange the order of neighboring modes, so frequencies are compared only
// after the simulated modes have been brought into the order of the measured ones. If the
// laboratory measured shapes, the likeness of two modes is the subspace MAC (mac.h) of the groups
// of equal frequency to which they belong. If it reported labels only, the likeness is 1 for equal
// (n, type, phase), where an unknown entry agrees with any, and 0 otherwise. Modes with neither
// shape nor label are paired by their frequencies alone.
//
// The pairing is one to one. Among all pairings the one with the largest summed likeness is chosen;
// of equal ones (two modes of one label, the two members of a pair) the one with the least
// frequency difference. Pairs with a likeness below `min_likeness` are not made; both modes are
// then unmatched and reported. A measured mode without a simulated mode of its name may be paired
// with one of its n whose name may have been lost by mixing. Frequencies of pairs too close to be
// distinguished are compared in ascending order (close_modes.h).
#pragma once

#include <vector>

#include "correlation/observable/close_modes.h"
#include "experiment/rigs/mode_record.h"

namespace latsch::correlation {

using experiment::ModeRecord;

struct PairingSettings {
  double min_likeness = 0.5;      // smaller: pairs are not made; in (0, 1]
  double same_frequency = 0.002;  // modes closer than this, relative, form one group
};

struct ModePair {
  int measured = 0;   // index into the measured modes
  int simulated = 0;  // index into the simulated modes
  /// subspace MAC; otherwise 1 for an equal label, 0 for a mode that may have lost its label by
  /// mixing
  double likeness = 0.0;
};

struct ModePairing {
  std::vector<ModePair> pairs;  // ascending in `measured`
  std::vector<int> missing;     // measured modes without a simulated mode
  std::vector<int> extra;       // simulated modes without a measured mode
  bool is_by_shape = false;     // true if likeness is a MAC
  CloseModes close = {};        // relative distances that count as too close
};

ModePairing pair_modes(const std::vector<ModeRecord>& measured,
                       const std::vector<ModeRecord>& simulated,
                       const PairingSettings& settings = {});

}  // namespace latsch::correlation
