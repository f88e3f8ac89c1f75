// SPDX-License-Identifier: Apache-2.0
// Compares derivatives, from the model to the Jacobian of a score, with central differences of the
// residuals; and a fit that uses them.
#include "correlation/study/study_slopes.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>

#include "correlation/search/study_method.h"
#include "correlation/search/study_reuse_testing.h"
#include "correlation/target/study_trials.h"

namespace latsch::correlation {
namespace {

class StudySlopes : public FittedStudy {
 protected:
  Study read_squares(const std::string& more) { return read("exponent = 2\n" + more); }
};

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

std::vector<double> residuals_at(const Study& study, const DesignPoint& point) {
  return objective(study)(point, *evaluator(study)(point))->residuals;
}

/// Returns the matrix whose column i is (r(x + h e_i) - r(x - h e_i)) / 2h; its errors are h^2 r'''
/// / 6 and eps r / h.
RowMajor central_differences(const Study& study, const DesignPoint& point) {
  const auto r = residuals_at(study, point);
  RowMajor J(std::ssize(r), study.space.size());
  for (int i = 0; i < J.cols(); ++i) {
    DesignPoint up = point, down = point;
    const double h = 1e-5 * std::abs(point.values[static_cast<std::size_t>(i)]);
    up.values[static_cast<std::size_t>(i)] += h;
    down.values[static_cast<std::size_t>(i)] -= h;
    const auto a = residuals_at(study, up), b = residuals_at(study, down);
    for (int k = 0; k < J.rows(); ++k)
      J(k, i) = (a[static_cast<std::size_t>(k)] - b[static_cast<std::size_t>(k)]) / (2.0 * h);
  }
  return J;
}

void expect_exact(const Study& study) {
  ASSERT_FALSE(reason_without_slopes(study)) << *reason_without_slopes(study);
  const DesignPoint point{{1.1, -18.0}};
  const auto score = objective(study)(point, *evaluator(study)(point));
  ASSERT_TRUE(score);
  const RowMajor differences = central_differences(study, point);
  ASSERT_EQ(std::ssize(score->jacobian), differences.size());
  const Eigen::Map<const RowMajor> J(
      score->jacobian.data(), differences.rows(), differences.cols());
  EXPECT_LT((J - differences).norm(), 1e-8 * differences.norm());
  EXPECT_GT(J.colwise().norm().minCoeff(), 0.0);
}

TEST_F(StudySlopes, AreThoseOfTheResiduals) { expect_exact(read_squares("")); }

// A search with derivatives minimizes the sum of squares, whatever the exponent of the target that
// it reports.
TEST_F(StudySlopes, AreOfResidualsOfAnyExponent) {
  for (const char* exponent : {"1", "1.5", "4"}) {
    const Study study = read(std::string("exponent = ") + exponent + "\n");
    expect_exact(study);
    EXPECT_EQ(method_of(study).method, Method::levenberg_marquardt);
    EXPECT_TRUE(study.asks_slopes);
  }
}

TEST_F(StudySlopes, OfACurveAboutItsMean) {
  expect_exact(read_squares("compare = \"about_mean\"\n"));
}

// Half of the values lie beyond the scale of the loss.
TEST_F(StudySlopes, CountNoiseRobustLossAndPriors) {
  for (const char* loss : {"huber", "cauchy"}) {
    expect_exact(
        read_squares(std::string("noise = \"100 N + 2 %\"\nloss = \"") + loss +
                     "\"\n[experiment.one]\nkind = \"values\"\nchannel = \"steady/Fy\"\n"
                     "value = \"900 N\"\nof = \"mean\"\nscale = \"100 N\"\nnoise = \"5 N\"\n"
                     "exponent = 2\nweight = 3\n[tie.camber]\npath = \"PDY2\"\n"
                     "follows = \"grip\"\nfactor = -0.1\n"));
  }
  std::string head = kHead;
  const std::string linear = "initial = 0.7\n";
  head.replace(head.find(linear),
               linear.size(),
               "initial = 0.7\nscale = \"logarithmic\"\nprior = 1\nprior_sigma = \"10 %\"\n");
  write("study.toml", head + "exponent = 2\nnoise = \"30 N\"\n");
  expect_exact(read_study(folder_ / "study.toml", experiment::language()));
}

// The true values are 1.3 and -22. The residuals vanish there, so Gauss-Newton steps converge
// quadratically.
TEST_F(StudySlopes, LetAFitEndInAFewTrials) {
  const Study study = read_squares("");
  EXPECT_EQ(method_of(study).method, Method::levenberg_marquardt);
  const auto fits = fit_all(study);
  const latsch::Run& run = fits.front().run;
  EXPECT_EQ(run.end, RunEnd::converged);
  EXPECT_LE(run.steps.size(), 12u);
  EXPECT_NEAR(run.best()->point.values[0], 1.3, 1e-6);
  EXPECT_NEAR(run.best()->point.values[1], -22.0, 1e-4);
  evaluated_ = 0;
  // this fit reads all trials from the journal, with their derivatives
  expect_same(fits, fit_all(study));
  EXPECT_EQ(evaluated_, 0);
}

TEST_F(StudySlopes, AreAskedForAgainWhereATrialWasKeptWithoutThem) {
  Study study = read_squares("");
  {
    Study plain = study;
    plain.asks_slopes = false;
    Journal journal = Journal::open(study.run.journal, identity(study));
    const DesignPoint start = study.space.initial();
    journal.append({start, evaluate(evaluator(plain), start)});
    EXPECT_FALSE(journal.trials().front().outcome.result->has_slopes());
  }
  const auto fits = fit_all(study);
  EXPECT_EQ(fits.front().run.end, RunEnd::converged);
  EXPECT_EQ(evaluated_, std::ssize(fits.front().run.steps));
}

TEST_F(StudySlopes, WhereTheyEndIsSaidByName) {
  const auto without = [&](const std::string& more, const std::string& part) {
    const Study study = read(more);
    const auto reason = reason_without_slopes(study);
    ASSERT_TRUE(reason) << more;
    EXPECT_NE(reason->find(part), std::string::npos) << *reason;
    EXPECT_NE(method_of(study).method, Method::levenberg_marquardt);
    EXPECT_FALSE(objective(study)(*evaluator(study)(study.space.initial()))->jacobian.size());
  };
  write("sweep.toml",
        "kind = \"slip_sweep\"\nspeed = \"60 km/h\"\nload = \"4 kN\"\n"
        "alpha = [\"-5 deg\", \"5 deg\"]\nduration = \"0.1 s\"\n");
  write("swept.csv", "time [s],Fy [N]\n0.46,100\n0.54,-100\n");
  without(
      "exponent = 2\n[test.sweep]\nfile = \"sweep.toml\"\n[experiment.sweep]\nkind = \"curve\"\n"
      "x = \"sweep/time\"\ny = \"sweep/Fy\"\nmeasurement = \"swept.csv\"\nexponent = 2\n",
      "sweep/");
  try {
    read(
        "exponent = 2\n[test.sweep]\nfile = \"sweep.toml\"\n[experiment.sweep]\nkind = \"curve\"\n"
        "x = \"sweep/time\"\ny = \"sweep/Fy\"\nmeasurement = \"swept.csv\"\nexponent = 2\n"
        "[optimizer]\nmethod = \"levenberg_marquardt\"\n");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("sweep/"), std::string::npos) << error.what();
    EXPECT_GT(error.place().line, 0);
  }
}

}  // namespace
}  // namespace latsch::correlation
