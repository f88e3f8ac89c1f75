// SPDX-License-Identifier: Apache-2.0
// A corner of a suspension as a kind of specimen, with the contents of the files that its file
// names (composed_suspension.h).
#include <fmt/format.h>

#include "base/error.h"
#include "experiment/kinds/composed_suspension.h"
#include "experiment/kinds/hardpoint_doubts.h"
#include "experiment/kinds/pictures/films_of_tests.h"
#include "experiment/kinds/pictures/suspension_scene.h"
#include "experiment/kinds/specimen_kinds.h"
#include "experiment/language/capabilities.h"
#include "experiment/language/specimen.h"
#include "experiment/rigs/suspension/kc_compliance.h"
#include "formats/car/car_file_doubts.h"
#include "models/suspension/geometry_reader.h"
#include "models/suspension/suspension_reader.h"
#include "report/report.h"

namespace latsch::experiment {
namespace {

class SuspensionSpecimen : public Specimen, public IsLoaded, public MovesAsLinkage {
 public:
  explicit SuspensionSpecimen(const Document& numbers)
      : numbers_(numbers), corner_(suspension::read_corner(numbers.root())) {}

  Result<Channels> load(const KcTest& test, const Asked& asked) override {
    const suspension::CompliantCorner& corner = statics();
    KcSlopes slopes{{}, asked.channels};
    for (const std::string& path : asked.paths)
      slopes.varied.push_back(suspension::stiffnesses_at(numbers_, path, corner.joints));
    return run(corner, test, slopes);
  }
  Result<Channels> watch(const KcTest& test, const RigWatcher& watcher) override {
    return run(statics(), test, {}, watcher);
  }
  Result<Channels> compliance(const KcTest& test) override {
    return compliance_matrices(statics(), test);
  }

  Result<Channels> move(const KinematicsTest& test) override {
    if (test.with_rates && !corner_.geometry.rates)
      throw InputError(numbers_.root().place(),
                       "has no [spring]: wheel rate, ride rate and ride frequency need its "
                       "stiffness, sprung_mass and tire_stiffness");
    if (test.with_anti_roll_bar && !corner_.geometry.spring.blade)
      throw InputError(numbers_.root().place(),
                       "has no anti-roll bar: it needs rocker_arb_link, arb_link_blade and "
                       "arb_center");
    return run(corner_.geometry, test);
  }

 private:
  /// Throws InputError if the file has no bushings.
  const suspension::CompliantCorner& statics() const {
    if (corner_.compliant) return *corner_.compliant;
    numbers_.root().reject("bushing", "is missing: loads need the stiffnesses of its joints");
  }

  Document numbers_;
  suspension::SuspensionCorner corner_;
};

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
    const ComposedSuspension composed = composed_suspension(written, file.parent_path());
    try {
      SuspensionSpecimen{composed.document};
    } catch (const InputError& error) {  // messages refer to the file as written
      const Place& there = error.place();
      if (there.file != written.file() || composed.added.empty()) throw;
      const std::string words = error.what();
      throw InputError(composed.origin(there), words.substr(there.text().size() + 2));
    }
    return composed.document;
  }
  std::vector<std::string> notes(const std::filesystem::path& file) const override {
    std::vector<std::string> all = SpecimenKind::notes(file);
    const Document numbers = read(file);
    for (const std::string& doubt : doubts_about_hardpoints(numbers.root()))
      all.push_back(file.string() + ": " + doubt);
    // The ledger of the file judges signs of hardpoints that the file itself states.
    if (Document::read(file).root().has("hardpoints"))
      for (const LedgerDoubt& doubt : formats::doubts_of_car_file(numbers.root()))
        if (doubt.name.starts_with("hardpoint"))
          all.push_back(file.string() + ": " + doubt.sentence);
    return all;
  }
  std::unique_ptr<Specimen> build(const Document& numbers,
                                  std::unique_ptr<Specimen>) const override {
    return std::make_unique<SuspensionSpecimen>(numbers);
  }
  bool knows_slopes_in(const std::string& path) const override {
    return suspension::is_stiffness(path);
  }
  Place written_place(const std::filesystem::path& file, const Place& place) const override {
    return composed_suspension(Document::read(file), file.parent_path()).origin(place);
  }
  bool has_usual_numbers() const override { return true; }
  bool has_body() const override { return true; }
  void draw_body(const Document& numbers,
                 const std::vector<const Test*>& tests,
                 report::StudyReport& page) const override {
    page.scene = suspension_scene(suspension::read_corner(numbers.root()).geometry);
    SuspensionSpecimen specimen(numbers);
    add_films(tests, specimen, *page.scene);
  }
};

}  // namespace

const SpecimenKind& suspension_kind() {
  static const SuspensionKind kind;
  return kind;
}

}  // namespace latsch::experiment
