// SPDX-License-Identifier: Apache-2.0
#include "base/utf8.h"

#include <gtest/gtest.h>

namespace latsch {
namespace {

// The first and last characters of every length [RFC 3629, 3].
TEST(Utf8, HasCharactersOfOneToFourBytes) {
  for (const char* text : {"",
                           "a",
                           "\x7f",
                           "\xc2\x80",
                           "\xdf\xbf",
                           "\xe0\xa0\x80",
                           "\xed\x9f\xbf",
                           "\xee\x80\x80",
                           "\xef\xbf\xbf",
                           "\xf0\x90\x80\x80",
                           "\xf4\x8f\xbf\xbf"}) {
    EXPECT_TRUE(is_utf8(text)) << text;
    EXPECT_EQ(replaced_where_no_utf8(text), text);
  }
}

TEST(Utf8, RefusesLongerFormsSurrogatesAndPieces) {
  for (const char* bytes : {"\x80",
                            "\xc0\xaf",          // "/" in two bytes
                            "\xe0\x80\xaf",      // "/" in three bytes
                            "\xf0\x80\x80\xaf",  // "/" in four bytes
                            "\xed\xa0\x80",      // U+D800
                            "\xf4\x90\x80\x80",  // U+110000
                            "\xf5\x80\x80\x80",
                            "\xff",
                            "a\xc3",
                            "\xe2\x82",
                            "\xc3(",
                            "\xe2\x82("}) {
    EXPECT_FALSE(is_utf8(bytes)) << bytes;
    EXPECT_TRUE(is_utf8(replaced_where_no_utf8(bytes)));
  }
  EXPECT_EQ(replaced_where_no_utf8("K\xf6k"), "K\xef\xbf\xbdk");
}

}  // namespace
}  // namespace latsch
