// SPDX-License-Identifier: Apache-2.0
// The road of a program that calls a tire through the Standard Tyre Interface. Its height comes
// from the ROAD function of the caller [argument list: apps/exchange/sti.h]. Slopes that ROAD does
// not return are differences over 2 mm. The ground does not move.
#pragma once

#include <cstddef>
#include <string>

#include "models/road/road.h"

namespace latsch::exchange {

/// The function ROAD of the calling program. Input: time; x and y; whether slopes are requested; 0
/// in a run (1 before it, 99 after it); numbers of tire and road; the road's parameters and file.
/// Output: kind of road (0: none); height; its first and second derivatives and their number;
/// properties (the first is a factor on the friction; 0 means unknown and is used as 1); an error
/// code like IERR.
using RoadCall = void(const double* time,
                      const double dis[2],
                      const int* iflag,
                      const int* jflag,
                      const int* idtyre,
                      const int* idroad,
                      const int* nropar,
                      const double ropar[],
                      const int* nchrds,
                      const char* chrdst,
                      const int* nprsur,
                      int* nroad,
                      double* z,
                      double dz[2],
                      double ddz[3],
                      int* dflag,
                      double prsurf[],
                      int* ierr,
                      std::ptrdiff_t chrdst_length);

class CalledRoad final : public road::Road {
 public:
  /// The arguments are the addresses that DTYRE received, so this object is valid only during that
  /// call of DTYRE.
  CalledRoad(RoadCall* road,
             const int* idtyre,
             const int* idroad,
             const int* nropar,
             const double* ropar,
             const int* nchrds,
             const char* chrdst)
      : road_(road),
        idtyre_(idtyre),
        idroad_(idroad),
        nropar_(nropar),
        ropar_(ropar),
        nchrds_(nchrds),
        chrdst_(chrdst) {}

  /// These functions throw InputError if ROAD reports that it has no result.
  road::GroundPoint at(double x, double y, double time) const override;
  double height(double x, double y, double time) const override {
    return ask(x, y, time, 0).height;
  }

 private:
  struct Answer {
    double height, slope_x, slope_y, friction;
    bool has_slopes;
  };
  Answer ask(double x, double y, double time, int with_slopes) const;

  RoadCall* road_;
  const int *idtyre_, *idroad_, *nropar_;
  const double* ropar_;
  const int* nchrds_;
  const char* chrdst_;
};

}  // namespace latsch::exchange
