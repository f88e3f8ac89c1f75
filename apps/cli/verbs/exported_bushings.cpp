// SPDX-License-Identifier: Apache-2.0
#include "cli/verbs/exported_bushings.h"

#include <filesystem>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/file.h"
#include "cli/console/console.h"
#include "cli/run/model_source.h"
#include "experiment/language/capabilities.h"
#include "formats/car/bus_file.h"
#include "models/suspension/suspension_reader.h"

namespace latsch::cli {

void write_bushings(const std::string& file,
                    const std::string& folder,
                    const experiment::Language& language) {
  const ModelSource source = model_source(file, language);
  if (!experiment::can(*source.kind, {experiment::IsLoaded::kName}))
    throw InputError(
        {file, 0},
        "is a " + source.kind->in_words() + ": expected a suspension, whose bushings --bus writes");
  using suspension::DoubleWishbone;
  const DoubleWishbone corner = suspension::read_suspension(source.numbers.root());
  std::vector<std::pair<std::string, std::string>> files;
  for (std::size_t i = 0; i < DoubleWishbone::kJoints; ++i) {
    const std::string joint = DoubleWishbone::kNames[i];
    files.emplace_back(joint + ".bus", formats::bus_text(corner.bushings[i], joint));
  }
  std::filesystem::create_directories(folder);
  for (const auto& [name, text] : files) {
    const std::filesystem::path path = std::filesystem::path(folder) / name;
    write_text_file(path, text);
    say_written(path.string());
  }
}

}  // namespace latsch::cli
