// SPDX-License-Identifier: Apache-2.0
#include "cli/verbs/exported_unit.h"

#include <filesystem>

#include "base/error.h"
#include "base/file.h"
#include "cli/console/console.h"
#include "cli/console/implausible.h"
#include "cli/console/ledgers.h"
#include "cli/console/version.h"
#include "cli/run/export_date.h"
#include "cli/run/model_source.h"
#include "correlation/study/ledgers/file_ledgers.h"
#include "correlation/study_report/fitted_model.h"
#include "exchange/package/fmu_package.h"
#include "exchange/package/unit_folder.h"
#include "experiment/language/capabilities.h"

namespace latsch::cli {
namespace {

namespace fs = std::filesystem;

/// Returns the path of a library of the program, ../lib/latsch/`name` relative to the program, in a
/// build folder as well as in an installation.
fs::path library(const std::string& name) {
  const fs::path program = fs::read_symlink("/proc/self/exe");
  const fs::path file = program.parent_path().parent_path() / "lib" / "latsch" / name;
  if (!fs::exists(file))
    throw InputError({file.string(), 0}, "is not there: it is built and installed with latsch");
  return file;
}

/// Returns the libraries for a version of FMI: slim ones if they can make the unit.
std::vector<exchange::UnitLibrary> libraries(const std::string& version, bool is_slim) {
  const std::string name = version == "2.0" ? "latsch_fmi2" : "latsch_fmi3";
  return {{library(name + (is_slim ? ".so" : "_all.so")), is_slim}};
}

}  // namespace

void write_fmu(const std::string& file,
               const std::string& version,
               const std::string& road,
               const std::string& output,
               const experiment::Language& language) {
  if (output.empty()) throw InputError("export --fmu: expected the package to write, -o FILE.fmu");
  const ModelSource source = model_source(file, language);
  // The exported text of the model holds the parameters and, for a tire, the ranges of its inputs
  // that the data cover.
  std::string text;
  if (is_study(file)) {
    const correlation::Study study = study_with_model(file, language);
    text = correlation::text_of(
        study,
        correlation::fitted_model(study, {version_number(), export_date(calendar_of_system())}));
  }
  warn_of_doubts(correlation::ledgers_of_file(file, "the model"));
  if (!road.empty()) warn_of_doubts(correlation::ledgers_of_file(road, "the road"));
  const auto files = exchange::unit_files(*source.kind, source.numbers, road, text);
  const auto fmi = version == "2.0" ? exchange::FmiVersion::fmi2 : exchange::FmiVersion::fmi3;
  exchange::UnitTitle title;
  title.name = fs::path(output).stem().string();
  title.description = source.kind->describe(source.numbers) + "; made by latsch";
  title.token = exchange::token_of(files);
  write_text_file(
      output,
      exchange::fmu_package(fmi,
                            title,
                            exchange::unit_of(*source.kind, source.numbers, road)->variables(),
                            libraries(version, exchange::is_slim(*source.kind, source.numbers)),
                            files));
  say_written(output);
}

void say_sti(const std::string& file, const experiment::Language& language) {
  const experiment::SpecimenKind& kind = language.kind_of_file(file);
  if (!experiment::can(kind, {Rolls::kName}))
    throw InputError({file, 0}, "is a " + kind.in_words() + ", which does not roll");
  const Document numbers = kind.read(file);
  kind.check(numbers);
  examine_model(kind, numbers, file);
  warn_of_doubts(correlation::ledgers_of_file(file, "the model"));
  say("library   {}\nfunction  dtyre_ (Fortran: DTYRE; C: dtyre)\ntire file {}\ntire      {}\n",
      library("latsch_sti.so").string(),
      fs::absolute(file).string(),
      kind.describe(numbers));
}

}  // namespace latsch::cli
