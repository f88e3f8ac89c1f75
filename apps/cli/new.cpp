// SPDX-License-Identifier: Apache-2.0
// latsch new: writes a study to start from.
#include <fmt/format.h>

#include <filesystem>

#include "base/error.h"
#include "base/file.h"
#include "cli/console.h"
#include "cli/study_template.h"
#include "cli/verbs.h"

namespace latsch::cli {
namespace {

namespace fs = std::filesystem;

void write(const fs::path& file, std::string_view text) {
  write_text_file(file, text);
  say_written(file.string());
}

const TireTemplate& find_tire(const std::string& name) {
  for (const TireTemplate& tire : tire_templates()) {
    if (tire.name == name) return tire;
  }
  throw InputError("no tire " + name);  // the command line has checked the name
}

void start_study(const std::string& folder, const std::string& tire) {
  if (fs::exists(fs::path(folder) / "study.toml")) {
    throw InputError(Place{(fs::path(folder) / "study.toml").string(), 0},
                     "exists already; expected a new folder");
  }
  fs::create_directories(folder);
  write(fs::path(folder) / "tire.toml", find_tire(tire).text);
  write(fs::path(folder) / "stiffness.csv", stiffness_template());
  write(fs::path(folder) / "modes.csv", modes_template());
  write(fs::path(folder) / "study.toml", study_template(tire));
  say("\nReplace the example values of the .csv files by your measurements, then\n"
      "  latsch check {0}/study.toml\n  latsch run {0}/study.toml\n",
      folder);
}

}  // namespace

void add_new(CommandLine& app, int&) {
  Verb verb =
      app.add_subcommand("new", "Writes a study to start from: a tire, measurements, a study file");
  verb.footer("Example:\n  latsch new my_tire --tire passenger_225_50R16");
  auto folder = std::make_shared<std::string>();
  auto tire = std::make_shared<std::string>("passenger_205_55R16");
  std::vector<std::string> names;
  for (const TireTemplate& known : tire_templates()) names.emplace_back(known.name);
  verb.add_option("folder", *folder, "Folder to write, created where missing").required();
  verb.add_option("--tire", *tire, "Tire to start from").one_of(names).capture_default_str();
  verb.callback([=] { start_study(*folder, *tire); });
}

}  // namespace latsch::cli
