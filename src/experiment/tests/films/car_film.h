// SPDX-License-Identifier: Apache-2.0
// A car's run in space: chassis, links, springs, tires as they stand, the loads on its wheels, and
// the road or the posts below it.
//
// It is seen every kInterval, or at the test's samples where these are fewer, which shows waves of
// up to some 50 Hz. A run that has more of them than a page takes is shown where its wheel loads
// move most. Points are told from a place that goes along x with the chassis. The chassis is a
// sketch between the points its links hang on; it moves as the computed one.
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
  static constexpr double kLead = 0.03;      // s: what is shown of a run before time 0

  enum class On { road, posts };
  explicit CarFilm(On on) : on_(on) {}

  /// Has to be outlived by this, and this by the car.
  CarWatcher watcher();
  /// Meshes and a sequence of that name, of at most so many steps; with the road of the run, where
  /// it stands still.
  void add_to(report::Scene& scene,
              const std::string& name,
              int most_steps,
              const road::Road* road = nullptr);

 private:
  struct Ring {
    std::uint32_t first;   // point of the mesh, two for each around
    int points;            // around
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
  std::uint32_t contacts_ = 0, posts_ = 0;  // points of the mesh: of each wheel one, four
  double rear_ = 0.0, front_ = 0.0;         // m, of the road that is shown
  double side_ = 0.0;                       // m, from the car's middle
  double y_ = 0.0;                          // m, of that
  std::vector<report::Scene::Step> steps_;
};

}  // namespace latsch::experiment
