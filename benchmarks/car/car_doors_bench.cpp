// SPDX-License-Identifier: Apache-2.0
// Checks of the full-car model: equilibrium under downforce, rigid joints, drag, mirrored tires,
// and the four-post test. Downforce is 1 to 5 times the weight, and the transfer functions on the
// four posts are those of a test with default settings. The car is on springs, and on the shipped
// slick, whose slips relax over a length and which resists rolling.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "base/document.h"
#include "experiment/language.h"
#include "experiment/language/capabilities.h"
#include "experiment/rigs/car/axle_kc_rig.h"
#include "experiment/rigs/car/four_post_rig.h"
#include "models/car/car_linear.h"
#include "models/car/race_car_testing.h"
#include "models/road/plane_road.h"
#include "options.h"
#include "slick_tires.h"
#include "table.h"

namespace {

using namespace latsch;
using benchmarks::Table;
using benchmarks::TiresOfCar;
using car::Car;
using Eigen::Vector3d;

constexpr double kArea = 1.2, kDensity = 1.2, kDragHeight = 0.35;

void make_rigid(car::CarParameters& parameters) {
  for (car::Axle* axle : {&parameters.front, &parameters.rear})
    for (multibody::BushingParameters& bushing : axle->corner.bushings) {
      bushing = {Vector3d::Constant(1e10), Vector3d::Zero(), Vector3d::Constant(1e6)};
      bushing.rigid = true;
    }
}

/// Returns the race car with bump stops, drag, and downforce of `times` weights at the given speed.
/// The downforce grows as the floor comes nearer to the road.
car::CarParameters pressed(bool rigid, double speed, double times, double drag) {
  car::CarParameters parameters = car::race_car(false);
  if (rigid) make_rigid(parameters);
  for (car::Axle* axle : {&parameters.front, &parameters.rear})
    axle->inboard->unit.parts.push_back(multibody::ElasticCurve{multibody::ForceCharacteristic(
        {{-0.040, -12e3}, {-0.030, -2e3}, {-0.025, 0.0}, {0.0, 0.0}, {0.1, 0.0}})});
  double mass = 0.0;
  const car::CarMechanism built = car::build(parameters);
  for (const auto& body : built.mechanism.bodies()) mass += body.mass;
  const double q = 0.5 * kDensity * speed * speed * kArea;
  const double all = times * mass * parameters.gravity / q;
  car::AeroMap air;
  air.area = kArea;
  air.density = kDensity;
  air.drag = drag;
  air.drag_height = kDragHeight;
  air.floor_front = 0.03;
  air.floor_rear = 0.04;
  const auto row = [&](double front, double rear) {
    const double lower = 1.0 + 2.0 * (0.03 - front) + 1.5 * (0.04 - rear);
    return car::AeroMap::Row{front, rear, 0.45 * all * lower, 0.55 * all * lower};
  };
  air.set_rows({row(-0.1, -0.1), row(-0.1, 0.05), row(0.04, -0.1), row(0.04, 0.05)});
  parameters.aero = air;
  return parameters;
}

struct Rested {
  int cars = 0, at_rest = 0, in_words = 0;
  double force = 0.0, moment = 0.0, slowed = 0.0;  // relative, relative, m/s
};

/// Compares the forces of the road on the tires with weight plus aerodynamic forces, and both
/// moments about a line on the ground. The guide pulls at the height of the ground, in effect
/// (Trim::arm), so the moment of the tires includes their resistance to rolling.
void judge(const Car& car, const car::CarState& state, double speed, Rested& rested) {
  const car::CarParameters& of = car.parameters();
  const car::AeroMap& air = *of.aero;
  const auto at = [&](double x, double z) {
    return car.point(state, car.parts().chassis, {x, 0.0, z});
  };
  const auto& bodies = car.mechanism().bodies();
  const Vector3d front = at(of.front.corner.wheel_center.x(), air.floor_front),
                 rear = at(of.rear.corner.wheel_center.x(), air.floor_rear);
  const double q = 0.5 * air.density * speed * speed * air.area;
  const Eigen::Vector2d down = q * air.at(front.z(), rear.z()).downforce;
  double force = down.sum(), moment = down[0] * front.x() + down[1] * rear.x() -
                                      q * air.drag * at(bodies[0].origin.x(), air.drag_height).z();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    force += bodies[i].mass * of.gravity;
    moment += bodies[i].mass * of.gravity * state.bodies.poses[i].place.x();
  }
  const double all = force;
  const auto Fz = car.vertical_forces(state);
  for (std::size_t i = 0; i < car::kCorners; ++i) {
    force -= Fz[i];
    const WheelMotion& wheel = state.wheels[i].motion;
    const Vector3d F = wheel.carrier * state.wheels[i].hub.force,
                   M = wheel.carrier * state.wheels[i].hub.moment;
    moment += wheel.center.cross(F).y() + M.y();
  }
  rested.force = std::max(rested.force, std::abs(force) / all);
  rested.moment = std::max(rested.moment, std::abs(moment) / (all * 1.55));
}

Rested rest_under_air(bool rigid, TiresOfCar tires, bool smoke) {
  Rested rested;
  const road::PlaneRoad flat;
  for (double speed = 20.0; speed < 91.0; speed += smoke ? 70.0 : 10.0)
    for (double times = 1.0; times < 5.5; times += smoke ? 4.0 : 1.0) {
      ++rested.cars;
      auto car = Car::make(pressed(rigid, speed, times, 0.9), benchmarks::tires_of_car(tires));
      if (!car) throw std::runtime_error(car.failure().reason);
      auto state = (*car)->settle(flat, speed, {});
      if (!state) {
        const std::string& why = state.failure().reason;
        const bool words = why.find("had sunk most at") != std::string::npos;
        rested.in_words += words ? 1 : 0;
        fmt::print("  {:.0f} m/s, {:.0f} weights: {}\n", speed, times, why);
        continue;
      }
      ++rested.at_rest;
      judge(**car, *state, speed, rested);
      const double lasts = smoke ? 0.05 : 0.3;
      while (state->time() < lasts) {
        if (const auto done = (*car)->advance(*state, 2e-4, flat, {}); !done)
          throw std::runtime_error(done.failure().reason);
        rested.slowed = std::max(rested.slowed, std::abs(state->bodies.rates[0] - speed));
      }
    }
  return rested;
}

/// Returns wheel rate over spring rate of one corner at rest, by virtual work: the five rods leave
/// the upright one free twist, which raises the contact point and moves wishbone and rocker.
double ratio_of_rates(const car::Axle& axle) {
  using W = suspension::DoubleWishbone;
  const auto& p = axle.corner.points;
  const Vector3d c = axle.corner.wheel_center;
  Eigen::Matrix<double, 6, 6> rows;
  int row = 0;
  for (const auto& [inner, outer] : {std::pair{W::kUcaFront, W::kUbj},
                                     {W::kUcaRear, W::kUbj},
                                     {W::kLcaFront, W::kLbj},
                                     {W::kLcaRear, W::kLbj},
                                     {W::kTrackrodInner, W::kTrackrodOuter}}) {
    const Vector3d u = (p[outer] - p[inner]).normalized();
    rows.row(row++) << u.transpose(), (p[outer] - c).cross(u).transpose();
  }
  rows.row(row) << 0.0, 0.0, 1.0, (axle.corner.contact - c).cross(Vector3d::UnitZ()).transpose();
  const Eigen::Matrix<double, 6, 1> twist =
      rows.partialPivLu().solve(Eigen::Matrix<double, 6, 1>::Unit(5));
  // The push-rod of both axles is attached to the upper wishbone, which rotates about its own axis.
  const Vector3d axis = (p[W::kUcaRear] - p[W::kUcaFront]).normalized(),
                 lever = axis.cross(p[W::kUbj] - p[W::kUcaFront]),
                 ball = twist.head<3>() + twist.tail<3>().cross(p[W::kUbj] - c);
  const double turns = lever.dot(ball) / lever.squaredNorm();
  const Vector3d outer = turns * axis.cross(p[W::kPushrodOuter] - p[W::kUcaFront]);
  const car::Inboard& inboard = *axle.inboard;
  const Vector3d rod = (p[W::kPushrodOuter] - p[W::kPushrodInner]).normalized();
  const double rocker =
      rod.dot(outer) / rod.dot(inboard.axis.cross(p[W::kPushrodInner] - inboard.pivot));
  const Vector3d spring = (inboard.damper - inboard.damper_on_chassis).normalized();
  const double ratio = rocker * spring.dot(inboard.axis.cross(inboard.damper - inboard.pivot));
  return ratio * ratio;
}

double error_of_wheel_rate() {
  car::CarParameters parameters = car::race_car(false);
  make_rigid(parameters);
  const car::CarMechanism car = car::build(parameters);
  double worst = 0.0;
  for (const bool front : {true, false}) {
    experiment::AxleKcTest test;
    test.front = front;
    test.loads = Eigen::Matrix<double, 12, 1>::Zero();
    test.rack = {0.0};
    const auto found = experiment::axle_compliance(car, test);
    if (!found) throw std::runtime_error(found.failure().reason);
    const car::Axle& axle = front ? parameters.front : parameters.rear;
    const double expected = ratio_of_rates(axle) * axle.inboard->unit.stiffness;
    for (const char* side : {"L", "R"}) {
      const double rate = 1.0 / (*found)[fmt::format("dz_{0}_by_Fz_{0}", side)][0];
      worst = std::max(worst, std::abs(rate / expected - 1.0));
    }
  }
  return worst;
}

/// A full car as a specimen that driving tests can use.
class LinearCarSpecimen : public experiment::Specimen, public Drives {
 public:
  explicit LinearCarSpecimen(TiresOfCar tires) : tires_(tires) {}
  Result<std::unique_ptr<Car>> car(const car::CarInputs&) const override {
    return Car::make(car::race_car(false), benchmarks::tires_of_car(tires_));
  }

 private:
  TiresOfCar tires_;
};

/// Returns the largest error |H - H_linear| / |H_linear| of the transfer functions of all sensors
/// from 0.5 to 20 Hz, in a test that states its mode and uses defaults otherwise. By symmetry the
/// body does not heave in the roll mode: there the sensor's error is relative to |H| of a hub.
double error_of_responses(TiresOfCar tires, experiment::PostMode mode, const std::string& name) {
  LinearCarSpecimen specimen(tires);
  const auto car = specimen.car({});
  const road::PlaneRoad flat;
  const auto linear = car::linearize(**car, *(*car)->settle(flat, 0.0, {}), flat);
  const Document keys = Document::parse(
      fmt::format("test = {{kind = \"four_post\", mode = \"{}\", spectra = true}}", name), "test");
  const auto test = experiment::language().read_test(keys.root().table("test"), {});
  const auto recorded = test->run(specimen);
  if (!recorded) throw std::runtime_error(recorded.failure().reason);
  const Channels& measured = *recorded;
  const std::array<double, 4> sign = experiment::signs_of(mode);
  double worst = 0.0;
  const std::vector<double>& f = measured["frequency"];
  for (std::size_t i = 0; i < f.size() && f[i] <= 20.0; ++i) {
    const Eigen::VectorXcd H = linear->response(f[i]) * Eigen::Vector4d(sign.data());
    for (std::size_t k = 0; k < linear->names.size(); ++k) {
      const std::string& sensor = linear->names[k];
      const auto found = std::polar(measured["tf_" + sensor][i], measured["phase_" + sensor][i]);
      const auto expected = H[static_cast<Eigen::Index>(k)];
      const double size = mode == experiment::PostMode::roll && sensor == "body_z"
                              ? measured["tf_hub_FL"][i]
                              : std::abs(expected);
      worst = std::max(worst, std::abs(found - expected) / size);
    }
  }
  return worst;
}

void rows_at_rest(bool rigid, TiresOfCar tires, bool smoke, Table& table) {
  const Rested rested = rest_under_air(rigid, tires, smoke);
  const std::string car =
      fmt::format("{} joints, {}", rigid ? "rigid" : "compliant", benchmarks::in_words(tires));
  table.row(fmt::format("{}: {} cars, 20 to 90 m/s, 1 to 5 weights of downforce", car, rested.cars),
            fmt::format("{} at rest, {} in words", rested.at_rest, rested.in_words),
            "all",
            rested.at_rest + rested.in_words == rested.cars && rested.at_rest > 0);
  table.row(car + ": sum Fz against weight and downforce, largest",
            fmt::format("{:.1e}", rested.force),
            "<= 1e-6",
            rested.force <= 1e-6);
  table.row(car + ": moment about the ground with drag, of sum Fz times wheelbase",
            fmt::format("{:.1e}", rested.moment),
            "<= 1e-6",
            rested.moment <= 1e-6);
  table.row(car + ": speed kept with drag, largest change",
            fmt::format("{:.1e} m/s", rested.slowed),
            "<= 1e-3 m/s",
            rested.slowed <= 1e-3);
}

/// Responses against the linear model. On the slick they are printed and not judged, because the
/// linear model leaves out the moments of a tire on its hub (docs/car.md).
void rows_on_posts(TiresOfCar tires, bool smoke, Table& table) {
  using experiment::PostMode;
  const bool is_judged = tires == TiresOfCar::springs;
  for (const auto& [mode, name] : {std::pair{PostMode::heave, "heave"},
                                   {PostMode::pitch, "pitch"},
                                   {PostMode::roll, "roll"}}) {
    if ((smoke || !is_judged) && mode != PostMode::heave) continue;
    const double error = error_of_responses(tires, mode, name);
    const std::string what =
        fmt::format("four posts at their defaults, {}, {}: all sensors, 0.5 to 20 Hz",
                    benchmarks::in_words(tires),
                    name);
    const std::string value = fmt::format("{:.2f} %", 100.0 * error);
    if (is_judged)
      table.row(what, value, "<= 2 %", error <= 0.02);
    else
      table.note(what + " (not judged: the linear model has no moments of tires)", value);
  }
}

int run(const benchmarks::Options& options) {
  const bool smoke = options.is_smoke();
  Table table("car_doors", options);
  for (const bool rigid : {true, false})
    for (const TiresOfCar tires : {TiresOfCar::springs, TiresOfCar::relaxing})
      rows_at_rest(rigid, tires, smoke, table);
  const double rate = error_of_wheel_rate();
  table.row("wheel rate on rigid joints against virtual work",
            fmt::format("{:.1e}", rate),
            "<= 1e-4",
            rate <= 1e-4);
  for (const TiresOfCar tires : {TiresOfCar::springs, TiresOfCar::relaxing})
    if (!smoke || tires == TiresOfCar::springs) rows_on_posts(tires, smoke, table);
  return table.exit_code();
}

}  // namespace

int main(int argc, char** argv) { return benchmarks::run_benchmark(argc, argv, {}, run); }
