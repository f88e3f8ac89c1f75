// SPDX-License-Identifier: Apache-2.0
#include "cli/verbs/exported_unit.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "base/error.h"
#include "base/file.h"
#include "base/text.h"
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
fs::path library_path(const std::string& name) {
  const fs::path program = fs::read_symlink("/proc/self/exe");
  return program.parent_path().parent_path() / "lib" / "latsch" / name;
}

/// Returns the path of a library that has to be there.
fs::path library(const std::string& name) {
  const fs::path file = library_path(name);
  if (!fs::exists(file))
    throw InputError({file.string(), 0}, "is not there: it is built and installed with latsch");
  return file;
}

constexpr const char* kLinux = "linux";
constexpr const char* kWindows = "windows";

/// Returns the systems of a list such as "linux,windows". Throws InputError for another one.
std::vector<std::string> systems_of(const std::string& list) {
  std::vector<std::string> systems;
  for (std::size_t begin = 0; begin <= list.size();) {
    const std::size_t end = std::min(list.find(',', begin), list.size());
    const std::string name(trimmed(std::string_view(list).substr(begin, end - begin)));
    if (name != kLinux && name != kWindows)
      throw InputError("export --platforms: " + in_quotes(name) +
                       " is none, expected \"linux\", \"windows\" or \"linux,windows\"");
    if (std::ranges::find(systems, name) == systems.end()) systems.push_back(name);
    begin = end + 1;
  }
  return systems;
}

/// Returns the libraries of a unit: slim ones if they can make it. A system that was not asked for
/// and has no library here is left out.
std::vector<exchange::UnitLibrary> libraries(const FmuRequest& request, bool is_slim) {
  const std::string name = request.version == "2.0" ? "latsch_fmi2" : "latsch_fmi3";
  if (request.platforms.empty()) {
    std::vector<exchange::UnitLibrary> found = {
        {library(is_slim ? name + ".so" : "latsch_all.so"), is_slim}};
    if (const fs::path dll = library_path(name + ".dll"); is_slim && fs::exists(dll))
      found.push_back({dll, true});
    return found;
  }
  std::vector<exchange::UnitLibrary> found;
  for (const std::string& system : systems_of(request.platforms)) {
    if (system == kLinux) {
      found.push_back({library(is_slim ? name + ".so" : "latsch_all.so"), is_slim});
      continue;
    }
    if (!is_slim)
      throw InputError({request.file, 0},
                       "has finite elements, whose library exists for Linux alone: expected "
                       "--platforms linux");
    if (!fs::exists(library_path(name + ".dll")))
      throw InputError({library_path(name + ".dll").string(), 0},
                       "is not there: the Debian package latsch-units-windows brings it; cmake "
                       "--preset units-windows builds it, to be put there (docs/exchange.md)");
    found.push_back({library_path(name + ".dll"), true});
  }
  return found;
}

}  // namespace

void write_fmu(const FmuRequest& request, const experiment::Language& language) {
  const std::string &file = request.file, &version = request.version, &road = request.road,
                    &output = request.output;
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
  const auto binaries = libraries(request, exchange::is_slim(*source.kind, source.numbers));
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
                            binaries,
                            files));
  say_written(output);
  std::string systems;
  for (const exchange::UnitLibrary& binary : binaries)
    systems += std::string(systems.empty() ? "" : " and ") +
               (binary.file.extension() == ".dll" ? "Windows" : "Linux");
  say("It runs on {}, x86-64\n", systems);
}

void say_sti(const std::string& file,
             const std::string& folder,
             const experiment::Language& language) {
  const ModelSource source = model_source(file, language);
  const experiment::SpecimenKind& kind = *source.kind;
  if (!experiment::can(kind, {Rolls::kName}))
    throw InputError({file, 0}, "is a " + kind.in_words() + ", which does not roll");
  kind.check(source.numbers);
  warn_of_doubts(correlation::ledgers_of_file(file, "the model"));
  // A missing library is found before anything is written.
  const fs::path so = library(folder.empty() ? "latsch_all.so" : "latsch_sti.so");
  fs::path named = fs::absolute(file);
  if (!folder.empty()) {
    if (!exchange::is_slim(kind, source.numbers))
      throw InputError({file, 0},
                       "has finite elements, which the library for a folder in SI lacks: leave "
                       "out --output");
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) throw InputError({folder, 0}, "cannot be made: " + error.message());
    for (const auto& [name, bytes] : exchange::unit_files(kind, source.numbers)) {
      write_text_file(fs::path(folder) / name, bytes);
      say_written((fs::path(folder) / name).string());
    }
    named = fs::absolute(folder) / exchange::kUnitFile;
  } else if (is_study(file)) {
    throw InputError({file, 0},
                     "is a study, which the library does not read: expected --output FOLDER, or "
                     "the file of a tire");
  }
  const fs::path dll = library_path("latsch_sti.dll");
  const bool has_windows = !folder.empty() && fs::exists(dll);
  answer()["library"] = so.string();
  if (has_windows) answer()["windows_library"] = dll.string();
  answer()["function"] = "dtyre_";
  answer()["tire_file"] = named.string();
  answer()["tire"] = kind.describe(source.numbers);
  say("library   {}\n{}function  dtyre_ (Fortran: DTYRE; C: dtyre)\ntire file {}\ntire      {}\n",
      so.string(),
      has_windows ? "Windows   " + dll.string() + "\n" : "",
      named.string(),
      kind.describe(source.numbers));
}

}  // namespace latsch::cli
