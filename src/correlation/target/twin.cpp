// SPDX-License-Identifier: Apache-2.0
#include "correlation/target/twin.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "base/file.h"
#include "correlation/laboratory/frame_conversion.h"
#include "correlation/laboratory/measurement.h"
#include "correlation/observable/mode_set.h"
#include "experiment/language/capabilities.h"
#include "experiment/rigs/load_case.h"

namespace latsch::correlation {
namespace {

constexpr const char* kComment =
    "Not measured: computed by the model itself, latsch export --measurements";

/// Returns the study with shapes of modes recorded at the model's sensors, for the experiments that
/// compare shapes but have no measured ones.
Study with_sensors(Study study, experiment::Specimen& specimen) {
  for (StudyExperiment& experiment : study.experiments) {
    if (experiment.shapes_file.empty()) continue;
    for (StudyTest& test : study.tests) {
      const auto* modes = test.test->settings_as<experiment::ModalTest>();
      if (!modes || test.name != experiment.name) continue;
      const Eigen::Matrix3Xd points = modes->points.cols() > 0
                                          ? modes->points
                                          : specimen.find<experiment::Vibrates>()->sensor_points();
      experiment.observable =
          std::make_shared<ModeSet>(test.name,
                                    std::vector<ModeRecord>{},
                                    static_cast<std::size_t>(experiment.measured_modes),
                                    points);
      test.test = test.test->with_points(points);
    }
  }
  return study;
}

/// Refuses to write a measurement into the table that holds the states of a test, because the
/// states would be lost.
void refuse_to_overwrite_inputs(const Study& study) {
  for (const StudyExperiment& experiment : study.experiments) {
    const std::filesystem::path& file = experiment.measurement_file;
    for (const StudyTest& test : study.tests) {
      for (const std::filesystem::path& read : test.files) {
        std::error_code absent;
        if (!std::filesystem::equivalent(file, read, absent)) continue;
        throw InputError(
            {study.file.string(), 0},
            "experiment " + experiment.name + " is measured in " + file.string() + ", which test " +
                test.name +
                " reads its states from: a twin would write over them. Give the experiment a file "
                "of its own");
      }
    }
  }
}

/// Returns the channels that the measurement of an experiment will contain. If in_frame has
/// converted a force of a file, they include all forces of the file.
std::vector<std::string> answers(const StudyExperiment& experiment) {
  std::vector<std::string> all = experiment.observable->asks();
  if (!experiment.measurement || all.empty()) return all;
  const std::string test = all[0].substr(0, all[0].find('/') + 1);
  for (const auto& [name, from] : experiment.measurement->turned_from()) {
    const std::string channel = test + force_without_frame(name);
    if (std::find(all.begin(), all.end(), channel) == all.end()) all.push_back(channel);
  }
  return all;
}

/// Throws if two tests would write different values into the same column of a file.
void refuse_two_answers(const Study& study, const Channels& trial) {
  struct Answer {
    const StudyExperiment* experiment;
    const Channel* channel;
  };
  std::map<std::pair<std::filesystem::path, std::string>, Answer> columns;
  for (const StudyExperiment& experiment : study.experiments) {
    for (const std::string& name : answers(experiment)) {
      const Channel* channel = trial.find(name);
      if (!channel) continue;
      const std::string column = name.substr(name.find('/') + 1);
      const auto [at, is_new] =
          columns.try_emplace({experiment.measurement_file, column}, Answer{&experiment, channel});
      const Answer& other = at->second;
      if (is_new || other.channel->values == channel->values) continue;
      throw InputError(
          {study.file.string(), 0},
          fmt::format("experiments {} and {} are both measured in {}, and {} and {} differ: a twin "
                      "would keep the {} of one. Give each test a file of its own",
                      other.experiment->name,
                      experiment.name,
                      experiment.measurement_file.string(),
                      other.channel->name,
                      name,
                      column));
    }
  }
}

/// If no twin has written the file before, it may be measured: copies it to a free name beside it,
/// "curve.measured.csv".
void keep_measured(const std::filesystem::path& file, std::vector<TwinFiles::Kept>& kept) {
  if (file.empty() || !std::filesystem::is_regular_file(file)) return;
  if (read_text_file(file).starts_with(std::string("# ") + kComment)) return;
  std::filesystem::path as = file;
  as.replace_extension(".measured" + file.extension().string());
  for (int number = 2; std::filesystem::exists(as); ++number) {
    as = file;
    as.replace_extension(fmt::format(".measured_{}{}", number, file.extension().string()));
  }
  std::filesystem::copy_file(file, as);
  kept.push_back({file, as});
}

}  // namespace

Result<TwinFiles> write_twin(const Study& study) {
  const experiment::SpecimenKind* kind = study.specimens->kind();
  if (!kind) {
    throw InputError(
        {study.file.string(), 0},
        "has an outside program instead of a model, so no twin of a model can be written");
  }
  refuse_to_overwrite_inputs(study);
  const auto specimen = kind->build(study.model);
  const Study twin = with_sensors(study, *specimen);
  Channels trial;
  for (const StudyTest& test : twin.tests) {
    auto recording = test.test->run(*specimen);
    if (!recording) {
      return Failure{test.in_words() + ": " + recording.failure().reason,
                     recording.failure().cause};
    }
    for (Channel channel : recording->all()) {
      channel.name = test.name + "/" + channel.name;
      trial.add(std::move(channel));
    }
  }
  refuse_two_answers(twin, trial);
  TwinFiles files;
  std::vector<std::filesystem::path>& written = files.written;
  for (const StudyExperiment& experiment : twin.experiments) {
    const bool is_shared =
        std::find(written.begin(), written.end(), experiment.measurement_file) != written.end();
    for (const auto& file : {experiment.measurement_file, experiment.shapes_file}) {
      if (std::find(written.begin(), written.end(), file) != written.end()) continue;
      keep_measured(file, files.kept);
      allow_to_replace(file);
    }
    for (auto& file : experiment.observable->write(trial,
                                                   {experiment.measurement_file,
                                                    experiment.shapes_file,
                                                    kComment,
                                                    is_shared,
                                                    experiment.measurement.get()}))
      if (!is_shared) written.push_back(std::move(file));
  }
  return files;
}

}  // namespace latsch::correlation
