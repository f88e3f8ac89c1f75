// SPDX-License-Identifier: Apache-2.0
// A corner of a suspension as a kind of specimen. Bushings that its file names by their own files,
// [bushing.ubj] file = "rubber.bus", become numbers of it: bushing.ubj.x, bushing.ubj.curve.x.
#include <algorithm>

#include "base/document_parts.h"
#include "base/error.h"
#include "experiment/language/capabilities.h"
#include "experiment/language/specimen.h"
#include "experiment/rigs/suspension/kc_compliance.h"
#include "formats/car/bus_file.h"
#include "models/suspension/bushing_reader.h"
#include "models/suspension/suspension_reader.h"

namespace latsch::experiment {
namespace {

class SuspensionSpecimen : public Specimen, public IsLoaded, public MovesAsLinkage {
 public:
  explicit SuspensionSpecimen(const Document& numbers)
      : numbers_(numbers), corner_(suspension::read_corner(numbers.root())) {}

  Result<Channels> load(const KcTest& test, const Asked& asked) override {
    KcSlopes slopes{{}, asked.channels};
    for (const std::string& path : asked.paths)
      slopes.varied.push_back(suspension::stiffnesses_at(numbers_, path));
    return run(statics(), test, slopes);
  }
  Result<Channels> compliance(const KcTest& test) override {
    return compliance_matrices(statics(), test);
  }

  Result<Channels> move(const KinematicsTest& test) override {
    if (test.with_rates && !corner_.geometry.rates)
      throw InputError(numbers_.root().place(),
                       "has no [spring]: wheel rate, ride rate and ride frequency take its "
                       "stiffness, sprung_mass and tire_stiffness");
    if (test.with_anti_roll_bar && !corner_.geometry.spring.blade)
      throw InputError(numbers_.root().place(),
                       "has no anti-roll bar: it takes rocker_arb_link, arb_link_blade and "
                       "arb_center");
    return run(corner_.geometry, test);
  }

 private:
  /// InputError where the file has none.
  suspension::DoubleWishbone statics() const {
    return corner_.statics ? *corner_.statics : suspension::read_suspension(numbers_.root());
  }

  Document numbers_;
  suspension::Corner corner_;
};

/// A document with bushings of other files in it, and where lines came to it.
struct Composed {
  Document document;
  struct Added {
    int line, count;  // behind this line of the file, so many
  };
  std::vector<Added> added;

  /// The line of the file that has become this one.
  int line_of_file(int line) const {
    for (auto one = added.rbegin(); one != added.rend(); ++one)
      if (line > one->line) line = std::max(one->line, line - one->count);
    return line;
  }
};

Composed with_bushings_of_files(const Document& written, const std::filesystem::path& folder) {
  Composed composed{written, {}};
  if (!written.root().has("bushing")) return composed;
  for (const Node& bushing : written.root().named_tables("bushing")) {
    if (!bushing.has("file")) continue;
    for (const std::string& key : suspension::keys_in_place_of_a_file())
      if (bushing.has(key)) bushing.reject(key, "stands beside file, expected one of them");
    const formats::BusFile file = formats::read_bus_file(folder / bushing.text("file"));
    const std::vector<std::string> lines = suspension::bushing_lines(file.bushing);
    const std::string path = bushing.path() + ".file";
    const Node now = composed.document.root().table("bushing").table(bushing.name());
    composed.added.push_back({now.place("file").line, static_cast<int>(lines.size()) - 1});
    composed.document = with_lines(composed.document, path, lines);
  }
  return composed;
}

class SuspensionKind : public SpecimenKind {
 public:
  std::string name() const override { return "suspension"; }
  std::string in_words() const override { return "suspension"; }
  std::string file() const override { return "a TOML file with kind = \"suspension\""; }
  int version() const override { return 2; }
  std::vector<std::string> abilities() const override { return abilities_of<SuspensionSpecimen>(); }

  bool recognizes(const std::filesystem::path&) const override { return false; }
  Document read(const std::filesystem::path& file) const override {
    const Document written = Document::read(file);
    const Composed composed = with_bushings_of_files(written, file.parent_path());
    try {
      SuspensionSpecimen{composed.document};
    } catch (const InputError& error) {  // what is wrong is said of the file as it stands
      const Place there = error.place();
      if (there.file != written.file() || composed.added.empty()) throw;
      const std::string words = error.what();
      throw InputError({there.file, composed.line_of_file(there.line)},
                       words.substr(there.text().size() + 2));
    }
    return composed.document;
  }
  std::unique_ptr<Specimen> build(const Document& numbers,
                                  std::unique_ptr<Specimen>) const override {
    return std::make_unique<SuspensionSpecimen>(numbers);
  }
  bool knows_slopes_in(const std::string& path) const override {
    return path.starts_with("bushing.");
  }
};

}  // namespace

const SpecimenKind& suspension_kind() {
  static const SuspensionKind kind;
  return kind;
}

}  // namespace latsch::experiment
