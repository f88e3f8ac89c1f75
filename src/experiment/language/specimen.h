// SPDX-License-Identifier: Apache-2.0
// A specimen is a model with its numbers, or an outside program that replaces a model, as a test
// uses it.
//
// A specimen knows no tests, files or measurements. It offers capabilities (capabilities.h),
// interfaces of physics that its class may implement; a test requests the one that it needs. The
// results of a specimen depend on its numbers and the test alone, not on earlier tests.
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

  /// Returns nullptr if the specimen does not have this capability.
  template <class Capability>
  Capability* find() {
    return dynamic_cast<Capability*>(this);
  }
};

/// Computing time that a page may spend in addition to the fit.
enum class Thoroughness { seconds, minutes };

/// Default bounds of a parameter, SI, for studies that state none.
struct UsualRange {
  double lower, upper;  // SI
};

/// A fault of a specimen beyond the data to which it was fitted, and the parameters that cause it,
/// by their paths, SI.
struct FaultBeyondData {
  std::string words;                                         // one sentence
  std::vector<std::pair<std::string, double>> numbers = {};  // paths and values, SI
};

/// Returns the values (SI) of a condition, "Fz" or "alpha", at which a specimen was measured.
using MeasuredAt = std::function<std::vector<double>(const std::string&)>;

/// Converts a file to parameters that can vary, and parameters to a specimen. A new kind is one
/// file x_kind.cpp and its line in language.cpp.
class SpecimenKind {
 public:
  virtual ~SpecimenKind() = default;

  /// Returns the name of this kind of specimen, such as "ring_tire".
  virtual std::string name() const = 0;
  /// Returns the name of this kind of specimen for users, such as "flexible ring".
  virtual std::string in_words() const = 0;
  /// Returns a description of the files of this kind, such as "a TOML file with kind =
  /// \"ring_tire\"".
  virtual std::string file() const = 0;
  /// Version number, which is increased whenever a specimen with equal parameters gives other
  /// results than before: trials of another version are not reused.
  virtual int version() const = 0;
  /// Returns the names of the capabilities of its specimens.
  virtual std::vector<std::string> abilities() const = 0;
  /// True if its specimens have this capability.
  bool has(const std::string& ability) const;

  /// True if a file that states no kind belongs to this kind, judged by its extension or its
  /// tables.
  virtual bool recognizes(const std::filesystem::path& file) const = 0;
  /// Returns the numbers of a file by their paths: "sidewall.radial.stiffness", "PKY1". Throws
  /// InputError.
  virtual Document read(const std::filesystem::path& file) const = 0;
  /// Says what reading left out of the file or assumed for it, one sentence each.
  virtual std::vector<std::string> notes(const std::filesystem::path&) const { return {}; }
  /// The file of a part of the model, under the key that names it.
  struct Part {
    std::string key;             // such as "front_tire"
    const SpecimenKind* kind;    // kind of the part
    std::filesystem::path file;  // its file
  };
  /// Returns the files of models that a model's file names; none for a model of a single file.
  virtual std::vector<Part> parts(const std::filesystem::path&) const { return {}; }
  /// Returns the place in the file as written, given the place in the numbers that read() returned,
  /// which may contain lines of other files.
  virtual Place written_place(const std::filesystem::path&, const Place& place) const {
    return place;
  }
  /// Returns the specimen. Throws InputError if the parameters make none. `reuse` is a specimen of
  /// earlier parameters whose work may be reused if it is still valid: the result equals that of a
  /// fresh specimen to the last bit.
  virtual std::unique_ptr<Specimen> build(const Document& numbers,
                                          std::unique_ptr<Specimen> reuse = nullptr) const = 0;
  /// Throws InputError if the parameters make no specimen; computes as little as possible.
  virtual void check(const Document& numbers) const { build(numbers); }
  /// Returns the text of a model file with these numbers.
  virtual std::string text(const Document& numbers) const;
  /// Returns the same file as text(), with the origin of its numbers in comments (provenance.h).
  /// Reading it gives the same numbers.
  virtual std::string annotated_text(const Document& numbers, const Provenance& provenance) const;
  /// Returns the characters that begin a comment line in files of this kind.
  virtual std::string comment_mark() const { return "#"; }

  /// True if its specimens can compute derivatives of their results by the parameter at this path.
  virtual bool knows_slopes_in(const std::string& /*path*/) const { return false; }
  /// Returns why a specimen with these numbers does not know its slopes in this test by the
  /// parameters at these paths, whose slopes it knows in other tests; empty if it does.
  virtual std::string why_without_slopes(const Document& /*numbers*/,
                                         const Test& /*test*/,
                                         const std::vector<std::string>& /*paths*/) const {
    return "";
  }

  /// Returns the range of the number at this path; nullopt if it has none.
  virtual std::optional<UsualRange> usual_range(const std::string& /*path*/) const {
    return std::nullopt;
  }

  /// Returns implausible behavior of a specimen in ranges 1.5 times as wide as the measured ones.
  /// If the function that returns the measured ranges is null, uses those of the file or usual
  /// ranges.
  virtual std::vector<FaultBeyondData> faults_beyond_data(const Document&,
                                                          const MeasuredAt& = nullptr) const {
    return {};
  }

  /// Returns a description in one line: "Tire B, 225/50R16, 2400 HEX8, 40 sectors".
  virtual std::string describe(const Document& numbers) const;
  /// Returns a warning about running this test with these parameters; empty: none.
  virtual std::string remark(const Document&, const Test&) const { return ""; }
  /// Dimensions, m, that limit a measurement; nullopt if the parameters do not determine them.
  struct Size {
    double outer_radius = 0.0, section_height = 0.0;  // m
  };
  /// Returns the dimensions of a specimen with these numbers.
  virtual std::optional<Size> size(const Document& numbers) const;
  /// True if the usual magnitudes of its numbers are known, so that unusual ones can be reported.
  virtual bool has_usual_numbers() const { return false; }
  /// True if draw_body() draws anything.
  virtual bool has_body() const { return false; }
  /// Adds its shape in space to a page, in the states of the tests: StudyReport::pictures or scene.
  virtual void draw_body(const Document&,
                         const std::vector<const Test*>&,
                         report::StudyReport&) const {}
  /// Adds the results of this kind for the identified specimen to a page, in the states of the
  /// tests.
  virtual void draw(const Document&,
                    const std::vector<const Test*>&,
                    Thoroughness,
                    report::StudyReport&) const {}
};

}  // namespace latsch::experiment
