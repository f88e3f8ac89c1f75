// SPDX-License-Identifier: Apache-2.0
#include "experiment/tests/pictures/kerb_pictures.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "report/color_map.h"
#include "report/line_plot.h"
#include "report/svg_plot.h"

namespace latsch::experiment {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr std::array<int, 2> kLeftWheels = {car::kFL, car::kRL};
// Sketch of the chassis relative to the axles, m at rest: a wedge with a cockpit.
const std::vector<Vector2d> kBody = {{0.45, 0.06}, {0.45, 0.20}, {-0.45, 0.42}, {-0.60, 0.62}};
const std::vector<Vector2d> kTail = {{0.25, 0.72}, {-0.30, 0.60}, {-0.40, 0.12}};

Vector2d side_of(const Vector3d& point) { return {point.x(), point.z()}; }

/// Rounds to tenths of millimeters, which is fine enough for a page.
std::string tenths(const std::vector<Vector2d>& points, const Vector2d& from) {
  std::vector<long> numbers;
  for (const Vector2d& point : points) {
    numbers.push_back(std::lround(1e4 * (point.x() - from.x())));
    numbers.push_back(std::lround(1e4 * (point.y() - from.y())));
  }
  return fmt::format("[{}]", fmt::join(numbers, ","));
}

// All lengths are in tenths of millimeters; z points upward, the y axis of the picture downward.
constexpr std::string_view kPlayer = R"js(
(function () {
  const box = document.currentScript.parentElement, svg = box.querySelector("svg");
  const part = name => svg.querySelector("." + name);
  const slider = box.querySelector("input"), button = box.querySelector("button");
  const words = box.querySelector("output");
  const points = (a, x, z) => {
    let s = "";
    for (let i = 0; i < a.length; i += 2) s += (a[i] + x) + "," + -(a[i + 1] + z) + " ";
    return s;
  };
  function draw(k) {
    const f = film.frames[k];
    part("kerb").setAttribute("points", points(film.road, -f.x, 0) + " 30000,2000 -12000,2000");
    part("chassis").setAttribute("points", points(f.c, 0, 0));
    for (const w of [0, 1]) {
      const [x, z] = f.w[w];
      const tire = part("tire" + w), rim = part("rim" + w);
      tire.setAttribute("points", points(f.o[w].length ? f.o[w] : film.circle, x, z));
      rim.setAttribute("cx", x);
      rim.setAttribute("cy", -z);
    }
    let bars = "";
    const [x] = f.w[0], n = f.p.length;
    f.p.forEach((p, i) => {
      const at = x + film.reach * (2 * i / n - 1), width = 2 * film.reach / n;
      bars += "M" + at + " 900v" + p * 3 + "h" + width * 0.9 + "v" + -p * 3 + "z";
    });
    part("pressure").setAttribute("d", bars);
    slider.value = k;
    words.textContent = f.t.toFixed(3) + " s, contact FL " + f.a.toFixed(0) + " cm²";
  }
  let at = 0, timer = null;
  function stop() { clearInterval(timer); timer = null; button.textContent = "Play"; }
  button.onclick = function () {
    if (timer) return stop();
    button.textContent = "Pause";
    timer = setInterval(() => { at = (at + 1) % film.frames.length; draw(at); }, 40);
  };
  slider.max = film.frames.length - 1;
  slider.oninput = function () { stop(); at = +slider.value; draw(at); };
  at = Math.min(film.frames.length - 1, film.shown);
  draw(at);
})();
)js";

}  // namespace

void KerbFilm::see(const car::Car& car, const car::CarState& state, double time) {
  Frame frame;
  frame.time = time;
  const auto& parts = car.parts();
  const Vector3d front = parts.corners[car::kFL].wheel_center,
                 rear = parts.corners[car::kRL].wheel_center;
  for (const Vector2d& p : kBody)
    frame.chassis.push_back(
        side_of(car.point(state, parts.chassis, {front.x() + p.x(), 0.0, p.y()})));
  for (const Vector2d& p : kTail)
    frame.chassis.push_back(
        side_of(car.point(state, parts.chassis_rear, {rear.x() + p.x(), 0.0, p.y()})));
  for (std::size_t w = 0; w < 2; ++w) {
    const auto& wheel = state.wheels[static_cast<std::size_t>(kLeftWheels[w])];
    frame.centers[w] = side_of(wheel.motion.center);
    const Eigen::Matrix3Xd outline = wheel.tire->outline();
    for (Eigen::Index k = 0; k < outline.cols(); ++k)
      frame.outlines[w].push_back(side_of(outline.col(k) - wheel.motion.center));
  }
  radius_ = state.wheels[0].tire->free_radius();
  for (std::size_t i = 0; i < car::kCorners; ++i) {
    const auto print = state.wheels[i].tire->footprint();
    if (!print) continue;
    frame.areas[i] = print->area;
    if (i != car::kFL || !(print->width > 0.0)) continue;
    constexpr double kBin = 2.0 * kReach / kBins;
    for (const FootprintElement& at : print->elements) {
      const double bin = (at.x + kReach) / kBin;
      if (bin < 0.0 || bin >= kBins) continue;
      frame.pressure[static_cast<std::size_t>(bin)] +=
          at.pressure * at.length * at.width / (kBin * print->width);
    }
  }
  frames_.push_back(std::move(frame));
}

std::array<std::complex<double>, KerbFilm::kWaves> KerbFilm::waves(
    const std::vector<Vector2d>& points) {
  std::array<std::complex<double>, kWaves> c{};
  const std::size_t count = points.size();
  const auto angle = [&](std::size_t k) {
    return std::atan2(points[k % count].y(), points[k % count].x());
  };
  double all = 0.0;
  for (std::size_t k = 0; k < count; ++k) {
    // The weight is half the distance between both neighbors on the circle.
    const double weight =
        0.5 * std::abs(std::remainder(angle(k + 1) - angle(k + count - 1), 2.0 * M_PI));
    all += weight;
    for (int n = 0; n < kWaves; ++n)
      c[static_cast<std::size_t>(n)] += weight * points[k].norm() * std::polar(1.0, -n * angle(k));
  }
  for (auto& value : c) value /= all;
  return c;
}

std::vector<double> KerbFilm::times() const {
  std::vector<double> times;
  for (const Frame& frame : frames_) times.push_back(frame.time);
  return times;
}

std::string KerbFilm::animation() const {
  constexpr double kBefore = -0.03, kSpacing = 0.01;  // s, m
  std::string frames;
  std::size_t shown = 0, count = 0;
  Vector2d first = Vector2d::Zero(), last = Vector2d::Zero();
  for (const Frame& frame : frames_) {
    if (frame.time < kBefore) continue;
    const Vector2d from(frame.centers[1].x(), 0.0);
    if (count == 0) first = from;
    last = from;
    if (frame.time < 0.1) shown = count;
    std::vector<long> pressure;
    for (const double p : frame.pressure) pressure.push_back(std::lround(p / 1e3));
    frames += fmt::format("{}{{t:{:.4f},x:{},a:{:.1f},c:{},w:[{},{}],o:[{},{}],p:[{}]}}",
                          count == 0 ? "" : ",\n",
                          frame.time,
                          std::lround(1e4 * from.x()),
                          1e4 * frame.areas[0],
                          tenths(frame.chassis, from),
                          tenths({frame.centers[0]}, from),
                          tenths({frame.centers[1]}, from),
                          tenths(frame.outlines[0], Vector2d::Zero()),
                          tenths(frame.outlines[1], Vector2d::Zero()),
                          fmt::join(pressure, ","));
    ++count;
  }
  std::vector<Vector2d> road, circle;
  for (double x = first.x() - 1.2; x < last.x() + 3.0; x += kSpacing)
    road.emplace_back(x, road_.height(x, line_, 0.0));
  for (int k = 0; k < 60; ++k)
    circle.emplace_back(radius_ * std::cos(k * M_PI / 30.0), radius_ * std::sin(k * M_PI / 30.0));
  return fmt::format(
             "<svg viewBox=\"-6000 -8200 28000 10400\" width=\"100%\" style=\"overflow:hidden\" "
             "role=\"img\" "
             "aria-label=\"The car on the kerb from its left\"><polygon class=\"kerb\" "
             "fill=\"#9aa5b1\"/><path class=\"pressure\" fill=\"{}\"/><polygon class=\"chassis\" "
             "fill=\"#9aa5b1\" fill-opacity=\"0.3\" stroke=\"#5b6875\" stroke-width=\"30\"/>",
             report::category(1)) +
         "<polygon class=\"tire0\" fill=\"none\" stroke=\"#1c2733\" stroke-width=\"90\"/><circle "
         "class=\"rim0\" r=\"1650\" fill=\"#d9dee4\" stroke=\"#5b6875\" stroke-width=\"30\"/>"
         "<polygon class=\"tire1\" fill=\"none\" stroke=\"#1c2733\" stroke-width=\"90\"/><circle "
         "class=\"rim1\" r=\"1650\" fill=\"#d9dee4\" stroke=\"#5b6875\" stroke-width=\"30\"/>"
         "</svg>\n<p><button type=\"button\">Play</button> <input type=\"range\" min=\"0\" "
         "value=\"0\" style=\"width:60%\" aria-label=\"Time\"> <output></output></p>\n<script>" +
         fmt::format("\nconst film = {{shown:{},reach:{},road:{},circle:{},frames:[{}]}};",
                     shown,
                     std::lround(1e4 * kReach),
                     tenths(road, Vector2d::Zero()),
                     tenths(circle, Vector2d::Zero()),
                     frames) +
         std::string(kPlayer) + "</script>";
}

std::string KerbFilm::area_plot() const {
  report::LinePlot plot;
  plot.description = "Contact area over time";
  plot.x_title = "Time [s]";
  plot.y_title = "Contact area [cm²]";
  for (std::size_t i = 0; i < car::kCorners; ++i) {
    std::vector<double> areas;
    for (const Frame& frame : frames_) areas.push_back(1e4 * frame.areas[i]);
    plot.lines.push_back({car::kCornerNames[i], times(), areas, static_cast<int>(i), {}});
  }
  return line_plot(plot);
}

std::string KerbFilm::pressure_map() const {
  constexpr double kX = 64.0, kTop = 28.0, kWidth = 380.0, kHeight = 200.0;
  constexpr std::size_t kColumns = 140;
  double most = 0.0;
  for (const Frame& frame : frames_)
    most = std::max(most, *std::max_element(frame.pressure.begin(), frame.pressure.end()));
  if (!(most > 0.0)) return "";
  const std::size_t every = frames_.size() / kColumns + 1;
  report::Svg svg(kX + kWidth + 90.0, kTop + kHeight + 48.0, "Pressure below the tire over time");
  const report::Axis along(frames_.front().time, frames_.back().time, kX, kX + kWidth);
  const report::Axis across(-1e3 * kReach, 1e3 * kReach, kTop + kHeight, kTop);
  draw_frame(svg, along, across, "Time [s]", "x from below the axle [mm]");
  const double bin = 2e3 * kReach / kBins;
  for (std::size_t k = 0; k + every < frames_.size(); k += every)
    for (std::size_t b = 0; b < kBins; ++b) {
      const double p = frames_[k].pressure[b];
      if (!(p > 0.0)) continue;
      const double left = along.at(frames_[k].time);
      svg.rectangle({left, across.at(-1e3 * kReach + bin * static_cast<double>(b + 1))},
                    along.at(frames_[k + every].time) - left + 0.3,
                    kHeight / kBins + 0.3,
                    fmt::format("fill=\"{}\"", report::viridis(p / most)));
    }
  draw_color_bar(svg,
                 {kX + kWidth + 20.0, kTop},
                 kHeight,
                 report::Axis(0.0, most / 1e5, kTop + kHeight, kTop),
                 "bar");
  return svg.str();
}

std::string KerbFilm::wave_plot() const {
  if (frames_.empty() || frames_[0].outlines[0].empty()) return "";
  std::vector<std::array<std::complex<double>, kWaves>> all;
  std::array<std::complex<double>, kWaves> before{};
  double count = 0.0;
  for (const Frame& frame : frames_) {
    all.push_back(waves(frame.outlines[0]));
    if (frame.time >= -0.02 && count > 0.0) continue;
    ++count;
    for (std::size_t n = 0; n < kWaves; ++n) before[n] += all.back()[n];
  }
  report::LinePlot plot;
  plot.description = "Waves of the belt over time";
  plot.x_title = "Time [s]";
  plot.y_title = "Amplitude of the radius [mm]";
  for (std::size_t n = 0; n < kWaves; ++n) {
    std::vector<double> values;
    for (const auto& c : all)
      values.push_back((n == 0 ? 1e3 : 2e3) * std::abs(c[n] - before[n] / count));
    plot.lines.push_back(
        {fmt::format("n = {}", n), times(), std::move(values), static_cast<int>(n), {}});
  }
  return line_plot(plot);
}

Test::Details KerbFilm::details() const {
  Test::Details details;
  if (frames_.empty()) return details;
  details.pictures.push_back(
      {"On the kerb",
       animation(),
       "From the left, to scale; below the road the pressure under the front left tire. The "
       "belts are the computed ones, the chassis is a sketch that moves like the computed one."});
  details.pictures.push_back({"Contact area", area_plot(), "Grooves included."});
  if (const std::string map = pressure_map(); !map.empty())
    details.pictures.push_back(
        {"Pressure, front left", map, "Mean over the width of the patch, forward upward."});
  if (const std::string plot = wave_plot(); !plot.empty())
    details.pictures.push_back(
        {"Waves of the belt, front left",
         plot,
         "Change of the belt's radius about the wheel center against the ride before the kerb, by "
         "waves around it; n = 1 is the belt as a rigid ring."});
  return details;
}

}  // namespace latsch::experiment
