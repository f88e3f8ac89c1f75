// SPDX-License-Identifier: Apache-2.0
#include "formats/mesh/hexahedron.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <set>

namespace latsch::formats {
namespace {

// Faces of the eight-node brick element in the CalculiX CrunchiX user's manual 2.20: face 1:
// 1-2-3-4, face 2: 5-8-7-6, face 3: 1-5-6-2, face 4: 2-6-7-3, face 5: 3-7-8-4, face 6: 4-8-5-1.
TEST(Hexahedron, FacesAreThoseOfCalculix) {
  const std::set<int> expected[6] = {
      {0, 1, 2, 3}, {4, 7, 6, 5}, {0, 4, 5, 1}, {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 4, 0}};
  for (int face = 1; face <= 6; ++face) {
    const auto corners = face_corners(face_direction(face));
    EXPECT_EQ(std::set<int>(corners.begin(), corners.end()), expected[face - 1]) << face;
  }
}

Hex brick() {
  Hex X;
  X << 0, 2, 2, 0, 0, 2, 2, 0,  //
      0, 0, 3, 3, 0, 0, 3, 3,   //
      0, 0, 0, 0, 5, 5, 5, 5;
  return X;
}

TEST(Hexahedron, AllTwentyFourRenumberingsAreProperAndPutTheAxesInPlace) {
  const Hex X = brick();
  int count = 0;
  for (int x = 0; x < 3; ++x)
    for (int z = 0; z < 3; ++z)
      for (int sx : {-1, 1})
        for (int sz : {-1, 1}) {
          if (x == z) continue;
          ++count;
          const LocalDirection xi{x, sx}, zeta{z, sz};
          const auto present = renumbering(xi, zeta);
          Hex Y;
          for (int a = 0; a < 8; ++a) Y.col(a) = X.col(present[a]);
          EXPECT_TRUE(span(Y, {0, 1}) == span(X, xi));
          EXPECT_TRUE(span(Y, {2, 1}) == span(X, zeta));
          EXPECT_DOUBLE_EQ(smallest_corner_volume(Y), 2.0 * 3.0 * 5.0);  // not mirrored
        }
  EXPECT_EQ(count, 24);
}

TEST(Hexahedron, AMirroredElementHasANegativeCorner) {
  Hex X = brick();
  X.row(0) *= -1.0;
  EXPECT_DOUBLE_EQ(smallest_corner_volume(X), -30.0);
}

}  // namespace
}  // namespace latsch::formats
