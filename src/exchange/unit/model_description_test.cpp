// SPDX-License-Identifier: Apache-2.0
#include "exchange/unit/model_description.h"

#include <gtest/gtest.h>

namespace latsch::exchange {
namespace {

TEST(ModelDescription, EscapesWhatXmlTakesForItsOwn) {
  // The value of an attribute must not contain < or &, nor the quotes around it [XML 1.0, 2.3].
  const UnitTitle title{"a <b> & \"c\"\n", "d\t", "{1}", 1e-3};
  for (const FmiVersion version : {FmiVersion::fmi2, FmiVersion::fmi3}) {
    const std::string text = model_description(version, title, {});
    EXPECT_NE(text.find("modelName=\"a &lt;b&gt; &amp; &quot;c&quot; \""), text.npos) << text;
    EXPECT_NE(text.find("description=\"d \""), text.npos) << text;
  }
}

TEST(ModelDescription, ABinaryHasTheNameOfACIdentifier) {
  EXPECT_EQ(identifier_of("passenger_205_55R16"), "passenger_205_55R16");
  EXPECT_EQ(identifier_of("205/55 R16-a"), "_205_55_R16_a");
  EXPECT_EQ(identifier_of("Reifen ä"), "Reifen___");
  EXPECT_EQ(identifier_of(""), "unit");
}

}  // namespace
}  // namespace latsch::exchange
