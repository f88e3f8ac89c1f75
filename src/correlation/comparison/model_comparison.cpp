// SPDX-License-Identifier: Apache-2.0
#include "correlation/comparison/model_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <ctime>
#include <exception>
#include <mutex>
#include <numeric>
#include <stdexcept>
#include <thread>

#include "base/random.h"
#include "base/text.h"
#include "correlation/analysis/limits_by_name.h"
#include "experiment/language/known_limits.h"
#include "formats/tables/csv_table.h"
#include "measurement/band_level.h"
#include "numerics/chi_square.h"
#include "numerics/signals/butterworth.h"

namespace latsch::correlation {
namespace {

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double cpu_seconds() {
  timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double rate_of(const Channels& channels) {
  const auto& time = channels["time"];
  return static_cast<double>(time.size() - 1) / (time.back() - time.front());
}

/// Throws InputError if the samples of a recording do not follow each other evenly: spectra would
/// take a gap for none.
void check_even(const ModelComparisonFile& file,
                const Channels& channels,
                const std::string& whose) {
  constexpr double kOff = 0.5;  // share of a step; less may be the rounding of a table
  const auto& time = channels["time"];
  const double step = (time.back() - time.front()) / static_cast<double>(time.size() - 1);
  for (std::size_t i = 1; i < time.size(); ++i)
    if (!(std::abs(time[i] - time[i - 1] - step) <= kOff * step))
      throw InputError(
          {file.file.string(), 0},
          fmt::format("{} is not even in time: sample {} follows at {:.6g} s the one at {:.6g} s, "
                      "where {:.4g} s are usual",
                      whose,
                      i + 1,
                      time[i],
                      time[i - 1],
                      step));
}

/// Filters forward only, starting from the steady state of the first 20 ms, so that later samples
/// do not affect earlier ones.
Channels low_passed(const ModelComparisonFile& file, const Channels& recording) {
  const double edge = file.low_pass;
  if (edge == 0.0) return recording;
  constexpr double kFirst = 0.02;  // s
  const double rate = rate_of(recording);
  if (edge >= 0.5 * rate)
    throw InputError(
        {file.file.string(), 0},
        fmt::format("reference.low_pass is {:g} Hz, but {:g} samples a second hold nothing above "
                    "{:g} Hz; expected a lower edge, or none",
                    edge,
                    rate,
                    0.5 * rate));
  const auto filter = numerics::polynomials_of(
      numerics::butterworth(2, numerics::FilterBand::low_pass, {edge}, rate));
  const auto rest = numerics::steady_state(filter);
  Channels channels;
  for (Channel channel : recording.all()) {
    if (channel.name != "time") {
      const auto first = std::clamp<std::size_t>(
          static_cast<std::size_t>(kFirst * rate), 1, channel.values.size());
      const double level = mean(
          {channel.values.begin(), channel.values.begin() + static_cast<std::ptrdiff_t>(first)});
      std::vector<double> state = rest;
      for (double& value : state) value *= level;
      channel.values = numerics::filter(filter, channel.values, state);
    }
    channels.add(std::move(channel));
  }
  return channels;
}

std::unique_ptr<experiment::Test> read_case(const Document& document,
                                            const std::filesystem::path& folder,
                                            const experiment::Language& language,
                                            const Channels* measured) {
  const Node root = document.root();
  experiment::TestSource source{folder, nullptr};
  if (measured)
    source.measured = [measured](const Node& table,
                                 const std::vector<experiment::MeasuredCondition>& conditions) {
      if (table.text("from") != "measurement.reference")
        table.reject("from", "is none, expected \"measurement.reference\"");
      Channels channels;
      for (const auto& one : conditions) {
        const Channel* found = measured->find(one.channel);
        if (!found && !one.is_needed) continue;
        if (!found)
          table.reject("from",
                       "needs the channel " + in_quotes(one.channel) +
                           ", which the reference does not record: name it in recorded");
        channels.add({one.channel, one.unit, found->values});
      }
      return channels;
    };
  auto test = language.read_test(root, source);
  root.close();
  return test;
}

/// `limits`: receives the limits of the model in the test, unless it is null.
Channels run_of(const ComparedModel& model,
                const Document& numbers,
                const experiment::Test& test,
                const std::string& name,
                std::vector<std::string>* limits = nullptr) {
  const auto specimen = model.kind->build(numbers);
  auto channels = test.run(*specimen);
  if (!channels)
    throw std::runtime_error(
        fmt::format("{} in {}: {}", model.title, name, channels.failure().reason));
  if (!limits) return std::move(*channels);
  if (const auto* tells = dynamic_cast<const experiment::TellsLimits*>(&test))
    *limits = tells->limits(*specimen);
  for (std::string& limit : experiment::limits_met(*specimen)) limits->push_back(std::move(limit));
  return std::move(*channels);
}

/// Returns the selected samples of a channel.
std::vector<double> counted(const ModelComparisonFile& file,
                            const Channels& channels,
                            const std::string& name,
                            const std::string& whose) {
  const Channel* channel = channels.find(name);
  if (!channel)
    throw InputError({file.file.string(), 0}, whose + " does not record " + in_quotes(name));
  if (!file.has_from || channel->values.size() != channels["time"].size()) return channel->values;
  const auto& time = channels["time"];
  const auto first = std::lower_bound(time.begin(), time.end(), file.from - 1e-9) - time.begin();
  return {channel->values.begin() + first, channel->values.end()};
}

numerics::WelchSettings welch_of(const ModelComparisonFile& file,
                                 std::size_t samples,
                                 double rate) {
  return numerics::welch_settings(numerics::Convention::scipy,
                                  static_cast<int>(samples),
                                  static_cast<int>(std::lround(file.segment * rate)));
}

/// Throws InputError if a band or the segment asks for more than a recording contains.
void check_spectrum(const ModelComparisonFile& file,
                    std::size_t samples,
                    double rate,
                    const std::string& whose) {
  constexpr double kFewest = 16.0;  // samples of a segment
  const auto reject = [&](const std::string& why) {
    throw InputError({file.file.string(), 0}, why);
  };
  const double length = static_cast<double>(samples) / rate;
  if (file.segment * rate < kFewest)
    reject(fmt::format("segment is {:g} s, {:.3g} samples of {}; expected {:.0f} samples at least",
                       file.segment,
                       file.segment * rate,
                       whose,
                       kFewest));
  if (file.segment * rate > static_cast<double>(samples) + 1.0)
    reject(
        fmt::format("segment is {:g} s, but {} has {:.4g} s to select it from; expected a "
                    "shorter segment or a longer test",
                    file.segment,
                    whose,
                    length));
  const double spacing = rate / welch_of(file, samples, rate).length;
  for (const auto& [name, band] : file.bands) {
    if (band.upper > 0.5 * rate * (1.0 + 1e-6))
      reject(
          fmt::format("band.{}.edges ends at {:g} Hz, but the {:g} samples a second of {} hold "
                      "nothing above {:g} Hz",
                      name,
                      band.upper,
                      rate,
                      whose,
                      0.5 * rate));
    if (std::floor(band.upper / spacing + 1e-9) * spacing < band.lower - 1e-9)
      reject(
          fmt::format("band.{}.edges from {:g} to {:g} Hz has no line of the spectra, which are "
                      "{:.3g} Hz apart; expected a wider band or a longer segment",
                      name,
                      band.lower,
                      band.upper,
                      spacing));
  }
}

std::vector<numerics::Density> densities_of(const ModelComparisonFile& file,
                                            const Channels& channels,
                                            const std::string& whose) {
  std::vector<numerics::Density> all;
  check_even(file, channels, whose);
  const double rate = rate_of(channels), first = channels["time"].front();
  constexpr double kRounding = 1e-9;  // s
  if (file.has_from && file.from < first - kRounding)
    throw InputError(
        {file.file.string(), 0},
        fmt::format("from is {:g} s, but {} begins at {:.4g} s; expected a later time, "
                    "or no from for the whole record",
                    file.from,
                    whose,
                    first));
  for (const std::string& name : file.channels) {
    const auto values = counted(file, channels, name, whose);
    if (values.size() < 16)
      throw InputError({file.file.string(), 0}, whose + " has fewer than 16 selected samples");
    check_spectrum(file, values.size(), rate, whose);
    all.push_back(numerics::power_density(values, rate, welch_of(file, values.size(), rate)));
  }
  return all;
}

bool is_in(double frequency, FrequencyBand band) {
  return frequency >= band.lower - 1e-9 && frequency <= band.upper + 1e-9;
}

/// Throws InputError if a channel of the reference is still in a band, to which nothing can be
/// compared.
void check_power(const ModelComparisonFile& file, const std::vector<numerics::Density>& reference) {
  for (std::size_t c = 0; c < reference.size(); ++c)
    for (const auto& [name, band] : file.bands) {
      double most = 0.0;
      for (std::size_t k = 0; k < reference[c].value.size(); ++k)
        if (is_in(reference[c].frequency[k], band)) most = std::max(most, reference[c].value[k]);
      if (most > 0.0) continue;
      throw InputError({file.file.string(), 0},
                       fmt::format("{} of {} does not move in band.{}, so there is nothing to "
                                   "compare with; expected another channel or band",
                                   in_quotes(file.channels[c]),
                                   file.reference.title,
                                   name));
    }
}

/// Throws InputError for a channel of `told` that no test of the models records.
void check_told(const ModelComparisonFile& file,
                const std::vector<std::unique_ptr<experiment::Test>>& tests) {
  for (const std::string& name : file.told) {
    std::vector<std::string> recorded;
    for (const auto& test : tests)
      for (const experiment::ChannelInfo& channel : test->channels())
        if (std::find(recorded.begin(), recorded.end(), channel.name) == recorded.end())
          recorded.push_back(channel.name);
    if (std::find(recorded.begin(), recorded.end(), name) != recorded.end()) continue;
    throw InputError(
        {file.file.string(), 0},
        fmt::format(
            "told has {}, which no test records{}", in_quotes(name), did_you_mean(name, recorded)));
  }
}

/// Returns white noise as stated.
std::vector<LineNoise> noise_of(const ModelComparisonFile& file, const Channels& recording) {
  std::vector<LineNoise> all;
  const double rate = rate_of(recording);
  for (const std::string& name : file.channels) {
    const auto samples = counted(file, recording, name, file.reference.title).size();
    const auto stated = file.noise.find(name);
    const double deviation = stated == file.noise.end() ? 0.0 : stated->second;
    all.push_back({2.0 * deviation * deviation / rate,
                   independent_segments(static_cast<int>(samples), welch_of(file, samples, rate))});
  }
  return all;
}

bool has(const Document& numbers, const std::vector<std::string>& wanted) {
  const auto paths = numbers.paths();
  return std::any_of(wanted.begin(), wanted.end(), [&](const std::string& path) {
    return std::find(paths.begin(), paths.end(), path) != paths.end();
  });
}

/// Multiplies a number stated by hand by exp(`spreads` times its spread), if the model has it.
void move_typed(const Uncertainty& number, double spreads, Document& numbers) {
  const auto paths = numbers.paths();
  for (const std::string& path : number.paths)
    if (std::find(paths.begin(), paths.end(), path) != paths.end())
      numbers.set(path, std::exp(spreads * number.spread) * numbers.get(path));
}

/// A model with moved numbers.
struct MovedModel {
  Document numbers;
  double count = 1.0;  // factor to a full deviation: bounds may allow only a part of one
};

/// Moves a model by up to one deviation along a direction of a fit, to the side with more room.
MovedModel moved_along(const FitSource& source,
                       const FitPosterior& fit,
                       Eigen::Index axis,
                       const Document& numbers) {
  const auto u = source.study->space.to_unit(fit.point);
  const auto room = [&](double side) {  // available part of a deviation, at most 1
    double least = 1.0;
    for (std::size_t i = 0; i < u.size(); ++i) {
      const double step = side * fit.axes(static_cast<Eigen::Index>(i), axis);
      if (step > 0.0) least = std::min(least, (1.0 - u[i]) / step);
      if (step < 0.0) least = std::min(least, u[i] / -step);
    }
    return least;
  };
  constexpr double kLeast = 0.01;  // share of a deviation: least step even if a variable lies on
                                   // its bound
  const double up = room(1.0), down = room(-1.0);
  const double step = up >= down ? std::max(up, kLeast) : -std::max(down, kLeast);
  auto place = u;
  for (std::size_t i = 0; i < u.size(); ++i)
    place[i] += step * fit.axes(static_cast<Eigen::Index>(i), axis);
  MovedModel moved{numbers, 1.0 / std::abs(step)};
  move_to(source, place, moved.numbers);
  return moved;
}

std::vector<MovedModel> along_directions(const ModelComparisonFile& file,
                                         const ComparedModel& model,
                                         const std::vector<FitPosterior>& fits) {
  std::vector<MovedModel> all;
  for (const Uncertainty& number : file.uncertainties) {
    if (!has(model.numbers, number.paths)) continue;
    all.push_back({model.numbers});
    move_typed(number, 1.0, all.back().numbers);
  }
  for (const std::size_t k : model.fits)
    for (Eigen::Index axis = 0; axis < fits[k].axes.cols(); ++axis)
      all.push_back(moved_along(file.fits[k], fits[k], axis, model.numbers));
  return all;
}

/// Models that share a fit share its random draws.
MovedModel drawn(const ModelComparisonFile& file,
                 const ComparedModel& model,
                 const std::vector<FitPosterior>& fits,
                 int number) {
  RandomStream random(static_cast<std::uint64_t>(file.band_seed),
                      static_cast<std::uint64_t>(number));
  MovedModel moved{model.numbers};
  for (const Uncertainty& one : file.uncertainties) move_typed(one, random.normal(), moved.numbers);
  for (std::size_t k = 0; k < fits.size(); ++k) {
    Eigen::VectorXd place(fits[k].axes.cols());
    for (double& value : place) value = random.normal();
    if (std::find(model.fits.begin(), model.fits.end(), k) == model.fits.end()) continue;
    const Eigen::VectorXd offset = fits[k].axes * place;
    auto u = file.fits[k].study->space.to_unit(fits[k].point);
    for (std::size_t i = 0; i < u.size(); ++i) u[i] += offset[static_cast<Eigen::Index>(i)];
    move_to(file.fits[k], u, moved.numbers);
  }
  return moved;
}

/// Returns the moved models that are run for the bands; empty if nothing of the model is uncertain.
std::vector<MovedModel> band_models(const ModelComparisonFile& file,
                                    const ComparedModel& model,
                                    const std::vector<FitPosterior>& fits) {
  auto all = along_directions(file, model, fits);
  if (file.samples == 0 || all.empty()) return all;
  all.clear();
  for (int k = 0; k < file.samples; ++k) all.push_back(drawn(file, model, fits, k));
  return all;
}

/// Returns z such that a normal number lies within ±z with that probability, by bisection.
double normal_bound(double level) {
  double low = 0.0, high = 10.0;
  for (int i = 0; i < 60; ++i) {
    const double z = 0.5 * (low + high);
    (std::erf(z / std::sqrt(2.0)) < level ? low : high) = z;
  }
  return low;
}

double quantile(std::vector<double> values, double p) {
  std::sort(values.begin(), values.end());
  const double at = p * static_cast<double>(values.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(at), values.size() - 2);
  return values[i] + (at - static_cast<double>(i)) * (values[i + 1] - values[i]);
}

/// Spectra of a moved model, by channel.
struct MovedDensities {
  std::vector<numerics::Density> densities;
  double count = 1.0;  // copied from MovedModel::count
};

/// Half widths of a line's logarithm, downward and upward.
struct LogReach {
  double down = 0.0, up = 0.0;  // >= 0
};

LogReach reach_of(const ModelComparisonFile& file,
                  const std::vector<MovedDensities>& others,
                  double S,
                  std::size_t channel,
                  std::size_t line,
                  double z) {
  if (file.samples == 0) {
    double sum = 0.0;
    for (const MovedDensities& other : others)
      sum += std::pow(other.count * std::log(other.densities[channel].value[line] / S), 2);
    return {z * std::sqrt(sum), z * std::sqrt(sum)};
  }
  if (others.size() < 2) return {};
  std::vector<double> values;
  for (const MovedDensities& other : others) values.push_back(other.densities[channel].value[line]);
  return {std::max(0.0, std::log(S / quantile(values, 0.5 - 0.5 * file.level))),
          std::max(0.0, std::log(quantile(values, 0.5 + 0.5 * file.level) / S))};
}

/// Returns the variance of the logarithm that the fits' own spectra leave unexplained.
double unexplained(const ComparedModel& model, const std::vector<FitPosterior>& fits, double f) {
  double sum = 0.0;
  for (const std::size_t k : model.fits) sum += std::pow(fits[k].discrepancy.at(f), 2);
  return sum;
}

void add_bands(const ModelComparisonFile& file,
               const ComparedModel& model,
               const std::vector<FitPosterior>& fits,
               const std::vector<MovedDensities>& others,
               ModelRun& run) {
  if (others.empty()) return;
  const double z = normal_bound(file.level);
  for (std::size_t c = 0; c < run.densities.size(); ++c) {
    const auto& [frequency, S] = run.densities[c];
    std::vector<double> lower(S.size()), upper(S.size());
    for (std::size_t k = 0; k < S.size(); ++k) {
      const LogReach reach = reach_of(file, others, S[k], c, k, z);
      const double missing = z * std::sqrt(unexplained(model, fits, frequency[k]));
      lower[k] = S[k] * std::exp(-std::hypot(reach.down, missing));
      upper[k] = S[k] * std::exp(std::hypot(reach.up, missing));
    }
    run.lower.push_back(std::move(lower));
    run.upper.push_back(std::move(upper));
  }
}

/// True if a measured line lies in the band widened by noise.
bool holds(
    double measured, double S, double lower, double upper, const LineNoise& noise, double z) {
  const double M = S + noise.density, share = S / M;  // ratio of d ln M to d ln S
  const double off = std::log(measured / M);
  const double down = std::hypot(share * std::log(S / lower), noise.log_quantile(S, -z));
  const double up = std::hypot(share * std::log(upper / S), noise.log_quantile(S, z));
  return off >= -down && off <= up;
}

void compare_run(const ModelComparisonFile& file, const CaseComparison& compared, ModelRun& run) {
  const auto& reference = compared.reference;
  const double z = normal_bound(file.level);
  for (const NamedBand& band : file.bands) {
    run.distance.emplace_back();
    run.decibels.emplace_back();
    for (std::size_t c = 0; c < reference.size(); ++c) {
      run.distance.back().push_back(psd_distance(run.densities[c], reference[c], band.band));
      run.decibels.back().push_back(
          log_spectral_distance(run.densities[c], reference[c], band.band));
    }
  }
  for (std::size_t c = 0; c < run.lower.size(); ++c) {
    int lines = 0, inside = 0;
    double reach = 0.0;
    for (std::size_t k = 0; k < reference[c].value.size(); ++k) {
      if (!is_in(reference[c].frequency[k], file.bands[0].band)) continue;
      ++lines;
      reach += 0.5 * std::log(run.upper[c][k] / run.lower[c][k]);
      inside += holds(reference[c].value[k],
                      run.densities[c].value[k],
                      run.lower[c][k],
                      run.upper[c][k],
                      compared.noise[c],
                      z);
    }
    run.coverage.push_back(static_cast<double>(inside) / lines);
    run.reach.push_back(reach / lines);
  }
}

ModelRun run_model(const ModelComparisonFile& file,
                   const ComparedModel& model,
                   const experiment::Test& test,
                   const ComparedCase& one,
                   const std::vector<FitPosterior>& fits,
                   const CaseComparison& compared) {
  const auto& reference = compared.reference;
  ModelRun run;
  const double begin = cpu_seconds();
  const Channels channels = run_of(model, model.numbers, test, one.name, &run.limits);
  run.cpu = cpu_seconds() - begin;
  run.densities = densities_of(file, channels, model.title);
  for (std::size_t c = 0; c < reference.size(); ++c)
    if (run.densities[c].value.size() != reference[c].value.size() ||
        std::abs(run.densities[c].frequency.back() - reference[c].frequency.back()) > 1e-3)
      throw InputError({file.file.string(), 0},
                       fmt::format("{} in {} is not sampled like the reference: expected the same "
                                   "sample_step, run_in and duration in both tests",
                                   model.title,
                                   one.name));
  for (const std::string& name : file.told)
    run.told.push_back(channels.find(name) ? mean(counted(file, channels, name, model.title))
                                           : std::nan(""));
  std::vector<MovedDensities> others;
  int beyond = 0, count = 0;
  for (const MovedModel& moved : band_models(file, model, fits)) {
    std::vector<std::string> limits;
    others.push_back(
        {densities_of(file, run_of(model, moved.numbers, test, one.name, &limits), model.title),
         moved.count});
    ++count;
    if (limits.size() > run.limits.size()) ++beyond;
  }
  if (beyond > 0)
    run.limits.push_back(fmt::format(
        "{} of {} models moved for the bands met limits that the model itself did not, ranges of "
        "its file or the loss of the road: the bands are too narrow there",
        beyond,
        count));
  add_bands(file, model, fits, others, run);
  compare_run(file, compared, run);
  return run;
}

/// Calls work(0) ... work(count - 1), distributed over this number of threads, and rethrows the
/// first exception.
void share_out(std::size_t count, int threads, const std::function<void(std::size_t)>& work) {
  std::atomic<std::size_t> next{0};
  std::mutex guard;
  std::exception_ptr trouble;
  const auto take = [&] {
    for (std::size_t i = next++; i < count; i = next++) {
      try {
        work(i);
      } catch (...) {
        const std::lock_guard lock(guard);
        if (!trouble) trouble = std::current_exception();
        next = count;
      }
    }
  };
  std::vector<std::thread> others;
  for (int t = 1; t < threads; ++t) others.emplace_back(take);
  take();
  for (std::thread& other : others) other.join();
  if (trouble) std::rethrow_exception(trouble);
}

}  // namespace

std::vector<std::string> limits_of_models(const ModelComparisonFile& file,
                                          const ModelComparison& comparison) {
  LimitsByName limits;
  for (std::size_t i = 0; i < file.cases.size(); ++i)
    for (const std::string& limit : comparison.cases[i].limits_of_reference)
      limits.add(file.reference.title + ": " + limit, file.cases[i].name);
  for (std::size_t m = 0; m < file.models.size(); ++m)
    for (std::size_t i = 0; i < file.cases.size(); ++i)
      for (const std::string& limit : comparison.cases[i].models[m].limits)
        limits.add(file.models[m].title + ": " + limit, file.cases[i].name);
  return limits.before_names();
}

double ModelRun::mean_distance(std::size_t band) const { return mean(distance[band]); }
double ModelRun::mean_decibels(std::size_t band) const { return mean(decibels[band]); }

double LineNoise::log_quantile(double S, double z) const {
  if (density == 0.0) return 0.0;
  const double M = S + density;
  const double h = 2.0 * segments * M * M / (2.0 * S * density + density * density);
  return std::log(numerics::chi_square_at(z, h) / h);
}

double psd_distance(const numerics::Density& a, const numerics::Density& b, FrequencyBand band) {
  double difference = 0.0, all = 0.0;
  for (std::size_t k = 0; k < b.value.size(); ++k) {
    if (!is_in(b.frequency[k], band)) continue;
    difference += std::pow(a.value[k] - b.value[k], 2);
    all += std::pow(b.value[k], 2);
  }
  return std::sqrt(difference / all);
}

Channels record_reference(const ModelComparisonFile& file,
                          std::size_t index,
                          const experiment::Language& language,
                          std::vector<std::string>* limits) {
  const ComparedCase& one = file.cases[index];
  const auto test =
      read_case(one.reference_test, file.tests[one.test].reference_folder, language, nullptr);
  const Channels clean = run_of(file.reference, file.reference.numbers, *test, one.name, limits);
  for (const auto& [name, deviation] : file.noise)
    if (!clean.find(name))
      throw InputError({file.file.string(), 0},
                       "reference.noise." + name +
                           " is of a channel that the reference does not record; expected one of "
                           "the compared channels");
  Channels noisy;
  std::uint64_t number = 64 * index;  // random stream, different for each channel of each case
  for (Channel channel : clean.all()) {
    RandomStream random(static_cast<std::uint64_t>(file.seed), number++);
    if (const auto noise = file.noise.find(channel.name); noise != file.noise.end())
      for (double& value : channel.values) value += noise->second * random.normal();
    noisy.add(std::move(channel));
  }
  return noisy;
}

Channels kept_of(const ModelComparisonFile& file, const Channels& all) {
  std::vector<std::string> names = {"time"};
  names.insert(names.end(), file.channels.begin(), file.channels.end());
  names.insert(names.end(), file.recorded.begin(), file.recorded.end());
  Channels kept;
  for (const std::string& name : names) {
    const Channel* channel = all.find(name);
    if (!channel)
      throw InputError({file.file.string(), 0}, "the reference does not record " + in_quotes(name));
    if (!kept.find(name)) kept.add(*channel);
  }
  return kept;
}

Channels reference_of(const ModelComparisonFile& file,
                      std::size_t index,
                      const experiment::Language& language,
                      std::vector<std::string>* limits) {
  const std::size_t source = file.find_case(file.cases[index].recording);
  if (file.recordings.empty())
    return kept_of(file, record_reference(file, source, language, limits));
  const auto table = formats::CsvTable::read(file.recordings / (file.cases[source].name + ".csv"));
  return table.channels();
}

namespace {

/// Sets the models to the best points of their fits.
ModelComparisonFile at_fits(ModelComparisonFile file, const std::vector<FitPosterior>& fits) {
  for (ComparedModel& model : file.models) {
    for (const std::size_t k : model.fits)
      move_to(file.fits[k], file.fits[k].study->space.to_unit(fits[k].point), model.numbers);
    model.kind->check(model.numbers);
  }
  return file;
}

}  // namespace

ModelComparison compare_models(const ModelComparisonFile& as_written,
                               const experiment::Language& language,
                               int threads,
                               const std::function<void(long, long)>& tell) {
  ModelComparison all;
  for (const FitSource& source : as_written.fits)
    all.fits.push_back(fit_posterior(source, as_written.segment));
  const ModelComparisonFile file = at_fits(as_written, all.fits);
  const std::size_t count = file.cases.size();
  all.cases.resize(count);
  std::vector<std::unique_ptr<experiment::Test>> tests(count);
  share_out(count, threads, [&](std::size_t i) {
    const Channels recording = reference_of(file, i, language, &all.cases[i].limits_of_reference);
    all.cases[i].reference = densities_of(file, recording, file.reference.title);
    check_power(file, all.cases[i].reference);
    all.cases[i].noise = noise_of(file, recording);
    all.cases[i].models.resize(file.models.size());
    const Channels conditions = low_passed(file, recording);
    tests[i] = read_case(
        file.cases[i].model_test, file.tests[file.cases[i].test].folder, language, &conditions);
  });
  check_told(file, tests);
  std::mutex guard;
  long done = 0;
  const std::size_t runs = count * file.models.size();
  share_out(runs, threads, [&](std::size_t k) {
    const std::size_t i = k / file.models.size(), m = k % file.models.size();
    all.cases[i].models[m] =
        run_model(file, file.models[m], *tests[i], file.cases[i], all.fits, all.cases[i]);
    const std::lock_guard lock(guard);
    if (tell) tell(++done, static_cast<long>(runs));
  });
  if (file.pictures) {
    const auto [model, index] = *file.pictures;
    const ComparedModel& shown = file.models[model];
    auto details = tests[index]->details(*shown.kind->build(shown.numbers));
    if (!details) throw std::runtime_error(details.failure().reason);
    all.pictures = std::move(details->pictures);
  }
  return all;
}

}  // namespace latsch::correlation
