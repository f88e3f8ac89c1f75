// SPDX-License-Identifier: Apache-2.0
#include "correlation/campaign/test_slopes.h"

#include <fmt/format.h>

#include <algorithm>
#include <mutex>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/text.h"
#include "base/units.h"
#include "correlation/study/study_slopes.h"
#include "correlation/target/predictions.h"
#include "correlation/target/study_trials.h"
#include "evaluation/executors/thread_executor.h"
#include "experiment/language/capabilities.h"
#include "optimization/design/continuous_design.h"
#include "optimization/design/sobol.h"
#include "optimization/identifiability/confidence.h"
#include "optimization/problem/point_vector.h"

namespace latsch::correlation {
namespace {

/// Collects the measured channels of a recording. Fails if one is missing.
Result<TestValues> values_of_recording(const CampaignSettings& campaign,
                                       const Channels& recording,
                                       const std::string& prefix) {
  std::vector<double> y;
  TestValues values;
  for (std::size_t c = 0; c < campaign.measures.size(); ++c) {
    const Channel* channel = recording.find(prefix + campaign.measures[c]);
    if (!channel) return Failure{"the test recorded no " + campaign.measures[c]};
    y.insert(y.end(), channel->values.begin(), channel->values.end());
    values.channel.insert(values.channel.end(), channel->values.size(), static_cast<int>(c));
  }
  values.y = to_vector(y);
  return values;
}

/// Returns the slopes of the measured channels by all variables of the unit cube; empty if they are
/// not known. Slopes of channels are by variables in SI.
Eigen::MatrixXd slopes_of_recording(const Study& study,
                                    const Channels& recording,
                                    const std::string& prefix,
                                    const DesignPoint& point) {
  const auto n = static_cast<std::size_t>(study.space.size());
  Score score;
  for (const std::string& name : study.campaign->measures) {
    const Channel* channel = recording.find(prefix + name);
    const std::size_t rows = channel->values.size();
    if (channel->slopes.size() != rows * n) return {};
    score.residuals.insert(score.residuals.end(), channel->values.begin(), channel->values.end());
    for (std::size_t row = 0; row < rows; ++row)
      for (std::size_t i = 0; i < n; ++i) score.jacobian.push_back(channel->slopes[i * rows + row]);
  }
  return study.space.unit_jacobian(point, score);
}

class ComputedSlopes : public TestSlopes {
 public:
  ComputedSlopes(const Study& study, const std::vector<DesignPoint>& points)
      : study_(study), points_(points), moved_(study.space) {
    for (const DesignPoint& point : points) specimens_.push_back(study.specimens->at(study, point));
  }

  Result<TestValues> at(const std::vector<double>& settings) const override {
    const CampaignSettings& campaign = *study_.campaign;
    experiment::MovableTest moved = *campaign.movable;
    for (std::size_t k = 0; k < settings.size(); ++k)
      moved.set(campaign.settings[k].path, settings[k]);
    const experiment::Asked asked{campaign.measures, moved_.paths()};
    TestValues values;
    try {
      const std::unique_ptr<experiment::Test> test = moved.test();
      for (std::size_t p = 0; p < points_.size(); ++p) {
        auto run = test->run_with_slopes(*specimens_[p], asked);
        if (!run) return run.failure();
        Channels recording;
        for (Channel channel : run->all()) {
          if (!channel.slopes.empty()) channel.slopes = moved_.in_variables(channel.slopes);
          recording.add(std::move(channel));
        }
        auto own = values_of_recording(campaign, recording, "");
        if (!own) return own;
        const Eigen::MatrixXd J = slopes_of_recording(study_, recording, "", points_[p]);
        if (J.rows() != own->y.size() || !J.allFinite() || !own->y.allFinite())
          return Failure{"a value or slope of the test is not finite"};
        if (p == 0) {
          values = *std::move(own);
          values.J.resize(J.rows(), J.cols() * std::ssize(points_));
        }
        if (J.rows() != values.J.rows())
          return Failure{"the test has another number of values at another point of the variables"};
        values.J.middleCols(static_cast<Eigen::Index>(p) * J.cols(), J.cols()) = J;
      }
    } catch (const InputError& error) {
      return Failure{error.what()};
    }
    return values;
  }

 private:
  Study study_;
  std::vector<DesignPoint> points_;
  MovedNumbers moved_;
  std::vector<std::unique_ptr<experiment::Specimen>> specimens_;
};

/// Stands for the channels that trials record; nothing is compared.
class AskedChannels : public Observable {
 public:
  explicit AskedChannels(const std::vector<std::string>& channels)
      : Observable({.kind = "curve", .compared = "", .asks = channels, .passes_slopes = true}) {}
  Result<Comparison> compare(const Channels&, const ObjectiveSettings&) const override {
    return Failure{"these channels are compared with nothing"};
  }
  std::vector<std::filesystem::path> write(const Channels&,
                                           const MeasurementFiles&) const override {
    return {};
  }
  void draw(const ShownExperiment&, report::StudyReport&) const override {}
  std::string table(const Channels&, const Comparison&) const override { return ""; }
  std::pair<std::string, nlohmann::ordered_json> answer(const Channels&,
                                                        const Comparison&) const override {
    return {"", {}};
  }
};

std::string run_name(std::size_t k) { return fmt::format("run_{:03}", k + 1); }

/// Returns admitted places for the runs, in the unit cube: the corners that are admitted as far as
/// a third of the runs, then points of a low-discrepancy sequence.
std::vector<std::vector<double>> run_places(const CampaignSettings& campaign, int count) {
  const auto d = static_cast<int>(campaign.settings.size());
  std::vector<std::vector<double>> places;
  const auto add = [&](const std::vector<double>& place) {
    if (std::ssize(places) < count && campaign.admits(campaign.values_at(place)))
      places.push_back(place);
  };
  for (int k = 0; k < 1 << d && 3 * (1 << d) <= count; ++k) {
    std::vector<double> corner;
    for (int i = 0; i < d; ++i) corner.push_back((k >> i) & 1);
    add(corner);
  }
  std::vector<DesignVariable> variables;
  for (int i = 0; i < d; ++i) variables.push_back({.name = std::to_string(i)});
  constexpr int kMostTried = 20;  // points tried for each run
  for (const DesignPoint& point : sobol(DesignSpace(variables), kMostTried * count).points)
    add(point.values);
  return places;
}

/// Returns the study whose trials run the test at all these settings.
Study study_of_runs(const Study& study, const std::vector<std::vector<double>>& places) {
  const CampaignSettings& campaign = *study.campaign;
  Study runs = study;
  runs.tests.clear();
  runs.constraints.clear();
  runs.stages.clear();
  std::vector<std::string> asks;
  for (std::size_t k = 0; k < places.size(); ++k) {
    experiment::MovableTest moved = *campaign.movable;
    for (std::size_t i = 0; i < places[k].size(); ++i)
      moved.set(campaign.settings[i].path, campaign.settings[i].at(places[k][i]));
    experiment::ReadTest read = moved.identified();
    StudyTest test;
    test.name = run_name(k);
    test.test = std::move(read.test);
    test.identity = std::move(read.identity);
    test.files = std::move(read.files);
    runs.tests.push_back(std::move(test));
    for (const std::string& channel : campaign.measures)
      asks.push_back(run_name(k) + "/" + channel);
  }
  StudyExperiment experiment;
  experiment.name = "runs";
  experiment.observable = std::make_shared<AskedChannels>(asks);
  runs.experiments = {experiment};
  runs.run.journal.replace_extension(".design.latsch");
  runs.asks_slopes = why_no_test_slopes(study).empty();
  return runs;
}

class InterpolatedSlopes : public TestSlopes {
 public:
  InterpolatedSlopes(const CampaignSettings& campaign,
                     const Eigen::MatrixXd& places,
                     const Eigen::MatrixXd& fields,
                     TestValues shape)
      : campaign_(campaign), kriging_(places, fields), shape_(std::move(shape)) {}

  Result<TestValues> at(const std::vector<double>& settings) const override {
    Eigen::VectorXd place(std::ssize(settings));
    for (std::size_t k = 0; k < settings.size(); ++k)
      place[static_cast<Eigen::Index>(k)] = campaign_.settings[k].place(settings[k]);
    const Eigen::VectorXd fields = kriging_.at(place);
    TestValues values = shape_;
    values.y = fields.head(shape_.y.size());
    values.J = fields.tail(shape_.J.size()).reshaped(shape_.J.rows(), shape_.J.cols());
    return values;
  }
  const FieldKriging& kriging() const { return kriging_; }

 private:
  CampaignSettings campaign_;
  FieldKriging kriging_;
  TestValues shape_;
};

}  // namespace

std::string why_no_test_slopes(const Study& study) {
  const experiment::SpecimenKind& kind = *study.specimens->kind();
  const MovedNumbers moved(study.space);
  for (const std::string& path : moved.paths())
    if (!kind.knows_slopes_in(path))
      return fmt::format("a {} does not know its slopes in {}", kind.in_words(), in_quotes(path));
  const std::unique_ptr<experiment::Test> test = study.campaign->movable->test();
  for (const std::string& channel : study.campaign->measures)
    if (!test->tells_slopes(kind, channel))
      return fmt::format("the test has no slopes of {}", channel);
  return kind.why_without_slopes(study.model, *test, moved.paths());
}

bool takes_long(const Study& study) {
  return study.specimens->kind()->has(experiment::IsFeTire::kName);
}

std::unique_ptr<TestSlopes> computed_slopes(const Study& study,
                                            const std::vector<DesignPoint>& points) {
  return std::make_unique<ComputedSlopes>(study, points);
}

std::optional<Result<KrigedSlopes>> kriged_slopes(const Study& study,
                                                  const DesignPoint& point,
                                                  const Eigen::VectorXd& lengths,
                                                  const RunOptions& options) {
  constexpr int kRunsBySetting = 10, kRunsBeside = 10;
  const CampaignSettings& campaign = *study.campaign;
  const auto d = static_cast<int>(campaign.settings.size());
  const int count = campaign.runs > 0 ? campaign.runs : kRunsBySetting * d + kRunsBeside;
  const auto places = run_places(campaign, count);
  std::optional<Result<KrigedSlopes>> answer;
  if (std::ssize(places) < d + 3) {
    answer.emplace(Failure{fmt::format(
        "the limits leave {} of {} settings at which the model could run, too few for an "
        "interpolation",
        places.size(),
        count)});
    return answer;
  }
  const Study runs = study_of_runs(study, places);
  const std::vector<DesignPoint> points = runs.asks_slopes
                                              ? std::vector<DesignPoint>{point}
                                              : difference_points(study.space, point, lengths);
  {
    ThreadExecutor executor([&] { return evaluator(runs); }, std::max(1, study.run.workers));
    if (!evaluate_points(runs, points, executor, options)) return std::nullopt;
  }
  const auto channels = recorded_channels(runs, points);
  if (!channels) {
    std::string reason = "a trial at the settings of the runs failed";
    const Journal journal = Journal::read(runs.run.journal, identity(runs));
    journal.for_each([&](const Trial& trial) {
      if (!trial.outcome.result) reason = trial.outcome.result.failure().reason;
    });
    for (std::size_t k = 0; k < places.size(); ++k) {
      if (reason.find(run_name(k)) == std::string::npos) continue;
      std::string words;
      for (std::size_t i = 0; i < places[k].size(); ++i)
        words +=
            (i == 0 ? "" : ", ") + campaign.settings[i].name + " " +
            format_quantity(campaign.settings[i].at(places[k][i]), campaign.settings[i].unit, 4);
      reason += " (" + words + "; limits of [design] leave such settings out)";
      break;
    }
    answer.emplace(Failure{reason});
    return answer;
  }
  const auto n = static_cast<Eigen::Index>(study.space.size());
  Eigen::MatrixXd at(std::ssize(places), d), fields;
  TestValues shape;
  for (std::size_t k = 0; k < places.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    at.row(row) = to_vector(places[k]).transpose();
    std::vector<Eigen::VectorXd> y;
    TestValues first;
    for (const Channels& trial : *channels) {
      auto own = values_of_recording(campaign, trial, run_name(k) + "/");
      if (!own) {
        answer.emplace(own.failure());
        return answer;
      }
      y.push_back(own->y);
      if (y.size() == 1) first = *std::move(own);
    }
    const Eigen::MatrixXd J =
        runs.asks_slopes ? slopes_of_recording(study, channels->front(), run_name(k) + "/", point)
                         : differences(study.space, points, y).J;
    if (k == 0) {
      shape = first;
      shape.J.setZero(first.y.size(), n);
      fields.resize(std::ssize(places), first.y.size() * (n + 1));
    }
    if (first.y.size() != shape.y.size() || J.rows() != shape.y.size()) {
      answer.emplace(
          Failure{"the test has different numbers of values at different settings, which cannot be "
                  "interpolated; measure channels with a fixed number of values"});
      return answer;
    }
    fields.row(row) << first.y.transpose(), J.reshaped().transpose();
  }
  KrigedSlopes kriged;
  auto slopes = std::make_unique<InterpolatedSlopes>(campaign, at, fields, shape);
  const Eigen::VectorXd& Q2 = slopes->kriging().Q2();
  const Eigen::Index m = shape.y.size();
  kriged.least_values = Q2.head(m).minCoeff();
  for (Eigen::Index i = 0; i < n; ++i)
    kriged.least_slopes.push_back(Q2.segment(m + i * m, m).minCoeff());
  kriged.slopes = std::move(slopes);
  kriged.runs = static_cast<int>(places.size());
  kriged.trials = std::ssize(points);
  answer.emplace(std::move(kriged));
  return answer;
}

}  // namespace latsch::correlation
