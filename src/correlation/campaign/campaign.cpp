// SPDX-License-Identifier: Apache-2.0
#include "correlation/campaign/campaign.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <utility>

#include "base/units.h"
#include "correlation/campaign/campaign_places.h"
#include "correlation/campaign/campaign_rounding.h"
#include "correlation/campaign/predicted_slopes.h"
#include "correlation/campaign/rival_predictions.h"
#include "correlation/study/study_slopes.h"
#include "numerics/dense/cholesky.h"
#include "numerics/dense/self_adjoint_eigen.h"
#include "optimization/design/change_order.h"
#include "optimization/design/continuous_design.h"
#include "optimization/design/model_discrimination.h"
#include "optimization/problem/point_vector.h"

namespace latsch::correlation {
namespace {

using Place = Eigen::VectorXd;
using Places = std::vector<Eigen::VectorXd>;

// Quantile of a 95 % interval.
constexpr double kNormalQuantile = 1.96;
constexpr double kFinestSetting = 1e-3;  // last length of a search, in ranges of settings
constexpr int kMostGridPoints = 20'000;
constexpr std::size_t kRankedFirst = 3;  // tests of the ranking that are compared at the ends

Eigen::MatrixXd covariance_of(const Eigen::MatrixXd& M) {
  return numerics::PivotedCholesky(M).solve(
      Eigen::MatrixXd(Eigen::MatrixXd::Identity(M.rows(), M.cols())));
}

/// The problem of choosing tests, and how a set of tests is judged.
class CampaignChoice {
 public:
  CampaignChoice(const CampaignPlan& plan, const CampaignPlaces& places, Eigen::MatrixXd W)
      : plan_(plan), places_(places), n_(std::ssize(plan.start.free)) {
    const CampaignSettings& campaign = *plan.study.campaign;
    const int draws = static_cast<int>(plan.start.draws.size());
    problem_.settings = static_cast<int>(campaign.settings.size());
    problem_.rows = [this, draws](const Place& s) {
      const Eigen::MatrixXd J = places_.rows(s);
      return draws == 0 ? J : Eigen::MatrixXd(J.rightCols(draws * n_));
    };
    problem_.admits = [this](const Place& s) { return places_.admits(s); };
    problem_.present = present_information(plan.start);
    problem_.draws = std::max(1, draws);
    problem_.finest = kFinestSetting;
    if (W.size() > 0) problem_.W = std::move(W);
    if (plan.rival) rival_.emplace(plan, places);
  }
  CampaignChoice(const CampaignChoice&) = delete;
  CampaignChoice& operator=(const CampaignChoice&) = delete;

  const DesignProblem& problem() const { return problem_; }

  Places best(int count) const {
    return rival_ ? best_tests_against(rival_->problem(), count) : best_tests(problem_, count);
  }
  /// Returns the order of the tests by what each gains after those before it.
  std::vector<int> ranking(const Places& tests) const {
    if (!rival_) return order_of_gain(problem_, tests);
    std::vector<int> order(tests.size());
    std::iota(order.begin(), order.end(), 0);
    return order;
  }
  /// Returns a number that is less for better tests.
  double criterion(const Places& tests, double weight = 1.0) const {
    return rival_ ? 1.0 / std::max(1e-300, fit_rival(rival_->problem(), tests, weight).T)
                  : design_criterion(problem_, tests, weight);
  }
  double T(const Places& tests) const {
    return rival_ && !tests.empty() ? fit_rival(rival_->problem(), tests).T : 0.0;
  }
  /// Returns the information at the fit with these tests.
  Eigen::MatrixXd information(const Places& tests, double weight = 1.0) const {
    Eigen::MatrixXd M = problem_.present;
    for (const Place& s : tests) {
      const Eigen::MatrixXd J = places_.rows(s).leftCols(n_);
      M += weight * J.transpose() * J;
    }
    return M;
  }
  Eigen::VectorXd deviations(const Places& tests, double weight = 1.0) const {
    return covariance_of(information(tests, weight)).diagonal().cwiseSqrt();
  }

 private:
  const CampaignPlan& plan_;
  const CampaignPlaces& places_;
  Eigen::Index n_;
  DesignProblem problem_;
  std::optional<RivalPredictions> rival_;
};

/// Returns the weights of the variances for the aim; empty for the determinant.
Result<Eigen::MatrixXd> weights_of_aim(const CampaignPlan& plan) {
  const CampaignSettings& campaign = *plan.study.campaign;
  const std::vector<int>& free = plan.start.free;
  const auto n = std::ssize(free);
  switch (campaign.aim) {
    case CampaignAim::volume:
    case CampaignAim::distinction:
      break;
    case CampaignAim::mean:
      return Eigen::MatrixXd(Eigen::MatrixXd::Identity(n, n) / static_cast<double>(n));
    case CampaignAim::prediction: {
      auto g = predicted_slopes(plan.study, plan.start, campaign.of);
      if (!g) return g;
      return Eigen::MatrixXd(g->transpose() * *g / static_cast<double>(g->rows()));
    }
    case CampaignAim::variable: {
      Eigen::MatrixXd W = Eigen::MatrixXd::Zero(n, n);
      for (Eigen::Index k = 0; k < n; ++k)
        if (plan.study.space[free[static_cast<std::size_t>(k)]].name == campaign.of) W(k, k) = 1.0;
      if (W.isZero())
        return Failure{
            fmt::format("{} is held constant by the last stage of the study, so no test "
                        "is needed to know it; free it, or name another variable",
                        campaign.of)};
      return W;
    }
  }
  return Eigen::MatrixXd();
}

CampaignGrid compare_with_grid(const CampaignChoice& choice,
                               const CampaignSettings& campaign,
                               const CampaignPlaces& places,
                               const Places& tests) {
  CampaignGrid grid;
  long points = 1;
  for (const CampaignSetting& setting : campaign.settings) {
    grid.levels.push_back(setting.grid);
    points *= setting.grid;
    if (points > kMostGridPoints) return grid;
  }
  Places admitted;
  for (long k = 0; k < points; ++k) {
    Place s(std::ssize(campaign.settings));
    long rest = k;
    for (std::size_t i = 0; i < grid.levels.size(); ++i) {
      const int levels = grid.levels[i];
      s[static_cast<Eigen::Index>(i)] =
          levels == 1 ? 0.5 : static_cast<double>(rest % levels) / (levels - 1);
      rest /= levels;
    }
    if (places.admits(s)) admitted.push_back(s);
  }
  grid.points = static_cast<int>(admitted.size());
  if (admitted.empty()) return grid;
  const double weight = static_cast<double>(tests.size()) / static_cast<double>(admitted.size());
  grid.interval_ratio =
      choice.deviations(tests).cwiseQuotient(choice.deviations(admitted, weight)).mean();
  grid.criterion_ratio = choice.criterion(admitted, weight) / choice.criterion(tests);
  return grid;
}

/// Returns the directions about which the bounds tell more than data and tests at any settings.
std::vector<std::string> untouched_directions(const CampaignPlan& plan,
                                              const CampaignChoice& choice,
                                              int count) {
  const Places all = first_places(choice.problem());
  const Eigen::MatrixXd M =
      choice.information(all, static_cast<double>(count) / static_cast<double>(all.size()));
  Eigen::MatrixXd told = M;
  const Eigen::MatrixXd bounds = choice.problem().present - plan.start.data;
  told -= bounds;
  const auto eigen = numerics::self_adjoint_eigen(told);
  std::vector<std::string> names;
  for (Eigen::Index k = 0; k < told.rows(); ++k) {
    if (eigen.values[k] > bounds(0, 0)) continue;
    Eigen::VectorXd direction = Eigen::VectorXd::Zero(plan.study.space.size());
    for (Eigen::Index i = 0; i < told.rows(); ++i)
      direction[plan.start.free[static_cast<std::size_t>(i)]] = eigen.vectors(i, k);
    Eigen::Index largest = 0;
    direction.cwiseAbs().maxCoeff(&largest);
    // A direction of a single variable needs no sign, one of many variables no list of them.
    constexpr double kAlone = 0.97;
    const std::string& first = plan.study.space[static_cast<int>(largest)].name;
    const std::string text = direction_text(plan.study.space, direction);
    names.push_back(std::abs(direction[largest]) > kAlone ? first
                    : text.empty()                        ? first + " together with many others"
                                                          : text);
  }
  return names;
}

/// Returns the distinct places of the first tests of a ranking.
std::set<std::vector<double>> first_of(const Places& tests, const std::vector<int>& order) {
  std::set<std::vector<double>> first;
  for (const int k : order) {
    const Place& s = tests[static_cast<std::size_t>(k)];
    if (first.size() < kRankedFirst) first.insert(std::vector<double>(s.begin(), s.end()));
  }
  return first;
}

/// Ranks the tests by the slopes at every end of every interval, the other variables following as
/// the data let them.
void look_at_ends(const CampaignPlan& plan,
                  const CampaignChoice& choice,
                  const CampaignPlaces& places,
                  const Places& tests,
                  Campaign& found) {
  const Study& study = plan.study;
  if (plan.rival) {
    found.why_no_ends = "a rival is told apart by values, not by slopes";
    return;
  }
  if (!plan.computes_slopes) {
    found.why_no_ends = "the slopes were interpolated at the fit alone";
    return;
  }
  if (found.draws > 0) {
    found.why_no_ends = "the draws of the posterior density vary the variables already";
    return;
  }
  const Eigen::MatrixXd C = covariance_of(choice.problem().present);
  const Eigen::VectorXd center = to_vector(study.space.to_unit(plan.start.point));
  const auto at_fit = first_of(tests, choice.ranking(tests));
  for (std::size_t k = 0; k < plan.start.free.size(); ++k) {
    const auto own = static_cast<Eigen::Index>(k);
    for (const double sign : {-1.0, 1.0}) {
      const Eigen::VectorXd moved = sign * kNormalQuantile * C.col(own) / std::sqrt(C(own, own));
      std::vector<double> u(center.begin(), center.end());
      for (std::size_t j = 0; j < plan.start.free.size(); ++j) {
        const auto at = static_cast<std::size_t>(plan.start.free[j]);
        u[at] = std::clamp(u[at] + moved[static_cast<Eigen::Index>(j)], 0.0, 1.0);
      }
      ++found.ends;
      try {
        const auto slopes = computed_slopes(study, {study.space.from_unit(u)});
        CampaignStart there = plan.start;
        there.draws.clear();
        for (std::size_t c = 0; c < there.noise.size(); ++c)
          there.noise[c].noise = {.absolute = places.deviations()[c]};
        const CampaignPlaces moved_places(*study.campaign, there, *slopes, 1);
        DesignProblem problem = choice.problem();
        problem.rows = [&](const Place& s) { return moved_places.rows(s); };
        if (!std::all_of(
                tests.begin(), tests.end(), [&](const Place& s) { return moved_places.admits(s); }))
          continue;
        if (first_of(tests, order_of_gain(problem, tests)) == at_fit) ++found.ends_kept;
      } catch (const InputError&) {  // the model does not accept this end, so nothing is kept there
      }
    }
  }
}

/// Gives tests the values of others in settings whose change costs something, the dearest first, as
/// long as all of that costs little of the criterion.
void share_dear_settings(const CampaignSettings& campaign,
                         const CampaignChoice& choice,
                         Places& tests) {
  constexpr double kShared = 1.002;  // factor of the criterion that is given away
  std::vector<std::size_t> dear;
  for (std::size_t i = 0; i < campaign.settings.size(); ++i)
    if (campaign.settings[i].cost > 0.0) dear.push_back(i);
  std::stable_sort(dear.begin(), dear.end(), [&](std::size_t a, std::size_t b) {
    return campaign.settings[a].cost > campaign.settings[b].cost;
  });
  const double most = kShared * choice.criterion(tests);
  for (const std::size_t i : dear) {
    const auto k = static_cast<Eigen::Index>(i);
    const Places before = tests;
    const auto holders = [&](double value) {
      return std::count_if(
          tests.begin(), tests.end(), [&](const Place& s) { return s[k] == value; });
    };
    for (std::size_t test = 0; test < tests.size(); ++test) {
      // the value that most other tests have comes first
      Places others = before;
      std::stable_sort(others.begin(), others.end(), [&](const Place& a, const Place& b) {
        return holders(a[k]) > holders(b[k]);
      });
      for (const Place& other : others) {
        if (other[k] == tests[test][k] || holders(other[k]) < holders(tests[test][k])) continue;
        Place moved = tests[test];
        moved[k] = other[k];
        if (!choice.problem().admits(moved)) continue;
        Places changed = tests;
        changed[test] = moved;
        if (choice.criterion(changed) > most) continue;
        tests = std::move(changed);
        break;
      }
    }
  }
}

/// Puts the tests into their order and says what is known after them.
void lay_out(const CampaignPlan& plan,
             const CampaignChoice& choice,
             const Places& tests,
             Campaign& found) {
  const CampaignSettings& campaign = *plan.study.campaign;
  const std::vector<int> ranking = choice.ranking(tests);
  Eigen::MatrixXd all(std::ssize(tests), std::ssize(campaign.settings));
  for (std::size_t k = 0; k < tests.size(); ++k)
    all.row(static_cast<Eigen::Index>(k)) = tests[k].transpose();
  std::vector<double> costs;
  for (const CampaignSetting& setting : campaign.settings) costs.push_back(setting.cost);
  const std::vector<int> order = campaign.has_costs ? order_of_few_changes(all, costs) : ranking;
  found.changes = setting_changes(all, order);
  found.changes_by_rank = setting_changes(all, ranking);
  Places ordered;
  for (const int k : order) {
    const Place& s = tests[static_cast<std::size_t>(k)];
    CampaignTest test{campaign.values_at({s.begin(), s.end()})};
    for (std::size_t i = 0; i < test.values.size(); ++i)
      test.values[i] = tidy_value(campaign.settings[i], test.values[i]);
    test.rank =
        static_cast<int>(std::find(ranking.begin(), ranking.end(), k) - ranking.begin()) + 1;
    for (std::size_t before = 0; before < ordered.size() && test.replicate_of < 0; ++before)
      if (ordered[before] == s) test.replicate_of = static_cast<int>(before);
    found.tests.push_back(test);
    ordered.push_back(s);
  }
  for (const int count : {0, 4, 8, static_cast<int>(ordered.size())}) {
    if (count > std::ssize(ordered)) continue;
    if (!found.standings.empty() && found.standings.back().tests == count) continue;
    const Places first(ordered.begin(), ordered.begin() + count);
    found.standings.push_back({count, choice.deviations(first), choice.T(first)});
  }
}

/// Returns the settings at both ends of which the first and the last test measure the same values
/// with the same slopes: what the campaign states for them is arbitrary. Slopes that are kriged
/// tell nothing of the kind.
std::vector<std::string> idle_settings(const CampaignPlan& plan, const Campaign& found) {
  constexpr double kSame = 1e-9;  // share of the length of values and slopes
  std::vector<std::string> idle;
  if (!plan.computes_slopes || found.tests.empty()) return idle;
  const auto same = [](const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
    return a.rows() == b.rows() && a.cols() == b.cols() && (a - b).norm() <= kSame * a.norm();
  };
  const auto& settings = plan.study.campaign->settings;
  for (std::size_t i = 0; i < settings.size(); ++i) {
    bool is_idle = true;
    for (const CampaignTest* test : {&found.tests.front(), &found.tests.back()}) {
      std::vector<double> values = test->values;
      values[i] = settings[i].lower;
      const auto low = plan.slopes->at(values);
      values[i] = settings[i].upper;
      const auto high = plan.slopes->at(values);
      is_idle = is_idle && low && high && same(low->y, high->y) && same(low->J, high->J);
    }
    if (is_idle) idle.push_back(settings[i].name);
  }
  return idle;
}

}  // namespace

Result<Campaign> plan_campaign(const CampaignPlan& plan, int count) {
  const CampaignSettings& campaign = *plan.study.campaign;
  const auto points = static_cast<int>(plan.start.draws.size()) + 1;
  const CampaignPlaces places(campaign, plan.start, *plan.slopes, points);
  if (places.first_admitted() == 0)
    return Failure{
        "the limits of [design] leave no settings: none of 256 points spread over the ranges and "
        "none of their corners fulfills all of them; widen the limits or the ranges"};
  Campaign found;
  found.draws = static_cast<int>(plan.start.draws.size());
  found.largest = places.largest();
  found.deviations = places.deviations();
  for (std::size_t c = 0; c < found.deviations.size(); ++c)
    if (!(found.deviations[c] > 0.0))
      return Failure{
          places.failed() > 0
              ? "the model fails at all settings inside the limits: " + places.first_failure()
              : campaign.measures[c] +
                    " is 0 at all settings, so a noise that is a share of it is 0, too; state its "
                    "noise as a quantity"};
  auto W = weights_of_aim(plan);
  if (!W) return W.failure();
  const CampaignChoice choice(plan, places, *std::move(W));
  if (first_places(choice.problem()).empty())
    return Failure{"the model fails at all settings inside the limits: " + places.first_failure()};
  const Eigen::MatrixXd told =
      choice.information(first_places(choice.problem())) - choice.problem().present;
  if (!(told.trace() > 0.0))
    return Failure{
        fmt::format("no setting changes what is measured ({}) by any variable, so no test of {} "
                    "tells anything; measure other channels or make another test",
                    fmt::join(campaign.measures, ", "),
                    campaign.test)};
  const Places exact = choice.best(count);
  Places tests = rounded_places(campaign, exact, choice.problem().admits);
  if (!plan.rival) share_dear_settings(campaign, choice, tests);
  found.rounding = choice.criterion(tests) / choice.criterion(exact);
  found.untouched = untouched_directions(plan, choice, count);
  lay_out(plan, choice, tests, found);
  found.idle = idle_settings(plan, found);
  found.grid = compare_with_grid(choice, campaign, places, tests);
  look_at_ends(plan, choice, places, tests, found);
  found.failed = places.failed();
  found.first_failure = places.first_failure();
  return found;
}

std::string why_no_rival(const Study& study,
                         const Study& rival,
                         const experiment::Language& language) {
  if (!rival.specimens->kind()) return "is a study of an outside program, expected one of a model";
  const auto reason =
      reason_against(*rival.specimens->kind(), *study.campaign->movable->test(), language);
  return reason ? "has a model that cannot run the test: its test " + *reason : "";
}

}  // namespace latsch::correlation
