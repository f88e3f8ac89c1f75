// SPDX-License-Identifier: Apache-2.0
// A tire on the other side of the car than the one it was measured on: its mirror image. With
// S = diag(1, -1, 1) it sees the wheel's motion and its road mirrored in y = 0 and gives back its
// answer mirrored,
//   center S p, carrier S C S, velocity S v, angular velocity -S w;  force S F, moment -S M
// so that slip angle, inclination and turn slip go in with the other sign and Fy, Mx, Mz come out
// with it, of any kind of tire: what plies, cone and tread pull one way on the left they pull the
// other way on the right.
#pragma once

#include <memory>

#include "models/tire/tire.h"

namespace latsch {

/// Of the car, as on which a tire was measured and its file written.
enum class TireSide { left, right };

class MirroredTire final : public Tire {
 public:
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
  Eigen::Matrix3Xd outline() const override;
  std::unique_ptr<Tire> clone() const override {
    return std::make_unique<MirroredTire>(tire_->clone());
  }

 private:
  std::unique_ptr<Tire> tire_;
};

/// The tire as it is mounted on that side: itself, or its mirror image where it is of the other.
std::unique_ptr<Tire> mounted(std::unique_ptr<Tire> tire, TireSide of, TireSide on);

}  // namespace latsch
