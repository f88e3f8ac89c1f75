// SPDX-License-Identifier: Apache-2.0
#include "correlation/search/study_search.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <span>
#include <utility>

#include "correlation/doe/doe_basins.h"
#include "correlation/search/study_method.h"
#include "correlation/target/study_trials.h"
#include "correlation/target/trial_ownership.h"
#include "evaluation/schedule/retried_failures.h"
#include "optimization/design/basins.h"
#include "optimization/problem/point_vector.h"
#include "optimization/strategy/multi_start.h"

namespace latsch::correlation {
namespace {

constexpr const char* kMark = "start";
constexpr int kModels = 2;  // number of quadratic models that the points passed to a run determine
// limit for the number of points: the time to find neighbors grows with its square
constexpr int kMostScattered = 5000;

/// Numbers of trials and marks in a journal when a search began.
struct KnownAtStart {
  long trials = 0;
  std::size_t marks = 0;
};

struct Known {
  DesignPoint point;
  Result<Score> outcome;
};

/// Returns the last outcome of every point inside the bounds, in an order that does not depend on
/// that in the journal. Only trials before `at_start` count, and only if the marks before it show
/// that a search or a design requested them: a resumed search has requested further points that
/// were not known at its start.
std::vector<Known> known_points(const Study& study,
                                const Journal& journal,
                                const KnownAtStart& at_start) {
  const Objective target = objective(study);
  std::map<std::string, Known> known;
  const std::span marks(journal.marks());
  const AskedTrials asked(marks.first(at_start.marks));
  TrialsThatCount(journal, at_start.trials, asked).for_each([&](const Trial& trial) {
    if (!study.space.contains(trial.point)) return;
    const auto& result = trial.outcome.result;
    Result<Score> score = result ? target(trial.point, *result) : Result<Score>(result.failure());
    if (score && !std::isfinite(score->value)) score = Failure{"the target is not finite"};
    known.insert_or_assign(trial.point.bits(), Known{trial.point, std::move(score)});
  });
  std::vector<Known> all;
  for (auto& [bits, point] : known) all.push_back(std::move(point));
  return all;
}

Eigen::VectorXd unit(const DesignSpace& space, const DesignPoint& point) {
  return to_vector(space.to_unit(point));
}

/// Returns the indices of the best point and, if there are several starts, of the other minima
/// among scattered points.
std::vector<std::size_t> minima(const DesignSpace& space,
                                const std::vector<Known>& known,
                                int count) {
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (known[i].outcome) places.push_back(i);
  }
  std::stable_sort(places.begin(), places.end(), [&](std::size_t a, std::size_t b) {
    return is_better(*known[a].outcome, *known[b].outcome);
  });
  if (count == 1 || places.size() < 2) {
    places.resize(std::min<std::size_t>(places.size(), 1));
    return places;
  }
  places.resize(std::min<std::size_t>(places.size(), kMostScattered));
  std::vector<Eigen::VectorXd> points;
  std::vector<double> values;
  for (const std::size_t i : places) {
    points.push_back(unit(space, known[i].point));
    values.push_back(known[i].outcome->value);
  }
  const auto basins = find_basins(values, nearest_neighbors(points, 2 * space.size() + 2));
  std::vector<std::size_t> lowest;
  for (const Basin& basin : basins) {
    if (std::ssize(lowest) < count) lowest.push_back(places[basin.lowest]);
  }
  return lowest;
}

std::vector<DesignPoint> starts_in_journal(const Study& study, const std::vector<Known>& known) {
  std::vector<DesignPoint> starts;
  for (const std::size_t i : minima(study.space, known, study.start.starts)) {
    starts.push_back(known[i].point);
  }
  return starts;
}

/// Returns only the known points that belong to the design.
std::vector<Known> of_design(const Study& study, std::vector<Known> known) {
  std::set<std::string> planned;
  for (const DesignPoint& point : plan(*study.doe, study.space).points) {
    planned.insert(point.bits());
  }
  std::erase_if(known, [&](const Known& k) { return !planned.contains(k.point.bits()); });
  return known;
}

std::vector<DesignPoint> starts_in_design(const Study& study, const std::vector<Known>& known) {
  std::vector<RatedTrial> rated;
  for (const Known& k : known) {
    if (k.outcome) rated.push_back({k.point, k.outcome->value, violation(*k.outcome)});
  }
  std::vector<DesignPoint> starts;
  if (const auto found = doe_basins(study, *study.doe, rated)) {
    for (const DoeBasin& basin : found->basins) {
      if (std::ssize(starts) < study.start.starts) starts.push_back(basin.lowest);
    }
    return starts;
  }
  return starts_in_journal(study, known);  // too many points of the design have failed
}

/// Passes to the optimizer only the start and the points near it.
void tell(Optimizer& optimizer,
          const DesignSpace& space,
          const std::vector<Known>& known,
          bool is_one_of_several) {
  const DesignPoint start = space.initial();
  const Eigen::VectorXd u = unit(space, start);
  const auto at =
      std::find_if(known.begin(), known.end(), [&](const Known& k) { return k.point == start; });
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (known[i].point == start) continue;
    const bool is_lower = is_one_of_several && at != known.end() && at->outcome &&
                          known[i].outcome && is_better(*known[i].outcome, *at->outcome);
    if (!is_lower) order.push_back({(unit(space, known[i].point) - u).norm(), i});
  }
  std::sort(order.begin(), order.end());
  const std::size_t n = static_cast<std::size_t>(space.size());
  order.resize(std::min(order.size(), kModels * ((n + 1) * (n + 2) / 2 + n)));
  std::reverse(order.begin(), order.end());  // the point nearest to the start comes last
  for (const auto& [distance, i] : order) optimizer.observe(known[i].point, known[i].outcome);
}

std::unique_ptr<Optimizer> optimizer_knowing(const Study& study, std::vector<Known> known) {
  const bool by_design = study.start.from == StartSettings::From::basins;
  if (by_design) known = of_design(study, std::move(known));
  std::vector<DesignPoint> starts =
      by_design ? starts_in_design(study, known) : starts_in_journal(study, known);
  if (starts.empty()) starts.push_back(study.space.initial());
  const bool several = starts.size() > 1;
  return std::make_unique<MultiStart>(
      study.space, starts, [study, known, several](const DesignSpace& space) {
        Study at_start = study;
        at_start.space = space;
        auto optimizer = make_optimizer(at_start);
        tell(*optimizer, space, known, several);
        return optimizer;
      });
}

/// Returns nullopt if this search has not begun.
std::optional<KnownAtStart> known_at_start(const Study& study, const Journal& journal) {
  const auto& marks = journal.marks();
  for (std::size_t i = 0; i < marks.size(); ++i) {
    if (marks[i].kind == kMark && marks[i].text == study.search_key) {
      return KnownAtStart{marks[i].trials, i};
    }
  }
  return std::nullopt;
}

void take_over(const Study& study, Journal& journal) {
  const Journal other = Journal::read(study.start.journal, identity(study));
  std::set<std::string> known;
  journal.for_each([&](const Trial& trial) { known.insert(trial.point.bits()); });
  std::vector<Trial> more;
  std::set<std::string> asked;
  other.for_each_asked([&](const Trial& trial) {
    if (known.insert(trial.point.bits()).second) more.push_back(trial);
    asked.insert(trial.point.bits());
  });
  if (more.empty()) return;
  journal.begin_asking();
  mark_taken_over(journal);
  journal.append(more);
  mark_target(study, journal);
  journal.keep_asked(asked);
}

}  // namespace

std::unique_ptr<Optimizer> begin_search(const Study& study, Journal& journal) {
  if (study.start.from == StartSettings::From::journal && !known_at_start(study, journal)) {
    if (!study.start.journal.empty()) take_over(study, journal);
    journal.mark(kMark, study.search_key);
  }
  return begun_search(study, journal);
}

std::unique_ptr<Optimizer> begun_search(const Study& study, const Journal& journal) {
  const KnownAtStart everything{journal.size(), journal.marks().size()};
  switch (study.start.from) {
    case StartSettings::From::values:
      return make_optimizer(study);
    case StartSettings::From::basins:
      return optimizer_knowing(study, known_points(study, journal, everything));
    case StartSettings::From::journal:
      break;
  }
  const auto at_start = known_at_start(study, journal);
  if (!at_start) return nullptr;
  return optimizer_knowing(study, known_points(study, journal, *at_start));
}

}  // namespace latsch::correlation
