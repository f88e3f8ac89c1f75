// SPDX-License-Identifier: Apache-2.0
// Computes the filter from the dummy rim to the real one and its benefit in every case.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "correlation/rig_data/rig_processing.h"
#include "measurement/band_level.h"
#include "measurement/bootstrap.h"
#include "numerics/signals/time_delay.h"

namespace latsch::correlation {
namespace {

std::vector<double> without_mean(std::vector<double> x) {
  const double level = std::accumulate(x.begin(), x.end(), 0.0) / static_cast<double>(x.size());
  for (double& value : x) value -= level;
  return x;
}

const ProcessedPlateau& plateau_of(const std::vector<ProcessedRun>& runs, int run, int speed) {
  return runs[run].plateaus[speed];
}

/// Cuts both averages to the length of the shorter, because speeds differ a little from run to run.
RimPair same_length(std::vector<double> dummy, std::vector<double> real) {
  const std::size_t length = std::min(dummy.size(), real.size());
  dummy.resize(length);
  real.resize(length);
  return {without_mean(std::move(dummy)), without_mean(std::move(real))};
}

void check_rates(const std::vector<ProcessedRun>& runs) {
  constexpr double kSame = 1e-6;
  for (const ProcessedRun& run : runs) {
    const double rate = runs[0].record.rate;
    if (std::abs(run.record.rate - rate) > kSame * rate) {
      throw InputError(
          {run.record.source, 0},
          fmt::format("is sampled at {:g} Hz and {} at {:g} Hz, expected the same rate "
                      "for a compensation",
                      run.record.rate,
                      runs[0].record.source,
                      rate));
    }
  }
}

/// Passages of the rims of every fitted case, of one length within a case.
struct FitPassages {
  std::vector<std::vector<double>> dummy, real;
};

std::vector<FitPassages> fit_passages(const RigFile& rig, const std::vector<ProcessedRun>& runs) {
  std::vector<FitPassages> all;
  for (const int k : rig.compensation->fit) {
    const RigCase& one = rig.cases[k];
    const auto rows = [&](int run) {
      const ProcessedPlateau& p = plateau_of(runs, run, one.speed);
      return cut(runs[run].record.channel(rig.force).subspan(p.plateau.first, p.plateau.samples()),
                 p.passages);
    };
    all.push_back({rows(one.dummy), rows(one.real)});
  }
  return all;
}

/// Returns the averages of all passages, or of resampled ones: `chosen` holds for each passage in
/// turn the index of the passage that replaces it.
std::vector<RimPair> averages(const std::vector<FitPassages>& cases,
                              const std::vector<int>* chosen) {
  std::size_t next = 0;
  const auto mean = [&](const std::vector<std::vector<double>>& rows) {
    std::vector<int> own(rows.size());
    for (std::size_t k = 0; k < own.size(); ++k) {
      own[k] = chosen ? static_cast<int>((*chosen)[next] * rows.size() / chosen->size())
                      : static_cast<int>(k);
      ++next;
    }
    return mean_of(rows, own);
  };
  std::vector<RimPair> pairs;
  for (const FitPassages& one : cases) {
    auto dummy = mean(one.dummy);
    pairs.push_back(same_length(std::move(dummy), mean(one.real)));
  }
  return pairs;
}

RigResponse start_of(const RigFile& rig, const std::optional<HammerResult>& hammer) {
  // A response that the rig file states is used as the response of the rig, with or without a
  // hammer test.
  const RigResponse of_rig = hammer ? hammer->fit.response : *rig.compensation->start;
  const auto back = inverse(of_rig);
  if (!back) {
    throw InputError({rig.file.string(), 0},
                     fmt::format("the rig's response with A/f^2 = {:.4g} and c = {:.4g} has no "
                                 "inverse to start from: give a start by hand in [compensation] "
                                 "or fit another band",
                                 of_rig.gain(),
                                 of_rig.c));
  }
  return *back;
}

void fit_filter(const RigFile& rig,
                const std::vector<ProcessedRun>& runs,
                const std::optional<HammerResult>& hammer,
                CompensationResult& result) {
  const double rate = runs[0].record.rate;
  const auto cases = fit_passages(rig, runs);
  result.fit = fit_to_rims(averages(cases, nullptr), rate, rig.band, start_of(rig, hammer));
  result.filter_response = result.fit->response;
  int hits = 0;
  for (const auto& one : cases) hits += static_cast<int>(one.dummy.size() + one.real.size());
  if (rig.compensation->bootstrap > 0) {
    const auto d = bootstrap_deviation(
        hits, rig.compensation->bootstrap, 2, [&](const std::vector<int>& chosen) {
          const auto r =
              fit_to_rims(averages(cases, &chosen), rate, rig.band, result.filter_response)
                  .response;
          return std::vector<double>{r.gain(), r.f, r.zeta, r.c};
        });
    result.over_hits = {d[0], d[1], d[2], d[3]};
  }
}

numerics::RationalFilter checked(const RigFile& rig, Result<numerics::RationalFilter> filter) {
  if (filter) return *filter;
  throw InputError({rig.file.string(), 0}, "compensation: " + filter.failure().reason);
}

/// Returns the difference of two averages without their means. `other` is first shifted onto
/// `real`: a few segments of a passage see a hit through the slope of their windows, so a delay
/// changes the density.
RimDifference difference(const RigFile& rig,
                         double rate,
                         const std::vector<double>& real,
                         const numerics::Density& real_density,
                         std::vector<double>& other,
                         numerics::Density& density) {
  const int length = static_cast<int>(real.size());
  const auto delay = numerics::delay_between(other, real, -length / 4, length / 4);
  other = numerics::shifted(other, delay.samples);
  density = density_of(rig, other, rate);
  RimDifference d;
  for (int i = 0; i < length; ++i) d.time += std::pow(other[i] - real[i], 2) / length;
  d.time = std::sqrt(d.time);
  int lines = 0;
  for (std::size_t k = 0; k < density.value.size(); ++k) {
    const double f = density.frequency[k];
    if (f < rig.band.lower || f > rig.band.upper) continue;
    d.psd += std::pow(density.value[k] - real_density.value[k], 2);
    ++lines;
  }
  d.psd = std::sqrt(d.psd / std::max(1, lines));
  d.level = log_spectral_distance(density, real_density, rig.band);
  return d;
}

CaseRow case_row(const RigFile& rig,
                 const RigCase& one,
                 const std::vector<ProcessedRun>& runs,
                 const std::vector<double>& filtered) {
  const ProcessedPlateau& dummy = plateau_of(runs, one.dummy, one.speed);
  const ProcessedPlateau& real = plateau_of(runs, one.real, one.speed);
  const double rate = runs[one.dummy].record.rate;
  const auto part =
      std::span<const double>(filtered).subspan(dummy.plateau.first, dummy.plateau.samples());
  const RimPair before = same_length(dummy.force(), real.force());
  const RimPair after = same_length(average(cut(part, dummy.passages)).mean, real.force());
  CaseRow row;
  row.name = one.name;
  row.speed = rig.speeds[one.speed];
  row.real = before.real;
  row.before = before.dummy;
  row.after = after.dummy;
  row.real_density = density_of(rig, row.real, rate);
  row.dummy = difference(rig, rate, row.real, row.real_density, row.before, row.before_density);
  row.filtered = difference(rig, rate, row.real, row.real_density, row.after, row.after_density);
  return row;
}

}  // namespace

std::vector<double> filtered_force(const numerics::RationalFilter& filter,
                                   std::span<const double> force) {
  const double level =
      std::accumulate(force.begin(), force.end(), 0.0) / static_cast<double>(force.size());
  std::vector<double> x(force.begin(), force.end());
  for (double& value : x) value -= level;
  auto state = numerics::steady_state(filter);
  for (double& z : state) z *= x.front();
  x = numerics::filter(filter, x, state);
  for (double& value : x) value += level;
  return x;
}

CompensationResult compensate(const RigFile& rig,
                              const std::vector<ProcessedRun>& runs,
                              const std::optional<HammerResult>& hammer) {
  check_rates(runs);
  const double rate = runs[0].record.rate;
  CompensationResult result;
  if (!rig.compensation->fit.empty()) {
    fit_filter(rig, runs, hammer, result);
    result.filter = checked(rig, filter_of(result.filter_response, rate));
  } else {
    const RigResponse of_rig = hammer ? hammer->fit.response : *rig.compensation->start;
    result.filter = checked(rig, inverse_filter(of_rig, rate, rig.compensation->low_pass));
    result.filter_response = inverse(of_rig).value_or(RigResponse{});
  }
  std::vector<std::vector<double>> filtered(runs.size());
  for (std::size_t k = 0; k < rig.cases.size(); ++k) {
    const RigCase& one = rig.cases[k];
    auto& force = filtered[one.dummy];
    if (force.empty()) {
      force = filtered_force(result.filter, runs[one.dummy].record.channel(rig.force));
    }
    result.cases.push_back(case_row(rig, one, runs, force));
    const auto& fit = rig.compensation->fit;
    result.cases.back().fitted =
        std::find(fit.begin(), fit.end(), static_cast<int>(k)) != fit.end();
  }
  return result;
}

}  // namespace latsch::correlation
