// SPDX-License-Identifier: Apache-2.0
// Profile likelihood: how well the data can still be explained when one variable is held at another
// value and all others are fitted anew.
//
//   S_i(v) = least sum of squares with u_i = v                [Raue et al., Bioinformatics 25
//   (2009)
//                                                              1923, eq. (5)]
// All v with S_i(v) - S <= s^2 t^2 belong to the confidence interval of variable i. Unlike the
// linear interval it sees curvature, bounds and further minima. From the shape follows a verdict:
//   identifiable     S_i rises above the threshold on both sides
//   one_sided        on one only: the data give a limit, not a value
//   flat             on none: any value between the bounds explains the data as well
//   several_minima   S_i falls again behind a rise: a search can end in the wrong basin
//
// The ladder starts at the best point in steps as long as the linear interval and lengthens them to
// a tenth of the range, up to both bounds; a rung that leaps over the threshold is halved. Each
// rung is a refit that starts where the last ended; it may miss a better basin of the other
// variables, so S_i is an upper bound. Linear constraints are kept to, and end a ladder as bounds
// do.
#pragma once

#include <string>
#include <vector>

#include "optimization/refit.h"

namespace latsch {

struct ProfilePoint {
  Eigen::VectorXd u;
  double S;
};

/// One way outward from the best point: ask and tell, as Refit.
class ProfileBranch {
 public:
  /// `half`: of the linear confidence interval; `threshold`: s^2 t^2. direction: +1 or -1.
  ProfileBranch(const Linearization& best,
                int variable,
                int direction,
                double half,
                double threshold,
                const FeasibleRegion& region);

  /// nullopt at the end of the ladder.
  std::optional<Eigen::VectorXd> wanted() const;
  void observe(const std::optional<Eigen::VectorXd>& residuals);

  /// From the best point outward, without it.
  const std::vector<ProfilePoint>& points() const { return points_; }

 private:
  struct Bracket {
    Linearization inner, outer;  // below the threshold, and far above it
    double upper;                // the variable at the least rung known to be above
    int halvings = 0;
  };

  void next_rung(const Linearization& from);
  void climb(const Linearization& from, double to);
  void halve();
  bool within(const Linearization& at) const { return at.sum_of_squares() - least_ <= threshold_; }
  bool leaps(const Linearization& from, const Linearization& to) const;
  void insert(const Linearization& reached);

  int variable_, direction_;
  double length_, threshold_, least_;
  FeasibleRegion region_;
  double end_;  // the last value of the variable inside it
  std::vector<int> free_;
  Linearization last_;  // rung of the ladder
  std::optional<Bracket> bracket_;
  std::optional<Refit> refit_;
  std::vector<ProfilePoint> points_;
};

enum class Verdict { identifiable, one_sided, flat, several_minima };

struct Profile {
  int variable = 0;
  std::vector<ProfilePoint> points;  // ascending in the variable, the best point among them
  double least = 0.0;                // S that the profile is measured against
  double threshold = 0.0;
  Interval interval{};  // where S - least crosses the threshold; infinite where never
  Verdict verdict = Verdict::flat;
  std::vector<int> other_minima;  // places in `points`
};

/// Joins the two branches of a variable and judges.
Profile judge(const Linearization& best,
              int variable,
              const ProfileBranch& down,
              const ProfileBranch& up,
              double threshold);

/// "identifiable", "one-sided", "flat", "several minima".
std::string name(Verdict verdict);
/// The same as a sentence: "one-sided: the data give only an upper limit".
std::string in_words(const Profile& profile);

}  // namespace latsch
