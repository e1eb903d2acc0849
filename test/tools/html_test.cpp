// SPDX-License-Identifier: BSD-3-Clause
#include "../../tools/html.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace rhmap::tools {
namespace {

TEST(Html, EscapesWhatMeansSomething) { EXPECT_EQ(escapeHtml("a<b>&\"c\""), "a&lt;b&gt;&amp;&quot;c&quot;"); }

TEST(Html, Base64IsThatOfRfc4648) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xff\xfe"), "//4=");
}

TEST(Html, FillsInEachName) {
  EXPECT_EQ(fillIn("<a>{{x}}</a>{{y}}{{x}}", {{"x", "1"}, {"y", "{{x}}"}}), "<a>1</a>{{x}}1");
  EXPECT_EQ(fillIn("nothing {here}", {}), "nothing {here}");
  EXPECT_THROW(fillIn("{{z}}", {}), std::logic_error);
}

}  // namespace
}  // namespace rhmap::tools
