// SPDX-License-Identifier: Apache-2.0
// Test support: a model as a user might add it, a spring with a damper, and its one test. A
// language of models and tests needs nothing more, and such a study supports everything that others
// do.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <chrono>
#include <thread>

#include "experiment/language.h"

namespace latsch::experiment {

class Spring : public Specimen {
 public:
  static constexpr const char* kName = "is pulled";
  Spring(double stiffness, double damping) : stiffness_(stiffness), damping_(damping) {}
  double force(double travel, double speed) const { return stiffness_ * travel + damping_ * speed; }

 private:
  double stiffness_, damping_;  // N/m, N s/m
};

class SpringKind : public SpecimenKind {
 public:
  std::string name() const override { return "spring"; }
  std::string in_words() const override { return "spring"; }
  std::string file() const override { return "a TOML file with kind = \"spring\""; }
  int version() const override { return 1; }
  std::vector<std::string> abilities() const override { return {Spring::kName}; }
  bool recognizes(const std::filesystem::path&) const override { return false; }
  Document read(const std::filesystem::path& file) const override { return Document::read(file); }
  std::unique_ptr<Specimen> build(const Document& numbers,
                                  std::unique_ptr<Specimen>) const override {
    return std::make_unique<Spring>(
        numbers.root().quantity("stiffness", "N/m", Range::positive()),
        numbers.root().quantity("damping", "N s/m", Range::not_negative()));
  }
};

/// A test kind = "pull": travels = ["1 mm", ...] at one speed. The test can wait at each travel, so
/// that a run can be killed meanwhile.
class PullTest : public Test {
 public:
  PullTest(std::vector<double> travels, double speed, double hold)
      : travels_(std::move(travels)), speed_(speed), hold_(hold) {}
  std::string in_words() const override { return fmt::format("pulled at {:g} m/s", speed_); }
  std::vector<ChannelInfo> channels() const override { return {{"travel", "m"}, {"force", "N"}}; }
  std::vector<std::string> needs() const override { return {Spring::kName}; }
  Result<Channels> run(Specimen& specimen) const override {
    Channel force{"force", "N", {}};
    for (const double x : travels_) {
      std::this_thread::sleep_for(std::chrono::duration<double>(hold_));
      force.values.push_back(specimen.find<Spring>()->force(x, speed_));
    }
    Channels channels;
    channels.add({"travel", "m", travels_});
    channels.add(std::move(force));
    return channels;
  }

 private:
  std::vector<double> travels_;  // m
  double speed_, hold_;          // m/s, s
};

inline const Language& spring_language() {
  static const SpringKind kind;
  static const TestKind pull = {
      "pull", "is pulled", {Spring::kName}, [](const Node& root, const TestSource&) {
        auto travels = root.quantities("travels", "m", Range::positive());
        const double speed = root.quantity("speed", "m/s", Range::not_negative());
        const double hold = root.quantity("hold", "s", Range::not_negative(), 0.0);
        return std::unique_ptr<Test>(std::make_unique<PullTest>(std::move(travels), speed, hold));
      }};
  static const Language language = {{&kind}, {&pull}};
  return language;
}

}  // namespace latsch::experiment
