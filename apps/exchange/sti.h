// SPDX-License-Identifier: Apache-2.0
// A tire behind the Standard Tyre Interface: the subroutine DTYRE as Fortran programs call it
// [TYDEX working group, Standard Tyre Interface 1.4, 1999; the argument lists as Adams Tire's
// manual prints them for TYRSUB and as the open Fedem solver calls DTYRE and is called back for the
// road]. SI, TYDEX axes. Arguments are passed by address, arrays by column.
//
//   JOBFLG  1, 11  sizes of the arrays: NTYPAR, NDEQVR, NVARS, NWORK, NIWORK
//           2, 3   reads the tire file CHTDST(1:NCHTDS); forgets earlier states
//           0      forces at TIME
//           5      forces for a difference: no state is kept
//           4, 6   nothing to be done (a step is over; initial conditions of no states)
//           99     forgets the tire
//   IERR    0 good, 1 warning, 2 no result, 3 the program should stop
//
// The tire file is the unit.toml of a folder in SI (exchange/unit/unit_reading.h) or, in the
// library with all models, any file of a tire that rolls.
//
// The state of the tire stays here, by IDTYRE: DEQVAR is empty, and
// src/exchange/unit/stepped_tire.h says how a call becomes a step. If ROAD is a null pointer the
// road is read from CHRDST(1:NCHRDS).
//   TYPARR(7)      m, unloaded radius
//   VARINF(10)     m, deflection: unloaded minus loaded radius
//   VARINF(12)     m, loaded radius
//   VARINF(13:15)  m, the point of the road below the wheel's plane, inertial
// All other elements are zero: that solver reads these positions. TYRMOD has 256 characters.
#pragma once

#include "exchange/exported.h"
#include "exchange/unit/called_road.h"

namespace latsch::exchange::sti {

using Dtyre = void(const int* ndev,
                   const int* iswtch,
                   const int* jobflg,
                   const int* idtyre,
                   const double* time,
                   const double dis[3],
                   const double tramat[9],
                   const double* angtwc,
                   const double vel[3],
                   const double omega[3],
                   const double* omegar,
                   int* ndeqvr,
                   const double deqvar[],
                   int* ntypar,
                   double typarr[],
                   const int* nchtds,
                   const char* chtdst,
                   RoadCall* road,
                   const int* idroad,
                   const int* nropar,
                   const double ropar[],
                   const int* nchrds,
                   const char* chrdst,
                   double force[3],
                   double torque[3],
                   double deqini[],
                   double deqder[],
                   char tyrmod[256],
                   int* nvars,
                   double varinf[],
                   int* nwork,
                   double wrkarr[],
                   int* niwork,
                   int iwrkar[],
                   int* ierr);

extern "C" {
/// Symbols for Fortran compilers (GNU and, on Linux, Intel: with underscore) and for C.
LATSCH_EXPORTED Dtyre dtyre_, dtyre;
/// Returns the reason why IERR of the tire's last call was not 0; "" if it was 0. The text is valid
/// until the next call for this tire.
LATSCH_EXPORTED const char* latsch_sti_message(const int* idtyre);
}

}  // namespace latsch::exchange::sti
