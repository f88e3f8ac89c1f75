// SPDX-License-Identifier: Apache-2.0
#include "compliant_cars.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/file.h"
#include "base/random.h"
#include "correlation/target/study_trials.h"
#include "models/suspension/suspension_reader.h"

namespace latsch::benchmarks {
namespace {

namespace fs = std::filesystem;
using correlation::Study;
using suspension::DoubleWishbone;

constexpr double kJitter = 10e-3;  // m
constexpr double kLeastTooStiff = 3.0, kMostTooStiff = 15.0;

/// Replaces the text between `from` and `to` in its first occurrence after `anchor`.
void replace_behind(std::string& text,
                    const std::string& anchor,
                    const std::string& from,
                    const std::string& to,
                    const std::string& by) {
  const std::size_t at = text.find(anchor);
  const std::size_t begin = at == std::string::npos ? at : text.find(from, at);
  const std::size_t end = begin == std::string::npos ? begin : text.find(to, begin + from.size());
  if (end == std::string::npos) throw std::runtime_error("the study has no " + anchor);
  text.replace(begin + from.size(), end - begin - from.size(), by);
}

/// Displaces the hardpoints at random. The ground stays where it is, and the contact point stays
/// below the wheel.
std::string jittered(std::string corner, const DoubleWishbone& as_written, RandomStream& random) {
  const auto write = [&](const std::string& name, const Eigen::Vector3d& moved) {
    replace_behind(corner,
                   "\n" + name + " = ",
                   "[",
                   "]",
                   fmt::format("\"{} m\", \"{} m\", \"{} m\"", moved.x(), moved.y(), moved.z()));
  };
  const auto elsewhere = [&](Eigen::Vector3d point) {
    for (double& x : point) x += kJitter * (2.0 * random.uniform() - 1.0);
    return point;
  };
  for (std::size_t i = 0; i < DoubleWishbone::kJoints; ++i)
    write(DoubleWishbone::kNames[i], elsewhere(as_written.points[i]));
  const Eigen::Vector3d center = elsewhere(as_written.wheel_center);
  write("wheel_center", center);
  Eigen::Vector3d contact = elsewhere(as_written.contact);
  contact.x() = center.x();
  contact.z() = as_written.contact.z();
  write("contact", contact);
  return corner;
}

/// Returns a quantity with its SI unit as a user would write it.
std::string in_si(double value, const std::string& unit) {
  return fmt::format("{} {}", value, unit);
}

DesignPoint drawn_from_prior(const DesignSpace& space, RandomStream& random) {
  DesignPoint truth;
  for (const DesignVariable& variable : space.variables()) {
    const Prior& prior = variable.prior.value();
    truth.values.push_back(prior.value * std::exp(std::log1p(prior.sigma) * random.normal()));
  }
  return truth;
}

}  // namespace

CompliantCars::CompliantCars(fs::path folder, std::uint64_t seed)
    : folder_(std::move(folder)), seed_(seed) {
  const fs::path studies = fs::path(LATSCH_SOURCE_DIR) / "studies" / "compliance";
  study_ = read_text_file(studies / "axes.toml");
  corner_ = read_text_file(studies / "corner.toml");
}

CompliantCar CompliantCars::draw(int number) const {
  RandomStream random(seed_, static_cast<std::uint64_t>(number));
  const fs::path folder = folder_ / fmt::format("car_{}", number);
  const fs::path file = folder / "axes.toml";
  fs::create_directories(folder);
  const auto as_written =
      suspension::read_suspension(Document::parse(corner_, "corner.toml").root());
  write_text_file(folder / "corner.toml", jittered(corner_, as_written, random));
  write_text_file(file, study_);
  const Study before = correlation::read_study(file, experiment::language());

  CompliantCar car{before, drawn_from_prior(before.space, random), {}};
  auto recording = correlation::simulate_all(before, car.truth);
  if (!recording) throw std::runtime_error(recording.failure().reason);
  car.recording = *std::move(recording);

  std::string text = study_;
  for (int i = 0; i < before.space.size(); ++i) {
    const double too_stiff =
        kLeastTooStiff * std::pow(kMostTooStiff / kLeastTooStiff, random.uniform());
    const DesignVariable& variable = before.space[i];
    const double start =
        std::min(too_stiff * car.truth.values[static_cast<std::size_t>(i)], 0.999 * variable.upper);
    replace_behind(text, "variable." + variable.name, "initial = \"", "\"", in_si(start, "N/m"));
  }
  for (const correlation::StudyExperiment& experiment : before.experiments) {
    const std::string channel = experiment.observable->asks().front();
    const double noise = experiment.noise.value().relative * random.normal();
    const double measured = car.recording[channel].front() * (1.0 + noise);
    replace_behind(text,
                   "[experiment." + experiment.name + "]",
                   "\nvalue = \"",
                   "\"",
                   in_si(measured, experiment.observable->unit()));
  }
  write_text_file(file, text);
  car.study = correlation::read_study(file, experiment::language());
  return car;
}

}  // namespace latsch::benchmarks
