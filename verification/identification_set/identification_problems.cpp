// SPDX-License-Identifier: Apache-2.0
#include "identification_set/identification_problems.h"

#include <cmath>

#include "base/random.h"

namespace latsch::identification_set {
namespace {

// least ratio of the upper to the lower bound for a variable with logarithmic scale
constexpr double kLogarithmic = 9.99;

DesignSpace space_of(const std::vector<Number>& numbers) {
  std::vector<DesignVariable> variables;
  for (const Number& number : numbers) {
    const bool is_wide = number.lower > 0.0 && number.upper / number.lower > kLogarithmic;
    variables.push_back({.name = number.name,
                         .lower = number.lower,
                         .upper = number.upper,
                         .initial = number.start,
                         .scale = is_wide ? Scale::logarithmic : Scale::linear});
  }
  return DesignSpace(variables);
}

/// FNV-1a hash of the problem's name, used because the errors of its data must not depend on the
/// standard library.
std::uint64_t number_of(const std::string& name) {
  std::uint64_t hash = 14695981039346656037u;
  for (const char byte : name) {
    hash = (hash ^ static_cast<unsigned char>(byte)) * 1099511628211u;
  }
  return hash;
}

}  // namespace

Problem fitted(const std::string& name,
               const std::vector<Number>& numbers,
               const Model& model,
               double error) {
  Vector truth;
  for (const Number& number : numbers) truth.push_back(number.truth);
  Vector data = model(truth);
  double square = 0.0;
  for (const double y : data) square += y * y;
  const double scale = std::sqrt(square / static_cast<double>(data.size()));
  RandomStream random(number_of(name), 0);
  for (double& y : data) y += error * scale * random.normal();
  const auto residuals = [model, data, scale](const Vector& x) {
    Vector r = model(x);
    for (std::size_t i = 0; i < r.size(); ++i) r[i] = (r[i] - data[i]) / scale;
    return r;
  };
  return {name, space_of(numbers), truth, residuals};
}

std::vector<Problem> problems() {
  std::vector<Problem> all = tuning_problems();
  for (Problem& problem : held_out_problems()) all.push_back(std::move(problem));
  return all;
}

Vector grid(double first, double last, int count) {
  Vector values;
  for (int i = 0; i < count; ++i) values.push_back(first + (last - first) * i / (count - 1.0));
  return values;
}

std::vector<Vector> integrate(const Rates& f, Vector y, const Vector& times, int steps) {
  const auto moved = [](const Vector& from, double h, const Vector& rate) {
    Vector to = from;
    for (std::size_t i = 0; i < to.size(); ++i) to[i] += h * rate[i];
    return to;
  };
  std::vector<Vector> states{y};
  for (std::size_t k = 1; k < times.size(); ++k) {
    const double h = (times[k] - times[k - 1]) / steps;
    for (int s = 0; s < steps; ++s) {
      const double t = times[k - 1] + s * h;
      const Vector k1 = f(t, y), k2 = f(t + 0.5 * h, moved(y, 0.5 * h, k1));
      const Vector k3 = f(t + 0.5 * h, moved(y, 0.5 * h, k2)), k4 = f(t + h, moved(y, h, k3));
      for (std::size_t i = 0; i < y.size(); ++i) {
        y[i] += h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]);
      }
    }
    states.push_back(y);
  }
  return states;
}

}  // namespace latsch::identification_set
