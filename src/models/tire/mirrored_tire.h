// SPDX-License-Identifier: Apache-2.0
// The mirror image of a tire, for use on the side of the car opposite to that on which the tire was
// measured. The tire gets the wheel's motion and the road mirrored in the plane y = 0, with S =
// diag(1, -1, 1), and its results are mirrored back:
//   center S p, carrier S C S, velocity S v, angular velocity -S w;  force S F, moment -S M
// so slip angle, inclination and turn slip enter with reversed sign and Fy, Mx, Mz are returned
// with reversed sign, for any kind of tire: pulls by ply steer, conicity and tread pattern change
// their side.
#pragma once

#include <memory>

#include "models/tire/tire.h"

namespace latsch {

/// Side of the car on which a tire was measured and for which its file was written.
enum class TireSide { left, right };

class MirroredTire final : public Tire {
 public:
  /// Constructs the mirror image of a tire that belongs to the other side of the car.
  explicit MirroredTire(std::unique_ptr<Tire> tire) : tire_(std::move(tire)) {}

  double free_radius() const override { return tire_->free_radius(); }
  Result<HubForces> settle(const WheelMotion& motion, const road::Road& road, double time) override;
  Result<HubForces> advance(const WheelMotion& motion,
                            const road::Road& road,
                            double time,
                            double step) override;
  Result<HubForces> advance_free(WheelMotion& motion,
                                 FreeWheel& wheel,
                                 const road::Road& road,
                                 double time,
                                 double step) override;
  std::optional<Footprint> footprint() const override;
  std::optional<double> road_load() const override { return tire_->road_load(); }
  bool starts_steadily() const override { return tire_->starts_steadily(); }
  Eigen::Matrix3Xd outline() const override;
  std::unique_ptr<Tire> clone() const override {
    return std::make_unique<MirroredTire>(tire_->clone());
  }

 private:
  std::unique_ptr<Tire> tire_;
};

/// Returns the tire of side `of` as mounted on side `on`: itself if the sides are equal, otherwise
/// its mirror image.
std::unique_ptr<Tire> mounted(std::unique_ptr<Tire> tire, TireSide of, TireSide on);

}  // namespace latsch
