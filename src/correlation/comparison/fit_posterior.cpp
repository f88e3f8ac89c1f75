// SPDX-License-Identifier: Apache-2.0
#include "correlation/comparison/fit_posterior.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "correlation/analysis/identifiability.h"
#include "correlation/search/search_standing.h"
#include "correlation/search/stage_runs.h"
#include "correlation/target/best_trial.h"
#include "numerics/dense/self_adjoint_eigen.h"
#include "optimization/problem/point_vector.h"

namespace latsch::correlation {
namespace {

// inverse variance of a number that is uniform between 0 and 1
constexpr double kOfAUniformNumber = 12.0;

/// Returns independent axes of the covariance P in the free variables.
Eigen::MatrixXd free_axes(const Confidence& c, double held_out) {
  const auto [values, Q] = numerics::self_adjoint_eigen(c.covariance);
  Eigen::MatrixXd axes(Q.rows(), Q.cols());
  Eigen::Index count = 0;
  for (Eigen::Index k = values.size() - 1; k >= 0; --k) {
    const double variance = held_out * held_out * values[k];
    if (!(variance > 0.0)) continue;  // held variables have variance 0
    axes.col(count++) = Q.col(k) / std::sqrt(1.0 / variance + kOfAUniformNumber);
  }
  return axes.leftCols(count);
}

/// Returns the axis of a variable at its bound: the change of that variable inward, with the
/// changes of the other variables in a refit.
Eigen::VectorXd held_axis(const Eigen::VectorXd& u, const Confidence& c, int variable) {
  const Interval& interval = c.intervals[static_cast<std::size_t>(variable)];
  const bool at_lower = c.held[static_cast<std::size_t>(variable)] == Bound::lower;
  const double inward = at_lower ? std::min(interval.upper, 1.0) - u[variable]
                                 : std::max(interval.lower, 0.0) - u[variable];
  Eigen::VectorXd axis = c.free.axes * c.free.following.col(variable);
  if (c.free.kept.size() > 0) axis += c.free.kept.col(variable);
  axis[variable] = 1.0;
  return axis * (inward / c.free.t);
}

Eigen::MatrixXd axes_of(const Identifiability& what, double held_out) {
  const Confidence& c = what.identification.confidence();
  const Eigen::VectorXd& u = what.identification.linearization().u;
  Eigen::MatrixXd axes = free_axes(c, held_out);
  const auto add = [&axes](const Eigen::VectorXd& axis) {
    if (axis.squaredNorm() == 0.0) return;
    axes.conservativeResize(axis.size(), axes.cols() + 1);
    axes.rightCols(1) = axis;
  };
  // share of the rise that ends an interval; the distance that a search has not covered is added
  // only if it is larger
  constexpr double kWorthwhile = 0.1;
  if (c.left_to_gain > kWorthwhile * c.threshold()) add(c.free.axes * c.free.left);
  for (int i = 0; i < u.size(); ++i)
    if (c.held[static_cast<std::size_t>(i)] != Bound::none) add(held_axis(u, c, i));
  if (what.refined_shift) add(*what.refined_shift);
  return axes;
}

std::string prefixed(const std::string& at, const std::string& path) {
  return at.empty() ? path : at + "." + path;
}

std::vector<std::string> places(const FitSource& source, const std::vector<std::string>& paths) {
  std::vector<std::string> all;
  for (const std::string& at : source.at)
    for (const std::string& path : paths) all.push_back(prefixed(at, path));
  return all;
}

}  // namespace

FitPosterior fit_posterior(const FitSource& source, double segment) {
  const auto file = source.study->run.journal;
  const std::string run =
      "run it before: latsch run " + source.study->file.lexically_normal().string();
  const auto refuse = [&](const std::string& why) {
    return InputError(source.place, "fit " + source.name + ": " + why);
  };
  if (!std::filesystem::exists(file))
    throw refuse(in_quotes(file.string()) + ", the journal of its study, does not exist; " + run);
  const Journal journal = Journal::read(file, identity(*source.study));
  const Study study = with_estimated_noise(*source.study, journal);
  if (const std::string why = why_no_best(study, journal); !why.empty()) throw refuse(why);
  if (!source.has_bands)
    return {source.name,
            best_trial(study, journal)->point,
            Eigen::MatrixXd(study.space.size(), 0),
            std::nan(""),
            std::nan(""),
            {},
            {"its best point is used without an uncertainty, as the comparison asks"}};
  const auto what = recorded_identifiability(study, journal);
  if (!what) throw refuse("its journal does not show how certain its variables are; " + run);
  const Confidence& c = what->identification.confidence();
  if (!std::isfinite(c.sigma))
    throw refuse(
        "there are no more measured values than variables, so the remaining uncertainty is not "
        "known; "
        "expected a noise in the experiments of " +
        in_quotes(study.file.string()));
  FitPosterior posterior{source.name, what->best, {}, c.excess, 1.0, {}, remarks(study, *what)};
  posterior.held_out = held_out_error(study, *what, journal);
  posterior.axes = axes_of(*what, posterior.held_out);
  posterior.discrepancy = spectral_discrepancy(study, *what, posterior.axes, segment);
  return posterior;
}

std::vector<std::string> paths_of(const FitSource& source, const DesignVariable& variable) {
  std::vector<std::string> all = places(source, variable.paths);
  for (const Follower& follower : variable.followers) {
    const auto more = places(source, follower.paths);
    all.insert(all.end(), more.begin(), more.end());
  }
  return all;
}

void check_fit(const FitSource& source, const Document& model, const std::string& title) {
  const auto known = model.paths();
  const Document& own = source.study->model;
  for (const DesignVariable& variable : source.study->space.variables()) {
    for (const std::string& path : paths_of(source, variable))
      if (std::find(known.begin(), known.end(), path) == known.end())
        throw InputError(source.place,
                         fmt::format("fit {} varies {}, which would be {} of {}: it has no such "
                                     "number; expected `at`, the path of the fit's model in the "
                                     "compared one, such as \"front_suspension\"",
                                     source.name,
                                     variable.name,
                                     in_quotes(path),
                                     title));
    for (const std::string& path : variable.paths)
      for (const std::string& at : source.at)
        if (own.unit(path) != model.unit(prefixed(at, path)))
          throw InputError(source.place,
                           fmt::format("fit {} has {} in {}, {} has it in {}",
                                       source.name,
                                       variable.name,
                                       own.unit(path),
                                       title,
                                       model.unit(prefixed(at, path))));
  }
}

void move_to(const FitSource& source, const std::vector<double>& u, Document& model) {
  const DesignSpace& space = source.study->space;
  const DesignPoint point = space.from_unit(u);
  for (int i = 0; i < space.size(); ++i) {
    const double value = point.values[static_cast<std::size_t>(i)];
    for (const std::string& path : places(source, space[i].paths)) model.set(path, value);
    for (const Follower& follower : space[i].followers)
      for (const std::string& path : places(source, follower.paths))
        model.set(path, follower.factor * value);
  }
}

}  // namespace latsch::correlation
