// SPDX-License-Identifier: Apache-2.0
// Implements `latsch export`: writes the identified model, measurements computed by the model
// itself, a finite-element tire for other programs, or a rolling tire or a car for programs that
// simulate the system around it.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/file.h"
#include "cli/console/console.h"
#include "cli/console/parsed.h"
#include "cli/console/version.h"
#include "cli/run/export_date.h"
#include "cli/run/exported_kc.h"
#include "cli/run/model_source.h"
#include "cli/templates/meshed_tire.h"
#include "cli/verbs/exported_bushings.h"
#include "cli/verbs/exported_rolling.h"
#include "cli/verbs/exported_unit.h"
#include "cli/verbs/verbs.h"
#include "correlation/study_report/fitted_model.h"
#include "correlation/target/twin.h"
#include "experiment/language/kind_files.h"
#include "formats/mesh/ccx_cords.h"
#include "formats/mesh/ccx_deck.h"
#include "formats/mesh/vtu_file.h"
#include "formats/tire/lost_keys.h"
#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/description/tire_description.h"

namespace latsch::cli {
namespace {

namespace fs = std::filesystem;
using fe_tire::TireDescription;

constexpr int kLoadSteps = 5;

struct ExportOptions {
  std::string file, vtu, ccx, model, pressure, deflection, rolling, fmu, road, platforms, output,
      bus, kc, kc_travel, kc_rack;
  int modes = 0;
  bool measurements = false, sti = false;
};

struct State {
  double pressure = 0.0;
  double deflection = 0.0;  // m; 0: the tire does not touch the ground
};

State state_of(const ExportOptions& options, const MeshedTire& tire) {
  State state;
  state.pressure =
      options.pressure.empty() ? tire.pressure : parse_option("--pressure", options.pressure, "Pa");
  if (!options.deflection.empty()) {
    state.deflection = parse_option("--deflection", options.deflection, "m");
  }
  return state;
}

/// Returns the value. If the result is a failure, ends the verb with the reason.
template <class T>
T required(Result<T> result) {
  if (!result) throw std::runtime_error(result.failure().reason);
  return std::move(*result);
}

void add_modes(std::vector<formats::VtuField>& fields, const std::vector<fe_tire::Mode>& modes) {
  for (size_t i = 0; i < modes.size(); ++i) {
    fields.push_back(
        {fmt::format("mode {} {} {:.2f} Hz", i + 1, modes[i].label(), modes[i].frequency),
         modes[i].shape});
  }
}

/// Writes the table of the contact patch beside the tire's output file if that is a regular file;
/// nothing can be written beside a device.
void write_patch(const fs::path& tire, const fe_tire::Standing& standing) {
  if (fs::exists(tire) && !fs::is_regular_file(tire)) return;
  const fs::path patch = fs::path(tire).replace_extension(".patch.vtu");
  formats::write_patch_vtu(patch, standing);
  say_written(patch.string());
}

void write_vtu(const ExportOptions& options, const MeshedTire& tire) {
  const State state = state_of(options, tire);
  fe_tire::FeTire model(tire.mesh, tire.materials, tire.settings);
  const auto inflated = required(model.inflate(state.pressure));
  std::vector<formats::VtuField> fields = {{"inflation", inflated.u}};
  if (state.deflection == 0.0) {
    if (options.modes > 0) add_modes(fields, required(model.modes(inflated, options.modes)));
  } else {
    std::vector<double> steps;
    for (int i = 1; i <= kLoadSteps; ++i) steps.push_back(state.deflection * i / kLoadSteps);
    const auto loaded = required(model.press(inflated, fe_tire::Ground{}, steps)).back();
    fields.push_back({"displacement", loaded.u});
    if (options.modes > 0) add_modes(fields, required(model.modes(loaded, options.modes)));
    write_patch(options.vtu, model.stand(loaded));
  }
  formats::write_tire_vtu(options.vtu, model.mesh(), fields);
  say_written(options.vtu);
}

/// Warns how the exported deck differs from the tire, and of the size of the effect.
void say_differences(const fe_tire::Mesh& mesh, const formats::CcxRun& run) {
  const bool has_cords = std::any_of(
      mesh.elements.begin(), mesh.elements.end(), [](const auto& e) { return !e.rebars.empty(); });
  if (run.element == fe_tire::ElementKind::full_integration)
    say("its elements are C3D8, as the tire's are those of full integration: they lock in "
        "bending\n");
  else
    say("its elements are C3D8I in place of the solid shell, its cords are {}\n"
        "  CalculiX 2.20 computes a coarse tire of 18 sectors with 0.2 % more growth than Latsch "
        "and modes within 2 %, a 205/55R16 of 18 and of 40 equal sectors with 1.4 % and 0.7 % less "
        "growth\n",
        has_cords ? "springs, one for every layer in an element" : "smeared");
  if (!mesh.theta.empty() && !run.ground)
    say("  its sectors are equal, as those by which Latsch inflates a tire; a comment keeps the "
        "planes of the zones, by which Latsch divides the standing tire\n");
  if (!mesh.theta.empty() && run.ground)
    say("  its sectors are of unequal width, and CalculiX does not keep such a ring round: a "
        "205/55R16 with sectors of 2.4 to 13.1 degrees grows by 1.27 mm at the ground and by 1.38 "
        "mm at the wide sectors, in Latsch by 1.375 mm everywhere; pressed by 20 mm, it carries "
        "1.0 % less force\n");
  if (has_cords && run.modes > 0)
    say("  modes from some {:.0f} Hz on may be those of neighboring sectors moving against each "
        "other, which the tire does not have: the least of three measurements on a 205/55R16, by "
        "the widest sector; other tires are not measured\n",
        formats::first_loose_mode(run.ground ? mesh : mesh.evenly_divided()));
}

void write_ccx(const ExportOptions& options, const MeshedTire& tire) {
  const State state = state_of(options, tire);
  const fe_tire::Mesh& mesh = tire.mesh;
  const fe_tire::Materials& materials = tire.materials;
  formats::CcxRun run;
  run.title = tire.name;
  run.pressure = state.pressure;
  run.element = tire.settings.element;
  if (options.modes > 0) run.modes = options.modes;
  if (state.deflection > 0.0) {
    fe_tire::FeTire model(mesh, materials, tire.settings);
    const auto inflated = required(model.inflate(state.pressure));
    run.ground = formats::CcxGround{inflated.radius, state.deflection};
  }
  formats::write_ccx_deck(fs::path(options.ccx), mesh, materials, run);
  say_differences(mesh, run);
  say("wrote {}; run it with: ccx {}\n",
      options.ccx,
      fs::path(options.ccx).replace_extension().string());
}

void write_model(const ExportOptions& options, const std::string& text) {
  write_text_file(options.model, text);
  say_written(options.model);
}

void warn_of_lost_keys(const fs::path& file, const std::string& exported) {
  const std::vector<std::string> lost = formats::lost_keys(file, exported);
  if (lost.empty()) return;
  warn(fmt::format("{} {} a comment in the exported file, with the units of the old one: it is in "
                   "SI, and the unit of what Latsch does not know is not known",
                   fmt::join(lost, ", "),
                   lost.size() == 1 ? "is" : "are"),
       {file.string(), 0});
}

/// Returns the text of the model: a model's file as it is read or, for a study, the identified
/// model with the origin of its parameters.
std::string model_text(const std::string& file,
                       const fs::path& output,
                       const experiment::Language& language) {
  if (!is_study(file)) {
    const ModelSource source = model_source(file, language);
    experiment::expect_own_ending(*source.kind, output);
    const std::string text = source.kind->text(source.numbers);
    warn_of_lost_keys(file, text);
    return text;
  }
  const correlation::Study study = study_with_model(file, language);
  experiment::expect_own_ending(*study.specimens->kind(), output);
  const auto model =
      correlation::fitted_model(study, {version_number(), export_date(calendar_of_system())});
  say("{} at {}\n", study.title, model.is_fitted ? "its best point" : "its initial values");
  if (!model.search_has_ended)
    warn(
        "no search of this study has ended: the numbers are those of its best trial so far, which "
        "need not be at a minimum; run latsch run " +
        file + " first");
  const std::string text = correlation::text_of(study, model);
  warn_of_lost_keys(study.model_file, text);
  return text;
}

void write_measurements(const std::string& file, const experiment::Language& language) {
  const auto study = correlation::read_study(file, language, correlation::Measurements::not_yet);
  const correlation::TwinFiles files = required(correlation::write_twin(study));
  for (const auto& [path, as] : files.kept)
    warn(fmt::format("{} was measured, or made by another program: it is kept as {}",
                     path.string(),
                     as.string()));
  for (const auto& path : files.written) say_written(path.string());
}

/// Writes a tire that rolls. Throws InputError for options whose values the test states.
void write_rolling(const ExportOptions& options, const experiment::Language& language) {
  if (options.vtu.empty())
    throw InputError("--rolling: expected --vtu FILE beside it, the ParaView file to write");
  if (!options.pressure.empty() || !options.deflection.empty() || options.modes > 0)
    throw InputError(
        "--rolling: the test states the pressure and the load of the tire that rolls; expected no "
        "--pressure, --deflection or --modes");
  if (!options.ccx.empty())
    throw InputError("--rolling: a deck of CalculiX has no tire that rolls; expected --vtu alone");
  write_rolling_vtu(options.file, options.rolling, options.vtu, language);
}

void export_files(const ExportOptions& options, const experiment::Language& language) {
  if (options.measurements) return write_measurements(options.file, language);
  if (options.sti && !options.fmu.empty())
    throw InputError(
        "export --sti: expected no --fmu beside it, because both write their --output");
  if (options.sti) say_sti(options.file, options.output, language);
  if (!options.fmu.empty())
    write_fmu({options.file, options.fmu, options.road, options.platforms, options.output},
              language);
  if (!options.bus.empty()) write_bushings(options.file, options.bus, language);
  if (!options.kc.empty())
    write_kc({options.file, options.kc, options.kc_travel, options.kc_rack}, language);
  if (!options.rolling.empty()) return write_rolling(options, language);
  const bool mesh = !options.vtu.empty() || !options.ccx.empty();
  if (!mesh && options.model.empty()) {
    if (options.sti || !options.fmu.empty() || !options.bus.empty() || !options.kc.empty()) return;
    throw InputError(
        "export: say what to write: --vtu, --ccx, --model, --fmu, --sti, --bus, --kc or "
        "--measurements");
  }
  if (!options.model.empty())
    write_model(options, model_text(options.file, options.model, language));
  if (!mesh) return;
  const MeshedTire tire = meshed_tire(options.file, language);
  if (!options.vtu.empty()) write_vtu(options, tire);
  if (!options.ccx.empty()) write_ccx(options, tire);
}

}  // namespace

void add_export(CommandLine& app, Program& program) {
  Verb verb = app.add_subcommand("export",
                                 "Writes the identified model, measurements of a twin, a mesh for "
                                 "ParaView or CalculiX, an FMU, K&C tables");
  verb.footer(
      "A study file stands for its best point so far, or for the initial values if nothing has "
      "run.\n\n"
      "Examples:\n"
      "  latsch export studies/tires/passenger_225_50R16.toml --vtu tire.vtu --deflection \"25 "
      "mm\" --modes 6\n"
      "  # A tire that rolls: its ring and its patch, of a rolling_chain its chains, too.\n"
      "  latsch export studies/tires/passenger_225_50R16.toml --vtu rolling.vtu --rolling '{kind = "
      "\"rolling\", load = \"4 kN\", speed = \"60 km/h\", alpha = \"2 deg\"}'\n"
      "  latsch export studies/tires/passenger_225_50R16.toml --ccx tire.inp --deflection \"25 "
      "mm\"\n"
      "  latsch export studies/tire_b_twin/study.toml --model identified.toml\n"
      "  # Measurements as the laboratory would have made them on the model that the file "
      "describes.\n"
      "  latsch export studies/tire_b_twin/study.toml --measurements\n"
      "  # A co-simulation unit: wheel motion in, hub forces out (docs/exchange.md).\n"
      "  latsch export studies/ring_tires/passenger_205_55R16.toml --fmu 3.0 -o tire.fmu\n"
      "  # A car: rack, torques and loads in, its motion and push-rod forces out.\n"
      "  latsch export studies/kerb/baseline.toml --fmu 3.0 -o car.fmu\n"
      "  # The bushings of a suspension as Adams property files.\n"
      "  latsch export studies/kerb/front.toml --bus bushings\n"
      "  # Its kinematics and compliance as tables (docs/kc_tables.md).\n"
      "  latsch export studies/suspensions/race_car_front.toml --kc tables --kc-travel \"30 mm\"\n"
      "  # The library by which a program with the Standard Tyre Interface rolls the tire.\n"
      "  latsch export studies/ring_tires/passenger_205_55R16.toml --sti\n"
      "  # The same by a library of 4 MB that needs nothing of Latsch, from a folder in SI.\n"
      "  latsch export studies/ring_tires/passenger_205_55R16.toml --sti -o tire_sti");
  auto options = std::make_shared<ExportOptions>();
  verb.add_option("file", options->file, "Model file or study file").required();
  verb.add_option("--vtu", options->vtu, "ParaView file to write")
      .written_as("a ParaView file", {".vtu"});
  verb.add_option("--ccx", options->ccx, "CalculiX deck to write")
      .written_as("a CalculiX deck", {".inp"});
  verb.add_option("--model", options->model, "Model file to write, with the identified values");
  verb.add_option("--pressure",
                  options->pressure,
                  "Inflation, such as \"2.6 bar\"; the tire's own unless given");
  verb.add_option("--deflection",
                  options->deflection,
                  "Presses the tire on the ground by this much, such as \"25 mm\"");
  verb.add_option("--rolling",
                  options->rolling,
                  "Test of a tire that rolls, a file or its keys in braces: --vtu writes its "
                  "states");
  verb.add_option("--modes", options->modes, "Number of lowest modes to write; 0 unless given")
      .between(0, 200);
  verb.add_option(
          "--fmu", options->fmu, "FMI version of the unit to write: a tire that rolls, or a car")
      .one_of({"2.0", "3.0"});
  verb.add_option("--road",
                  options->road,
                  "Road of the unit, a file as for latsch road; flat "
                  "unless given");
  verb.add_option("--platforms",
                  options->platforms,
                  "Systems whose libraries the unit must hold, \"linux,windows\"; unless given, "
                  "all that are installed");
  verb.add_option(
      "-o,--output", options->output, "Package of the unit to write; of --sti, the folder");
  verb.add_option("--bus", options->bus, "Folder for the bushings of a suspension, a .bus a joint");
  verb.add_option(
      "--kc", options->kc, "Folder for tables of a suspension's kinematics and compliance");
  verb.add_option("--kc-travel",
                  options->kc_travel,
                  "Largest travel of these tables up and down; 50 mm unless given");
  verb.add_option("--kc-rack",
                  options->kc_rack,
                  "Largest travel of the rack to both sides; 20 mm unless given");
  verb.add_flag("--sti", options->sti, "Prints how to use it by the Standard Tyre Interface");
  verb.add_flag("--measurements",
                options->measurements,
                "Write the study's measurement files from the model itself: a twin");
  const bool alone = false;
  verb.forms(
      {{"writes a ParaView file",
        {"--vtu"},
        {"--pressure", "--deflection", "--modes", "--rolling"},
        alone},
       {"writes a CalculiX deck", {"--ccx"}, {"--pressure", "--deflection", "--modes"}, alone},
       {"writes a model file as it is", {"--model"}, {}, alone},
       {"writes a unit, which starts at the pressure of the model",
        {"--fmu"},
        {"--road", "--platforms", "--output"},
        alone},
       {"writes bushings", {"--bus"}, {}, alone},
       {"writes tables of kinematics and compliance",
        {"--kc"},
        {"--kc-travel", "--kc-rack"},
        alone},
       {"prints how to use the Standard Tyre Interface", {"--sti"}, {"--output"}, alone},
       {"writes measurements", {"--measurements"}}});
  verb.callback([=, &program] { export_files(*options, program.language); });
}

}  // namespace latsch::cli
