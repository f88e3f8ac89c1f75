// SPDX-License-Identifier: Apache-2.0
// The finite-element tire as a kind of specimen.
#include <fmt/format.h>

#include <algorithm>
#include <list>

#include "base/text.h"
#include "experiment/kinds/fe_tire_specimen.h"
#include "experiment/kinds/fe_variations.h"
#include "experiment/kinds/pictures/fe_tire_pictures.h"
#include "experiment/kinds/specimen_kinds.h"
#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/description/fine_tread.h"
#include "models/fe_tire/description/model_version.h"
#include "models/fe_tire/description/tire_description.h"

namespace latsch::experiment {
namespace {

using fe_tire::FeTire;
using fe_tire::TireDescription;

class DescribedTire : public FeTireSpecimen, public HasTreadElements {
 public:
  DescribedTire(const TireDescription& description, const Document& numbers)
      : FeTireSpecimen(FeTire(description), description.pressure, numbers, described_tires()),
        description_(description) {
    set_rim(description.rim);
    set_losses(fe_tire::build_losses(description));
    set_friction(description.friction);
    set_reduction(description.reduced_to);
  }

  /// Changes the materials and keeps the symbolic factorization for the mesh. Returns false if the
  /// mesh differs.
  bool becomes(const TireDescription& description, const Document& numbers) {
    if (!fe_tire::same_mesh(description_, description)) return false;
    set(fe_tire::build_materials(description), description.pressure, numbers);
    set_rim(description.rim);
    set_losses(fe_tire::build_losses(description));
    set_friction(description.friction);
    set_reduction(description.reduced_to);
    for (FineTire& fine : fine_) {
      fine.tire.set(fe_tire::build_materials(with_split_tread(description, fine.split)));
    }
    description_ = description;
    return true;
  }

 protected:
  /// Returns the tire on the mesh of the other tests if it has comparison elements.
  SlopedTire& for_footprint(const FootprintTest& test) override {
    if (description_.element != fe_tire::ElementKind::solid_shell)
      return FeTireSpecimen::for_footprint(test);
    fe_tire::TreadElements largest;
    if (test.elements) largest = {test.elements->around, test.elements->across};
    const fe_tire::TreadSplit split = split_of(description_, largest);
    const auto is_whole = [](int parts) { return parts == 1; };
    if (std::ranges::all_of(split.columns, is_whole) &&
        std::ranges::all_of(split.sectors, is_whole))
      return FeTireSpecimen::for_footprint(test);
    for (FineTire& fine : fine_)
      if (fine.split == split) return fine.tire;
    fine_.push_back(
        {split, {FeTire(with_split_tread(description_, split)), described_tires(split)}});
    return fine_.back().tire;
  }

 private:
  struct FineTire {
    fe_tire::TreadSplit split;
    SlopedTire tire;
  };

  TireDescription description_;
  std::list<FineTire> fine_;  // finer meshes requested by footprints
};

class FeTireKind : public SpecimenKind {
 public:
  std::string name() const override { return "fe_tire"; }
  std::string in_words() const override { return "finite-element tire"; }
  std::string file() const override { return "a TOML file with a section and plies"; }
  int version() const override { return fe_tire::kModelVersion; }
  std::vector<std::string> abilities() const override { return abilities_of<DescribedTire>(); }

  bool recognizes(const std::filesystem::path& file) const override {
    return file.extension() == ".toml" && Document::read(file).root().has("section");
  }
  Document read(const std::filesystem::path& file) const override {
    Document document = Document::read(file);
    // throws for a wrong file; messages then refer to the file as written
    fe_tire::read_tire(document.root());
    return document;
  }
  std::unique_ptr<Specimen> build(const Document& numbers,
                                  std::unique_ptr<Specimen> reuse) const override {
    const TireDescription description = fe_tire::read_tire(numbers.root());
    auto* before = dynamic_cast<DescribedTire*>(reuse.get());
    if (before && before->becomes(description, numbers)) return reuse;
    return std::make_unique<DescribedTire>(description, numbers);
  }
  /// True for pressure, friction, rubbers, layers, contour and thicknesses, except the positions at
  /// which parts begin and end, because these change the mesh.
  bool knows_slopes_in(const std::string& path) const override {
    const auto begins = [&path](const char* with) { return path.starts_with(with); };
    if (path.ends_with(".from") || path.ends_with(".to")) return false;
    return path == "pressure" || begins("friction") || begins("rubber.") || begins("layer.") ||
           begins("section.contour") || begins("section.thickness");
  }
  std::string why_without_slopes(const Document& numbers,
                                 const Test& test,
                                 const std::vector<std::string>& paths) const override {
    const TireDescription tire = fe_tire::read_tire(numbers.root());
    std::string why = why_without_rates(fe_tire::build_losses(tire), test);
    if (!why.empty() || !rolls(test)) return why;
    for (const std::string& path : paths)
      if (path.starts_with("section."))
        return "slopes of a rolling tire by its shape, " + in_quotes(path) + ", are not known";
    return "";
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
    return why_every_run_fails(fe_tire::build_mesh(fe_tire::read_tire(numbers.root())), test);
  }
  std::optional<Size> size(const Document& numbers) const override {
    const TireDescription tire = fe_tire::read_tire(numbers.root());
    const double radius = tire.section.contour.front().r + tire.section.outside.at(0.0);
    return Size{radius, radius - tire.section.contour.back().r};
  }
  bool has_usual_numbers() const override { return true; }

  bool has_body() const override { return true; }
  void draw_body(const Document& numbers,
                 const std::vector<const Test*>& tests,
                 report::StudyReport& page) const override {
    add_pictures(fe_tire::read_tire(numbers.root()), tests, page);
  }
  void draw(const Document& numbers,
            const std::vector<const Test*>& tests,
            Thoroughness thoroughness,
            report::StudyReport& page) const override {
    draw_body(numbers, tests, page);
    const TireDescription tire = fe_tire::read_tire(numbers.root());
    add_mesh_error(tire, tests, thoroughness, page);
  }
};

}  // namespace

const SpecimenKind& fe_tire_kind() {
  static const FeTireKind kind;
  return kind;
}

}  // namespace latsch::experiment
