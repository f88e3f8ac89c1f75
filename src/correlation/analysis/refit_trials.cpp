// SPDX-License-Identifier: Apache-2.0
#include "correlation/analysis/refit_trials.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "correlation/target/residuals.h"
#include "correlation/target/study_trials.h"
#include "evaluation/trial/encoding.h"
#include "optimization/problem/point_vector.h"

namespace latsch::correlation {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr const char* kUseless =
    "the trial cannot be compared with the measurements, or brings no derivatives there";

std::string name_of(const Linearization& at, const RowGroups& groups) {
  const auto bytes = [](const auto& numbers) {
    return std::string_view(reinterpret_cast<const char*>(numbers.data()),
                            static_cast<std::size_t>(numbers.size()) * sizeof(numbers.data()[0]));
  };
  std::uint64_t all = hash(bytes(at.J), hash(bytes(at.r)));
  for (const auto& group : groups) all = hash(bytes(group), hash("group", all));
  return fmt::format("reduced residuals {:016x}", all);
}

std::unique_ptr<Journal> opened(const Journal& journal, bool writes) {
  const auto file = RefitTrials::file(journal.file());
  const StudyIdentity& identity = journal.identity();
  if (!writes) {
    if (!std::filesystem::exists(file)) return nullptr;
    auto kept = std::make_unique<Journal>(Journal::read(file));
    return kept->identity() == identity ? std::move(kept) : nullptr;
  }
  if (std::filesystem::exists(file) && Journal::read(file).identity() != identity) {
    // files that SQLite leaves after a kill
    for (const char* part : {"", "-wal", "-shm", "-journal"})
      std::filesystem::remove(file.string() + part);
  }
  return std::make_unique<Journal>(Journal::open(file, identity));
}

/// Calls `visit` for the entries of [J r] of reduced rows that are not zero by construction, row by
/// row, with row and column (n for the column r). These are the entries of a triangular factor on
/// and above its diagonal, and all entries of a group that has no more than n + 1 rows.
void for_each_entry(const RowGroups& groups,
                    Eigen::Index n,
                    const std::function<void(Eigen::Index, Eigen::Index)>& visit) {
  Eigen::Index row = 0;
  for (const auto& group : groups) {
    const bool is_triangular = std::ssize(group) > n + 1;
    const Eigen::Index count = std::min<Eigen::Index>(std::ssize(group), n + 1);
    for (Eigen::Index i = 0; i < count; ++i, ++row)
      for (Eigen::Index j = is_triangular ? i : 0; j <= n; ++j) visit(row, j);
  }
}

Score score_of(const Evaluated& rows) {
  Score score;
  score.residuals.assign(rows.r.begin(), rows.r.end());
  score.jacobian.resize(static_cast<std::size_t>(rows.J.size()));
  Eigen::Map<RowMajor>(score.jacobian.data(), rows.J.rows(), rows.J.cols()) = rows.J;
  score.value = rows.r.squaredNorm();
  return score;
}

}  // namespace

RefitTrials::RefitTrials(const Study& study,
                         const Journal& journal,
                         RowGroups groups,
                         const Linearization& at,
                         Journal* better)
    : study_(study),
      journal_(journal),
      better_(better),
      residuals_(residual_objective(study)),
      target_(correlation::objective(study)),
      groups_(std::move(groups)),
      variables_(at.J.cols()),
      name_(name_of(at, groups_)),
      kept_(opened(journal, better != nullptr)) {
  if (better_) best_ = best_trial(study, journal);
}

std::filesystem::path RefitTrials::file(const std::filesystem::path& journal) {
  return journal.string() + ".refits";
}

Objective RefitTrials::objective() const {
  return Objective([this](const DesignPoint& point,
                          const Channels& channels) { return reduced(point, channels); },
                   /*needs_slopes=*/true);
}

std::size_t RefitTrials::packed_size() const {
  std::size_t size = 0;
  for_each_entry(groups_, variables_, [&](Eigen::Index, Eigen::Index) { ++size; });
  return size;
}

std::vector<double> RefitTrials::packed(const Evaluated& rows) const {
  std::vector<double> numbers;
  for_each_entry(groups_, variables_, [&](Eigen::Index i, Eigen::Index j) {
    numbers.push_back(j < variables_ ? rows.J(i, j) : rows.r[i]);
  });
  return numbers;
}

/// Returns the reduced rows that the numbers encode; nullopt if their count is wrong, as for a
/// trial that a refit cannot use.
std::optional<Evaluated> RefitTrials::unpacked(const std::vector<double>& numbers) const {
  if (numbers.size() != packed_size()) return std::nullopt;
  const auto rows = std::ssize(groups_of_reduced_rows(groups_, variables_));
  Evaluated all(Eigen::VectorXd(rows), Eigen::MatrixXd::Zero(rows, variables_));
  std::size_t next = 0;
  for_each_entry(groups_, variables_, [&](Eigen::Index i, Eigen::Index j) {
    (j < variables_ ? all.J(i, j) : all.r[i]) = numbers[next++];
  });
  return all;
}

/// A full recording and its stored reduced form give the same bits.
Result<Score> RefitTrials::reduced(const DesignPoint& point, const Channels& channels) const {
  if (const Channel* kept = channels.find(name_)) {
    const auto rows = unpacked(kept->values);
    if (!rows) return Failure{kUseless};
    return score_of(*rows);
  }
  const Result<Score> whole = residuals_(point, channels);
  if (!whole) return whole;
  const auto m = std::ssize(whole->residuals);
  if (std::ssize(whole->jacobian) != m * variables_) return Failure{kUseless};
  const Eigen::Map<const RowMajor> J(whole->jacobian.data(), m, variables_);
  return score_of(reduced_rows(Evaluated(to_vector(whole->residuals), J), groups_));
}

bool RefitTrials::is_best(const Trial& trial) {
  if (!trial.outcome.result || !study_.space.contains(trial.point)) return false;
  const auto score = target_(trial.point, *trial.outcome.result);
  if (!score || !std::isfinite(score->value)) return false;
  RatedTrial rated{trial.point, score->value, violation(*score)};
  if (best_ && !is_better(rated, *best_)) return false;
  best_ = std::move(rated);
  return true;
}

void RefitTrials::append(std::span<const Trial> trials) {
  std::vector<Trial> small;
  for (const Trial& trial : trials) {
    if (!is_best(trial)) {
      small.push_back(trial);
      continue;
    }
    better_->append(trial);
    better_->keep_asked({trial.point.bits()});
  }
  for (Trial& trial : small) {
    if (!trial.outcome.result) continue;
    const Result<Score> score = reduced(trial.point, *trial.outcome.result);
    Channel channel{name_, "1", {}};  // stays empty if a refit cannot use the trial
    if (score) {
      const Eigen::Map<const RowMajor> J(
          score->jacobian.data(), std::ssize(score->residuals), variables_);
      channel.values = packed(Evaluated(to_vector(score->residuals), J));
    }
    Channels only;
    only.add(std::move(channel));
    trial.outcome.result = std::move(only);
  }
  kept_->append(small);
}

void RefitTrials::for_each(const std::function<void(const Trial&)>& visit) const {
  journal_.for_each([&](const Trial& trial) {
    if (!trial.outcome.result || trial.outcome.result->has_slopes()) visit(trial);
  });
  if (!kept_) return;
  try {
    kept_->for_each([&](const Trial& trial) {
      if (!trial.outcome.result || trial.outcome.result->find(name_)) visit(trial);
    });
  } catch (const JournalError& error) {
    throw JournalError(
        fmt::format("{}. It only saves latsch identify some trials: delete {} and identify again",
                    error.what(),
                    kept_->file().string()));
  }
}

long refit_trial_count(const Journal& journal) {
  const auto kept = opened(journal, /*writes=*/false);
  return kept ? kept->size() : 0;
}

}  // namespace latsch::correlation
