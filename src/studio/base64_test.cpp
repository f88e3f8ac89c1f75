// SPDX-License-Identifier: Apache-2.0
#include "studio/base64.h"

#include <gtest/gtest.h>

namespace latsch::studio {
namespace {

TEST(Base64, IsThatOfTheStandard) {  // expected texts from RFC 4648, section 10
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
}

}  // namespace
}  // namespace latsch::studio
