// SPDX-License-Identifier: Apache-2.0
#include "evaluation/trial/encoding.h"

#include <gtest/gtest.h>

namespace latsch {
namespace {

TEST(Encoding, SlopesStandBehindTheirChannel) {
  Channels channels;
  channels.add({"Fz", "N", {1000.0, 2000.0}});
  channels.add({"Fy", "N", {10.0, 20.0}, {1.0, 2.0, 3.0, 4.0}});
  const std::string bytes = encode(Outcome{.result = channels});
  const auto back = decode_outcome(bytes);
  ASSERT_TRUE(back && back->result);
  EXPECT_TRUE(*back->result == channels);
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_FALSE(decode_outcome(std::string_view(bytes).substr(0, size)));
}

TEST(Encoding, HashIsFnv1a) {
  // The test vectors are those of draft-eastlake-fnv, appendix C.
  EXPECT_EQ(hash(""), 0xcbf29ce484222325u);
  EXPECT_EQ(hash("a"), 0xaf63dc4c8601ec8cu);
  EXPECT_EQ(hash("foobar"), 0x85944171f73967e8u);
}

}  // namespace
}  // namespace latsch
