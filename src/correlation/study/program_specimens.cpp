// SPDX-License-Identifier: Apache-2.0
#include "correlation/study/program_specimens.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "correlation/study/study.h"
#include "evaluation/outside_program/outside_program.h"

namespace latsch::correlation {
namespace {

struct RunsAsProgram {
  static constexpr const char* kName = "is an outside program";
  virtual ~RunsAsProgram() = default;
  virtual Result<Channels> run() = 0;
};

class ProgramSpecimen : public experiment::Specimen, public RunsAsProgram {
 public:
  ProgramSpecimen(Evaluator evaluator, DesignPoint point)
      : evaluator_(std::move(evaluator)), point_(std::move(point)) {}
  Result<Channels> run() override { return evaluator_(point_); }

 private:
  Evaluator evaluator_;
  DesignPoint point_;
};

class ProgramTest : public experiment::Test {
 public:
  explicit ProgramTest(std::vector<OutputReader> outputs) : outputs_(std::move(outputs)) {}

  std::string in_words() const override { return "a run of the program"; }
  // Specimens::identity contains the identity of the program, so the test adds nothing to it.
  std::vector<std::string> needs() const override { return {RunsAsProgram::kName}; }
  std::vector<experiment::ChannelInfo> channels() const override {
    std::vector<experiment::ChannelInfo> channels;
    for (const OutputReader& output : outputs_) {
      for (const auto& quantity : output.quantities)
        channels.push_back({output.name + "/" + quantity.name, quantity.unit});
    }
    return channels;
  }
  Result<Channels> run(experiment::Specimen& specimen) const override {
    return specimen.find<RunsAsProgram>()->run();
  }

 private:
  std::vector<OutputReader> outputs_;
};

class ProgramSpecimens : public Specimens {
 public:
  explicit ProgramSpecimens(const Simulator& simulator) : simulator_(simulator) {}

  std::unique_ptr<experiment::Specimen> at(const Study& study,
                                           const DesignPoint& point,
                                           std::unique_ptr<experiment::Specimen>) const override {
    // A worker of a run ends a trial at the limit of [run]. Where no worker watches, as in latsch
    // simulate, the program has this limit and a little more, so that a worker comes first.
    Simulator limited = simulator_;
    if (limited.timeout == 0.0 && study.run.timeout > 0.0)
      limited.timeout = 1.0 + 1.05 * study.run.timeout;
    return std::make_unique<ProgramSpecimen>(evaluator(limited, study.space), point);
  }
  void check(const Study& study) const override {
    const std::string program = command(simulator_).front();
    if (can_be_found(program)) return;
    throw InputError(
        {study.file.string(), 0},
        fmt::format("simulator.command starts \"{}\", which is no program {}; expected "
                    "one that is installed, or its path with {{study}} for the folder "
                    "of the study",
                    program,
                    program.starts_with('/') ? "there" : "in PATH"));
  }
  StudyIdentity identity(const Study& study) const override {
    return latsch::identity(simulator_, study.space);
  }

  std::string describe(const Study&) const override {
    std::string text = fmt::format(
        "Simulator: {}{}",
        fmt::join(simulator_.arguments, " "),
        simulator_.timeout > 0.0 ? fmt::format(", {:g} s at most", simulator_.timeout) : "");
    std::vector<std::string> watched;
    for (const auto& file : watched_files(simulator_)) watched.push_back(file.filename().string());
    text += fmt::format(
        "\n  trials depend on the files of the command, inputs, files{}{}; state others that the "
        "program reads in files",
        watched.empty() ? "" : ", and, because a script names them, ",
        fmt::join(watched, ", "));
    for (const OutputReader& output : simulator_.outputs) {
      text += fmt::format("\n  {:<16} from {}:", output.name, output.file.string());
      for (const auto& quantity : output.quantities)
        text += fmt::format(" {} [{}]", quantity.name, quantity.unit);
    }
    return text;
  }
  bool may_repeat() const override { return false; }
  double own_timeout() const override { return simulator_.timeout; }
  std::filesystem::path leftovers() const override {
    return simulator_.keep_failed ? std::filesystem::path() : simulator_.scratch;
  }
  std::string how_to_see_more() const override {
    return simulator_.keep_failed ? "" : "keep_failed = true in [simulator] keeps its folder";
  }

 private:
  Simulator simulator_;
};

}  // namespace

std::shared_ptr<const Specimens> specimens_of(const Simulator& simulator) {
  return std::make_shared<ProgramSpecimens>(simulator);
}

StudyTest test_of(const Simulator& simulator) {
  return {"", std::make_shared<ProgramTest>(simulator.outputs), ""};
}

}  // namespace latsch::correlation
