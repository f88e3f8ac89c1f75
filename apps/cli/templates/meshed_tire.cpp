// SPDX-License-Identifier: Apache-2.0
#include "cli/templates/meshed_tire.h"

#include <filesystem>

#include "cli/run/model_source.h"
#include "experiment/kinds/inp_numbers.h"
#include "experiment/language/capabilities.h"

namespace latsch::cli {
namespace {

void expect_mesh(const std::string& file, const experiment::SpecimenKind& kind) {
  if (experiment::can(kind, {experiment::IsPressed::kName})) return;
  throw InputError(
      {file, is_study(file) ? 0 : 1},
      "has a " + kind.in_words() + ", expected a tire of finite elements, which has a mesh");
}

}  // namespace

MeshedTire meshed_tire(const std::string& file, const experiment::Language& language) {
  if (!is_study(file)) expect_mesh(file, language.kind_of_file(file));
  const ModelSource source = model_source(file, language);
  expect_mesh(file, *source.kind);
  if (experiment::is_inp(source.numbers.file())) {
    const formats::InpTire tire = experiment::inp_model(source.numbers).tire;
    const std::string name = std::filesystem::path(source.numbers.file()).filename().string();
    return {name, "", tire.pressure, tire.mesh, tire.materials, {.element = tire.element}, {}};
  }
  const fe_tire::TireDescription tire = fe_tire::read_tire(source.numbers.root());
  return {tire.name,
          tire.size,
          tire.pressure,
          fe_tire::build_mesh(tire),
          fe_tire::build_materials(tire),
          {.element = tire.element},
          tire};
}

}  // namespace latsch::cli
