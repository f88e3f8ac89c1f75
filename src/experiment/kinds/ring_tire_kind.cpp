// SPDX-License-Identifier: Apache-2.0
// The flexible ring as a kind of specimen.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "experiment/kinds/pictures/rolling_scene.h"
#include "experiment/kinds/rolling_specimen.h"
#include "experiment/kinds/specimen_kinds.h"
#include "experiment/kinds/tir_numbers.h"
#include "experiment/language/known_limits.h"
#include "experiment/rigs/vibration_rig.h"
#include "models/ring_tire/description/ring_reader.h"
#include "models/ring_tire/ring/ring_tire.h"
#include "models/ring_tire/rolling_ring.h"
#include "report/report.h"

namespace latsch::experiment {
namespace {

class RingSpecimen : public RollingSpecimen, public Vibrates, public KnowsLimits {
 public:
  explicit RingSpecimen(const Document& numbers)
      : ring_(numbers), parameters_(ring_.parameters()) {}

  std::unique_ptr<Tire> tire(const Inflation& pressure) const override {
    return ring_.tire(pressure);
  }
  Result<Channels> vibrate(const ModalTest& test, const Asked&) override {
    ring_tire::RingTire tire(ring_.parameters_at(test.pressure));
    return experiment::run(tire, test);
  }
  /// Returns the limits of this tire model on a cleat: a rigid cross section rests on the highest
  /// point below it, and a cell of the tread that lies across an edge touches only one plane
  /// (docs/ring_tire.md).
  std::vector<std::string> limits_on(const Cleat& cleat) const override {
    std::vector<std::string> all;
    if (std::abs(cleat.angle) >= kStraightCleat && parameters_.belt.bending_across == 0.0)
      all.push_back(
          "the sections of this flexible ring stay straight across (belt.bending_across is 0), so "
          "an oblique cleat lifts it over its whole width: the more oblique the cleat, the larger "
          "is Fz, while that of a finite-element tire falls (docs/ring_tire.md); "
          "belt.bending_across lets the sections bend");
    if (std::string unresolved = unresolved_by_tread(cleat); !unresolved.empty())
      all.push_back(std::move(unresolved));
    return all;
  }
  /// Returns the limit of a flat tread: if the wheel is cambered, the load acts at the edge of the
  /// tread, whereas on a real tire it acts on the curved crown of the tread.
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
  /// Returns a sentence if a cleat is so narrow that the blocks of the tread, or the lines of
  /// blocks, do not resolve it; otherwise an empty text.
  std::string unresolved_by_tread(const Cleat& cleat) const {
    // least number of blocks along a cleat; the force then has an error of a few percent, with
    // fewer blocks 10 % and more
    constexpr double kCells = 4.0;
    const ring_tire::Tread& tread = parameters_.tread;
    const double around = 2.0 * std::numbers::pi * parameters_.belt.radius / parameters_.nodes;
    const double cell = around / tread.blocks, spacing = tread.width / tread.lines;
    const double along = cleat.length / std::max(std::abs(std::cos(cleat.angle)), 1e-9),
                 across = cleat.length / std::max(std::abs(std::sin(cleat.angle)), 1e-9);
    if (along < kCells * cell)
      return fmt::format(
          "the cleat is {:.3g} mm long and the blocks of this flexible ring are {:.3g} mm apart: a "
          "block across an edge carries nearly nothing, so the ring feels the cleat shorter than "
          "it "
          "is by about a block, and hardly at all below two; tread.blocks = {:.0f} resolves it",
          1e3 * along,
          1e3 * cell,
          8.0 * std::ceil(kCells * around / along / 8.0));
    if (std::abs(cleat.angle) > 0.25 * std::numbers::pi && across < spacing)
      return fmt::format(
          "the cleat is {:.3g} mm wide across the tread, whose lines of blocks are {:.3g} mm "
          "apart: "
          "it may lie between two lines, and the ring does not feel it there; tread.lines = {:.0f} "
          "resolves it",
          1e3 * across,
          1e3 * spacing,
          std::ceil(2.0 * tread.width / across));
    return "";
  }

  ring_tire::RollingRing ring_;
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
  /// Adds a note on the side of the tire, except for a ring without ply steer and conicity, which
  /// equals its mirror image.
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
    // throws for a wrong file; messages then refer to the file as written
    (void)RingSpecimen{document};
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
