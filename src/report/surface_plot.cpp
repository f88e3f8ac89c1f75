// SPDX-License-Identifier: Apache-2.0
// Draws the target over two variables. Between the grid points the target is interpolated
// bilinearly in the drawn axes (logarithmic if these are), which adds no minima. A cell with a
// failed corner stays empty.
#include "report/surface_plot.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "report/color_map.h"
#include "report/html_text.h"
#include "report/svg_plot.h"

namespace latsch::report {
namespace {

constexpr int kBands = 14;
constexpr double kEverything = -1e300;
constexpr int kFineCells = 40;  // approximate number of fine cells along each axis
constexpr double kSurfaceLeft = 82, kSurfaceRight = 492, kSurfaceTop = 26, kSurfaceBottom = 376;

struct Corner {
  Point at;
  double value;
};

/// Returns the part of a small quadrilateral in which the interpolated value is at least `level`.
/// [Sutherland & Hodgman, Comm. ACM 17 (1974)]
std::vector<Point> part_above(const std::array<Corner, 4>& quad, double level) {
  std::vector<Point> part;
  for (size_t k = 0; k < 4; ++k) {
    const Corner &a = quad[k], &b = quad[(k + 1) % 4];
    if (a.value >= level) part.push_back(a.at);
    if ((a.value >= level) != (b.value >= level)) {
      part.push_back(a.at + (level - a.value) / (b.value - a.value) * (b.at - a.at));
    }
  }
  return part;
}

/// Returns the line on which the interpolated value is `level` through the quadrilateral; empty if
/// there is none.
std::vector<Point> crossing(const std::array<Corner, 4>& quad, double level) {
  std::vector<Point> ends;
  for (size_t k = 0; k < 4; ++k) {
    const Corner &a = quad[k], &b = quad[(k + 1) % 4];
    if ((a.value >= level) != (b.value >= level)) {
      ends.push_back(a.at + (level - a.value) / (b.value - a.value) * (b.at - a.at));
    }
  }
  if (ends.size() != 2) ends.clear();
  return ends;
}

class SurfacePlot {
 public:
  explicit SurfacePlot(const Surface& surface);
  std::string draw();

 private:
  void cut_into_quads();
  void fill_bands();
  double level(int band) const;
  std::string region_above(double level) const;
  std::string contour(double level) const;
  void mark_points();
  void mark(const Eigen::Vector2d& si, std::string_view words, bool cross);
  std::string describe(int i, int j) const;
  double x_at(double si) const { return x_.at(in_unit(si, surface_.x_unit)); }
  double y_at(double si) const { return y_.at(in_unit(si, surface_.y_unit)); }

  const Surface& surface_;
  Axis x_, y_, levels_;
  std::vector<std::array<Corner, 4>> quads_;
  Svg svg_;
};

SurfacePlot::SurfacePlot(const Surface& s)
    : surface_(s),
      x_(in_unit(s.x.front(), s.x_unit),
         in_unit(s.x.back(), s.x_unit),
         kSurfaceLeft,
         kSurfaceRight,
         s.x_logarithmic),
      y_(in_unit(s.y.front(), s.y_unit),
         in_unit(s.y.back(), s.y_unit),
         kSurfaceBottom,
         kSurfaceTop,
         s.y_logarithmic),
      svg_(620, 424, "Target over " + s.x_name + " and " + s.y_name) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (double t : s.target.reshaped()) {
    if (!std::isfinite(t)) continue;
    low = std::min(low, t);
    high = std::max(high, t);
  }
  if (!(low < high)) high = low + 1e-6;
  // The lowest values matter most, so colors follow the logarithm of the target if it spans more
  // than a factor of 5.
  const bool logarithmic = low > 1e-9 * high && high > 5.0 * low;
  levels_ = Axis(100.0 * low, 100.0 * high, kSurfaceBottom, kSurfaceTop, logarithmic);
}

void SurfacePlot::cut_into_quads() {
  const auto nx = surface_.target.rows(), ny = surface_.target.cols();
  const int mx = std::max(1, static_cast<int>(kFineCells / std::max<Eigen::Index>(1, nx - 1)));
  const int my = std::max(1, static_cast<int>(kFineCells / std::max<Eigen::Index>(1, ny - 1)));
  for (Eigen::Index i = 0; i + 1 < nx; ++i) {
    for (Eigen::Index j = 0; j + 1 < ny; ++j) {
      const auto t = surface_.target.block<2, 2>(i, j);
      if (!t.allFinite()) continue;
      const auto corner = [&](int a, int b) {
        const double u = static_cast<double>(a) / mx, v = static_cast<double>(b) / my;
        const double x0 = x_at(surface_.x[i]), x1 = x_at(surface_.x[i + 1]);
        const double y0 = y_at(surface_.y[j]), y1 = y_at(surface_.y[j + 1]);
        const double value = (1 - u) * (1 - v) * t(0, 0) + u * (1 - v) * t(1, 0) +
                             (1 - u) * v * t(0, 1) + u * v * t(1, 1);
        return Corner{{x0 + u * (x1 - x0), y0 + v * (y1 - y0)}, value};
      };
      for (int a = 0; a < mx; ++a) {
        for (int b = 0; b < my; ++b) {
          quads_.push_back(
              {corner(a, b), corner(a + 1, b), corner(a + 1, b + 1), corner(a, b + 1)});
        }
      }
    }
  }
}

double SurfacePlot::level(int band) const {
  const double part = static_cast<double>(band) / kBands;
  const double percents = levels_.logarithmic()
                              ? levels_.lower() * std::pow(levels_.upper() / levels_.lower(), part)
                              : levels_.lower() + part * (levels_.upper() - levels_.lower());
  return 0.01 * percents;
}

/// Returns the region above the level as one path; adjacent whole quadrilaterals of a row become
/// one rectangle.
std::string SurfacePlot::region_above(double level) const {
  std::string region;
  Eigen::AlignedBox2d run;
  const auto finish_run = [&] {
    if (run.isEmpty()) return;
    region += fmt::format("M{:.1f} {:.1f}h{:.1f}v{:.1f}h{:.1f}z",
                          run.min().x(),
                          run.min().y(),
                          run.sizes().x(),
                          run.sizes().y(),
                          -run.sizes().x());
    run.setEmpty();
  };
  for (const auto& quad : quads_) {
    const auto polygon = part_above(quad, level);
    if (polygon.size() < 3) continue;
    const bool whole = std::all_of(
        quad.begin(), quad.end(), [level](const Corner& c) { return c.value >= level; });
    if (whole) {
      const bool joins = !run.isEmpty() && std::abs(run.min().x() - quad[0].at.x()) < 1e-6 &&
                         std::abs(run.min().y() - quad[0].at.y()) < 1e-6;
      if (!joins) finish_run();
      run.extend(quad[0].at);
      run.extend(quad[2].at);
      continue;
    }
    for (size_t k = 0; k < polygon.size(); ++k) {
      region += fmt::format("{}{:.1f} {:.1f}", k == 0 ? "M" : "L", polygon[k].x(), polygon[k].y());
    }
    region += "z";
  }
  finish_run();
  return region;
}

std::string SurfacePlot::contour(double level) const {
  std::string line;
  for (const auto& quad : quads_) {
    const auto ends = crossing(quad, level);
    if (ends.empty()) continue;
    line += fmt::format(
        "M{:.1f} {:.1f}L{:.1f} {:.1f}", ends[0].x(), ends[0].y(), ends[1].x(), ends[1].y());
  }
  return line;
}

/// Fills the bands in ascending order. Each is drawn as the whole region above its lower level, so
/// no gaps remain between bands.
void SurfacePlot::fill_bands() {
  for (int band = 0; band < kBands; ++band) {
    const bool lowest = band == 0;
    const std::string region = region_above(lowest ? kEverything : level(band));
    const std::string color = viridis((band + 0.5) / kBands);
    if (region.empty()) continue;
    svg_.path(region, fmt::format("fill=\"{0}\" stroke=\"{0}\" stroke-width=\"0.6\"", color));
    if (!lowest) svg_.path(contour(level(band)), "class=\"contour\"");
  }
}

std::string SurfacePlot::describe(int i, int j) const {
  const double t = surface_.target(i, j);
  return fmt::format("{} = {}{}, {} = {}{}: {}",
                     surface_.x_name,
                     significant(in_unit(surface_.x[i], surface_.x_unit), 4),
                     unit_suffix(surface_.x_unit),
                     surface_.y_name,
                     significant(in_unit(surface_.y[j], surface_.y_unit), 4),
                     unit_suffix(surface_.y_unit),
                     std::isfinite(t) ? percent(t) : "failed");
}

void SurfacePlot::mark(const Eigen::Vector2d& si, std::string_view words, bool cross) {
  const double px = x_at(si[0]), py = y_at(si[1]);
  if (!(px >= kSurfaceLeft - 1 && px <= kSurfaceRight + 1 && py >= kSurfaceTop - 1 &&
        py <= kSurfaceBottom + 1))
    return;
  if (cross) {
    const std::string data = fmt::format("M{:.1f} {:.1f}l12 12m0 -12l-12 12", px - 6, py - 6);
    svg_.path(data, "class=\"halo\"");
    svg_.path(data, "class=\"mark\"");
  } else {
    svg_.circle({px, py}, 5.5, "class=\"halo\"");
    svg_.circle({px, py}, 5.5, "class=\"mark\"");
  }
  const bool right = px > 0.75 * kSurfaceRight;
  svg_.text({right ? px - 10 : px + 10, py - 8},
            words,
            right ? TextAnchor::end : TextAnchor::start,
            "on-field");
}

void SurfacePlot::mark_points() {
  for (int i = 0; i < surface_.target.rows(); ++i) {
    for (int j = 0; j < surface_.target.cols(); ++j) {
      const Point at(x_at(surface_.x[i]), y_at(surface_.y[j]));
      if (std::isfinite(surface_.target(i, j))) {
        svg_.circle(at, 1.6, "class=\"node\"", describe(i, j));
      } else {
        svg_.path(fmt::format("M{:.1f} {:.1f}l6 6m0 -6l-6 6", at.x() - 3, at.y() - 3),
                  "class=\"failed\"");
      }
    }
  }
  bool lowest = true;
  for (const GridMinimum& m : local_minima(surface_.target)) {
    const Point at(x_at(surface_.x[m.i]), y_at(surface_.y[m.j]));
    svg_.circle(at, lowest ? 7.5 : 6, "class=\"halo\"");
    svg_.circle(at,
                lowest ? 7.5 : 6,
                lowest ? "class=\"minimum lowest\"" : "class=\"minimum\"",
                describe(m.i, m.j));
    const bool right = at.x() > 0.75 * kSurfaceRight, low = at.y() + 18 > kSurfaceBottom;
    svg_.text({right ? at.x() - 12 : at.x() + 12, low ? at.y() - 10 : at.y() + 16},
              (lowest ? "lowest " : "local ") + small_percent(m.target),
              right ? TextAnchor::end : TextAnchor::start,
              "on-field");
    lowest = false;
  }
  if (surface_.initial) mark(*surface_.initial, "initial", false);
  if (surface_.found) mark(*surface_.found, "found", true);
}

std::string SurfacePlot::draw() {
  const auto title = [](const std::string& name, const std::string& unit) {
    return unit.empty() || unit == "1" ? name : fmt::format("{} [{}]", name, typeset_unit(unit));
  };
  cut_into_quads();
  draw_frame(svg_,
             x_,
             y_,
             title(surface_.x_name, surface_.x_unit),
             title(surface_.y_name, surface_.y_unit));
  fill_bands();
  mark_points();
  draw_color_bar(
      svg_, {kSurfaceRight + 26, kSurfaceTop}, kSurfaceBottom - kSurfaceTop, levels_, "Target [%]");
  return svg_.str();
}

}  // namespace

std::vector<GridMinimum> local_minima(const Eigen::MatrixXd& target) {
  std::vector<GridMinimum> minima;
  const int nx = static_cast<int>(target.rows()), ny = static_cast<int>(target.cols());
  for (int i = 0; i < nx; ++i) {
    for (int j = 0; j < ny; ++j) {
      if (!std::isfinite(target(i, j))) continue;
      bool least = true;
      for (int a = std::max(0, i - 1); a <= std::min(nx - 1, i + 1) && least; ++a) {
        for (int b = std::max(0, j - 1); b <= std::min(ny - 1, j + 1) && least; ++b) {
          // if neighbors are equal, the first counts
          const bool before = a < i || (a == i && b < j);
          least = !(target(a, b) < target(i, j)) && !(before && target(a, b) == target(i, j));
        }
      }
      if (least) minima.push_back({i, j, target(i, j)});
    }
  }
  std::stable_sort(minima.begin(), minima.end(), [](const auto& a, const auto& b) {
    return a.target < b.target;
  });
  return minima;
}

std::string surface_plot(const Surface& surface) {
  if (surface.x.size() < 2 || surface.y.size() < 2) return "";
  return SurfacePlot(surface).draw();
}

}  // namespace latsch::report
