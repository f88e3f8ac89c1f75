// SPDX-License-Identifier: Apache-2.0
// The flexible ring as a kind of specimen.
#include <cmath>

#include "experiment/kinds/pictures/rolling_scene.h"
#include "experiment/kinds/rolling_specimen.h"
#include "experiment/kinds/specimen_kinds.h"
#include "experiment/kinds/tir_numbers.h"
#include "experiment/language/known_limits.h"
#include "experiment/rigs/vibration_rig.h"
#include "models/ring_tire/description/ring_reader.h"
#include "models/ring_tire/ring/ring_tire.h"
#include "report/report.h"

namespace latsch::experiment {
namespace {

class RingSpecimen : public RollingSpecimen, public Vibrates, public KnowsLimits {
 public:
  explicit RingSpecimen(const Document& numbers)
      : numbers_(numbers), parameters_(ring_tire::read_ring_tire(numbers.root())) {}

  std::unique_ptr<Tire> tire(const Inflation& pressure) const override {
    return std::make_unique<ring_tire::RingTire>(parameters_at(pressure));
  }
  Result<Channels> vibrate(const ModalTest& test, const Asked&) override {
    ring_tire::RingTire tire(parameters_at(test.pressure));
    return experiment::run(tire, test);
  }
  /// A straight section stands on the highest point of what is below it (docs/ring_tire.md).
  std::vector<std::string> limits_on(const Cleat& cleat) const override {
    if (std::abs(cleat.angle) < kStraightCleat || parameters_.belt.bending_across > 0.0) return {};
    return {
        "the sections of this flexible ring stay straight across (belt.bending_across is 0), so an "
        "oblique cleat lifts it over its whole width: the more oblique the cleat, the larger is "
        "Fz, "
        "while that of a finite-element tire falls (docs/ring_tire.md); belt.bending_across lets "
        "the sections bend"};
  }
  /// A flat tread leans on the edge that camber presses; a real one leans on its crown.
  std::vector<std::string> limits_at_camber(bool rolls) const override {
    if (!rolls || parameters_.tread.crown_radius > 0.0) return {};
    return {
        "the tread of this flexible ring is flat across (tread.crown_radius is 0): a cambered "
        "wheel that rolls on it may be pushed to the side that it leans away from, which no tire "
        "does; tread.crown_radius gives it a crown"};
  }
  double felt_half_width() const override { return 0.5 * parameters_.tread.width; }
  std::optional<double> tread_half_width() const override { return felt_half_width(); }
  std::vector<std::string> limits_across() const override {
    if (parameters_.belt.bending_across > 0.0) return {};
    return {
        "the sections of this flexible ring stay straight across (belt.bending_across is 0), so an "
        "edge below a part of its width lifts it over its whole width, and Fz on the edge is too "
        "large (docs/ring_tire.md); belt.bending_across lets the sections bend"};
  }

 private:
  /// Returns the parameters of a file with that pressure.
  ring_tire::RingParameters parameters_at(const Inflation& pressure) const {
    if (!pressure) return parameters_;
    Document numbers = numbers_;
    numbers.set("pressure", *pressure);
    return ring_tire::read_ring_tire(numbers.root());
  }

  Document numbers_;
  ring_tire::RingParameters parameters_;
};

class RingTireKind : public SpecimenKind {
 public:
  std::string name() const override { return "ring_tire"; }
  std::string in_words() const override { return "flexible ring"; }
  std::string file() const override { return "a TOML file with kind = \"ring_tire\""; }
  int version() const override { return 11; }
  std::vector<std::string> abilities() const override { return abilities_of<RingSpecimen>(); }

  bool recognizes(const std::filesystem::path&) const override { return false; }
  std::string describe(const Document& numbers) const override {
    return SpecimenKind::describe(numbers) + ", " + side_in_words(numbers);
  }
  /// A ring without ply steer and conicity is its own mirror image.
  std::vector<std::string> notes(const std::filesystem::path& file) const override {
    const Document numbers = Document::read(file);
    const auto belt = ring_tire::read_ring_tire(numbers.root()).belt;
    if (numbers.root().has("side") || (belt.bending_twist == 0.0 && belt.conicity == 0.0))
      return {};
    return {file.string() +
            ": has ply steer or conicity and states no side: it is assumed to be a tire of the "
            "left side (side = \"left\"); a car puts its mirror image on the right"};
  }
  Document read(const std::filesystem::path& file) const override {
    Document document = Document::read(file);
    RingSpecimen{document};  // errors are reported for the file as written
    return document;
  }
  std::unique_ptr<Specimen> build(const Document& numbers,
                                  std::unique_ptr<Specimen>) const override {
    return std::make_unique<RingSpecimen>(numbers);
  }
  void check(const Document& numbers) const override { RingSpecimen(numbers).tire({}); }
  bool has_usual_numbers() const override { return true; }
  bool has_body() const override { return true; }
  void draw_body(const Document& numbers,
                 const std::vector<const Test*>&,
                 report::StudyReport& page) const override {
    page.scene = rolling_scene(*RingSpecimen(numbers).tire({}));
  }
};

}  // namespace

const SpecimenKind& ring_tire_kind() {
  static const RingTireKind kind;
  return kind;
}

}  // namespace latsch::experiment
