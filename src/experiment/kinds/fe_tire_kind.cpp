// SPDX-License-Identifier: Apache-2.0
// The finite-element tire as a kind of specimen.
#include <fmt/format.h>

#include "experiment/kinds/fe_tire_pictures.h"
#include "experiment/language/capabilities.h"
#include "experiment/language/specimen.h"
#include "experiment/rigs/tire_rig.h"
#include "experiment/tests/modes.h"
#include "models/fe_tire/description/model_version.h"
#include "models/fe_tire/description/tire_description.h"
#include "models/fe_tire/ring/fe_tire.h"

namespace latsch::experiment {
namespace {

using fe_tire::FeTire;
using fe_tire::TireDescription;

class FeTireSpecimen : public Specimen,
                       public IsPressed,
                       public Vibrates,
                       public StandsOnGround,
                       public HasFootprint,
                       public TakesConditions {
 public:
  explicit FeTireSpecimen(TireDescription description)
      : description_(std::move(description)),
        tire_(description_),
        rig_(std::make_unique<TireRig>(tire_, description_.pressure)) {}

  /// The same with other materials: the symbolic work on the mesh is kept. False where the mesh is
  /// another one.
  bool becomes(const TireDescription& description) {
    if (!fe_tire::same_mesh(description_, description)) return false;
    tire_.set(fe_tire::build_materials(description));
    description_ = description;
    rig_ = std::make_unique<TireRig>(tire_, description_.pressure);
    return true;
  }

  Result<Channels> press(const LoadDeflection& test) override { return rig_->run(test); }
  Result<Channels> vibrate(const ModalTest& test) override { return rig_->run(test); }
  Eigen::Matrix3Xd sensor_points() const override { return default_points(tire_.mesh()); }
  Result<Channels> stand(const StandingTest& test) override {
    return experiment::stand(tire_, description_.pressure, test);
  }
  Result<std::vector<StandingFootprint>> footprints(const FootprintTest& test) override {
    fe_tire::Ground ground;
    ground.mu = test.friction.value_or(0.0);
    return experiment::footprints(
        tire_, test.pressure.value_or(description_.pressure), ground, test);
  }

 private:
  TireDescription description_;
  FeTire tire_;
  std::unique_ptr<TireRig> rig_;
};

class FeTireKind : public SpecimenKind {
 public:
  std::string name() const override { return "fe_tire"; }
  std::string in_words() const override { return "finite-element tire"; }
  std::string file() const override { return "a TOML file with a section and plies"; }
  int version() const override { return fe_tire::kModelVersion; }
  std::vector<std::string> abilities() const override { return abilities_of<FeTireSpecimen>(); }

  bool recognizes(const std::filesystem::path& file) const override {
    return file.extension() == ".toml" && Document::read(file).root().has("section");
  }
  Document read(const std::filesystem::path& file) const override {
    Document document = Document::read(file);
    fe_tire::read_tire(document.root());  // what is wrong is said of the file as it stands
    return document;
  }
  std::unique_ptr<Specimen> build(const Document& numbers,
                                  std::unique_ptr<Specimen> reuse) const override {
    const TireDescription description = fe_tire::read_tire(numbers.root());
    auto* before = dynamic_cast<FeTireSpecimen*>(reuse.get());
    if (before && before->becomes(description)) return reuse;
    return std::make_unique<FeTireSpecimen>(description);
  }
  void check(const Document& numbers) const override {
    fe_tire::build_mesh(fe_tire::read_tire(numbers.root()));
  }

  std::string describe(const Document& numbers) const override {
    const TireDescription tire = fe_tire::read_tire(numbers.root());
    const fe_tire::Mesh mesh = fe_tire::build_mesh(tire);
    return fmt::format("{}, {}\n  {} HEX8, {} nodes, {} free degrees of freedom, {} sectors",
                       tire.name,
                       tire.size,
                       mesh.element_count(),
                       mesh.nodes(),
                       mesh.free_dofs(),
                       mesh.sectors);
  }
  std::string remark(const Document& numbers, const Test& test) const override {
    constexpr double kFar = 0.02;  // m between a measured point and the nearest of the model
    const auto* modes = dynamic_cast<const ModesTest*>(&test);
    if (!modes || modes->settings().points.cols() == 0) return "";
    const auto mesh = fe_tire::build_mesh(fe_tire::read_tire(numbers.root()));
    const double distance = nearest_sensors(mesh, modes->settings().points).largest_distance;
    if (distance <= kFar) return "";
    return fmt::format("a measured point lies {:.0f} mm from the outer surface of the model",
                       distance * 1e3);
  }
  std::optional<Size> size(const Document& numbers) const override {
    const TireDescription tire = fe_tire::read_tire(numbers.root());
    const double radius = tire.section.contour.front().r + tire.section.outside.at(0.0);
    return Size{radius, radius - tire.section.contour.back().r};
  }
  bool has_usual_numbers() const override { return true; }

  void draw(const Document& numbers,
            const std::vector<const Test*>& tests,
            Thoroughness thoroughness,
            report::StudyReport& page) const override {
    const TireDescription tire = fe_tire::read_tire(numbers.root());
    add_pictures(tire, tests, page);
    add_mesh_error(tire, tests, thoroughness, page);
  }
};

}  // namespace

const SpecimenKind& fe_tire_kind() {
  static const FeTireKind kind;
  return kind;
}

}  // namespace latsch::experiment
