// SPDX-License-Identifier: Apache-2.0
#include "studio/http/target.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace latsch::studio {
namespace {

using Query = std::map<std::string, std::string>;

TEST(Target, IsPathAndQueryDecoded) {
  const Target target =
      parse_target("/api/study?study=tires%2Fa+b%2B.toml&weights=force:2,modes:0.5&x&y=&&z=1=2");
  EXPECT_EQ(target.path, "/api/study");
  EXPECT_EQ(target.query,
            (Query{{"study", "tires/a b+.toml"},
                   {"weights", "force:2,modes:0.5"},
                   {"x", ""},
                   {"y", ""},
                   {"z", "1=2"}}));
  EXPECT_EQ(parse_target("/").path, "/");
  EXPECT_TRUE(parse_target("/?").query.empty());
  EXPECT_EQ(parse_target("/gr%C3%BCn+c..d/...").path, "/gr\xc3\xbcn+c..d/...");
}

TEST(Target, ThatCouldMeanAnotherPlaceIsRefused) {
  for (const char* target : {"",
                             "x",
                             "*",
                             "http://127.0.0.1/",
                             "/..",
                             "/../etc/passwd",
                             "/a/../../etc/passwd",
                             "/./a",
                             "/a/.",
                             "/%2e%2e/etc/passwd",
                             "/..%2fetc/passwd",
                             "/%2E%2E%2Fetc",
                             "/..\\etc",
                             "/%5c..",
                             "/a%0d%0aSet-Cookie:x",
                             "/a%00.html",
                             "/%7f"}) {
    EXPECT_THROW(parse_target(target), InputError) << target;
  }
}

TEST(Target, ThatIsNotEncodedWellIsRefused) {
  for (const char* target : {"/%",
                             "/%1",
                             "/%zz",
                             "/%+1",
                             "/%-1",
                             "/%0x",
                             "/\xff",
                             "/%ff",
                             "/%c0%ae%c0%ae/etc",  // overlong encodings of ".."
                             "/?a=%ed%a0%80",
                             "/?a=%00",
                             "/?%ff=1",
                             "/?a=1&a=2",
                             "/?a=1&%61=2"}) {
    EXPECT_THROW(parse_target(target), InputError) << target;
  }
}

}  // namespace
}  // namespace latsch::studio
