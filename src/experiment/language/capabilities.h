// SPDX-License-Identifier: Apache-2.0
// What can be done with a specimen: interfaces of physics, none of a test. One class of tests can
// drive every specimen that has what it asks for.
//
// Conditions a test leaves open (pressure, friction) are the specimen's own. Every specimen has the
// pressure that a test states; the others are for specimens that take them.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "base/result.h"
#include "experiment/language/test.h"
#include "experiment/rigs/car/axle_kc_rig.h"
#include "experiment/rigs/footprint_rig.h"
#include "experiment/rigs/inflation.h"
#include "experiment/rigs/kc_rig.h"
#include "experiment/rigs/load_case.h"
#include "experiment/rigs/static_stiffness.h"
#include "experiment/rigs/suspension/kinematics_rig.h"
#include "formats/tables/csv_table.h"
#include "measurement/channels.h"
#include "models/car/car.h"
#include "models/magic_formula/conventions.h"
#include "models/tire/tire.h"

namespace latsch::experiment {

/// Is pressed on flat ground, standing still.
struct IsPressed {
  static constexpr const char* kName = "is pressed on the ground";
  virtual ~IsPressed() = default;
  /// With the slopes asked for, where they are known.
  virtual Result<Channels> press(const LoadDeflection& test, const Asked& asked) = 0;
};

/// Vibrates with its rim held, off the ground or standing on it.
struct Vibrates {
  static constexpr const char* kName = "vibrates";
  virtual ~Vibrates() = default;
  /// With the slopes asked for, where they are known.
  virtual Result<Channels> vibrate(const ModalTest& test, const Asked& asked) = 0;
  /// m, wheel frame: where shapes are recorded when no laboratory prescribes it; none: nowhere.
  virtual Eigen::Matrix3Xd sensor_points() const { return {}; }
};

/// Stands on the ground or on a bar and is moved in every direction there.
struct StandsOnGround {
  static constexpr const char* kName = "stands on the ground";
  virtual ~StandsOnGround() = default;
  /// With the slopes asked for, where they are known.
  virtual Result<Channels> stand(const StandingTest& test, const Asked& asked) = 0;
};

/// Grows under its pressure.
struct IsInflated {
  static constexpr const char* kName = "is inflated";
  virtual ~IsInflated() = default;
  /// With the slopes asked for, where they are known.
  virtual Result<Channels> inflate(const InflatedSizeTest& test, const Asked& asked) = 0;
};

/// Has a mass and moments of inertia of its own.
struct IsWeighed {
  static constexpr const char* kName = "is weighed";
  virtual ~IsWeighed() = default;
  /// With the slopes asked for, where they are known.
  virtual Result<Channels> weigh(const MassTest& test, const Asked& asked) = 0;
};

struct HasFootprint {
  static constexpr const char* kName = "leaves a footprint";
  virtual ~HasFootprint() = default;
  virtual Result<std::vector<StandingFootprint>> footprints(const FootprintTest& test) = 0;
  /// What the test records, with the slopes asked for, where they are known.
  virtual Result<Channels> print(const FootprintTest& test, const Asked&) {
    const auto states = footprints(test);
    if (!states) return states.failure();
    return to_channels(test, *states);
  }
};

/// Leaves its footprint with elements of a size that the test states.
struct HasTreadElements {
  static constexpr const char* kName = "has a section to divide into elements";
  virtual ~HasTreadElements() = default;
};

/// Rolls on a road, a step of time after the other.
struct Rolls {
  static constexpr const char* kName = "rolls";
  virtual ~Rolls() = default;
  /// A new one at rest, under this pressure. InputError where it is none for this tire.
  virtual std::unique_ptr<Tire> tire(const Inflation& pressure = {}) const = 0;
};

/// Answers to states of steady rolling, each for itself.
struct HasSteadyStates {
  static constexpr const char* kName = "has steady states";
  virtual ~HasSteadyStates() = default;
  virtual Channels steady(const formats::CsvTable& states,
                          const magic_formula::Conventions&) const = 0;
  /// The same block by block. Gives back what is to be minded: Test::run_in_blocks().
  virtual std::vector<std::string> steady_in_blocks(
      const formats::CsvTable& states,
      const magic_formula::Conventions&,
      const std::function<void(const Channels&)>& tell) const = 0;
  /// The same with the slopes asked for, where they are known.
  virtual Channels steady_with_slopes(const formats::CsvTable& states,
                                      const magic_formula::Conventions& conventions,
                                      const Asked&) const {
    return steady(states, conventions);
  }
  /// Through a table of states with their times, slips lagging (rigs/slip/slip_lag.h), with the
  /// slopes asked for.
  virtual Channels slip_history(const formats::CsvTable& states, const Asked&) const = 0;
};

/// A corner of a suspension, loaded on a rig that holds the chassis.
struct IsLoaded {
  static constexpr const char* kName = "is loaded on a K&C rig";
  virtual ~IsLoaded() = default;
  /// With the slopes asked for, where they are known.
  virtual Result<Channels> load(const KcTest& test, const Asked& asked) = 0;
  /// The same with somebody who looks at every state.
  virtual Result<Channels> watch(const KcTest& test, const RigWatcher& watcher) = 0;
  /// Its compliance matrices in the states of the test (rigs/suspension/kc_compliance.h).
  virtual Result<Channels> compliance(const KcTest& test) = 0;
};

/// A car that can be driven.
struct Drives {
  static constexpr const char* kName = "drives";
  virtual ~Drives() = default;
  /// A new one whose springs carry it as drawn, with these loads on it.
  virtual Result<std::unique_ptr<car::Car>> car(const car::CarInputs& at_rest) const = 0;
};

/// Has axles that a K&C rig loads while it holds the chassis.
struct HasAxles {
  static constexpr const char* kName = "is loaded on a K&C rig by its axles";
  virtual ~HasAxles() = default;
  /// With the slopes asked for, where they are known.
  virtual Result<Channels> load(const AxleKcTest& test, const Asked& asked) const = 0;
  /// The same with somebody who looks at every state.
  virtual Result<Channels> watch(const AxleKcTest& test, const RigWatcher& watcher) const = 0;
  /// Its compliance matrices in the states of the test.
  virtual Result<Channels> compliance(const AxleKcTest& test) const = 0;
};

/// A corner of a suspension as rigid links, and the axle of it and its mirror image.
struct MovesAsLinkage {
  static constexpr const char* kName = "moves as a linkage";
  virtual ~MovesAsLinkage() = default;
  virtual Result<Channels> move(const KinematicsTest& test) = 0;
};

/// Takes from a test what of others stands in their own files.
struct TakesConditions {
  static constexpr const char* kName = "takes friction and sensor points from a test";
  virtual ~TakesConditions() = default;
};

/// Names of the capabilities a class of specimens has.
template <class S>
std::vector<std::string> abilities_of() {
  std::vector<std::string> names;
  const auto add = [&]<class Capability>(Capability*) {
    if constexpr (std::is_base_of_v<Capability, S>) names.emplace_back(Capability::kName);
  };
  add(static_cast<IsPressed*>(nullptr));
  add(static_cast<Vibrates*>(nullptr));
  add(static_cast<StandsOnGround*>(nullptr));
  add(static_cast<IsInflated*>(nullptr));
  add(static_cast<IsWeighed*>(nullptr));
  add(static_cast<HasFootprint*>(nullptr));
  add(static_cast<HasTreadElements*>(nullptr));
  add(static_cast<Rolls*>(nullptr));
  add(static_cast<HasSteadyStates*>(nullptr));
  add(static_cast<IsLoaded*>(nullptr));
  add(static_cast<Drives*>(nullptr));
  add(static_cast<HasAxles*>(nullptr));
  add(static_cast<MovesAsLinkage*>(nullptr));
  add(static_cast<TakesConditions*>(nullptr));
  return names;
}

}  // namespace latsch::experiment
