// SPDX-License-Identifier: Apache-2.0
// Implements `latsch new`: writes a study to start from. Its measurements are an example: they are
// computed from the tire itself with other moduli than the study's start, with the scatter and the
// resolution of a rig, so that the first run ends well.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "base/error.h"
#include "base/file.h"
#include "base/random.h"
#include "base/units.h"
#include "cli/console/console.h"
#include "cli/console/ledgers.h"
#include "cli/run/model_source.h"
#include "cli/templates/car_template.h"
#include "cli/templates/drum_template.h"
#include "cli/templates/magic_formula_template.h"
#include "cli/templates/ring_template.h"
#include "cli/templates/schema_files.h"
#include "cli/templates/sized_tire.h"
#include "cli/templates/study_template.h"
#include "cli/verbs/verbs.h"
#include "correlation/study/ledgers/study_ledgers.h"
#include "correlation/study/study.h"
#include "correlation/study/variables.h"
#include "correlation/target/twin.h"
#include "formats/tables/measurement_file.h"

namespace latsch::cli {
namespace {

namespace fs = std::filesystem;

struct NewOptions {
  std::string folder, tire = "passenger_205_55R16", size;
  bool coarse = false;
  // files of a tire test, names of their columns, and held-out parts
  std::vector<std::string> recordings, columns, held_out;
  std::string axes, radius;
  // --ring-data: the model that is measured to fit a ring to it, or kExample; --known: the file of
  // the flexible ring at which the fit begins
  std::string ring_data, known;
  bool suspension = false, car = false;
  std::vector<std::string> drum;  // recordings of a drum with a cleat
  std::string cleat, diameter;
  int teeth = 0;
};
constexpr const char* kExample = "published example";

std::string_view text_of(const std::string& name) {
  for (const TireTemplate& tire : tire_templates()) {
    if (tire.name == name) return tire.text;
  }
  // not reached, because the command line has checked the name
  throw InputError("no tire " + name);
}

std::string tire_of(const NewOptions& options) {
  const std::string name = options.size.empty() ? options.tire : template_of(options.size);
  const std::string text(text_of(name));
  const std::string tire = options.coarse ? coarse_tire(text) : text;
  return options.size.empty() ? tire : stretched_tire(tire, options.size);
}

/// Returns the tire's text, with the mesh that its size needs if the user gave a size.
std::string meshed(const std::string& tire, const NewOptions& options) {
  if (options.size.empty()) return tire;
  RunningNote note;
  long done = 0;
  return with_placed_mesh(
      tire, options.size, [&](const std::string& round) { note.update(done++, 0, round); });
}

void write(const fs::path& file, std::string_view text) {
  write_text_file(file, text);
  say_written(file.string());
}

/// Returns the values with which the example's measurements are computed: "sidewall 6.25 N/mm^2,
/// carcass 4.5 GPa".
std::string truth_in_words(const correlation::Study& study, const DesignPoint& truth) {
  std::string text;
  for (int i = 0; i < study.space.size(); ++i) {
    const DesignVariable& variable = study.space[i];
    text += fmt::format("{}{} {}",
                        i > 0 ? ", " : "",
                        variable.name,
                        format_quantity(truth.values[i], variable.unit, 3));
  }
  return text;
}

/// Adds the scatter and the resolution of a rig to the measurements of the study.
void make_measured(const correlation::Study& study, const std::string& comment) {
  constexpr double kScatter = 0.003;  // standard deviation as a share of a value
  RandomStream chance(1, 0);
  const auto measured = [&](double value, double parts) {
    return std::round(value * (1.0 + kScatter * chance.normal()) * parts) / parts;
  };
  for (const auto& experiment : study.experiments) {
    if (experiment.observable->kind() == "modes") {
      ModeTable table = formats::read_modes(experiment.measurement_file);
      for (auto& mode : table.modes) mode.frequency = measured(mode.frequency, 20.0);
      formats::write_modes(experiment.measurement_file, table, comment);
    } else {
      LoadDeflectionCurve curve = formats::read_load_deflection(experiment.measurement_file);
      for (double& force : curve.force) force = measured(force, 1.0);
      formats::write_load_deflection(experiment.measurement_file, curve, comment);
    }
  }
}

void write_example(const fs::path& file, const experiment::Language& language) {
  auto study = correlation::read_study(file, language, correlation::Measurements::not_yet);
  DesignPoint truth = study.space.initial();
  const auto variables = starter_variables(study.model);
  for (std::size_t i = 0; i < variables.size(); ++i) truth.values[i] = variables[i].example;
  study.model = correlation::at(study.model, study.space, truth);
  const auto written = correlation::write_twin(study);
  if (!written) throw std::runtime_error(written.failure().reason);
  make_measured(study,
                "An example, not measured: this tire with " + truth_in_words(study, truth) +
                    ", and 0.3 % scatter. Replace it by your measurement.");
  for (const fs::path& table : written->written) say_written(table.string());
}

/// Returns the path of the study's file. Throws InputError if the folder already contains one.
fs::path new_study(const fs::path& folder) {
  const fs::path study = folder / "study.toml";
  if (fs::exists(study))
    throw InputError(Place{study.string(), 0}, "exists already; expected a new folder");
  return study;
}

/// Files that are being written for a study. Those that did not exist before are removed unless the
/// study can be read without an error, so that `latsch new` leaves either a readable study or
/// nothing.
class Unfinished {
 public:
  Unfinished(const fs::path& folder, const std::vector<std::string>& names) : folder_(folder) {
    for (const std::string& name : names) {
      files_.push_back(folder / name);
      if (!fs::exists(files_.back())) new_files_.push_back(files_.back());
    }
    was_there_ = fs::exists(folder);
  }
  ~Unfinished() {
    if (is_good_) return;
    std::error_code ignored;
    for (const fs::path& file : new_files_) fs::remove_all(file, ignored);
    if (!was_there_) fs::remove(folder_, ignored);  // removes the folder only if it is empty
  }
  Unfinished(const Unfinished&) = delete;
  Unfinished& operator=(const Unfinished&) = delete;

  /// Reads the study and prints the files that were written. Throws InputError for a study that
  /// `latsch check` refuses.
  correlation::Study finish(const fs::path& study, const experiment::Language& language) {
    correlation::Study read = correlation::read_study(study, language);
    correlation::refuse_doubtful(correlation::all_ledgers_of(read));
    is_good_ = true;
    for (const fs::path& file : files_) say_written(file.string());
    return read;
  }

 private:
  fs::path folder_;
  std::vector<fs::path> files_, new_files_;
  bool was_there_ = false, is_good_ = false;
};

/// Copies the schemas that the files of a study name beside them, and says so.
void say_schemas(const fs::path& folder) {
  for (const fs::path& schema : place_schemas(folder)) say_written(schema.string());
}

double length_of(const std::string& text) {
  const auto quantity = parse_quantity(text);
  if (!quantity || si_unit(quantity->unit.dimension()) != "m" || !(quantity->si > 0.0))
    throw InputError("--radius " + text + ": expected a length such as \"0.32 m\"");
  return quantity->si;
}

void start_magic_formula(const NewOptions& options, const experiment::Language& language) {
  const fs::path folder = options.folder, study = new_study(folder);
  TireTestFiles test{
      {options.recordings.begin(), options.recordings.end()}, options.axes, options.columns, {}};
  test.held_out = held_out_of(options.held_out);
  if (!options.radius.empty()) test.unloaded_radius = length_of(options.radius);
  const MagicFormulaStudy written = magic_formula_study(test, folder);
  Unfinished files(folder, {"tire.tir", "study.toml"});
  fs::create_directories(folder);
  write_text_file(folder / "tire.tir", written.tire);
  write_text_file(study, with_schema(written.study, language));
  const auto read = files.finish(study, language);
  say_schemas(folder);
  for (const std::string& word : written.words) say("  {}\n", word);
  say_ledgers(correlation::ledgers_of(read), LinesTo::output, "Files");
  say("\nNext\n"
      "  latsch show {0}                         what is used of the recordings\n"
      "  latsch run {0}                          fits, stage by stage\n"
      "  latsch export {0} --model fitted.tir    the tire\n",
      study.string());
}

int start_ring(const NewOptions& options, const experiment::Language& language) {
  const fs::path folder = options.folder, study = new_study(folder);
  RingStudy written = example_ring_study();
  if (options.ring_data != kExample) {
    const ModelSource model = model_source(options.ring_data, language);
    const Document known = options.known.empty() ? Document::parse(written.ring, "ring.toml")
                                                 : Document::read(options.known);
    auto derived = ring_study_of(*model.kind, model.numbers, known, language);
    if (!derived) {
      complain(options.ring_data + ": " + derived.failure().reason);
      return kFailed;
    }
    written = std::move(*derived);
  } else if (!options.known.empty()) {
    throw InputError(
        "--known has no effect without --ring-data MODEL; expected both: the ring that is fitted "
        "to "
        "MODEL begins at the values of the known ring");
  }
  Unfinished files(folder, {"ring.toml", "study.toml"});
  fs::create_directories(folder);
  write_text_file(folder / "ring.toml", with_schema(written.ring, language));
  write_text_file(study, with_schema(written.study, language));
  files.finish(study, language);
  say_schemas(folder);
  say("\n{1}\n"
      "  latsch run {0}                          finds the numbers\n"
      "  latsch identify {0}                     what the data do not determine, what would "
      "correct misses\n"
      "  latsch export {0} --model fitted.toml   the ring\n",
      study.string(),
      options.ring_data == kExample ? "Replace the example's values by your own, then" : "Next");
  return kDone;
}

fs::path write_all(const fs::path& folder,
                   const std::vector<WrittenFile>& files,
                   const experiment::Language& language) {
  fs::path study = new_study(folder);
  fs::create_directories(folder);
  for (const WrittenFile& file : files)
    write(
        folder / file.name,
        fs::path(file.name).extension() == ".toml" ? with_schema(file.text, language) : file.text);
  return study;
}

void start_suspension(const NewOptions& options, const experiment::Language& language) {
  const fs::path study = write_all(options.folder, suspension_study_files(), language);
  correlation::read_study(study, language);
  say_schemas(options.folder);
  say("\nPut your hardpoints into {1} and your values into the study, then\n"
      "  latsch run {0}                          finds the bushings\n"
      "  latsch identify {0}                     what the values do not determine, what to "
      "measure next\n"
      "  latsch test {1} '{{kind = \"kinematics\", from = \"-30 mm\", to = \"30 mm\", points = "
      "61}}' --html travel.html\n",
      study.string(),
      (fs::path(options.folder) / "corner.toml").string());
}

void start_car(const NewOptions& options, const experiment::Language& language) {
  const fs::path folder = options.folder, study = write_all(folder, car_study_files(), language),
                 car = folder / "car.toml";
  write(folder / "sweep.csv", example_sweep(car.string(), language));
  correlation::read_study(study, language);
  say_schemas(folder);
  say("\nPut your car in its place and your recording into sweep.csv, then\n"
      "  latsch run {0}                          finds springs and dampers\n"
      "  latsch test {1} {2} --html kerb.html    over a kerb\n",
      study.string(),
      car.string(),
      (folder / "kerb.toml").string());
}

void start_drum(const NewOptions& options, const experiment::Language& language) {
  const fs::path folder = options.folder, study = new_study(folder);
  const Document known = options.known.empty()
                             ? Document::parse(example_ring_study().ring, "ring.toml")
                             : Document::read(options.known);
  if (options.cleat.empty())
    throw InputError(
        "--drum: no recording contains the cleat's size; expected --cleat \"10 mm x 20 mm\" "
        "beside it, its height and its length along the road");
  Unfinished files(folder, {"rig.toml", "rig_processed", "ring.toml", "study.toml"});
  fs::create_directories(folder);
  const DrumStudy written = drum_study({{options.drum.begin(), options.drum.end()},
                                        options.cleat,
                                        options.diameter,
                                        options.teeth,
                                        options.columns},
                                       known,
                                       folder,
                                       language);
  write_text_file(folder / "ring.toml", with_schema(written.ring, language));
  write_text_file(study, with_schema(written.study, language));
  const auto read = files.finish(study, language);
  say_schemas(folder);
  for (const std::string& word : written.words) say("  {}\n", word);
  if (options.known.empty())
    say("  ring.toml is the published ring of a 205/55 R16 tire; give your own by --known RING\n");
  say_ledgers(correlation::ledgers_of(read), LinesTo::output, "Files");
  say("\nNext\n"
      "  latsch process {1}                      the rig's page: averages, spectra\n"
      "  latsch show {0}                         what is used of the averages\n"
      "  latsch run {0}                          finds sidewall and delays, with intervals\n",
      study.string(),
      (folder / "rig.toml").string());
}

void start_study(const NewOptions& options, const experiment::Language& language) {
  const fs::path folder = options.folder, study = new_study(folder);
  const std::string shape = tire_of(options);
  fs::create_directories(folder);  // throws before the mesh is computed, which takes seconds
  const Document tire = Document::parse(meshed(shape, options), (folder / "tire.toml").string());
  const std::string text = study_template(tire);
  write(folder / "tire.toml", with_schema(tire.text(), language));
  write(study, with_schema(text, language));
  write_example(study, language);
  say_schemas(folder);
  if (!options.size.empty())
    say("\nAssumed: {}\n", inflated_size_in_words(tire, options.size, language));
  say("\nReplace the example values of the .csv files by your measurements, then\n"
      "  latsch check {0}\n  latsch run {0}\n",
      study.string());
}

constexpr const char* kNewFooter =
    "Examples:\n  latsch new my_tire\n  latsch new wide_tire --size 275/35R19\n"
    "  latsch new race --tire race_16x7.5-10\n"
    "  latsch new mf --magic-formula studies/race_tire_mf/cornering.csv --radius \"203.2 mm\"\n"
    "  latsch new mf_held --magic-formula studies/race_tire_mf/cornering.csv --radius \"203.2 "
    "mm\" "
    "--hold-out \"p = 97 kPa +- 7 kPa\"\n"
    "  latsch new ring --ring-data my_tire/tire.toml\n"
    "  latsch new drum --drum raw.csv --cleat \"10 mm x 20 mm\"   # raw.csv: your recording\n"
    "  latsch new corner --suspension\n"
    "  latsch new car --car\n\n"
    "The measurements are an example, computed from the tire with other moduli than the study\n"
    "starts at: the first run ends at a target below 1 %. Put your own in their place.\n"
    "From recordings of a tire test comes a study of a Magic Formula: the coefficients that "
    "they\n"
    "tell, freed in stages. From a model of a tire comes a study of the flexible ring that "
    "shows\n"
    "the same loads and modes. From recordings of a drum with a cleat come averaged passages "
    "and\n"
    "a flexible ring fitted to them. --suspension: bushings from numbers of a K&C rig; --car: "
    "springs "
    "and\n"
    "dampers from a four-post recording, and a kerb to drive over.";

void add_tire_options(Verb& verb, NewOptions* options) {
  std::vector<std::string> names;
  for (const TireTemplate& known : tire_templates()) names.emplace_back(known.name);
  verb.add_option("folder", options->folder, "Folder to write, created if missing").required();
  verb.add_option("--tire", options->tire, "Tire to start from")
      .one_of(names)
      .capture_default_str();
  verb.add_option("--size",
                  options->size,
                  "Size of the tire, such as 275/35R19, scaled from the nearest "
                  "template");
  verb.add_flag("--coarse",
                options->coarse,
                "Some hundred elements: a trial takes a fraction of a second, with errors of "
                "some percent");
}

void add_recording_options(Verb& verb, NewOptions* options) {
  verb.add_option("--magic-formula",
                  options->recordings,
                  "Recordings of a tire test: CSV, consortium .dat or .mat, TYDEX, MDF 4 "
                  "(.mf4), universal file (.uff), TDMS, RPC III (.rsp)");
  verb.add_option("--axes",
                  options->axes,
                  "Axes of the recordings; chosen by the sign of Fz "
                  "unless given")
      .one_of({"iso", "adapted_sae", "sae"});
  verb.add_option("--column", options->columns, "How a channel is called: \"Fz = LOAD [N]\"");
  verb.add_option("--hold-out",
                  options->held_out,
                  "Recordings to predict and not to fit, or samples by a channel, \"p = 90 "
                  "kPa .. 104 kPa\"; with --magic-formula");
  verb.add_option("--radius",
                  options->radius,
                  "Radius of the unloaded tire, if no loaded radius "
                  "was recorded");
}

void add_ring_options(Verb& verb, NewOptions* options) {
  verb.add_option("--ring-data",
                  options->ring_data,
                  "A flexible ring from measured loads, modes and stiffnesses; or, with a model "
                  "of a tire, from the model's results")
      .or_alone(kExample);
  verb.add_option("--known", options->known, "Flexible ring whose numbers such a study begins at");
  verb.add_option(
      "--drum",
      options->drum,
      "Recordings of a drum with a cleat, in the formats of --magic-formula: averages, and a "
      "flexible ring fitted to them");
  verb.add_option("--cleat", options->cleat, "Height and length, \"10 mm x 20 mm\"; with --drum");
  verb.add_option("--drum-diameter",
                  options->diameter,
                  "\"2.5 m\"; unless given, from the speed and the period of the passages");
  verb.add_option("--teeth",
                  options->teeth,
                  "Number of teeth of a wheel that was recorded in "
                  "place of the speed")
      .between(1, 100000);
}

/// Writes the kind of study that the options choose.
void write_new(const NewOptions& options, Program& program) {
  if (!options.drum.empty()) {
    start_drum(options, program.language);
  } else if (options.suspension) {
    start_suspension(options, program.language);
  } else if (options.car) {
    start_car(options, program.language);
  } else if (!options.ring_data.empty()) {
    program.exit_code = start_ring(options, program.language);
  } else if (options.recordings.empty()) {
    start_study(options, program.language);
  } else {
    start_magic_formula(options, program.language);
  }
}

}  // namespace

void add_new(CommandLine& app, Program& program) {
  Verb verb =
      app.add_subcommand("new", "Writes a study to start from: a tire, measurements, a study file");
  verb.footer(kNewFooter);
  auto options = std::make_shared<NewOptions>();
  add_tire_options(verb, options.get());
  add_recording_options(verb, options.get());
  add_ring_options(verb, options.get());
  verb.add_flag("--suspension",
                options->suspension,
                "A corner of a suspension: its bushings from numbers of a K&C rig");
  verb.add_flag("--car", options->car, "A car on four posts and over a kerb");
  verb.forms({{"writes a study of a finite-element tire", {}, {"--coarse"}},
              {"writes a study of a finite-element tire from a template", {"--tire"}, {"--coarse"}},
              {"writes a study of a finite-element tire of a size", {"--size"}, {"--coarse"}},
              {"writes a study of a Magic Formula",
               {"--magic-formula"},
               {"--axes", "--column", "--hold-out", "--radius"}},
              {"writes a study of a flexible ring", {"--ring-data"}, {"--known"}},
              {"writes a study of recordings of a drum",
               {"--drum"},
               {"--cleat", "--drum-diameter", "--teeth", "--column", "--known"}},
              {"writes a study of a suspension", {"--suspension"}},
              {"writes a study of a car", {"--car"}}});
  verb.callback([=, &program] { write_new(*options, program); });
}

}  // namespace latsch::cli
