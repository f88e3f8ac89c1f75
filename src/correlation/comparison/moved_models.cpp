// SPDX-License-Identifier: Apache-2.0
#include "correlation/comparison/moved_models.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/random.h"

namespace latsch::correlation {
namespace {

bool has(const Document& numbers, const std::vector<std::string>& wanted) {
  const auto paths = numbers.paths();
  return std::any_of(wanted.begin(), wanted.end(), [&](const std::string& path) {
    return std::find(paths.begin(), paths.end(), path) != paths.end();
  });
}

/// Multiplies a parameter, whose uncertainty the file states, by exp(`spreads` times its relative
/// standard deviation), if the model has the parameter.
void move_typed(const Uncertainty& number, double spreads, Document& numbers) {
  const auto paths = numbers.paths();
  for (const std::string& path : number.paths)
    if (std::find(paths.begin(), paths.end(), path) != paths.end())
      numbers.set(path, std::exp(spreads * number.spread) * numbers.get(path));
}

/// Moves the parameters of a model by up to one standard deviation along a direction of a fit,
/// toward the farther bounds.
MovedModel moved_along(const FitSource& source,
                       const FitPosterior& fit,
                       Eigen::Index axis,
                       const Document& numbers) {
  const auto u = source.study->space.to_unit(fit.point);
  // part of a standard deviation by which the parameter can be changed within its bounds, at most 1
  const auto room = [&](double side) {
    double least = 1.0;
    for (std::size_t i = 0; i < u.size(); ++i) {
      const double step = side * fit.axes(static_cast<Eigen::Index>(i), axis);
      if (step > 0.0) least = std::min(least, (1.0 - u[i]) / step);
      if (step < 0.0) least = std::min(least, u[i] / -step);
    }
    return least;
  };
  // least step as a share of a standard deviation, even if a variable lies on its bound
  constexpr double kLeast = 0.01;
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

}  // namespace

std::vector<MovedModel> band_models(const ModelComparisonFile& file,
                                    const ComparedModel& model,
                                    const std::vector<FitPosterior>& fits) {
  auto all = along_directions(file, model, fits);
  if (file.samples == 0 || all.empty()) return all;
  all.clear();
  for (int k = 0; k < file.samples; ++k) all.push_back(drawn(file, model, fits, k));
  return all;
}

}  // namespace latsch::correlation
