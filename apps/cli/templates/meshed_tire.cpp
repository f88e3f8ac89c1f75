// SPDX-License-Identifier: Apache-2.0
#include "cli/templates/meshed_tire.h"

#include "cli/run/model_source.h"
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

fe_tire::TireDescription meshed_tire(const std::string& file,
                                     const experiment::Language& language) {
  if (!is_study(file)) expect_mesh(file, language.kind_of_file(file));
  const ModelSource source = model_source(file, language);
  expect_mesh(file, *source.kind);
  return fe_tire::read_tire(source.numbers.root());
}

}  // namespace latsch::cli
