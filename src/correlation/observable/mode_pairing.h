// SPDX-License-Identifier: Apache-2.0
// Pairs simulated modes with measured modes.
//
// A changed stiffness swaps the order of neighboring modes, so frequencies are compared only after
// the simulated modes have been reordered to the measured ones. If the laboratory measured shapes,
// likeness is the subspace MAC (mac.h) of the groups of equal frequency that the two modes belong
// to. If it reported labels only, likeness means equal (n, type, phase), and an unknown entry
// agrees with everything. Modes with neither are paired by their frequencies alone.
//
// The pairing is one to one. Of all pairings it takes the one of the greatest summed likeness;
// among equals (two modes of one label, the two members of a pair) the one of the least frequency
// difference. Pairs less alike than `min_likeness` are not made; both modes are then unmatched and
// reported. A measured mode without a mode of its name takes one of its n whose name may have been
// lost by mixing. Frequencies of pairs too close to be distinguished are compared in their order
// (close_modes.h).
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
  int measured = 0;       // index into the measured modes
  int simulated = 0;      // index into the simulated modes
  double likeness = 0.0;  // subspace MAC; 1 for an equal label, 0 for a name lost by mixing
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
