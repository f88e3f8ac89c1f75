// SPDX-License-Identifier: Apache-2.0
// A test is what a laboratory does with a specimen, and the channels that it records. A recording
// is a pure function of the specimen's parameters and the test: it has the same bits whether the
// test is run alone, with other tests, or in any order. A test states its whole load path. A new
// kind is one file in tests/ and its line in language.cpp.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/document.h"
#include "base/result.h"
#include "experiment/language/specimen.h"
#include "experiment/rigs/measured_conditions.h"
#include "experiment/rigs/rig_slopes.h"
#include "measurement/channels.h"
#include "measurement/ledger.h"
#include "models/suspension/sign_views.h"

namespace latsch::report {
struct Scene;
}

namespace latsch {
class DocumentRecord;
}

namespace latsch::experiment {

struct DrumTest;
struct KeySection;
struct LoadDeflection;
struct ModalTest;
struct RollingStiffnessTest;
struct RollingTest;
struct SteadyConditions;

/// The settings of a test for its rig, for code that needs more of a test than its channels: pages
/// that draw the loaded tire, checks, comparisons. monostate: the test has none.
using RigSettings = std::variant<std::monostate,
                                 const DrumTest*,
                                 const LoadDeflection*,
                                 const ModalTest*,
                                 const RollingStiffnessTest*,
                                 const RollingTest*,
                                 const SteadyConditions*>;

/// Effect of the discretization on a channel: root mean square differences over the record, in the
/// channel's unit.
struct ChannelConvergence {
  std::string name, unit;   // name and SI unit of the channel
  double about_mean = 0.0;  // root mean square of the channel about its mean
  double by_step = 0.0;     // difference from a run with half the time step
  /// difference from a run with 3/2 of the segments; 0: a model without segments
  double by_segments = 0.0;
};

/// Description of a channel before the test runs.
struct ChannelInfo {
  std::string name, unit;  // SI
  std::string frame = "";  // "W", "H" or "C" for a force or moment
  /// false: the channel only describes another channel, as the shape of a mode describes its
  /// frequency
  bool is_compared = true;
  /// The slope that this channel is, to be computed from other channels, also those of a recording.
  std::optional<Regression> regression = {};
};
/// Returns the description of the channel of a slope, such as "dz_by_Fz" for "dz".
ChannelInfo slope_of(const std::string& moved, const std::string& unit, const SlopesBy& slopes);

/// A range of values, in SI.
struct Reach {
  double from, to;  // SI
};

/// Requested derivatives: of these channels by these parameters of the specimen, which are given by
/// their paths. Columns of Channel::slopes are in the order of the paths, in SI units.
struct Asked {
  std::vector<std::string> channels, paths;  // names of channels, and paths of parameters
};

class Test {
 public:
  virtual ~Test() = default;

  /// Returns a description for people: "drum, 60 km/h, 4500 N, cleat 15 mm x 30 mm".
  virtual std::string in_words() const = 0;
  /// Returns the legend of a curve of this test on a page: "2.6 bar, friction 0.8"; in_words() by
  /// default.
  virtual std::string conditions() const { return in_words(); }
  /// Returns the channels that run() records.
  virtual std::vector<ChannelInfo> channels() const = 0;
  /// Returns the names of capabilities of which a specimen must have at least one. Fixed for its
  /// kind.
  virtual std::vector<std::string> needs() const = 0;
  /// Returns how the test interpreted each column of its tables, one ledger for each file or set of
  /// measured numbers; empty if it reads none. `by` is the user named in the ledgers: "test
  /// steady".
  virtual std::vector<Ledger> ledgers(const std::string& /*by*/) const { return {}; }
  /// Returns the range of a channel that serves as abscissa (time, deflection), as far as the test
  /// alone determines it; nullopt if it is known only after a run.
  virtual std::optional<Reach> reach(const std::string&) const { return std::nullopt; }
  /// Returns the number of values of its channels; nullopt if it is known only after a run.
  virtual std::optional<long> samples() const { return std::nullopt; }
  /// Returns the number of values of one channel: samples(), or one for a slope, unless the kind of
  /// test defines it otherwise.
  virtual std::optional<long> samples_of(const std::string& channel) const;

  /// Returns the values (SI) of the condition Fz, kappa, alpha, gamma, Vx or p in the table of
  /// states of this test; empty if the test has none.
  virtual std::vector<double> driven_at(const std::string& /*condition*/) const { return {}; }

  /// Returns the settings of the rig if they have this type, otherwise nullptr.
  template <class Settings>
  const Settings* settings_as() const {
    const auto settings = rig_settings();
    const auto* found = std::get_if<const Settings*>(&settings);
    return found ? *found : nullptr;
  }
  /// Returns the test with shapes of modes recorded at these points, [3 x points], m, wheel frame;
  /// nullptr if it records no shapes.
  virtual std::shared_ptr<const Test> with_points(const Eigen::Matrix3Xd&) const { return nullptr; }

  /// Throws InputError if the specimen does not accept a condition of the test.
  virtual Result<Channels> run(Specimen& specimen) const = 0;
  /// Passes the channels to `tell` block by block, for a recording that is too long to be kept.
  /// Returns warnings about it, one sentence each.
  virtual Result<std::vector<std::string>> run_in_blocks(
      Specimen& specimen, const std::function<void(const Channels&)>& tell) const;
  /// A picture of a run, which could not be drawn from a recording without storing too many
  /// numbers.
  struct Picture {
    std::string title, svg, caption;  // heading, the picture as SVG text, a sentence below it
  };
  /// Results in addition to the channels. They are computed again for a page or a table and never
  /// stored.
  struct Details {
    std::vector<Picture> pictures;  // in the order of the page
    Channels numbers;               // SI
  };
  /// Runs the test for its details; they are empty if the test has none.
  virtual Result<Details> details(Specimen&) const { return Details{}; }
  /// Repeats the test with finer steps in time and space; nullopt if the test has no such steps.
  virtual std::optional<Result<std::vector<ChannelConvergence>>> convergence(
      const SpecimenKind& /*kind*/, const Document& /*numbers*/) const {
    return std::nullopt;
  }
  /// True if film() shows anything.
  virtual bool has_film() const { return false; }
  /// Adds to a scene the motion of the specimen in this test, in at most the given number of steps.
  /// Returns a Failure if the run fails.
  virtual Status film(Specimen&, int /*most_steps*/, report::Scene&) const { return {}; }
  /// Returns the positive direction of a channel or a detail, for conversion into the signs of
  /// another convention; nullopt: the test does not say.
  virtual std::optional<suspension::SignSense> sense(const std::string&) const {
    return std::nullopt;
  }
  /// Returns the details of a test in the signs of another convention.
  virtual Result<Details> details_in(suspension::SignView view, Specimen& specimen) const;
  /// True if run_with_slopes() returns slopes of this channel in every number in which specimens of
  /// the kind have slopes.
  virtual bool tells_slopes(const SpecimenKind& /*kind*/, const std::string& /*channel*/) const {
    return false;
  }
  /// Returns the same values as run() to the last bit, and the requested derivatives as far as they
  /// are known.
  virtual Result<Channels> run_with_slopes(Specimen& specimen, const Asked&) const {
    return run(specimen);
  }

 protected:
  /// Returns the settings of the test for its rig.
  virtual RigSettings rig_settings() const { return {}; }
};

/// Origin of the keys of a test.
struct TestSource {
  std::filesystem::path folder;      // folder of the files it names
  MeasuredConditions measured = {};  // reads conditions from measurements; empty outside of a study

  /// Returns the path of the file that a key of the test names. Every file that a test reads is
  /// found by this function, which makes its content a part of the test's identity.
  std::filesystem::path file(const Node& table, std::string_view key) const;
};

/// A test with its identity: a text of everything on which its recording depends, except the
/// specimen. The text is made from the keys that the reader has read and from the content of the
/// files that they name (base/document_record.h). So no kind of test writes it, and it is the same
/// for keys in a study, in a file, as numbers or from a measurement.
struct ReadTest {
  std::unique_ptr<Test> test;                // ready to run
  std::string identity;                      // canonical text
  std::vector<std::filesystem::path> files;  // files that it reads in addition to its own
};

/// Measured abscissas at which the test of an experiment is run if the experiment has no
/// [test.NAME].
struct MeasuredAbscissa {
  std::vector<double> deflections = {}, loaded_radii = {};  // m; at most one of the two
  long modes = 0;                                           // number of measured modes
  Eigen::Matrix3Xd points = {};  // m, wheel frame, at which shapes were measured
};

/// A kind of test: its name, and how it is read from a file.
struct TestKind {
  std::string name;      // "drum_cleat"
  std::string in_words;  // "rolls over a cleat on the drum"
  /// Names of capabilities; a specimen must have at least one of them.
  std::vector<std::string> needs;
  /// Reads the keys of a test except `kind`. Throws InputError that names file, line and key.
  std::unique_ptr<Test> (*read)(const Node& root, const TestSource& source);
  /// Returns the descriptions and samples of its keys; nullptr: the reference has no section for
  /// it.
  const KeySection& (*keys)() = nullptr;
  /// Version of the rig's computation, if versions give different recordings for equal keys. It is
  /// part of the identity of its tests, so that a journal never mixes recordings of two versions.
  std::string scheme = "";
  /// Reads the test from the table of an experiment that has no [test.NAME], and records the keys
  /// that make the test's identity; nullptr: experiments state no such test.
  std::unique_ptr<Test> (*read_measured)(const Node& experiment,
                                         const MeasuredAbscissa& measured,
                                         DocumentRecord& keys) = nullptr;
};

}  // namespace latsch::experiment
