// SPDX-License-Identifier: Apache-2.0
// Compares the answers to the page with the results of the study's own functions on its journal.
#include "studio/studio.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <mutex>
#include <nlohmann/json.hpp>
#include <thread>

#include "base/file.h"
#include "correlation/posterior/posterior.h"
#include "correlation/search/study_reuse_testing.h"
#include "correlation/target/best_trial.h"
#include "evaluation/journal/journal_lock.h"

namespace latsch::studio {
namespace {

using Json = nlohmann::ordered_json;
using namespace std::chrono_literals;

class Asked : public correlation::FittedStudy {
 protected:
  static constexpr const char* kTwo = R"(
[experiment.aligning]
kind = "curve"
y = "steady/Mz"
measurement = "aligning.csv"
weight = 0.5
)";

  /// Returns a study that is fitted without derivatives, because a fit with derivatives would
  /// already give intervals.
  correlation::Study two() {
    std::string text = "Mz [N*m]\n";
    for (int i = -12; i <= 12; ++i) text += std::to_string(2.5 * i) + "\n";
    write("aligning.csv", text);
    return read(std::string(kTwo) + "[optimizer]\nmethod = \"residual_trust_region\"\n");
  }

  void begin() {
    StudioOptions options{folder_.path(), "/bin/false", "test", false};
    studio_ = std::make_unique<Studio>(
        options, experiment::language(), [this](auto topic, auto event, auto json) {
          const std::lock_guard lock(mutex_);
          events_.emplace_back(std::string(topic) + " " + std::string(event), Json::parse(json));
        });
    for (int k = 0; k < 200 && get("/api/home")["studies"].empty(); ++k)
      std::this_thread::sleep_for(10ms);
  }

  Response ask(const std::string& path, std::map<std::string, std::string> query = {}) {
    query.emplace("study", "study.toml");
    return studio_->answer({"GET", path, std::move(query), "", {}});
  }
  Json get(const std::string& path, std::map<std::string, std::string> query = {}) {
    const Response response = ask(path, std::move(query));
    EXPECT_EQ(response.status, 200) << path << ": " << response.body;
    return Json::parse(response.body);
  }
  Response post(const std::string& path, Json body) {
    body["study"] = "study.toml";
    return studio_->answer({"POST", path, {}, body.dump(), {}});
  }
  template <class Condition>
  bool wait_for(Condition&& is_so) {
    for (int k = 0; k < 500; ++k, std::this_thread::sleep_for(10ms))
      if (is_so()) return true;
    return false;
  }

  std::mutex mutex_;
  std::vector<std::pair<std::string, Json>> events_;
  std::unique_ptr<Studio> studio_;
};

TEST_F(Asked, KeysHaveTheChoicesOfTheirReaders) {
  begin();
  const Json keys = get("/api/keys");
  const Json methods = keys["optimizer"]["method"]["choices"];
  EXPECT_NE(std::find(methods.begin(), methods.end(), "nelder_mead"), methods.end());
  EXPECT_EQ(keys["run"]["on_failure"]["choices"].size(), 5u);
  EXPECT_NE(keys["doe"]["points"]["sentence"], "");
  EXPECT_FALSE(keys.contains("variable")) << "its tables have free names";
}

TEST_F(Asked, StudyAndTrialsAreThoseOfTheJournal) {
  const auto study = two();
  fit_all(study);
  const Journal journal = Journal::read(study.run.journal);
  const auto best = correlation::best_trial(study, journal);
  begin();
  ASSERT_TRUE(wait_for([&] { return get("/api/study")["trials"] == journal.size(); }));
  const Json view = get("/api/study");
  EXPECT_NEAR(view["best"]["target"], best->target, 1e-6 * best->target);
  EXPECT_NEAR(view["best"]["values"][1], best->point.values[1], 1e-6 * 60.0);
  double share = 0.0;
  for (const Json& experiment : view["experiments"]) share += experiment["share"].get<double>();
  EXPECT_NEAR(share, 1.0, 1e-6);
  EXPECT_TRUE(wait_for([&] { return get("/api/study")["state"] == "ended"; }));
  const Json optimizer = get("/api/study")["optimizer"];
  EXPECT_NE(optimizer["ending"], "");
  EXPECT_TRUE(optimizer["tests"].is_array());

  const auto rated = correlation::rated_trials(study, journal);
  const Json convergence = get("/api/convergence");
  ASSERT_EQ(convergence["target"].size(), rated.size());
  for (std::size_t k = 0; k < rated.size(); ++k)
    EXPECT_NEAR(convergence["target"][k], rated[k].target, 1e-6 * rated[k].target);
  const Json sorted = get("/api/trials", {{"order", "target"}, {"count", "1"}});
  EXPECT_EQ(sorted["rows"][0]["trial"], view["best"]["trial"]);
}

TEST_F(Asked, OtherWeightsGiveTheTargetOfAStudyWithThem) {
  const auto study = two();
  fit_all(study);
  begin();
  ASSERT_TRUE(wait_for([&] { return get("/api/study")["trials"].get<long>() > 0; }));
  std::string changed = kTwo;
  changed.replace(changed.find("0.5"), 3, "7.5");
  const auto other = read(changed, "other.toml");
  const auto rated = correlation::rated_trials(other, Journal::read(study.run.journal));
  const Json convergence = get("/api/convergence", {{"weights", "aligning:7.5"}});
  ASSERT_EQ(convergence["target"].size(), rated.size());
  for (std::size_t k = 0; k < rated.size(); ++k)
    EXPECT_NEAR(convergence["target"][k], rated[k].target, 1e-6 * rated[k].target);
  for (const char* wrong : {"nobody:1", "light", "light:x", "light:0,aligning:0", "light:-1"})
    EXPECT_EQ(ask("/api/convergence", {{"weights", wrong}}).status, 400) << wrong;
}

TEST_F(Asked, ManyTrialsKeepTheirLeastAndGreatest) {
  const auto study = two();
  const Evaluator model = evaluator(study);
  {
    Journal journal = Journal::open(study.run.journal, identity(study));
    std::vector<Trial> trials;
    for (int k = 0; k < 3000; ++k) {
      const DesignPoint point{{1.0 + 2e-4 * (k % 777), -20.0}};
      trials.push_back({point, {model(point), 0.1, 0.1, 0}});
    }
    journal.append(trials);
  }
  const auto rated = correlation::rated_trials(study, Journal::read(study.run.journal));
  double least = INFINITY, greatest = 0.0;
  for (const auto& trial : rated) {
    least = std::min(least, trial.target);
    greatest = std::max(greatest, trial.target);
  }
  begin();
  ASSERT_TRUE(wait_for([&] { return get("/api/convergence")["total"] == 3000; }));
  const Json few = get("/api/convergence", {{"most", "300"}});
  EXPECT_TRUE(few["is_decimated"]);
  EXPECT_LE(few["target"].size(), 300u);
  double shown_least = INFINITY, shown_greatest = 0.0;
  for (const Json& target : few["target"]) {
    shown_least = std::min(shown_least, target.get<double>());
    shown_greatest = std::max(shown_greatest, target.get<double>());
  }
  EXPECT_NEAR(shown_least, least, 1e-6 * least);
  EXPECT_NEAR(shown_greatest, greatest, 1e-6 * greatest);
  const Json zoomed = get("/api/convergence", {{"from", "100"}, {"to", "120"}});
  EXPECT_EQ(zoomed["trial"].size(), 21u);
  EXPECT_EQ(zoomed["trial"].front(), 100);
}

TEST_F(Asked, ATrialIsToldWhileAnotherWrites) {
  const auto study = two();
  const Evaluator model = evaluator(study);
  Journal journal = Journal::open(study.run.journal, identity(study));
  begin();
  ASSERT_TRUE(wait_for([&] { return get("/api/study")["state"] == "running"; }));
  const DesignPoint point{{1.2, -20.0}};
  journal.append(Trial{point, {model(point), 0.1, 0.1, 0}});
  EXPECT_TRUE(wait_for([&] {
    const std::lock_guard lock(mutex_);
    for (const auto& [what, json] : events_)
      if (what == "study.toml trials" && json["total"] == 1) return true;
    return false;
  }));
  EXPECT_EQ(get("/api/study")["state"], "running");
  EXPECT_EQ(post("/api/run", {{"verb", "run"}}).status, 400) << "somebody runs it";
}

TEST_F(Asked, MeasuredAndSimulatedStandBesideEachOther) {
  const auto study = two();
  fit_all(study);
  begin();
  ASSERT_TRUE(wait_for([&] { return !get("/api/study")["best"].is_null(); }));
  const Json view = get("/api/comparison", {{"trial", "best"}});
  ASSERT_EQ(view["curves"].size(), 2u);
  EXPECT_EQ(view["curves"][0]["measured"].size(), 25u);
  EXPECT_EQ(view["curves"][0]["simulated"]["y"].size(), 25u);
  EXPECT_FALSE(view["curves"][0]["initial"].is_null());
  EXPECT_EQ(ask("/api/comparison", {{"trial", "100000"}}).status, 400);
  EXPECT_EQ(get("/api/kpis")["rows"].size(), 2u);
  EXPECT_TRUE(get("/api/target")["scatter"]["target"].size() > 0);
  EXPECT_FALSE(get("/api/identifiability")["why_not"].get<std::string>().empty());
  EXPECT_FALSE(get("/api/model")["numbers"].empty());
  const Json both = get("/api/compare", {{"other", "study.toml"}});
  ASSERT_EQ(both["studies"].size(), 2u);
  EXPECT_EQ(both["studies"][1]["no_intervals"], get("/api/identifiability")["why_not"]);
  EXPECT_EQ(view["no_bands"], both["studies"][0]["no_intervals"]);
  EXPECT_EQ(both["variables"][0]["missing"], Json({"", ""}));
}

TEST_F(Asked, SamplesOfThePosteriorAreThoseOfTheJournal) {
  const auto study = read("noise = \"200 N\"\n");
  fit_all(study);
  std::optional<correlation::Posterior> drawn;
  {
    Journal journal = Journal::open(study.run.journal, identity(study));
    const auto best = correlation::best_trial(study, journal);
    InlineExecutor executor(evaluator(study));
    const auto found =
        correlation::sample_posterior(study, best->point, executor, journal, {.max_steps = 100});
    ASSERT_TRUE(found && *found);
    drawn = **found;
  }
  begin();
  ASSERT_TRUE(wait_for([&] { return get("/api/study")["state"] == "ended"; }));
  const Json view = get("/api/identifiability")["posterior"];
  ASSERT_FALSE(view.is_null());
  EXPECT_EQ(view["verdict"], "stands");
  EXPECT_EQ(view["trials"], drawn->trials);
  ASSERT_EQ(view["variables"].size(), 2u);
  for (std::size_t a = 0; a < 2; ++a) {
    const Json& variable = view["variables"][a];
    EXPECT_EQ(variable["name"], study.space[drawn->axes[a]].name);
    const double median = drawn->value_at(study.space, a, drawn->shapes[a].median);
    EXPECT_NEAR(variable["median"], median, 1e-6 * std::abs(median));
    ASSERT_EQ(variable["draws"].size(), 400u);
    const double first = drawn->point(study.space, 0).values[a];
    EXPECT_NEAR(variable["draws"][0], first, 1e-6 * std::abs(first));
    // the noise is stated and the data are exact: both intervals hold the truth and are alike
    const double truth = a == 0 ? 1.3 : -22.0;
    EXPECT_LT(variable["interval"][0], truth);
    EXPECT_GT(variable["interval"][1], truth);
    EXPECT_FALSE(variable["linear"][0].is_null());
  }
}

TEST_F(Asked, TheFileIsChangedWhereThePageHasSeenIt) {
  two();
  begin();
  const Json file = get("/api/file");
  const Json edit{{"table", {"variable", "grip"}}, {"key", "upper"}, {"value", 1.75}};
  const Json body{{"version", file["version"]}, {"edits", {edit}}};
  const Response changed = post("/api/edit", body);
  EXPECT_EQ(changed.status, 200) << changed.body;
  EXPECT_EQ(post("/api/edit", body).status, 409) << "that version is gone";
  EXPECT_TRUE(wait_for([&] { return get("/api/study")["variables"][0]["upper"] == 1.75; }));
}

TEST_F(Asked, TheFormWritesNothingThatTheCheckRefuses) {
  two();
  begin();
  const Json file = get("/api/file");
  for (const Json& edit : {Json{{"table", {"variable", "grip"}}, {"key", "upper"}, {"value", -1e9}},
                           Json{{"table", {"optimizer"}}, {"key", "method"}, {"value", "guess"}}}) {
    const Response refused =
        post("/api/edit", Json{{"version", file["version"]}, {"edits", {edit}}});
    EXPECT_EQ(refused.status, 400) << refused.body;
    EXPECT_NE(refused.body.find("is not changed"), std::string::npos) << refused.body;
    EXPECT_EQ(get("/api/file")["text"], file["text"]);
  }
}

TEST_F(Asked, AJournalOfAnotherStudyIsSaidNotShown) {
  const auto study = two();
  fit_all(study);
  const std::string text = kHead + kTwo;
  write("study.toml",
        text + "[variable.more]\npath = \"PEY1\"\nlower = -1\nupper = 1\ninitial = 0\n");
  begin();
  ASSERT_TRUE(wait_for([&] { return get("/api/study")["state"] != "reading"; }));
  EXPECT_NE(get("/api/study")["error"], "");
  EXPECT_EQ(get("/api/trials")["rows"].size(), 0u) << "its points have a variable less";
  EXPECT_NE(ask("/api/comparison").body.find("another study"), std::string::npos);
  write("study.toml", text);
  EXPECT_TRUE(wait_for([&] { return get("/api/study")["error"] == ""; }));
  EXPECT_TRUE(wait_for([&] { return get("/api/trials")["total"].get<long>() > 0; }));
}

// While the page is open, the table of a test changes. The page must not show the best point of the
// earlier test with the present test.
TEST_F(Asked, AnEditedTableOfATestMakesItAnotherStudy) {
  const auto study = two();
  fit_all(study);
  begin();
  ASSERT_TRUE(wait_for([&] { return get("/api/trials")["total"].get<long>() > 0; }));
  EXPECT_EQ(get("/api/study")["error"], "");
  const std::string text = read_text_file(folder_ / "states.csv");
  std::string other = text;
  other.replace(other.find(",-12\n"), 5, ",-11.5\n");
  write("states.csv", other);
  ASSERT_TRUE(wait_for([&] { return get("/api/study")["error"] != ""; }));
  EXPECT_NE(get("/api/study")["error"].get<std::string>().find("another study"), std::string::npos);
  EXPECT_EQ(get("/api/trials")["rows"].size(), 0u);
  write("states.csv", text);
  EXPECT_TRUE(wait_for([&] { return get("/api/study")["error"] == ""; }));
}

TEST_F(Asked, AJournalThatWasMendedIsRead) {
  const auto study = two();
  fit_all(study);
  const std::string whole = read_text_file(study.run.journal);
  std::filesystem::remove(study.run.journal);  // no output replaces a journal
  write_text_file(study.run.journal, "no journal");
  begin();
  ASSERT_TRUE(wait_for([&] { return get("/api/study")["state"] != "reading"; }));
  EXPECT_NE(get("/api/study")["error"], "");
  EXPECT_EQ(get("/api/study")["state"], "stopped");
  write_text_file(study.run.journal, whole);
  EXPECT_TRUE(wait_for([&] { return get("/api/study")["error"] == ""; }));
  EXPECT_TRUE(wait_for([&] { return get("/api/study")["trials"].get<long>() > 0; }));
}

TEST_F(Asked, NoiseThatTheFitTellsIsFollowed) {
  two();
  const std::string noise = "noise = \"estimated\"\n";
  const auto study = read(noise + kTwo + noise);
  begin();
  ASSERT_TRUE(wait_for([&] { return get("/api/study")["state"] == "new"; }));
  {
    Journal journal = Journal::open(study.run.journal, identity(study));
    ThreadExecutor executor([&] { return evaluator(study); }, 1);
    correlation::run_stages(study, [&](const correlation::StageRun& stage) {
      const RunOptions options{.max_steps = stage.study.max_steps};
      return correlation::StageResult{correlation::fit(stage.study, executor, journal, options),
                                      &journal};
    });
  }
  const Journal journal = Journal::read(study.run.journal);
  const auto weighted = correlation::with_estimated_noise(study, journal);
  const double target = correlation::best_trial(weighted, journal)->target;
  EXPECT_TRUE(wait_for([&] { return get("/api/study")["state"] == "ended"; }));
  EXPECT_TRUE(wait_for([&] {
    const Json best = get("/api/study")["best"];
    return !best.is_null() && std::abs(best["target"].get<double>() - target) < 1e-6 * target;
  })) << get("/api/study")["best"]
      << " but " << target;
}

TEST_F(Asked, StudiesAreNamedAsTheirFilesStandInTheFolder) {
  two();
  std::filesystem::create_symlink("study.toml", folder_ / "linked.toml");
  std::filesystem::create_symlink("nowhere.toml", folder_ / "dangling.toml");
  std::filesystem::create_directory_symlink(".", folder_ / "loop");
  write(".study.17.1.toml", kHead);  // `latsch check` creates such a file for a moment
  begin();
  std::vector<std::string> names;
  const Json home = get("/api/home");
  for (const Json& one : home["studies"]) names.push_back(one["study"]);
  EXPECT_EQ(names, (std::vector<std::string>{"linked.toml", "study.toml"}));
}

TEST_F(Asked, AStudyThatCannotBeReadSaysWhy) {
  two();
  write("study.toml", "model = \"nowhere.toml\"\n[variable.x]\n");
  begin();
  ASSERT_TRUE(wait_for([&] { return get("/api/study")["state"] == "broken"; }));
  EXPECT_NE(get("/api/study")["error"].get<std::string>().find("study.toml"), std::string::npos);
  for (const char* path : {"/api/convergence",
                           "/api/comparison",
                           "/api/target",
                           "/api/kpis",
                           "/api/model",
                           "/api/scene",
                           "/api/section"})
    EXPECT_EQ(ask(path).status, 400) << path;
}

// Like `latsch new`, the test writes the study's files one after the other while the studio watches
// the folder.
TEST_F(Asked, AStudyWhoseMeasurementComesLaterIsReadThen) {
  two();
  const std::string measured = read_text_file(folder_ / "aligning.csv");
  std::filesystem::remove(folder_ / "aligning.csv");
  begin();
  ASSERT_TRUE(wait_for([&] { return get("/api/study")["state"] == "broken"; }));
  write("aligning.csv", "Mz [N*m]\nabout 3\n");
  std::this_thread::sleep_for(300ms);
  EXPECT_EQ(get("/api/study")["state"], "broken");
  write("aligning.csv", measured);
  EXPECT_TRUE(wait_for([&] { return get("/api/study")["state"] == "new"; }));
}

TEST_F(Asked, AStudyHalfWrittenStaysUntilItsFileIsGone) {
  two();
  begin();
  write("study.toml", "");
  EXPECT_TRUE(wait_for([&] { return get("/api/study")["state"] == "broken"; }));
  std::this_thread::sleep_for(3500ms);  // all studies are checked every three seconds
  EXPECT_EQ(get("/api/study")["state"], "broken");
  std::filesystem::remove(folder_ / "study.toml");
  EXPECT_TRUE(wait_for([&] { return ask("/api/study").status == 404; }));
}

TEST_F(Asked, WhatIsNotThereIsNotFound) {
  two();
  begin();
  EXPECT_EQ(ask("/api/study", {{"study", "../study.toml"}}).status, 404);
  EXPECT_EQ(ask("/api/nothing").status, 404);
  EXPECT_EQ(ask("/api/trials", {{"from", "x"}}).status, 400);
  EXPECT_EQ(post("/api/run", {{"verb", "rm"}}).status, 400);
  EXPECT_EQ(post("/api/stop", Json::object()).status, 400);
  const auto refusal = [](const Response& response) {
    EXPECT_EQ(response.status, 400) << response.body;
    return Json::parse(response.body)["error"].get<std::string>();
  };
  EXPECT_NE(refusal(ask("/api/trials", {{"order", "foo"}})).find("expected \"trial\" or"),
            std::string::npos);
  for (const char* most : {"1", "0", "-5"})
    EXPECT_NE(refusal(ask("/api/convergence", {{"most", most}})).find("at least 10"),
              std::string::npos);
  for (const char* from : {"0", "-3", "1.5"})
    EXPECT_EQ(ask("/api/trials", {{"from", from}}).status, 400) << from;
  for (const Json& workers : {Json("2"), Json(2.5), Json(-1), Json(1e9)})
    EXPECT_NE(refusal(post("/api/run", {{"verb", "run"}, {"workers", workers}}))
                  .find("expected a whole number, 0 to 1024"),
              std::string::npos)
        << workers;
  EXPECT_NE(refusal(post("/api/run", {{"verb", "run"}, {"anew", "yes"}})).find("true or false"),
            std::string::npos);
  EXPECT_EQ(studio_->answer({"POST", "/api/run", {}, "{", {}}).status, 400);
  EXPECT_EQ(studio_->answer({"POST", "/api/run", {}, "[1]", {}}).status, 400);
}

}  // namespace
}  // namespace latsch::studio
