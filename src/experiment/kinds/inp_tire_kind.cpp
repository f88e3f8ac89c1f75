// SPDX-License-Identifier: Apache-2.0
// A tire on a mesh of the user, an .inp file of Abaqus or CalculiX, as a kind of specimen. Its
// numbers have the names of the file: material.RUBBER.C10, layer.BELT.angle, pressure.
#include <fmt/format.h>

#include "experiment/kinds/fe_tire_specimen.h"
#include "experiment/kinds/inp_numbers.h"
#include "experiment/kinds/pictures/fe_tire_pictures.h"
#include "experiment/kinds/specimen_kinds.h"
#include "models/fe_tire/description/model_version.h"

namespace latsch::experiment {
namespace {

fe_tire::FeTire tire_of(const formats::InpTire& tire) {
  return {tire.mesh, tire.materials, {.element = tire.element}};
}

class InpTireSpecimen : public FeTireSpecimen {
 public:
  InpTireSpecimen(InpModel model, const Document& numbers)
      : FeTireSpecimen(tire_of(model.tire), model.tire.pressure, numbers, varied),
        model_(std::move(model)) {
    set_losses(model_.tire.losses);
  }

  /// Sets the numbers of the model; returns false if they belong to another file.
  bool becomes(const Document& numbers) {
    if (!take_numbers(model_, numbers)) return false;
    set(model_.tire.materials, model_.tire.pressure, numbers);
    set_losses(model_.tire.losses);
    return true;
  }

 private:
  static fe_tire::VariedTire varied(const Document& numbers) {
    InpModel model = inp_model(numbers);
    return {std::move(model.tire.mesh), std::move(model.tire.materials), model.tire.pressure};
  }

  InpModel model_;
};

std::vector<report::Layer> layers_of(const InpModel& model) {
  std::vector<report::Layer> layers;
  for (std::size_t i = 0; i < model.tire.layers.size(); ++i) {
    const int rebars = model.tire.layers[i].rebars;  // -1: the deck models the cords as springs
    layers.push_back({rebars < 0 ? fmt::format("cords {}", i + 1)
                                 : model.deck.rebars[static_cast<std::size_t>(rebars)].name,
                      model.tire.materials.layers[i].angle});
  }
  return layers;
}

class InpTireKind : public SpecimenKind {
 public:
  std::string name() const override { return "inp_tire"; }
  std::string in_words() const override { return "finite-element tire on the user's mesh"; }
  std::string file() const override { return "an .inp file of Abaqus or CalculiX"; }
  int version() const override { return fe_tire::kModelVersion; }
  std::vector<std::string> abilities() const override { return abilities_of<InpTireSpecimen>(); }

  bool recognizes(const std::filesystem::path& file) const override { return is_inp(file); }
  Document read(const std::filesystem::path& file) const override { return read_inp_numbers(file); }
  std::vector<std::string> notes(const std::filesystem::path& file) const override {
    return inp_notes(file);
  }
  bool knows_slopes_in(const std::string&) const override { return true; }
  std::string why_without_slopes(const Document& numbers,
                                 const Test& test,
                                 const std::vector<std::string>&) const override {
    return rolls(test) ? why_without_rates(inp_model(numbers).tire.losses, test) : "";
  }
  std::unique_ptr<Specimen> build(const Document& numbers,
                                  std::unique_ptr<Specimen> reuse) const override {
    auto* before = dynamic_cast<InpTireSpecimen*>(reuse.get());
    if (before && before->becomes(numbers)) return reuse;
    return std::make_unique<InpTireSpecimen>(inp_model(numbers), numbers);
  }
  void check(const Document& numbers) const override { inp_model(numbers); }
  std::string text(const Document& numbers) const override { return inp_text_of(numbers); }
  std::string comment_mark() const override { return "**"; }

  std::string describe(const Document& numbers) const override {
    const InpModel model = inp_model(numbers);
    const fe_tire::Mesh& mesh = model.tire.mesh;
    std::string materials;
    for (const formats::InpSolid& solid : model.tire.solids)
      materials += (materials.empty() ? "" : ", ") + solid.material;
    return fmt::format(
        "mesh of the user, units {}\n  {} elements {}, {} nodes, {} free degrees of freedom, {} "
        "equal sector{}\n  materials {}; {} layer{} of rebars",
        formats::in_words(model.deck.units),
        mesh.element_count(),
        model.deck.element_type,
        mesh.nodes(),
        mesh.free_dofs(),
        mesh.sectors,
        mesh.sectors == 1 ? "" : "s",
        materials,
        model.tire.layers.size(),
        model.tire.layers.size() == 1 ? "" : "s");
  }
  std::string remark(const Document& numbers, const Test& test) const override {
    return why_every_run_fails(inp_model(numbers).tire.mesh, test);
  }
  std::optional<Size> size(const Document& numbers) const override {
    const fe_tire::Mesh mesh = inp_model(numbers).tire.mesh;
    const Eigen::RowVectorXd r = mesh.X({0, 2}, Eigen::all).colwise().norm();
    return Size{mesh.outer_radius(), mesh.outer_radius() - r.minCoeff()};
  }

  void draw(const Document& numbers,
            const std::vector<const Test*>& tests,
            Thoroughness,
            report::StudyReport& page) const override {
    draw_body(numbers, tests, page);
  }
  bool has_body() const override { return true; }
  void draw_body(const Document& numbers,
                 const std::vector<const Test*>& tests,
                 report::StudyReport& page) const override {
    const InpModel model = inp_model(numbers);
    page.tire = std::filesystem::path(numbers.file()).filename().string();
    fe_tire::FeTire tire = tire_of(model.tire);
    report::TirePictures pictures;
    pictures.layers = layers_of(model);
    add_pictures(tire, model.tire.pressure, tests, std::nullopt, std::move(pictures), page);
  }
};

}  // namespace

const SpecimenKind& inp_tire_kind() {
  static const InpTireKind kind;
  return kind;
}

}  // namespace latsch::experiment
