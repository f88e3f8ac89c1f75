// SPDX-License-Identifier: Apache-2.0
// A test: what a laboratory does with a specimen, and which channels it records.
//
// A recording is a pure function of the specimen's numbers and the test: the same bits alone,
// beside other tests, in any order. A test states its whole load path. A new kind is one file in
// tests/ and its line in language.cpp.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
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

namespace latsch::experiment {

/// A channel before the test runs.
struct ChannelInfo {
  std::string name, unit;   // SI
  std::string frame = "";   // "W", "H" or "C" of a force or moment
  bool is_compared = true;  // false: a part of another quantity, such as the shape of a mode
  std::optional<Regression> regression = {};  // what it is the slope of, in a recording too
};
/// "dz_by_Fz" of "dz"
ChannelInfo slope_of(const std::string& moved, const std::string& unit, const SlopesBy& slopes);

struct Reach {
  double from, to;  // SI
};

/// Which slopes a recording shall have: of these channels in these numbers of the specimen, by
/// their paths. Columns of Channel::slopes stand in the order of the paths, in SI.
struct Asked {
  std::vector<std::string> channels, paths;
};

class Test {
 public:
  virtual ~Test() = default;

  /// A sentence for people: "drum, 60 km/h, 4500 N, cleat 15 mm x 30 mm".
  virtual std::string in_words() const = 0;
  /// What a curve of it stands for on a page: "2.6 bar, friction 0.8"; in_words() unless it says
  /// less.
  virtual std::string conditions() const { return in_words(); }
  /// What run() records.
  virtual std::vector<ChannelInfo> channels() const = 0;
  /// Names of capabilities; a specimen has to have one of them. Those of its kind.
  virtual std::vector<std::string> needs() const = 0;
  /// What the test took each column of its tables for, one ledger a file or a measurement's
  /// numbers; empty where it reads none. `by`: "test steady".
  virtual std::vector<Ledger> ledgers(const std::string& /*by*/) const { return {}; }
  /// From where to where a channel goes by which others are told (time, deflection), as far as the
  /// test alone says; nullopt where a run has to.
  virtual std::optional<Reach> reach(const std::string&) const { return std::nullopt; }
  /// How many values its channels have; nullopt where a run has to tell.
  virtual std::optional<long> samples() const { return std::nullopt; }
  /// How many values one of its channels has: samples(), of a slope one, unless the test says more.
  virtual std::optional<long> samples_of(const std::string& channel) const;

  /// The values (SI) at which a table of states drives a rolling tire: of Fz, kappa, alpha, gamma,
  /// Vx or p. Empty: the test states none of that.
  virtual std::vector<double> driven_at(const std::string& /*condition*/) const { return {}; }

  /// Throws InputError where the specimen cannot take a condition of the test.
  virtual Result<Channels> run(Specimen& specimen) const = 0;
  /// The same channels block by block, for a recording that is too long to be kept. Gives back what
  /// is to be minded of it, a sentence each.
  virtual Result<std::vector<std::string>> run_in_blocks(
      Specimen& specimen, const std::function<void(const Channels&)>& tell) const;
  /// What a page shows of a run beside its channels, and the numbers that are too many for a trial.
  struct Picture {
    std::string title, svg, caption;
  };
  struct Details {
    std::vector<Picture> pictures;
    Channels numbers;
  };
  virtual Result<Details> details(Specimen&) const { return Details{}; }
  /// Whether film() has anything to show.
  virtual bool has_film() const { return false; }
  /// Adds to a scene how the specimen moves in this test, in at most so many steps. A Failure where
  /// the run is one.
  virtual Result<bool> film(Specimen&, int /*most_steps*/, report::Scene&) const { return true; }
  /// Which way a channel, also of the details, is positive, for those who want it in the signs of
  /// another convention; nullopt: the test does not say.
  virtual std::optional<suspension::SignSense> sense(const std::string&) const {
    return std::nullopt;
  }
  /// The details in these signs.
  virtual Result<Details> details_in(suspension::SignView view, Specimen& specimen) const;
  /// Whether run_with_slopes() tells slopes of this channel in every number in which specimens of
  /// the kind know them.
  virtual bool tells_slopes(const SpecimenKind& /*kind*/, const std::string& /*channel*/) const {
    return false;
  }
  /// The same values to the last bit, and the slopes that are asked for, as far as they are known.
  virtual Result<Channels> run_with_slopes(Specimen& specimen, const Asked&) const {
    return run(specimen);
  }
};

/// Where the keys of a test stand.
struct TestSource {
  std::filesystem::path folder;      // of files it names
  MeasuredConditions measured = {};  // empty: outside of a study

  /// The path of the file that a key of the test names. Every file that a test reads is found by
  /// this function: it makes the content a part of the test's identity.
  std::filesystem::path file(const Node& table, std::string_view key) const;
};

/// A test with its identity: all that its recording depends on but the specimen, as text. The text
/// is made from the keys the reader asked for and from the content of the files they name
/// (base/document_record.h), so no kind of test writes it, and it is the same wherever the keys
/// stand: in a study, in a file, as numbers or as they were measured.
struct ReadTest {
  std::unique_ptr<Test> test;
  std::string identity;
  std::vector<std::filesystem::path> files;  // that it reads beside its own
};

struct TestKind {
  std::string name;                // "drum_cleat"
  std::string in_words;            // "rolls over a cleat on the drum"
  std::vector<std::string> needs;  // names of capabilities: a specimen has to have one of them
  /// Reads its keys, but `kind`. Throws InputError naming the place.
  std::unique_ptr<Test> (*read)(const Node& root, const TestSource& source);
  /// How its rig computes, if another rig gives other recordings of the same keys: a part of the
  /// identity of its tests, so that a journal never mixes recordings of two.
  std::string scheme = "";
};

}  // namespace latsch::experiment
