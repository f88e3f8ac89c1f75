// SPDX-License-Identifier: Apache-2.0
#include "nist_strd/nist_strd.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <map>
#include <memory>
#include <numbers>
#include <sstream>

#include "base/error.h"
#include "more_wild/dual.h"

namespace latsch::nist_strd {
namespace {

using Vector = std::vector<double>;
using more_wild::Dual;
using std::atan, std::cos, std::exp, std::expm1, std::pow, std::sin;

/// A model function that can be evaluated with plain numbers and with dual numbers.
struct Model {
  using Value = double (*)(const Vector& x, const Vector& b);
  using Slope = Dual (*)(const Vector& x, const std::vector<Dual>& b);
  Value value;
  Slope dual;

  Model(Value v, Slope d) : value(v), dual(d) {}
  template <class Formula>
  Model(const Formula& formula) : value(formula), dual(formula) {}
};

template <class T>
T gauss(const Vector& x, const std::vector<T>& b) {
  const auto peak = [&](const T& height, const T& place, const T& width) {
    return height * exp(-pow((x[0] - place) / width, 2));
  };
  return b[0] * exp(-b[1] * x[0]) + peak(b[2], b[3], b[4]) + peak(b[5], b[6], b[7]);
}

template <class T>
T lanczos(const Vector& x, const std::vector<T>& b) {
  return b[0] * exp(-b[1] * x[0]) + b[2] * exp(-b[3] * x[0]) + b[4] * exp(-b[5] * x[0]);
}

template <class T>
T chwirut(const Vector& x, const std::vector<T>& b) {
  return exp(-b[0] * x[0]) / (b[1] + b[2] * x[0]);
}

template <class T>
T saturation(const Vector& x, const std::vector<T>& b) {
  return -b[0] * expm1(-b[1] * x[0]);
}

template <class T>
T cubic_over_cubic(const Vector& x, const std::vector<T>& b) {
  const double t = x[0];
  return (b[0] + t * (b[1] + t * (b[2] + t * b[3]))) / (1.0 + t * (b[4] + t * (b[5] + t * b[6])));
}

template <class T>
T enso(const Vector& x, const std::vector<T>& b) {
  const double w = 2.0 * std::numbers::pi * x[0];
  return b[0] + b[1] * cos(w / 12.0) + b[2] * sin(w / 12.0) + b[4] * cos(w / b[3]) +
         b[5] * sin(w / b[3]) + b[7] * cos(w / b[6]) + b[8] * sin(w / b[6]);
}

const std::map<std::string, Model>& models() {
  static const std::map<std::string, Model> all{
      {"Bennett5",
       [](const Vector& x, const auto& b) { return b[0] * pow(b[1] + x[0], -1.0 / b[2]); }},
      {"BoxBOD", {saturation, saturation}},
      {"Chwirut1", {chwirut, chwirut}},
      {"Chwirut2", {chwirut, chwirut}},
      {"DanWood", [](const Vector& x, const auto& b) { return b[0] * pow(x[0], b[1]); }},
      {"ENSO", {enso, enso}},
      {"Eckerle4",
       [](const Vector& x, const auto& b) {
         return b[0] / b[1] * exp(-0.5 * pow((x[0] - b[2]) / b[1], 2));
       }},
      {"Gauss1", {gauss, gauss}},
      {"Gauss2", {gauss, gauss}},
      {"Gauss3", {gauss, gauss}},
      {"Hahn1", {cubic_over_cubic, cubic_over_cubic}},
      {"Kirby2",
       [](const Vector& x, const auto& b) {
         const double t = x[0];
         return (b[0] + t * (b[1] + t * b[2])) / (1.0 + t * (b[3] + t * b[4]));
       }},
      {"Lanczos1", {lanczos, lanczos}},
      {"Lanczos2", {lanczos, lanczos}},
      {"Lanczos3", {lanczos, lanczos}},
      {"MGH09",
       [](const Vector& x, const auto& b) {
         const double t = x[0];
         return b[0] * (t * t + t * b[1]) / (t * t + t * b[2] + b[3]);
       }},
      {"MGH10", [](const Vector& x, const auto& b) { return b[0] * exp(b[1] / (x[0] + b[2])); }},
      {"MGH17",
       [](const Vector& x, const auto& b) {
         return b[0] + b[1] * exp(-x[0] * b[3]) + b[2] * exp(-x[0] * b[4]);
       }},
      {"Misra1a", {saturation, saturation}},
      {"Misra1b",
       [](const Vector& x, const auto& b) {
         return b[0] * (1.0 - pow(1.0 + b[1] * x[0] / 2.0, -2.0));
       }},
      {"Misra1c",
       [](const Vector& x, const auto& b) {
         return b[0] * (1.0 - pow(1.0 + 2.0 * b[1] * x[0], -0.5));
       }},
      {"Misra1d",
       [](const Vector& x, const auto& b) { return b[0] * b[1] * x[0] / (1.0 + b[1] * x[0]); }},
      {"Nelson",  // the model is for the logarithm of y
       [](const Vector& x, const auto& b) { return b[0] - b[1] * x[0] * exp(-b[2] * x[1]); }},
      {"Rat42",
       [](const Vector& x, const auto& b) { return b[0] / (1.0 + exp(b[1] - b[2] * x[0])); }},
      {"Rat43",
       [](const Vector& x, const auto& b) {
         return b[0] / pow(1.0 + exp(b[1] - b[2] * x[0]), 1.0 / b[3]);
       }},
      {"Roszman1",
       [](const Vector& x, const auto& b) {
         return b[0] - b[1] * x[0] - atan(b[2] / (x[0] - b[3])) / std::numbers::pi;
       }},
      {"Thurber", {cubic_over_cubic, cubic_over_cubic}}};
  return all;
}

Vector numbers_in(std::istream& line) {
  Vector values;
  for (double value; line >> value;) values.push_back(value);
  return values;
}

more_wild::Problem problem(const std::shared_ptr<const Dataset>& data,
                           const Vector& start,
                           int number) {
  more_wild::Problem problem{fmt::format("{}, start {}", data->name, number),
                             start,
                             static_cast<int>(data->rows.size()),
                             data->sum,
                             [data](const Vector& b) { return residuals(*data, b); }};
  constexpr double kShare = 0.1;
  problem.jacobian = [data](const Vector& b) { return jacobian(*data, b); };
  for (const double b : start) problem.steps.push_back(kShare * std::abs(b));
  return problem;
}

}  // namespace

Dataset read_dataset(const std::string& name) {
  const std::string path = std::string(LATSCH_NIST_STRD_TABLES) + "/" + name + ".txt";
  std::ifstream file(path);
  if (!file) throw InputError(path + ": cannot be read");
  Dataset data{name, {}, {}, {}, 0.0, {}};
  const std::map<std::string, Vector Dataset::*> vectors{{"start_1", &Dataset::start_1},
                                                         {"start_2", &Dataset::start_2},
                                                         {"certified", &Dataset::certified}};
  for (std::string text; std::getline(file, text);) {
    if (text.empty() || text[0] == '#') continue;
    std::istringstream line(text);
    std::string key = text.substr(0, text.find(' '));
    if (const auto found = vectors.find(key); found != vectors.end()) {
      line >> key;
      data.*(found->second) = numbers_in(line);
    } else if (key == "sum") {
      line >> key >> data.sum;
    } else {
      data.rows.push_back(numbers_in(line));
    }
  }
  return data;
}

std::vector<std::string> names() {
  std::vector<std::string> all;
  for (const auto& [name, model] : models()) all.push_back(name);
  return all;
}

std::vector<double> residuals(const Dataset& dataset, const std::vector<double>& b) {
  const Model model = models().at(dataset.name);
  const bool is_logarithmic = dataset.name == "Nelson";
  Vector r;
  for (const Vector& row : dataset.rows) {
    r.push_back(model.value(row, b) - (is_logarithmic ? std::log(row.back()) : row.back()));
  }
  return r;
}

std::vector<double> jacobian(const Dataset& dataset, const std::vector<double>& b) {
  const Model model = models().at(dataset.name);
  const auto values = [&](const std::vector<Dual>& at) {
    std::vector<Dual> all;
    for (const Vector& row : dataset.rows) all.push_back(model.dual(row, at));
    return all;
  };
  return more_wild::jacobian_of(values, b);
}

std::vector<more_wild::Problem> problems() {
  std::vector<more_wild::Problem> all;
  for (const std::string& name : names()) {
    const auto data = std::make_shared<const Dataset>(read_dataset(name));
    all.push_back(problem(data, data->start_1, 1));
    if (name != "MGH10" && name != "MGH17") all.push_back(problem(data, data->start_2, 2));
  }
  return all;
}

}  // namespace latsch::nist_strd
