// SPDX-License-Identifier: Apache-2.0
// Draws a car's run in space: chassis, links, springs, deformed tires, the loads on its wheels, and
// the road or the posts below it.
//
// Pictures are taken every kInterval, or at the test's samples if these are farther apart; this
// shows waves of up to some 50 Hz. Of a run with more pictures than a page can hold, the part is
// shown in which the wheel loads vary most. Points are relative to a position that moves along x
// with the chassis. The chassis is a sketch between the attachment points of its links; it moves as
// computed.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "experiment/rigs/car/car_record.h"
#include "experiment/tests/films/linkage_drawing.h"

namespace latsch::experiment {

class CarFilm {
 public:
  static constexpr double kInterval = 4e-3;  // s
  static constexpr double kLead = 0.03;      // s, shown before time 0

  enum class On { road, posts };
  explicit CarFilm(On on) : on_(on) {}

  /// This object has to outlive the watcher, and the car has to outlive this object.
  CarWatcher watcher();
  /// Adds meshes and a sequence of the given name with at most the given number of steps, and the
  /// road of the run if it does not move.
  void add_to(report::Scene& scene,
              const std::string& name,
              int most_steps,
              const road::Road* road = nullptr);

 private:
  struct Ring {
    std::uint32_t first;   // index in the mesh; two points for each position around
    int points;            // number around
    double width, radius;  // m, free
  };
  void see(const car::Car& car, const car::CarState& state, const road::Road& road, double time);
  void begin(const car::Car& car, const car::CarState& state);
  void add_chassis(const car::Car& car);
  void add_rings(const car::Car& car, const car::CarState& state);
  void add_loads();
  void add_posts(const car::Car& car);
  void place_tires(const car::Car& car,
                   const car::CarState& state,
                   const road::Road& road,
                   double time,
                   report::Scene::Step& step) const;

  On on_;
  std::optional<LinkageDrawing> drawing_;
  report::Scene::Mesh mesh_;
  std::vector<report::Scene::Arrow> arrows_;
  std::array<Ring, car::kCorners> rings_{};
  /// indices of the first points in the mesh: of one point for each wheel, and of four points for
  /// each post
  std::uint32_t contacts_ = 0, posts_ = 0;
  double rear_ = 0.0, front_ = 0.0;  // m, ends of the road that is shown
  double side_ = 0.0;  // m, edge of the road that is shown, from the middle of the car
  double y_ = 0.0;     // m, of that
  std::vector<report::Scene::Step> steps_;
};

}  // namespace latsch::experiment
