// SPDX-License-Identifier: Apache-2.0
// Reads samples of all tables that a study may have. A sample states the tables of its section; the
// tables that every study needs, a model, a variable and an experiment, are added if it lacks them.
// The model is a stand-in that accepts any numbers and can undergo every test, so no sample depends
// on a model.
#include "correlation/study_keys.h"

#include <stdlib.h>

#include <algorithm>
#include <cmath>

#include "base/file.h"
#include "base/text.h"
#include "correlation/comparison/comparison_file.h"
#include "correlation/comparison/model_comparison_file.h"
#include "correlation/observable/compared_kinds.h"
#include "correlation/rig_data/rig_file.h"
#include "correlation/study/keys/declared_keys.h"
#include "correlation/validation/suite.h"
#include "experiment/keys_of_models.h"
#include "experiment/keys_of_tests.h"
#include "experiment/language/capabilities.h"
#include "formats/tables/measurement_file.h"

namespace latsch::correlation {

using experiment::KeySection;
using experiment::KeyTable;
using experiment::Language;

const KeySection& study_keys();
const KeySection& model_keys();
const KeySection& named_test_keys();
const KeySection& simulator_keys();
const KeySection& variable_keys();
const KeySection& tie_keys();
const KeySection& linear_constraint_keys();
const KeySection& measurement_keys();
const KeySection& experiment_keys();
const KeySection& noise_keys();
const KeySection& nuisance_keys();
const KeySection& shared_nuisance_keys();
const KeySection& constraint_keys();
const KeySection& optimizer_keys();
const KeySection& start_keys();
const KeySection& stage_keys();
const KeySection& refined_keys();
const KeySection& doe_keys();
const KeySection& posterior_keys();
const KeySection& selection_keys();
const KeySection& campaign_keys();
const KeySection& run_keys();
const KeySection& suite_keys();

namespace {

namespace fs = std::filesystem;

/// A model for the samples of studies, which accepts any numbers.
class AnyModel : public experiment::SpecimenKind {
 public:
  explicit AnyModel(const Language& language) {
    for (const experiment::TestKind* test : language.tests)
      abilities_.insert(abilities_.end(), test->needs.begin(), test->needs.end());
    abilities_.emplace_back(experiment::TakesConditions::kName);
  }
  std::string name() const override { return "any_model"; }
  std::string in_words() const override { return "stand-in"; }
  std::string file() const override { return "a TOML file with kind = \"any_model\""; }
  int version() const override { return 1; }
  std::vector<std::string> abilities() const override { return abilities_; }
  bool recognizes(const fs::path&) const override { return false; }
  Document read(const fs::path& file) const override { return Document::read(file); }
  std::unique_ptr<experiment::Specimen> build(
      const Document&, std::unique_ptr<experiment::Specimen>) const override {
    return std::make_unique<experiment::Specimen>();
  }
  bool knows_slopes_in(const std::string&) const override { return true; }
  std::optional<experiment::UsualRange> usual_range(const std::string&) const override {
    return experiment::UsualRange{0.5, 2.0};
  }

 private:
  std::vector<std::string> abilities_;
};

constexpr const char* kModel = R"(kind = "any_model"
[belt]
nodes = 80
radius = "305 mm"
[sidewall]
progressivity = 1.2
radial.stiffness = "0.55 MN/m^2"
tangential.stiffness = "0.265 MN/m^2"
lateral.stiffness = "0.16 MN/m^2"
[tread]
blocks = 10
)";

constexpr const char* kVariable = R"([variable.radial]
path = "sidewall.radial.stiffness"
lower = "0.2 MN/m^2"
upper = "1.5 MN/m^2"
initial = "0.55 MN/m^2"
)";

constexpr const char* kExperiment = R"([experiment.force]
kind = "load_deflection"
measurement = "force.csv"
)";

constexpr const char* kSlow = R"(kind = "drum_cleat"
speed = "36 km/h"
load = "4 kN"
drum_diameter = "2 m"
duration = "0.1 s"
lead = "0.01 s"
)";

/// Returns a table of a load and a displacement over time, 20 ms at 2000 samples a second.
std::string swinging(const std::string& head, double mean, double amplitude) {
  constexpr int kSamples = 41;
  constexpr double kStep = 5e-4;  // s
  std::string text = head + "\n";
  for (int i = 0; i < kSamples; ++i)
    text += std::to_string(kStep * i) + "," + std::to_string(mean + amplitude * std::sin(0.7 * i)) +
            "\n";
  return text;
}

/// Returns a recording of a tire that is steered once, at 100 samples a second.
std::string steered() {
  constexpr int kSamples = 101;
  std::string text =
      "time [s],FX [N],FY [N],FZ [N],MX [N m],MY [N m],MZ [N m],SA [deg],IA [deg],"
      "loaded_radius [mm],P_kPa\n";
  for (int i = 0; i < kSamples; ++i) {
    const double alpha = -5.0 + 0.1 * i;  // deg
    text += std::to_string(0.01 * i) + ",10," + std::to_string(-500.0 * alpha) + ",4050,20,1,-15," +
            std::to_string(alpha) + ",0.1,310,240\n";
  }
  return text;
}

}  // namespace

void write_files_of_samples(const fs::path& folder) {
  experiment::write_sample_files(folder);
  for (const auto& [name, text] : std::vector<std::pair<const char*, std::string>>{
           {"model.toml", kModel},
           {"slow.toml", kSlow},
           {"spring.txt", "stiffness {modulus}\n"},
           {"beam.txt", "modulus {modulus}\n"},
           {"old.latsch", ""},
           {"rival.toml", "model = \"model.toml\"\n"},
           {"force.csv", "deflection [mm],force [N]\n5,1000\n10,2100\n"},
           {"two_runs.csv", "run1.Fz [N],run2.Fz [N]\n4000,4010\n3990,4005\n"},
           {"logged.uff",
            "    -1\n    58\nFz\nNONE\nNONE\nNONE\nNONE\n    1\n"
            "         2         3         1  0.00000e+00  1.00000e-02\n"
            "        17    0    0    0 time                 s\n"
            "         9    0    0    0 force                N\n"
            "         0    0    0    0 NONE                 NONE\n"
            "         0    0    0    0 NONE                 NONE\n"
            "  4.00000e+03  4.01000e+03  3.99000e+03\n    -1\n"},
           {"lengths.csv", "length [mm]\n112\n139\n"},
           {"modes.csv", "frequency [Hz],n,type\n54,0,torsional\n70,1,radial\n"},
           {"mode_shapes.csv",
            "mode,x [mm],y [mm],z [mm],ux,uy,uz\n1,0,50,310,0,0,1\n2,0,50,310,1,0,0\n"},
           {"step.csv", swinging("time [s],z [mm]", 0.0, 10.0)},
           {"slow_measured.csv", swinging("time [s],Fz [N]", 4000.0, 200.0)},
           {"over_speed.csv",
            "speed [km/h],Fz [N]\n10,4000\n20,4010\n30,4015\n40,4030\n50,4035\n60,4050\n"
            "70,4052\n80,4070\n"},
           {"frf.csv",
            "frequency [Hz],re_hub_Fz [N/mm],im_hub_Fz "
            "[N/mm],coherence\n20,210,12,0.99\n40,190,15,"
            "0.95\n"},
           {"cornering.csv", steered()}})
    write_text_file(folder / name, text);
}

namespace {

/// A temporary folder with the files that samples name, removed at the end.
class SampleFolder {
 public:
  SampleFolder() {
    std::string pattern = (fs::temp_directory_path() / "latsch_keys_XXXXXX").string();
    if (!::mkdtemp(pattern.data()))
      throw InputError("no folder can be made in " + in_quotes(fs::temp_directory_path().string()) +
                       ", where samples are written; set TMPDIR to a folder that can be written");
    path_ = pattern;
    write_files_of_samples(path_);
  }
  ~SampleFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  SampleFolder(const SampleFolder&) = delete;
  SampleFolder& operator=(const SampleFolder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

/// Returns a whole study: the sample, with a model, a variable and an experiment unless it has one.
std::string whole_study(std::string sample) {
  const std::string shown = "[model]\nkind = \"rigid_ring\"";  // the stand-in replaces this model
  if (const std::size_t at = sample.find(shown); at != sample.npos)
    sample.replace(at, shown.size(), "[model]\nkind = \"any_model\"");
  const auto has = [&](const std::string& text) { return sample.find(text) != sample.npos; };
  if (has("[simulator]\n")) return sample;
  const bool has_model = has("\nmodel = ") || has("[model]\n");
  return (has_model ? "" : "model = \"model.toml\"\n") + sample +
         (has("[variable.") ? "" : kVariable) + (has("[experiment.") ? "" : kExperiment);
}

/// Returns the language of the samples: models and tests of the program, the stand-in, and the
/// shipped tests that the samples use.
Language with_stand_in(const Language& language, const experiment::SpecimenKind& any) {
  Language all = language;
  all.kinds.push_back(&any);
  for (const experiment::TestKind* test : experiment::language().tests)
    if (!language.find_test(test->name)) all.tests.push_back(test);
  return all;
}

/// Removes choices that the program does not have.
void leave_out_samples(const Language& all,
                       const Language& language,
                       std::map<std::string, DeclaredKey>& keys) {
  for (auto& [path, key] : keys) {
    if (key.choices == all.kind_names()) key.choices = language.kind_names();
    if (key.choices == all.test_names()) key.choices = language.test_names();
  }
}

/// Returns the sections of a study in the order of the reference; the sections of tests are in the
/// place where the reference has them.
std::vector<const KeySection*> sections_of(const Language& language) {
  std::vector<const KeySection*> sections = {
      &study_keys(), &model_keys(), &named_test_keys(), &simulator_keys()};
  for (const KeySection* test : experiment::test_sections(language)) sections.push_back(test);
  for (const auto& section : {variable_keys,
                              tie_keys,
                              linear_constraint_keys,
                              measurement_keys,
                              experiment_keys,
                              noise_keys,
                              nuisance_keys,
                              shared_nuisance_keys})
    sections.push_back(&section());
  for (const ComparedKind* kind : compared_kinds()) experiment::add_section(kind->keys(), sections);
  for (const auto& section : {constraint_keys,
                              optimizer_keys,
                              start_keys,
                              stage_keys,
                              refined_keys,
                              doe_keys,
                              posterior_keys,
                              selection_keys,
                              campaign_keys,
                              run_keys,
                              suite_keys})
    sections.push_back(&section());
  return sections;
}

/// True for a section whose samples are studies or suites rather than tests or roads.
bool has_studies(const KeySection& section) {
  return !section.heading.starts_with("Test ") && !section.heading.starts_with("[kerb]");
}

}  // namespace

std::vector<SampledFile> sampled_files(const Language& language) {
  std::vector<SampledFile> files;
  for (const KeySection* section : sections_of(language)) {
    const bool is_road = section->heading.starts_with("[kerb]");
    const char* const kind = section == &suite_keys() ? "suite"
                             : is_road                ? "road"
                             : has_studies(*section)  ? "study"
                                                      : "test";
    for (const std::string& sample : section->samples)
      files.push_back({kind, kind == std::string("study") ? whole_study(sample) : sample});
  }
  return files;
}

const std::vector<std::string>& kinds_of_files() {
  static const std::vector<std::string> kinds = {"study",
                                                 "suite",
                                                 "test",
                                                 "road",
                                                 "comparison",
                                                 "rig",
                                                 "modes",
                                                 "fe_tire",
                                                 "ring_tire",
                                                 "suspension",
                                                 "car"};
  return kinds;
}

std::map<std::string, DeclaredKey> keys_of_file(const std::string& kind,
                                                const fs::path& file,
                                                const Language& language) {
  const auto& kinds = kinds_of_files();
  if (std::find(kinds.begin(), kinds.end(), kind) == kinds.end())
    throw InputError("no kind of file is called " + in_quotes(kind) + ", expected " +
                     list_of(kinds));
  const AnyModel any(experiment::language());
  const Language all = with_stand_in(language, any);
  std::map<std::string, DeclaredKey> keys;
  if (kind == "study") {
    keys = keys_of_study(file, all);
  } else if (kind == "suite") {
    keys = keys_of_suite(file, any, all);
  } else if (kind == "test") {
    keys = experiment::keys_of_test_file(language, file);
  } else if (kind == "road") {
    keys = experiment::keys_of_road_file(file);
  } else if (kind == "comparison") {
    keys = compares_models(file) ? keys_of_model_comparison(file, language)
                                 : keys_of_comparison(file, language);
  } else if (kind == "rig") {
    keys = keys_of_rig(file);
  } else if (kind == "modes") {
    keys = formats::keys_of_modes(file);
  } else {
    keys = experiment::keys_of_model(file);
  }
  leave_out_samples(all, language, keys);
  return keys;
}

KeyTable read_study_keys(const Language& language) {
  const SampleFolder folder;
  const AnyModel any(experiment::language());
  const Language all = with_stand_in(language, any);
  KeyTable table(sections_of(language));
  experiment::add_keys_of_tests(language, folder.path(), table);
  for (const experiment::TabledSection& tabled : table.sections()) {
    const KeySection& section = *tabled.section;
    if (!has_studies(section)) continue;
    for (const std::string& sample : section.samples) {
      const fs::path file = folder.path() / "study.toml";
      const bool is_suite = &section == &suite_keys();
      write_text_file(file, is_suite ? sample : whole_study(sample));
      auto keys = is_suite ? keys_of_suite(file, any, all) : keys_of_study(file, all);
      leave_out_samples(all, language, keys);
      table.add(section, keys);
    }
  }
  return table;
}

}  // namespace latsch::correlation
