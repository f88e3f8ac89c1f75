// SPDX-License-Identifier: Apache-2.0
// Chooses the number of points requested from an optimizer: as many as keep all workers busy,
// unless computing the additional points takes longer than a trial.
#pragma once

namespace latsch {

class LookAhead {
 public:
  /// `most` >= 1 is the number of points to request as long as computing them takes little time.
  explicit LookAhead(int most) : most_(most) {}

  /// Returns the number of points to request now, 1 or `most`; `trial` is the duration of a trial
  /// in s, 0 if none has ended.
  int points(double trial);
  /// Reports that the optimizer took `seconds` to compute `points` points.
  void took(int points, double seconds);

 private:
  int most_;
  /// Time that the last request for one point and that for `most` points took, s.
  double alone_ = 0.0, ahead_ = 0.0;
  int left_out_ = 0;  // number of requests since `most` points were last requested
  int patience_ = 0;  // number of requests before `most` points are requested again
};

}  // namespace latsch
