// SPDX-License-Identifier: Apache-2.0
// Input of `latsch compare` for models of any kind, not only tires, that go through tests of any
// kind beside a reference. The reference is a measured specimen or a simulated one.
//
//   title = "A car on a kerb"
//   channels = ["pushrod_FL", "pushrod_RL"]   # over an even "time", whose spectra are compared
//   told = ["unreachable", "area_mean_FL"]    # means over the record of channels, in a table
//   from = "0 s"                         # part of a record that is compared; all unless given
//   segment = "0.25 s"                   # of the spectra, one Hann window each
//   normalize = "150 Hz"                 # frequencies also over this one; not unless given
//
//   [band.whole]                         # the first is that of the distance, others beside it
//   edges = ["5 Hz", "150 Hz"]
//
//   [reference]
//   title = "Track"
//   recordings = "measured"              # folder of CASE.csv; simulated unless given:
//   virtual = true                       # latsch run records those that are missing or of another
//                                        # reference or test (laboratory/virtual_recording.h)
//   kind = "car"
//   file = "track.toml"
//   recorded = ["speed", "line"]         # channels beside those compared
//   low_pass = "10 Hz"                   # of what models read as {from = "measurement.reference"}
//   seed = 15
//   [reference.noise]                    # standard deviation of every sample, in SI or with unit
//   pushrod_FL = "30 N"
//
//   [test.exit]
//   file = "tests/exit.toml"             # of the models
//   reference = "tests/exit_track.toml"  # of the reference; the same unless given
//   recording = "exit-2-2"               # of another case, for a test without its own
//   mark = ["speed", "kerb.pitch"]       # draws the frequency first / second of the test's numbers
//   [test.exit.vary]                     # a case for every combination: "exit-1-1", "exit-1-2" ...
//   speed = ["50 m/s", "60 m/s", "70 m/s"]
//   line = ["0 m", "0.2 m", "0.4 m"]
//
//   [model.baseline]
//   kind = "car"
//   file = "baseline.toml"
//   title = "Baseline"
//   fits = ["tire", "front"]             # where its numbers come from; none unless given
//
//   [fit.front]                          # a study that latsch run has completed: the models get
//   study = "fits/front.toml"            # its best point, and their bands its uncertainty;
//   bands = false                        # the best point alone, for a search without intervals
//   at = ["front_suspension"]            # path of its model in those compared; the whole model
//                                        # unless given (fit_posterior.h)
//
//   [factorial]                          # two factors of two levels: 00, 01, 10, 11
//   factors = ["tire", "compliance"]
//   models = ["baseline", "mf_compliant", "ring_rigid", "proposed"]
//
//   [uncertainty.dampers]                # numbers of the models that no fit has determined
//   paths = ["front.spring.stiffness"]   # numbers that a model lacks are skipped
//   spread = 0.2                         # standard deviation of the logarithm
//   source = "assumed"
//
//   [bands]
//   samples = 20                         # random ones; 0: from slopes by differences of the spread
//   seed = 3
//   level = 0.9
//
//   [pictures]                           # of one run: Test::details
//   model = "proposed"
//   case = "exit-2-2"
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/document_record.h"
#include "correlation/comparison/fit_posterior.h"
#include "experiment/language.h"
#include "measurement/rig_response_fit.h"

namespace latsch::correlation {

struct ComparedModel {
  std::string name, title;
  const experiment::SpecimenKind* kind = nullptr;
  Document numbers = Document::parse("", "");
  std::vector<std::size_t> fits;  // indices into ModelComparisonFile::fits
};

struct NamedBand {
  std::string name;
  FrequencyBand band;  // Hz
};

/// Number that varies over the cases of a test.
struct VariedNumber {
  std::string path, unit;
  std::vector<double> values;  // SI
};

struct GridTest {
  std::string name, recording;
  Document model_test = Document::parse("", ""), reference_test = Document::parse("", "");
  std::filesystem::path folder, reference_folder;
  std::vector<VariedNumber> varied;
  std::array<std::string, 2> mark;  // paths; empty: none
};

/// One combination of the varied numbers of a test.
struct ComparedCase {
  std::size_t test = 0;
  std::string name, recording;
  std::vector<std::size_t> levels;  // one level for each varied number
  std::string in_words;             // for example "speed 60 m/s, line 0.2 m"
  Document model_test = Document::parse("", ""), reference_test = Document::parse("", "");
  double mark = 0.0;  // frequency drawn as a mark, Hz; 0: none
};

struct Uncertainty {
  std::string name, source;
  std::vector<std::string> paths;
  double spread = 0.0;
};

struct ModelComparisonFile {
  std::filesystem::path file;
  std::string title;
  std::vector<std::string> channels, told, recorded;
  double from = 0.0, segment = 0.0, normalize = 0.0;  // s, s, Hz
  bool has_from = false;
  std::vector<NamedBand> bands;
  ComparedModel reference;
  std::filesystem::path recordings;  // empty: the reference is simulated
  bool is_virtual = false;           // true: the recordings are written by the reference
  double low_pass = 0.0;             // Hz; 0: none
  long seed = 1;
  std::map<std::string, double> noise;
  std::vector<GridTest> tests;
  std::vector<ComparedCase> cases;
  std::vector<ComparedModel> models;
  std::vector<std::string> factors;  // two factors, or none
  /// indices of the models in a factorial design, by the levels of the first and second factor
  std::array<std::array<std::size_t, 2>, 2> factorial_models{};
  std::vector<Uncertainty> uncertainties;
  std::vector<FitSource> fits;
  int samples = 0;
  long band_seed = 1;
  double level = 0.9;
  std::optional<std::pair<std::size_t, std::size_t>> pictures;  // indices of model and case

  std::size_t find_case(const std::string& name) const;  // returns cases.size() if there is none
};

/// True if the file is a comparison of models: it contains tables [model.NAME].
bool compares_models(const std::filesystem::path& file);
/// True if the file is a comparison of models and no study: it contains a table [reference].
bool is_model_comparison(const std::filesystem::path& file);
/// Throws InputError if a test of the comparison does not record a compared channel. A run calls
/// this before its fits, which take long and which read_model_comparison() needs.
void expect_compared_channels(const std::filesystem::path& file,
                              const experiment::Language& language);
/// Returns the studies of the tables [fit.NAME] by their names, in the order of the file, without
/// reading them. Throws InputError for one that does not exist.
std::vector<std::pair<std::string, std::filesystem::path>> studies_of_fits(
    const std::filesystem::path& file);

/// Throws InputError naming the place.
ModelComparisonFile read_model_comparison(const std::filesystem::path& file,
                                          const experiment::Language& language);
/// Reads a comparison of models and returns every key that its readers request, by its path. Throws
/// InputError as read_model_comparison() does.
std::map<std::string, DeclaredKey> keys_of_model_comparison(const std::filesystem::path& file,
                                                            const experiment::Language& language);

}  // namespace latsch::correlation
