// SPDX-License-Identifier: Apache-2.0
// For tests: a tire whose forces can be computed with pencil and paper.
#pragma once

#include "models/magic_formula/parameters.h"

namespace latsch::magic_formula {

/// A symmetric passenger car tire whose coefficients are round numbers.
inline Parameters round_tire() {
  Parameters p;
  p.UNLOADED_RADIUS = 0.3;
  p.WIDTH = 0.2;
  p.RIM_RADIUS = 0.19;
  p.FNOMIN = 4000.0;
  p.VERTICAL_STIFFNESS = 2e5;
  p.PCX1 = 1.6;
  p.PDX1 = 1.2;
  p.PDX2 = -0.1;
  p.PEX1 = 0.1;
  p.PKX1 = 25.0;
  p.PCY1 = 1.3;
  p.PDY1 = 1.0;
  p.PDY2 = -0.1;
  p.PDY3 = 1.0;
  p.PEY1 = -0.5;
  p.PKY1 = -20.0;
  p.PKY2 = 1.5;
  p.PKY6 = -0.9;
  p.PVY3 = -0.3;
  p.RBX1 = 12.0;
  p.RBX2 = 10.0;
  p.RCX1 = 1.0;
  p.RBY1 = 10.0;
  p.RBY2 = 8.0;
  p.RCY1 = 1.0;
  p.QBZ1 = 10.0;
  p.QBZ9 = 15.0;
  p.QCZ1 = 1.2;
  p.QDZ1 = 0.1;
  p.QDZ8 = -0.1;
  p.QSX2 = 0.8;
  p.QSX3 = 0.02;
  p.QSY1 = 0.01;
  p.Q_RA1 = 0.6;
  p.Q_RA2 = 0.8;
  p.Q_RB1 = 1.2;
  p.LONGITUDINAL_STIFFNESS = 3e5;
  p.LATERAL_STIFFNESS = 1.5e5;
  p.BREFF = 8.0;
  p.DREFF = 0.25;
  p.FREFF = 0.05;
  p.PHYP1 = 1.0;
  p.PHYP2 = 0.15;
  p.PDYP1 = 0.4;
  p.QDRP1 = 1.0;
  p.QCRP1 = 0.2;
  p.QCRP2 = 0.1;
  p.PECP1 = 0.5;
  p.QDZ10 = 0.3;
  return p;
}

}  // namespace latsch::magic_formula
