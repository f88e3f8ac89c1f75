// SPDX-License-Identifier: Apache-2.0
// Implements `latsch test`: runs any model through any test that it supports and prints the
// channels.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <ostream>
#include <set>
#include <string_view>
#include <utility>

#include "base/clock.h"
#include "base/document.h"
#include "base/error.h"
#include "base/file.h"
#include "base/progress.h"
#include "base/text.h"
#include "cli/console/answers.h"
#include "cli/console/console.h"
#include "cli/console/implausible.h"
#include "cli/console/ledgers.h"
#include "cli/console/version.h"
#include "cli/run/model_source.h"
#include "cli/run/test_argument.h"
#include "cli/run/written_tydex.h"
#include "cli/verbs/shown_page.h"
#include "cli/verbs/verbs.h"
#include "correlation/study/ledgers/file_ledgers.h"
#include "experiment/language.h"
#include "experiment/language/sign_view.h"
#include "formats/tables/csv_table.h"

namespace latsch::cli {
namespace {

struct TestOptions {
  std::string model, test, output, html, details, kind, signs = "iso";
  bool convergence = false, list = false, all_digits = false;
};

/// Reports how finer time steps and more segments change the results.
int say_convergence(const experiment::SpecimenKind& kind,
                    const Document& numbers,
                    const experiment::Test& test) {
  const auto repeated = test.convergence(kind, numbers);
  if (!repeated)
    throw InputError("--convergence: expected a test of kind \"drum_cleat\", which steps in time");
  const auto& found = *repeated;
  if (!found) {
    complain(found.failure().reason);
    return kFailed;
  }
  Json& rows = answer()["changes"] = Json::array();
  for (const auto& one : *found)
    rows.push_back({{"channel", one.name},
                    {"unit", one.unit},
                    {"about_mean", one.about_mean},
                    {"by_half_step", one.by_step},
                    {"by_half_more_segments", one.by_segments}});
  say("{}\nroot mean square over the record, of\n{:4}{:>14}{:>20}{:>32}\n",
      test.in_words(),
      "",
      "all about mean",
      "change, half step",
      "change, half more segments");
  for (const auto& one : *found)
    say("{:4}{:>14}{:>20}{:>32}\n",
        one.name,
        fmt::format("{:.1f} {}", one.about_mean, one.unit),
        fmt::format("{:.2f} {}", one.by_step, one.unit),
        fmt::format("{:.2f} {}", one.by_segments, one.unit));
  say("Half the step divides its effect by four, half as many segments again divide theirs by "
      "about\n"
      "two. Both should stay below the noise of what they are compared with.\n");
  return kDone;
}

/// Prints which kinds of models can run which kinds of tests.
int say_matrix(const experiment::Language& language) {
  Json& rows = answer()["tests"] = Json::array();
  for (const experiment::TestKind* test : language.tests) {
    const auto able = language.kinds_for(test->needs);
    rows.push_back({{"kind", test->name}, {"what", test->in_words}, {"models", able}});
    say("{:<17} {}\n{:<17} {}\n", test->name, test->in_words, "", fmt::join(able, ", "));
  }
  return kDone;
}

/// Writes the further output that the user requested in addition to the channels.
void write_details(const TestOptions& options,
                   const experiment::Test& test,
                   const Channels& channels,
                   const experiment::Test::Details& details,
                   const std::vector<std::string>& notes) {
  if (!options.details.empty()) {
    if (details.numbers.all().empty())
      throw InputError("--details: this test (" + test.in_words() +
                       ") has no more numbers than its channels");
    write_text_file(options.details, formats::csv_text(details.numbers));
    say_written(options.details);
  }
  if (options.html.empty()) return;
  ShownFile shown;
  shown.kind = test.in_words();
  for (const std::string& note : notes) shown.facts.push_back("Note: " + note);
  shown.pictures = details.pictures;
  show_channels(channels, true, shown);
  write_text_file(options.html, shown_page(options.model, shown));
  say_written(options.html);
}

/// Writes blocks of samples as CSV, with the header before the first block.
class CsvBlocks {
 public:
  explicit CsvBlocks(std::function<void(const std::string&)> to) : to_(std::move(to)) {}
  void operator()(const Channels& block) {
    if (is_first_) to_(formats::csv_header(block));
    is_first_ = false;
    to_(formats::csv_rows(block));
  }

 private:
  std::function<void(const std::string&)> to_;
  bool is_first_ = true;
};

void append(const Channels& block, Json& all) {
  const Json more = answer_of(block);
  if (all.empty()) {
    all = more;
    return;
  }
  for (std::size_t i = 0; i < more.size(); ++i)
    for (const Json& value : more[i]["values"]) all[i]["values"].push_back(value);
}

/// Appends a block of samples to the channels in `all`.
void append(const Channels& block, Channels& all) {
  Channels longer;
  for (const Channel& channel : block.all()) {
    Channel whole = channel;
    if (const Channel* before = all.find(channel.name))
      whole.values.insert(whole.values.begin(), before->values.begin(), before->values.end());
    longer.add(std::move(whole));
  }
  all = std::move(longer);
}

/// Returns the channels with the states that the test was given in a table, such as its slip
/// angles, before them: a TYDEX file has nothing else that shows to which state a force belongs.
Channels with_states(const experiment::Test& test, const Channels& channels) {
  struct State {
    const char *name, *unit;
  };
  constexpr State kStates[] = {
      {"alpha", "rad"}, {"kappa", "1"}, {"gamma", "rad"}, {"p", "Pa"}, {"Vx", "m/s"}};
  Channels all;
  for (const State& state : kStates) {
    std::vector<double> values = test.driven_at(state.name);
    if (!values.empty() && !channels.find(state.name))
      all.add({.name = state.name, .unit = state.unit, .values = std::move(values)});
  }
  for (const Channel& channel : channels.all()) all.add(channel);
  return all;
}

/// Throws InputError if TYDEX defines none of the names, because the file would be read by nobody:
/// it is a format for measurements of tires.
void expect_names_of_tydex(const formats::TydexRecord& record, const std::string& file) {
  const formats::WrittenTydex written =
      formats::tydex_text(record, formats::TydexDigits::columns_of_ten);
  for (const auto& name : written.names)
    if (name.is_defined && name.channel != "time") return;
  throw InputError("-o " + file +
                   ": TYDEX is a format for measurements of tires, and it defines a name for no "
                   "channel of this test; expected a file that ends in \".csv\"");
}

/// Writes the channels as a TYDEX file, whose names state the frame of each force.
void write_tydex_of(const TestOptions& options,
                    const experiment::Test& test,
                    const Channels& channels) {
  formats::TydexRecord record;
  record.measurement = std::filesystem::path(options.output).stem().string();
  record.comments = {"Computed by Latsch " + version_number() + "; no measurement.",
                     "Test: " + test.in_words(),
                     "Model: " + options.model};
  const std::vector<experiment::ChannelInfo> known = test.channels();
  record.channels = with_states(test, channels);
  for (const Channel& channel : record.channels.all()) {
    const auto info = std::ranges::find(known, channel.name, &experiment::ChannelInfo::name);
    record.frames.push_back(info == known.end() ? std::string() : info->frame);
  }
  record.constants = {{"TESTRIG", "Test rig", "", "virtual: " + test.in_words()},
                      {"IDENTITY", "Identity of tyre", "", options.model}};
  expect_names_of_tydex(record, options.output);
  const auto digits =
      options.all_digits ? formats::TydexDigits::all : formats::TydexDigits::columns_of_ten;
  say_remarks(write_tydex(std::move(record), digits, options.output), "--all-digits");
}

/// Writes the channels to the output that the user requested.
void give_channels(const TestOptions& options,
                   const experiment::Test& test,
                   const Channels& channels) {
  if (is_tydex(options.output)) {
    write_tydex_of(options, test, channels);
  } else {
    give(channels, options.output);
  }
}

/// Throws InputError for options that do not fit the output file.
void refuse_tydex_options(const TestOptions& options) {
  if (options.all_digits && !is_tydex(options.output))
    throw InputError(
        "--all-digits: only a TYDEX file (-o FILE.tdx) has rounded numbers; every other output "
        "has all digits");
  if (options.signs != "iso" && is_tydex(options.output))
    throw InputError("--signs " + options.signs +
                     ": the axes of a TYDEX file have the signs of ISO 8855; leave out --signs, "
                     "or write a .csv file");
}

/// Thrown if a test fails while its output file is being written, so that the file is not created.
struct Unsuccessful {
  Failure failure;
};

/// Shows how many samples of a long test are known, unless a terminal shows the samples themselves.
class SampleNote {
 public:
  SampleNote(const experiment::Test& test, const TestOptions& options)
      : total_(test.samples().value_or(0)),
        is_shown_(!options.output.empty() || answers_in_json() || !is_terminal(1)) {}

  void add(const Channels& block) {
    if (block.empty()) return;
    done_ += std::ssize(block.all().front().values);
    // A test whose samples all come at the end has no progress to show, even if it takes long.
    const bool is_short = clock_() - start_ < kPatience || (total_ > 0 && done_ >= total_);
    if (!is_shown_ || (is_short && !has_shown_)) return;
    has_shown_ = true;
    note_.update(done_, total_, "");
  }

 private:
  static constexpr double kPatience = 5.0;  // s, before a test counts as long

  long total_, done_ = 0;
  bool is_shown_, has_shown_ = false;
  Clock clock_ = steady_clock();
  double start_ = clock_();
  RunningNote note_;  // its time counts from the start
};

/// Runs the test and writes its channels. Samples are written in blocks, so the memory that is
/// needed does not depend on the length of the recording.
int run_and_give(const TestOptions& options,
                 const experiment::Language& language,
                 const ModelSource& model,
                 const experiment::Test& test) {
  std::vector<std::string> notes;
  const auto view = experiment::sign_view(options.signs);
  const auto run = [&](const std::function<void(const Channels&)>& tell) {
    SampleNote progress(test, options);
    const auto done =
        language.run_in_blocks(*model.kind, model.numbers, test, [&](const Channels& block) {
          tell(experiment::in_signs(block, test, view));
          progress.add(block);
        });
    if (!done) throw Unsuccessful{done.failure()};
    notes = *done;
  };
  try {
    if (is_tydex(options.output)) {
      Channels recorded;
      run([&](const Channels& block) { append(block, recorded); });
      write_tydex_of(options, test, recorded);
    } else if (!options.output.empty()) {
      write_file(options.output, [&](std::ostream& out) {
        run(CsvBlocks([&](const std::string& text) { out << text; }));
      });
      say_written(options.output);
    } else if (answers_in_json()) {
      Json& all = answer()["channels"] = Json::array();
      run([&](const Channels& block) { append(block, all); });
    } else {
      run(CsvBlocks([](const std::string& text) { put(text); }));
    }
  } catch (const Unsuccessful& unsuccessful) {
    complain(unsuccessful.failure.reason);
    return kFailed;
  }
  for (const std::string& note : notes) warn(note);
  return kDone;
}

/// Throws InputError if `signs` are not iso and the test's results exist only in iso.
void refuse_signs(const std::string& signs, const experiment::Test& test) {
  if (signs == "iso" || experiment::has_sign_views(test)) return;
  throw InputError("--signs " + signs + ": this test (" + test.in_words() +
                   ") has its channels only in the signs of ISO 8855; other signs have the tests "
                   "of a suspension: kc, axle_kc, kinematics");
}

int test(const TestOptions& options, const experiment::Language& language) {
  if (options.list) return say_matrix(language);
  if (options.model.empty() || options.test.empty())
    throw InputError(
        "test: expected a model and a test, such as: latsch test tire.toml test.toml; "
        "latsch test --list says which model can do which");
  const ModelSource model = model_source(options.model, language, options.kind);
  const experiment::ReadTest read = test_argument(options.test, language);
  const std::unique_ptr<experiment::Test>& test = read.test;
  const bool gives_data = options.output.empty() && options.html.empty() && options.details.empty();
  const std::string model_file = is_study(options.model)
                                     ? study_with_model(options.model, language).model_file.string()
                                     : options.model;
  say_ledgers(ledgers_of_test(model_file, options.test, read.files, test->ledgers("the test")),
              gives_data ? LinesTo::standard_error : LinesTo::output,
              "Files");
  refuse_signs(options.signs, *test);
  refuse_tydex_options(options);
  if (const std::string fault = model.kind->remark(model.numbers, *test); !fault.empty())
    throw InputError(fault);
  if (options.convergence) return say_convergence(*model.kind, model.numbers, *test);
  if (options.html.empty() && options.details.empty())
    return run_and_give(options, language, model, *test);
  Channels recorded;
  const auto notes = language.run_in_blocks(
      *model.kind, model.numbers, *test, [&](const Channels& block) { append(block, recorded); });
  if (!notes) {
    complain(notes.failure().reason);
    return kFailed;
  }
  const auto view = experiment::sign_view(options.signs);
  const auto details = test->details_in(view, *model.kind->build(model.numbers));
  if (!details) throw std::runtime_error(details.failure().reason);
  const Channels channels = experiment::in_signs(recorded, *test, view);
  write_details(options, *test, channels, *details, *notes);
  give_channels(options, *test, channels);
  for (const std::string& note : *notes) warn(note);
  return kDone;
}

/// Examples for the help text: a kind of test, and a command line that runs it.
constexpr std::array<std::pair<const char*, const char*>, 7> kExamples{{
    {"drum_cleat",
     "studies/ring_tires/passenger_205_55R16.toml studies/cleat_fit/tests/slow.toml > forces.csv"},
    {"drum_cleat",
     "studies/ring_tires/passenger_205_55R16.toml studies/cleat_fit/tests/slow.toml --convergence"},
    {"footprint",
     "studies/ring_tires/passenger_205_55R16.toml "
     "'{kind = \"footprint\", loads = [\"2 kN\", \"4 kN\"]}' --html patch.html"},
    {"steady_states",
     "studies/race_tire_mf/tire.tir "
     "'{kind = \"steady_states\", states = \"studies/race_tire_mf/cornering.csv\"}' -o forces.csv"},
    {"slip_sweep",
     "studies/ring_tires/passenger_205_55R16.toml "
     "'{kind = \"slip_sweep\", load = \"4 kN\", speed = \"30 km/h\", alpha = [\"-6 deg\", "
     "\"6 deg\"], duration = \"2 s\"}' -o sweep.tdx"},
    {"kc", "studies/compliance/corner.toml '{kind = \"kc\", Fy = \"-4 kN\"}' --signs sae"},
    {"modes", "my_tire/study.toml '{kind = \"modes\", count = 6}'   # its best point"},
}};

/// True if the program has this kind of test. A user's own program may have other kinds.
bool knows(const experiment::Language& language, std::string_view kind) {
  return std::ranges::any_of(language.tests, [&](const auto* test) { return test->name == kind; });
}

}  // namespace

void add_test(CommandLine& app, Program& program) {
  Verb verb = app.add_subcommand("test", "Runs any model through any test that it can do");
  std::string tests;
  for (const experiment::TestKind* test : program.language.tests)
    tests += fmt::format("  kind = {:<20} {}\n", in_quotes(test->name), test->in_words);
  std::string examples;
  for (const auto& [kind, line] : kExamples)
    if (knows(program.language, kind)) examples += fmt::format("  latsch test {}\n", line);
  verb.footer(
      "MODEL is a file with a model, or a study at its best point; TEST a file (or its keys "
      "in\nbraces) that says its\n" +
      tests +
      "and the keys that `latsch help test KIND` lists; latsch test --list says which models can "
      "do\nwhich.\n\n"
      "--signs turns what a suspension's test puts out into the signs of others, a view alone:\n"
      "  iso    x forward, y left, z up (ISO 8855): steer and rack positive to the left\n"
      "  sae    x forward, y right, z down (SAE J670, 1976): both to the right, dz downward\n"
      "  adams  x rearward, y right, z up: steer to the left, rack to the right, dx rearward\n"
      "Toe-in, camber with the top outboard, caster with the top rearward, travel in bump, "
      "lengths\n"
      "and ratios are positive in all. What is typed in a test stays ISO.\n\n"
      "-o FILE.tdx writes TYDEX 1.3: SI units, angles of slip in degrees, forces in the axes that "
      "their names state (FYW: "
      "W),\nsigns of ISO 8855.\n\n"
      "Examples:\n" +
      examples + "  latsch test --list");
  auto options = std::make_shared<TestOptions>();
  verb.add_option("model", options->model, "Model or study");
  verb.add_option("test", options->test, "Test file, or its keys in braces");
  verb.add_option(
          "-o,--output", options->output, "CSV or TYDEX (.tdx) file to write; else the terminal")
      .written_as("CSV or TYDEX", {".csv", ".tdx", ".tydex", ".tda", ".tdb"});
  verb.add_option("--kind", options->kind, "Kind of model, for a file that can be read as several")
      .one_of(program.language.kind_names());
  verb.add_option("--html", options->html, "Page with pictures to write")
      .written_as("HTML", {".html", ".htm"});
  verb.add_option("--details",
                  options->details,
                  "CSV file for results beyond the channels, such as the pressures of a footprint")
      .written_as("CSV", {".csv"});
  verb.add_option(
          "--signs", options->signs, "Signs of the output of a suspension's test; iso unless given")
      .one_of(experiment::sign_view_names());
  verb.add_flag("--all-digits",
                options->all_digits,
                "Write every digit into a TYDEX file, in columns wider than its ten characters");
  verb.add_flag("--list", options->list, "Which models can do which tests");
  verb.add_flag("--convergence",
                options->convergence,
                "For a drum_cleat: effect of half the step, and of half as many segments again");
  verb.forms(
      {{"runs a test",
        {},
        {"model", "test", "--output", "--kind", "--html", "--details", "--signs", "--all-digits"}},
       {"prints the effects of step and segments", {"--convergence"}, {"model", "test", "--kind"}},
       {"lists models and tests", {"--list"}}});
  verb.callback([=, &program] { program.exit_code = test(*options, program.language); });
}

}  // namespace latsch::cli
