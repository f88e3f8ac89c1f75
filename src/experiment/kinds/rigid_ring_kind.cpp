// SPDX-License-Identifier: Apache-2.0
// The rigid ring as a kind of specimen.
#include <algorithm>
#include <cmath>

#include "experiment/kinds/fitted_tir.h"
#include "experiment/kinds/rolling_specimen.h"
#include "experiment/kinds/specimen_kinds.h"
#include "experiment/kinds/tir_numbers.h"
#include "experiment/kinds/tire_sanity.h"
#include "experiment/language/known_limits.h"
#include "formats/tire/tir_file.h"
#include "models/magic_formula/limits/file_ranges.h"
#include "models/rigid_ring/ring_doubts.h"
#include "models/rigid_ring/rolling_rigid_ring.h"

namespace latsch::experiment {
namespace {

class RigidRingSpecimen : public RollingSpecimen, public KnowsLimits {
 public:
  explicit RigidRingSpecimen(const Document& numbers)
      : rolling_(numbers), parameters_(rolling_.parameters()) {}

  std::unique_ptr<Tire> tire(const Inflation& pressure) const override {
    return rolling_.tire(pressure);
  }
  std::vector<std::string> limits_met() const override { return rolling_.limits_met(); }
  std::vector<std::string> limits_when_driven(const DrivenWheel& driven) const override {
    return limits_when_driven_of(parameters_, driven);
  }
  bool is_limit(const std::string& path) const override {
    return magic_formula::is_end_of_range(path);
  }
  void stood_under(double load) override { rolling_.stood_under(load); }
  std::string no_stiffness(const std::string& direction) const override {
    return no_stiffness_of(parameters_, direction);
  }
  std::string assumed_stiffness(const std::string& direction) const override {
    return assumed_stiffness_of(parameters_, direction);
  }
  std::optional<double> section_height() const override { return section_height_of(parameters_); }
  std::optional<double> tread_half_width() const override {
    return tread_half_width_of(parameters_);
  }
  /// Returns the distance of the outermost cams from the middle: they are at the edges of the
  /// contact patch, here of the patch at FNOMIN.
  double felt_half_width() const override {
    if (parameters_.ELLIPS_NWIDTH < 2.0) return 0.0;
    const magic_formula::MagicFormula formula(parameters_);
    return std::max(
        0.0,
        formula.evaluate({parameters_.FNOMIN, 0, 0, 0, 0, parameters_.LONGVL, parameters_.INFLPRES})
            .b);
  }
  std::vector<std::string> limits_at_camber(bool rolls) const override {
    return upright_footprint(rolls);
  }
  std::vector<std::string> limits_backward() const override {
    return limits_backward_of(parameters_);
  }
  /// Returns the limit of a tire with a single pair of cams: it follows only one line of the road.
  std::vector<std::string> limits_on(const Cleat& cleat) const override {
    if (std::abs(cleat.angle) < kStraightCleat || parameters_.ELLIPS_NWIDTH >= 2.0) return {};
    return {
        "this rigid ring senses the road along one line (ELLIPS_NWIDTH is below 2): an oblique "
        "cleat acts on it like a longer straight one; more tracks sense the width"};
  }
  std::vector<std::string> limits_across() const override {
    if (parameters_.ELLIPS_NWIDTH >= 2.0) return {};
    return {
        "this rigid ring feels the road along one line (ELLIPS_NWIDTH is below 2): an edge below a "
        "part of its width is felt wholly or not at all; more tracks feel the width"};
  }

 private:
  rigid_ring::RollingRigidRing rolling_;
  magic_formula::Parameters parameters_;
};

class RigidRingKind : public SpecimenKind {
 public:
  std::string name() const override { return "rigid_ring"; }
  std::string in_words() const override { return "rigid ring"; }
  std::string file() const override {
    return "a .tir file with belt and stiffnesses (MF 6.1, 6.2)";
  }
  int version() const override { return 5; }
  std::vector<std::string> abilities() const override { return abilities_of<RigidRingSpecimen>(); }

  bool recognizes(const std::filesystem::path&) const override { return false; }
  Document read(const std::filesystem::path& file) const override { return read_tir_numbers(file); }
  std::string describe(const Document& numbers) const override {
    return SpecimenKind::describe(numbers) + ", " + side_in_words(numbers);
  }
  std::vector<std::string> notes(const std::filesystem::path& file) const override {
    std::vector<std::string> all = tir_notes(file);
    const formats::TirFile tir = formats::read_tir(file);
    const auto is_given = [&](std::string_view name) {
      return std::ranges::any_of(tir.keys, [&](const auto& key) { return key.parameter == name; });
    };
    for (const std::string& doubt : rigid_ring::ring_doubts(tir.parameters, is_given))
      all.push_back(file.string() + ": " + doubt);
    return all;
  }
  std::unique_ptr<Specimen> build(const Document& numbers,
                                  std::unique_ptr<Specimen>) const override {
    return std::make_unique<RigidRingSpecimen>(numbers);
  }
  void check(const Document& numbers) const override { RigidRingSpecimen(numbers).tire({}); }
  std::optional<Size> size(const Document& numbers) const override { return tir_size(numbers); }
  std::string text(const Document& numbers) const override { return tir_text_of(numbers); }
  std::string annotated_text(const Document& numbers, const Provenance& provenance) const override {
    return fitted_tir_text(numbers, provenance);
  }
  std::vector<FaultBeyondData> faults_beyond_data(const Document& numbers,
                                                  const MeasuredAt& values_of) const override {
    return tire_faults(numbers, values_of);
  }
};

}  // namespace

const SpecimenKind& rigid_ring_kind() {
  static const RigidRingKind kind;
  return kind;
}

}  // namespace latsch::experiment
