// SPDX-License-Identifier: Apache-2.0
// How many points an optimizer is asked for: as many as keep the workers busy, unless thinking of
// them takes longer than the trials that are gained by it.
#pragma once

namespace latsch {

class LookAhead {
 public:
  /// `most`: points asked for where thinking costs nothing, >= 1.
  explicit LookAhead(int most) : most_(most) {}

  /// Points to ask for now, 1 or `most`; `trial`: s that a trial takes, 0 where none has ended.
  int points(double trial);
  /// The optimizer took so many seconds for so many points.
  void took(int points, double seconds);

 private:
  int most_;
  double alone_ = 0.0, ahead_ = 0.0;  // s, when last asked for one point, for most
  int left_out_ = 0;                  // times since it was last tried
  int patience_ = 0;                  // times before it is tried again
};

}  // namespace latsch
