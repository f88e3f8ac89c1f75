// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/grip/road_ground.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace latsch::fe_tire {
namespace {

/// Cells in w, along and across.
constexpr int kAlong = 12, kAcross = 3;

/// Integral of the hat of half width 1 from -1 to r.
double below_hat(double r) {
  if (r <= -1.0) return 0.0;
  if (r >= 1.0) return 1.0;
  return r < 0.0 ? 0.5 * (1.0 + r) * (1.0 + r) : 1.0 - 0.5 * (1.0 - r) * (1.0 - r);
}

double hat_at(double r) { return std::max(0.0, 1.0 - std::abs(r)); }

/// Shares of successive cells in the mean at one place in one direction, and their derivatives.
template <int kIn>
struct Shares {
  static constexpr int kMost = 2 * kIn + 1;
  int first = 0;
  std::array<double, kMost> share, by_place;

  /// `at`: place over the border of cell 0; `w`, m.
  Shares(double at, double w) {
    first = static_cast<int>(std::floor((at / w - 1.0) * kIn));
    double before = 0.0, slope_before = 0.0;
    for (int k = 0; k < kMost; ++k) {
      const double border = (first + k + 1.0) / kIn - at / w;
      const double now = below_hat(border), slope = -hat_at(border) / w;
      share[k] = now - before;
      by_place[k] = slope - slope_before;
      before = now;
      slope_before = slope;
    }
  }
};

/// The road around a wheel: one plane, or cells.
class RoadCells final : public FeltGround {
 public:
  RoadCells(double w, const Eigen::Vector2i& first, const Eigen::Vector2i& count)
      : w_(w), first_(first), heights_(Eigen::MatrixXd::Zero(count.x(), count.y())) {}

  /// Heights of the cells, m, [along x across].
  Eigen::MatrixXd& heights() { return heights_; }
  void set_plane(const Place& at_zero) { plane_ = at_zero; }

  Place at(const Eigen::Vector2d& p) const override {
    Place place = plane_;
    place.height += plane_.slope.dot(p);
    if (heights_.size() == 0) return place;
    const Shares<kAlong> along(p.x(), w_);
    const Shares<kAcross> across(p.y(), w_);
    const auto rows = static_cast<int>(heights_.rows()),
               columns = static_cast<int>(heights_.cols());
    for (int j = 0; j < across.kMost; ++j) {
      const int column = std::clamp(across.first + j - first_.y(), 0, columns - 1);
      double height = 0.0, slope = 0.0;
      for (int i = 0; i < along.kMost; ++i) {
        const int row = std::clamp(along.first + i - first_.x(), 0, rows - 1);
        height += along.share[i] * heights_(row, column);
        slope += along.by_place[i] * heights_(row, column);
      }
      place.height += across.share[j] * height;
      place.slope.x() += across.share[j] * slope;
      place.slope.y() += across.by_place[j] * height;
    }
    return place;
  }

 private:
  double w_;
  Eigen::Vector2i first_;  // index of the first cell; cell 0 begins at p = 0
  Eigen::MatrixXd heights_;
  Place plane_;
};

/// Values of a row of cells, as Road::below() fills them.
struct CellRow {
  std::vector<double> x, y, border_x, border_y, border_height, height, mean, friction;
  std::array<std::vector<double>, 2> slope;
  std::array<std::vector<double>, 3> velocity;

  explicit CellRow(std::size_t count) {
    for (auto* of : {&x, &y, &height, &mean, &friction, &slope[0], &slope[1]}) of->resize(count);
    for (auto* of : {&border_x, &border_y, &border_height}) of->resize(count + 1);
    for (auto& of : velocity) of.resize(count);
  }
  void evaluate(const road::Road& road, double time) {
    road.below({static_cast<int>(x.size()), x.data(), y.data(), border_x.data(), border_y.data()},
               time,
               {border_height.data(),
                height.data(),
                mean.data(),
                {slope[0].data(), slope[1].data()},
                friction.data(),
                {velocity[0].data(), velocity[1].data(), velocity[2].data()}});
  }
};

}  // namespace

ReferencePlane ReferencePlane::through(const Eigen::Vector3d& point,
                                       const Eigen::Vector3d& normal) {
  ReferencePlane plane;
  plane.origin = point;
  plane.axes.col(2) = normal.normalized();
  plane.axes.col(0) = Eigen::Vector3d::UnitY().cross(plane.axes.col(2)).normalized();
  plane.axes.col(1) = plane.axes.col(2).cross(plane.axes.col(0));
  return plane;
}

std::shared_ptr<const FeltGround> RoadGround::below(const WheelPlace& wheel) const {
  const double c = std::abs(std::cos(wheel.heading)), s = std::abs(std::sin(wheel.heading));
  const Eigen::Vector2d half(c * size_.along + s * size_.across,
                             s * size_.along + c * size_.across);
  const Eigen::Vector2d cell(size_.smooth / kAlong, size_.smooth / kAcross);
  const Eigen::Vector2d margin(size_.smooth, size_.smooth);
  const Eigen::Vector2d low = wheel.way - half - margin, high = wheel.way + half + margin;
  const Eigen::Vector2i first(static_cast<int>(std::floor(low.x() / cell.x())) - 1,
                              static_cast<int>(std::floor(low.y() / cell.y())) - 1);
  const Eigen::Vector2i count(static_cast<int>(std::ceil(high.x() / cell.x())) + 1 - first.x(),
                              static_cast<int>(std::ceil(high.y() / cell.y())) + 1 - first.y());
  const double upright = plane_.axes(2, 2);
  /// Height of the road over the plane along its normal.
  const auto over = [&](double road_height, const Eigen::Vector3d& on_plane) {
    return (road_height - on_plane.z()) * upright;
  };
  // Bounds hold in a rectangle in plan view around all cells.
  road::GroundBox box{1e300, -1e300, 1e300, -1e300};
  for (const int i : {0, count.x()})
    for (const int j : {0, count.y()}) {
      const Eigen::Vector3d corner =
          plane_.point({(first.x() + i) * cell.x(), (first.y() + j) * cell.y()});
      box = {std::min(box.x0, corner.x()),
             std::max(box.x1, corner.x()),
             std::min(box.y0, corner.y()),
             std::max(box.y1, corner.y())};
    }
  if (road_.bounds(box, wheel.time).plane) {
    auto cells = std::make_shared<RoadCells>(size_.smooth, first, Eigen::Vector2i::Zero());
    const Eigen::Vector3d at = plane_.point(wheel.way);
    const Eigen::Vector3d normal =
        plane_.axes.transpose() * road_.at(at.x(), at.y(), wheel.time).normal;
    FeltGround::Place place;
    place.slope = -normal.head<2>() / normal.z();
    place.height = over(road_.height(at.x(), at.y(), wheel.time), at) - place.slope.dot(wheel.way);
    cells->set_plane(place);
    return cells;
  }
  auto cells = std::make_shared<RoadCells>(size_.smooth, first, count);
  CellRow row(static_cast<std::size_t>(count.x()));
  for (int j = 0; j < count.y(); ++j) {
    const double across = (first.y() + j + 0.5) * cell.y();
    for (int i = 0; i <= count.x(); ++i) {
      const Eigen::Vector3d border = plane_.point({(first.x() + i) * cell.x(), across});
      row.border_x[i] = border.x();
      row.border_y[i] = border.y();
      if (i == count.x()) break;
      const Eigen::Vector3d middle = plane_.point({(first.x() + i + 0.5) * cell.x(), across});
      row.x[i] = middle.x();
      row.y[i] = middle.y();
    }
    row.evaluate(road_, wheel.time);
    for (int i = 0; i < count.x(); ++i)
      cells->heights()(i, j) =
          over(row.mean[i], plane_.point({(first.x() + i + 0.5) * cell.x(), across}));
  }
  return cells;
}

}  // namespace latsch::fe_tire
