#include "wheatstone/files/html_text.h"

#include <gtest/gtest.h>

namespace wheatstone {
namespace {

TEST(HtmlText, LeavesNothingThatBeginsATagOrEndsAnAttribute) {
  EXPECT_EQ(html_text(R"(<b title="a" id='c'> & x)"), "&lt;b title=&quot;a&quot; id=&#39;c&#39;&gt; &amp; x");
}

}  // namespace
}  // namespace wheatstone
