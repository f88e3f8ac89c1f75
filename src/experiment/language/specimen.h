// SPDX-License-Identifier: Apache-2.0
// A specimen: a model with its numbers, or an outside program in its place, as a test drives it.
//
// It knows nothing of tests, files and measurements. What can be done with it are its capabilities
// (capabilities.h), interfaces of physics that its class has or has not; a test asks for the one it
// drives. What a specimen answers depends on its numbers and the test alone, not on what was done
// with it before.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/document.h"

namespace latsch::report {
struct StudyReport;
}

namespace latsch::experiment {

class Test;
struct Provenance;

class Specimen {
 public:
  virtual ~Specimen() = default;

  /// nullptr where it has not this capability.
  template <class Capability>
  Capability* find() {
    return dynamic_cast<Capability*>(this);
  }
};

/// How much a page may compute of what it shows beside the fit.
enum class Thoroughness { seconds, minutes };

/// Between which values a number is looked for where a study says no bounds, SI.
struct UsualRange {
  double lower, upper;
};

/// What a specimen does beyond the data that it was fitted to, and the numbers that make it do so,
/// by their paths, SI.
struct FaultBeyondData {
  std::string words;
  std::vector<std::pair<std::string, double>> numbers = {};
};

/// The values (SI) of a condition, "Fz" or "alpha", at which a specimen was measured.
using MeasuredAt = std::function<std::vector<double>(const std::string&)>;

/// How a file becomes numbers that can vary, and numbers a specimen. A new kind is one file
/// x_kind.cpp and its line in language.cpp.
class SpecimenKind {
 public:
  virtual ~SpecimenKind() = default;

  /// "ring_tire"; in words "flexible ring"; its file "a TOML file with kind = \"ring_tire\"".
  virtual std::string name() const = 0;
  virtual std::string in_words() const = 0;
  virtual std::string file() const = 0;
  /// Raised whenever a specimen of the same numbers answers other than before: trials of another
  /// version are not taken for this one's.
  virtual int version() const = 0;
  /// Names of the capabilities its specimens have.
  virtual std::vector<std::string> abilities() const = 0;
  bool has(const std::string& ability) const;

  /// Whether a file that states no kind is one of this: by its ending, or by the tables it has.
  virtual bool recognizes(const std::filesystem::path& file) const = 0;
  /// The numbers of a file by their paths: "sidewall.radial.stiffness", "PKY1". InputError.
  virtual Document read(const std::filesystem::path& file) const = 0;
  /// What that left out of the file or assumed for it, a sentence each.
  virtual std::vector<std::string> notes(const std::filesystem::path&) const { return {}; }
  /// InputError where the numbers make no specimen. One of numbers before may hand on its work that
  /// does not depend on what has changed: the result is that of a fresh one to the last bit.
  virtual std::unique_ptr<Specimen> build(const Document& numbers,
                                          std::unique_ptr<Specimen> reuse = nullptr) const = 0;
  /// InputError where the numbers make no specimen; as cheap as that can be found out.
  virtual void check(const Document& numbers) const { build(numbers); }
  /// The text of a file with these numbers.
  virtual std::string text(const Document& numbers) const;
  /// The same file with the origin of its numbers in comments (provenance.h). It is read to the
  /// same numbers.
  virtual std::string annotated_text(const Document& numbers, const Provenance& provenance) const;
  /// The characters that begin a comment line in its files.
  virtual std::string comment_mark() const { return "#"; }

  /// Whether its specimens know the slopes of what they answer in the number at this path.
  virtual bool knows_slopes_in(const std::string& /*path*/) const { return false; }

  /// Of the number at this path; nullopt where it has none.
  virtual std::optional<UsualRange> usual_range(const std::string& /*path*/) const {
    return std::nullopt;
  }

  /// How it misbehaves in ranges 1.5 times as wide as those it was measured in; a null function: as
  /// the ranges of its file, or usual ones.
  virtual std::vector<FaultBeyondData> faults_beyond_data(const Document&,
                                                          const MeasuredAt& = nullptr) const {
    return {};
  }

  /// A line for people: "Tire B, 225/50R16, 2400 HEX8, 40 sectors".
  virtual std::string describe(const Document& numbers) const;
  /// What to mind when this test is run with these numbers; empty: nothing.
  virtual std::string remark(const Document&, const Test&) const { return ""; }
  /// What a measurement has to fit into, m; nullopt where the numbers do not say.
  struct Size {
    double outer_radius = 0.0, section_height = 0.0;
  };
  virtual std::optional<Size> size(const Document& numbers) const;
  /// Whether the magnitudes of its numbers are known, so that unusual ones can be pointed out.
  virtual bool has_usual_numbers() const { return false; }
  /// Whether draw_body() has anything to show.
  virtual bool has_body() const { return false; }
  /// Adds its shape in space to a page, in the states of the tests: StudyReport::pictures or scene.
  virtual void draw_body(const Document&,
                         const std::vector<const Test*>&,
                         report::StudyReport&) const {}
  /// Adds to a page what this kind can show of the found specimen, in the states of the tests.
  virtual void draw(const Document&,
                    const std::vector<const Test*>&,
                    Thoroughness,
                    report::StudyReport&) const {}
};

}  // namespace latsch::experiment
