// SPDX-License-Identifier: Apache-2.0
#include "optimization/strategy/hopeless_start.h"

#include <gtest/gtest.h>

#include "optimization/direct_search/gss.h"
#include "optimization/trust_region/residual_trust_region.h"

namespace latsch {
namespace {

const DesignSpace kSpace({{.name = "a", .initial = 0.1}, {.name = "b", .initial = 0.1}});

struct End {
  int trials = 0;
  std::optional<std::string> reason;
  bool succeeded = false;
};

template <class Method, class Model>
End run(const Model& model, int most = 500) {
  HopelessStart search(kSpace, std::make_unique<Method>(kSpace));
  End end;
  while (!search.converged() && end.trials < most) {
    const DesignPoint point = search.propose(1).front();
    const Result<Score> outcome = model(point);
    end.succeeded = end.succeeded || outcome.ok();
    search.observe(point, outcome);
    ++end.trials;
  }
  end.reason = search.reason();
  return end;
}

Result<Score> bowl(const DesignPoint& p) {
  const std::vector<double> r{p.values[0] - 0.7, p.values[1] - 0.6};
  return Score{.value = r[0] * r[0] + r[1] * r[1], .residuals = r};
}

TEST(HopelessStart, EndsWithTheReasonWhereEveryPointFailsForIt) {
  int trial = 0;
  const auto model = [&](const DesignPoint&) -> Result<Score> {
    return Failure{"license server does not answer, in folder /tmp/w" + std::to_string(++trial)};
  };
  for (const End& end : {run<Gss>(model), run<ResidualTrustRegion>(model)}) {
    EXPECT_LE(end.trials, 15);
    ASSERT_TRUE(end.reason);
    EXPECT_NE(end.reason->find("license server"), std::string::npos);
  }
}

TEST(HopelessStart, ARegionAroundTheStartThatFailsIsNotHopeless) {
  const auto model = [](const DesignPoint& p) -> Result<Score> {
    if (p.values[0] + p.values[1] < 0.6) return Failure{"too soft"};
    return bowl(p);
  };
  const End end = run<ResidualTrustRegion>(model);
  EXPECT_FALSE(end.reason);
  EXPECT_TRUE(end.succeeded);
}

TEST(HopelessStart, FailuresForDifferentReasonsAreLeftToTheOptimizer) {
  int trial = 0;
  const auto model = [&](const DesignPoint&) -> Result<Score> {
    return Failure{trial++ % 2 ? "buckles" : "no contact"};
  };
  EXPECT_FALSE(run<Gss>(model, 60).reason);
}

TEST(HopelessStart, ChangesNothingWhereASearchSucceeds) {
  HopelessStart watched(kSpace, std::make_unique<Gss>(kSpace));
  Gss plain(kSpace);
  for (int i = 0; i < 100 && !plain.converged(); ++i) {
    ASSERT_EQ(watched.propose(4), plain.propose(4));
    const DesignPoint point = plain.propose(1).front();
    watched.observe(point, bowl(point));
    plain.observe(point, bowl(point));
  }
  EXPECT_EQ(watched.converged(), plain.converged());
}

TEST(HopelessStart, AReasonIsItsWords) {
  EXPECT_EQ(words_of("residual 1e-3 N at step 4 in /a/b"),
            words_of("residual 0.2 N at step 5 in c/d"));
  EXPECT_NE(words_of("no license"), words_of("no equilibrium"));
}

}  // namespace
}  // namespace latsch
