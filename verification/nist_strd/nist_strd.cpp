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

namespace latsch::nist_strd {
namespace {

using Vector = std::vector<double>;
using Model = double (*)(const Vector& x, const Vector& b);

double gauss(const Vector& x, const Vector& b) {
  const auto peak = [&](double height, double place, double width) {
    return height * std::exp(-std::pow((x[0] - place) / width, 2));
  };
  return b[0] * std::exp(-b[1] * x[0]) + peak(b[2], b[3], b[4]) + peak(b[5], b[6], b[7]);
}

double lanczos(const Vector& x, const Vector& b) {
  return b[0] * std::exp(-b[1] * x[0]) + b[2] * std::exp(-b[3] * x[0]) +
         b[4] * std::exp(-b[5] * x[0]);
}

double chwirut(const Vector& x, const Vector& b) {
  return std::exp(-b[0] * x[0]) / (b[1] + b[2] * x[0]);
}

double saturation(const Vector& x, const Vector& b) { return -b[0] * std::expm1(-b[1] * x[0]); }

double cubic_over_cubic(const Vector& x, const Vector& b) {
  const double t = x[0];
  return (b[0] + t * (b[1] + t * (b[2] + t * b[3]))) / (1.0 + t * (b[4] + t * (b[5] + t * b[6])));
}

double enso(const Vector& x, const Vector& b) {
  const double w = 2.0 * std::numbers::pi * x[0];
  return b[0] + b[1] * std::cos(w / 12.0) + b[2] * std::sin(w / 12.0) + b[4] * std::cos(w / b[3]) +
         b[5] * std::sin(w / b[3]) + b[7] * std::cos(w / b[6]) + b[8] * std::sin(w / b[6]);
}

const std::map<std::string, Model>& models() {
  static const std::map<std::string, Model> all{
      {"Bennett5",
       [](const Vector& x, const Vector& b) { return b[0] * std::pow(b[1] + x[0], -1.0 / b[2]); }},
      {"BoxBOD", saturation},
      {"Chwirut1", chwirut},
      {"Chwirut2", chwirut},
      {"DanWood", [](const Vector& x, const Vector& b) { return b[0] * std::pow(x[0], b[1]); }},
      {"ENSO", enso},
      {"Eckerle4",
       [](const Vector& x, const Vector& b) {
         return b[0] / b[1] * std::exp(-0.5 * std::pow((x[0] - b[2]) / b[1], 2));
       }},
      {"Gauss1", gauss},
      {"Gauss2", gauss},
      {"Gauss3", gauss},
      {"Hahn1", cubic_over_cubic},
      {"Kirby2",
       [](const Vector& x, const Vector& b) {
         const double t = x[0];
         return (b[0] + t * (b[1] + t * b[2])) / (1.0 + t * (b[3] + t * b[4]));
       }},
      {"Lanczos1", lanczos},
      {"Lanczos2", lanczos},
      {"Lanczos3", lanczos},
      {"MGH09",
       [](const Vector& x, const Vector& b) {
         const double t = x[0];
         return b[0] * (t * t + t * b[1]) / (t * t + t * b[2] + b[3]);
       }},
      {"MGH10",
       [](const Vector& x, const Vector& b) { return b[0] * std::exp(b[1] / (x[0] + b[2])); }},
      {"MGH17",
       [](const Vector& x, const Vector& b) {
         return b[0] + b[1] * std::exp(-x[0] * b[3]) + b[2] * std::exp(-x[0] * b[4]);
       }},
      {"Misra1a", saturation},
      {"Misra1b",
       [](const Vector& x, const Vector& b) {
         return b[0] * (1.0 - std::pow(1.0 + b[1] * x[0] / 2.0, -2.0));
       }},
      {"Misra1c",
       [](const Vector& x, const Vector& b) {
         return b[0] * (1.0 - std::pow(1.0 + 2.0 * b[1] * x[0], -0.5));
       }},
      {"Misra1d",
       [](const Vector& x, const Vector& b) { return b[0] * b[1] * x[0] / (1.0 + b[1] * x[0]); }},
      {"Nelson",  // of the logarithm of y
       [](const Vector& x, const Vector& b) {
         return b[0] - b[1] * x[0] * std::exp(-b[2] * x[1]);
       }},
      {"Rat42",
       [](const Vector& x, const Vector& b) {
         return b[0] / (1.0 + std::exp(b[1] - b[2] * x[0]));
       }},
      {"Rat43",
       [](const Vector& x, const Vector& b) {
         return b[0] / std::pow(1.0 + std::exp(b[1] - b[2] * x[0]), 1.0 / b[3]);
       }},
      {"Roszman1",
       [](const Vector& x, const Vector& b) {
         return b[0] - b[1] * x[0] - std::atan(b[2] / (x[0] - b[3])) / std::numbers::pi;
       }},
      {"Thurber", cubic_over_cubic}};
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
    r.push_back(model(row, b) - (is_logarithmic ? std::log(row.back()) : row.back()));
  }
  return r;
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
