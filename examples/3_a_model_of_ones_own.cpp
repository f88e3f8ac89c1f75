// SPDX-License-Identifier: Apache-2.0
// Example 3. The whole program `latsch` with a model of one's own: a spring beside a damper, and one test that pulls it.
// Fits, intervals, designs, reports, the page and worker processes then work for the spring as for a tire.
//
//   target_link_libraries(spring PRIVATE latsch::cli)
//
//   $ cat spring.toml
//   kind = "spring"
//   stiffness = "20 N/mm"
//   damping = "300 N s/m"
//   $ 3_a_model_of_ones_own test spring.toml '{kind = "pull", speed = "0.4 m/s", travels = ["2 mm", "5 mm"]}'
//   travel [m],force [N]
//   0.002,160
//   0.005,220
//
// A program that also has the shipped models appends to the tables of experiment::language().
#include <latsch/cli/run_cli.h>
#include <latsch/experiment/language.h>

#include <memory>
#include <utility>

using namespace latsch;
using namespace latsch::experiment;

namespace {

/// The specimen, a spring with a damper: F = k x + d v. It is a capability of its own, because no
/// other specimen can be pulled.
struct Spring : Specimen {
  static constexpr const char* kName = "is pulled";
  Spring(double stiffness, double damping) : k(stiffness), d(damping) {}
  double k, d;  // N/m, N s/m
};

/// The kind of model: it reads the numbers of a file and makes a specimen from them. Every number
/// of the file may become a design variable.
struct SpringKind : SpecimenKind {
  std::string name() const override { return "spring"; }
  std::string in_words() const override { return "spring with a damper"; }
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

/// The test: it returns the forces at given travels, at one speed.
struct Pull : Test {
  Pull(std::vector<double> travels, double speed) : x(std::move(travels)), v(speed) {}
  std::string in_words() const override { return "pulled"; }
  std::vector<ChannelInfo> channels() const override { return {{"travel", "m"}, {"force", "N"}}; }
  std::vector<std::string> needs() const override { return {Spring::kName}; }
  Result<Channels> run(Specimen& specimen) const override {
    const Spring& spring = *specimen.find<Spring>();
    Channel force{"force", "N", {}};
    for (const double travel : x) force.values.push_back(spring.k * travel + spring.d * v);
    Channels recording;
    recording.add({"travel", "m", x});
    recording.add(std::move(force));
    return recording;
  }
  std::vector<double> x;  // m
  double v;               // m/s
};

/// The functions of `keys` read, check and document each key of the test, and record it in the
/// identity of the test's trials.
std::unique_ptr<Test> read_pull(const Node& keys, const TestSource&) {
  auto travels = keys.quantities("travels", "m", Range::positive());
  const double speed = keys.quantity("speed", "m/s", Range::not_negative());
  return std::make_unique<Pull>(std::move(travels), speed);
}

}  // namespace

int main(int argc, char** argv) {
  static const SpringKind spring;
  static const TestKind pull = {"pull", "is pulled", {Spring::kName}, read_pull};
  return cli::run_cli(argc, argv, Language{{&spring}, {&pull}});
}
