// SPDX-License-Identifier: Apache-2.0
// Capabilities are interfaces of physics that a specimen may implement; they know no test. A class
// of tests can drive every specimen with the capabilities that it needs. Rolls and Drives, which
// exported units use as well, are in models/tire and models/car.
//
// If a test does not state a condition (pressure, friction), the specimen's own value applies.
// Every specimen applies a pressure that the test states; other conditions can be stated only for
// specimens that accept them.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "base/result.h"
#include "experiment/language/test.h"
#include "experiment/rigs/car/axle_kc_rig.h"
#include "experiment/rigs/fe_tire/tire_rig.h"
#include "experiment/rigs/footprint_rig.h"
#include "experiment/rigs/inflation.h"
#include "experiment/rigs/kc_rig.h"
#include "experiment/rigs/load_case.h"
#include "experiment/rigs/slip/steady_conditions.h"
#include "experiment/rigs/suspension/kinematics_rig.h"
#include "formats/tables/csv_table.h"
#include "measurement/channels.h"
#include "models/car/drives.h"
#include "models/tire/rolls.h"

namespace latsch::experiment {

/// The specimen can be pressed on flat ground without rolling.
struct IsPressed {
  static constexpr const char* kName = "is pressed on the ground";  // in messages
  virtual ~IsPressed() = default;
  /// Returns the channels, with the requested derivatives as far as they are known.
  virtual Result<Channels> press(const LoadDeflection& test, const Asked& asked) = 0;
};

/// The specimen has vibration modes with its rim fixed, off the ground or on it.
struct Vibrates {
  static constexpr const char* kName = "vibrates";  // in messages
  virtual ~Vibrates() = default;
  /// Returns the modal channels, with the requested derivatives as far as they are known.
  virtual Result<Channels> vibrate(const ModalTest& test, const Asked& asked) = 0;
  /// Returns the default points at which mode shapes are recorded, m, wheel frame; none if there
  /// are no defaults.
  virtual Eigen::Matrix3Xd sensor_points() const { return {}; }
};

/// A function that runs a test on a finite-element tire and returns the channels. `slopes` is
/// nullptr if no derivatives are requested; otherwise the channels have those that are known.
using FeTireDrive = std::function<Result<Channels>(TireRig& rig, fe_tire::TireSlopes* slopes)>;

/// The specimen is a finite-element tire. A test that only such a tire can undergo runs the tire by
/// a function in the test's own file, so a new test needs no new capability.
struct IsFeTire {
  static constexpr const char* kName = "is a finite-element tire";  // in messages
  virtual ~IsFeTire() = default;
  /// Runs the test. `states_pressure` is true if the test states the pressure, so that the tire's
  /// own has no effect.
  virtual Result<Channels> drive(const FeTireDrive& drive,
                                 bool states_pressure,
                                 const Asked& asked) = 0;
  /// Returns the distance of neighboring rows of nodes at the ground, m, along the circumference.
  virtual double rows_apart() const = 0;
};

/// The specimen leaves a footprint on flat ground, whose pressures can be computed.
struct HasFootprint {
  static constexpr const char* kName = "leaves a footprint";  // in messages
  virtual ~HasFootprint() = default;
  /// Returns one footprint for each state of the test.
  virtual Result<std::vector<StandingFootprint>> footprints(const FootprintTest& test) = 0;
  /// Returns the channels of the test, with the requested derivatives as far as they are known.
  virtual Result<Channels> print(const FootprintTest& test, const Asked&) {
    const auto states = footprints(test);
    if (!states) return states.failure();
    return to_channels(test, *states);
  }
};

/// The specimen is a tire whose footprint can be divided into elements of a size that the test
/// states.
struct HasTreadElements {
  static constexpr const char* kName = "has a section to divide into elements";  // in messages
  virtual ~HasTreadElements() = default;
};

/// The specimen has forces in states of steady rolling, each independent of the others.
struct HasSteadyStates {
  static constexpr const char* kName = "has steady states";  // in messages
  virtual ~HasSteadyStates() = default;
  /// Returns those channels of slip_states.h that the specimen has, one sample for each row of
  /// `states`. Throws InputError, which names the row, for a state that the specimen does not take.
  virtual Result<Channels> steady(const formats::CsvTable& states, const SteadyConditions&) = 0;
  /// Computes the states block by block. Returns remarks as Test::run_in_blocks() does.
  virtual Result<std::vector<std::string>> steady_in_blocks(
      const formats::CsvTable& states,
      const SteadyConditions&,
      const std::function<void(const Channels&)>& tell) = 0;
  /// Computes the states, with the requested derivatives as far as they are known.
  virtual Result<Channels> steady_with_slopes(const formats::CsvTable& states,
                                              const SteadyConditions& conditions,
                                              const Asked&) {
    return steady(states, conditions);
  }
  /// Returns a sentence for each limit of the model that states exceed, for each condition that is
  /// assumed and for each condition of the test that has no effect on the model, without computing
  /// the states.
  virtual std::vector<std::string> limits_in(const formats::CsvTable& /*states*/,
                                             const SteadyConditions&) {
    return {};
  }
};

/// The specimen's forces lag behind slips that change as it rolls.
struct LagsBehindSlips {
  static constexpr const char* kName = "lags behind slips that change";  // in messages
  virtual ~LagsBehindSlips() = default;
  /// Returns the limits of the model, as sentences, for a table of states with times, which
  /// slip_history() computes.
  virtual std::vector<std::string> limits_in_history(const formats::CsvTable& /*states*/,
                                                     const SlipHistoryConditions&) const {
    return {};
  }
  /// Computes a table of states with times in which forces lag, and the requested derivatives.
  /// `remarks` receives sentences that are known after the run alone. Throws InputError, which
  /// names the row, for a state that the specimen does not take.
  virtual Result<Channels> slip_history(const formats::CsvTable& states,
                                        const SlipHistoryConditions&,
                                        const Asked&,
                                        std::vector<std::string>& remarks) = 0;
  /// Computes the table and passes the channels to `tell` in the order of the samples.
  virtual Status history_in_blocks(const formats::CsvTable& states,
                                   const SlipHistoryConditions& conditions,
                                   const std::function<void(const Channels&)>& tell,
                                   std::vector<std::string>& remarks) {
    const auto channels = slip_history(states, conditions, {}, remarks);
    if (!channels) return channels.failure();
    tell(*channels);
    return {};
  }
};

/// A corner of a suspension on a rig that holds the chassis fixed and applies loads to the wheel.
struct IsLoaded {
  static constexpr const char* kName = "is loaded on a K&C rig";  // in messages
  virtual ~IsLoaded() = default;
  /// Returns the channels of a K&C test, with the requested derivatives as far as they are known.
  virtual Result<Channels> load(const KcTest& test, const Asked& asked) = 0;
  /// Runs the test; `watcher` is called for every state.
  virtual Result<Channels> watch(const KcTest& test, const RigWatcher& watcher) = 0;
  /// Returns its compliance matrices in the states of the test (rigs/suspension/kc_compliance.h).
  virtual Result<Channels> compliance(const KcTest& test) = 0;
};

/// The specimen has axles to which a K&C rig can apply loads while it holds the chassis fixed.
struct HasAxles {
  static constexpr const char* kName = "is loaded on a K&C rig by its axles";  // in messages
  virtual ~HasAxles() = default;
  /// Returns the channels of a K&C test of an axle, with the requested derivatives as far as they
  /// are known.
  virtual Result<Channels> load(const AxleKcTest& test, const Asked& asked) const = 0;
  /// Runs the test; `watcher` is called for every state.
  virtual Result<Channels> watch(const AxleKcTest& test, const RigWatcher& watcher) const = 0;
  /// Returns its compliance matrices in the states of the test.
  virtual Result<Channels> compliance(const AxleKcTest& test) const = 0;
};

/// A corner of a suspension with rigid links, which with its mirror image forms an axle.
struct MovesAsLinkage {
  static constexpr const char* kName = "moves as a linkage";  // in messages
  virtual ~MovesAsLinkage() = default;
  /// Returns the kinematic outputs in every position of the test.
  virtual Result<Channels> move(const KinematicsTest& test) = 0;
};

/// The specimen accepts from a test conditions that other specimens state in their own files.
struct TakesConditions {
  /// description of this capability in messages
  static constexpr const char* kName = "takes friction and sensor points from a test";
  virtual ~TakesConditions() = default;
};

/// Returns the names of the capabilities of a class of specimens.
template <class S>
std::vector<std::string> abilities_of() {
  std::vector<std::string> names;
  const auto add = [&]<class Capability>(Capability*) {
    if constexpr (std::is_base_of_v<Capability, S>) names.emplace_back(Capability::kName);
  };
  add(static_cast<IsPressed*>(nullptr));
  add(static_cast<Vibrates*>(nullptr));
  add(static_cast<IsFeTire*>(nullptr));
  add(static_cast<HasFootprint*>(nullptr));
  add(static_cast<HasTreadElements*>(nullptr));
  add(static_cast<Rolls*>(nullptr));
  add(static_cast<HasSteadyStates*>(nullptr));
  add(static_cast<LagsBehindSlips*>(nullptr));
  add(static_cast<IsLoaded*>(nullptr));
  add(static_cast<Drives*>(nullptr));
  add(static_cast<HasAxles*>(nullptr));
  add(static_cast<MovesAsLinkage*>(nullptr));
  add(static_cast<TakesConditions*>(nullptr));
  return names;
}

}  // namespace latsch::experiment
