#include "wheatstone/files/text_encoding.h"

#include <gtest/gtest.h>

namespace wheatstone::text_encoding_test {

TEST(HtmlText, LeavesNothingThatBeginsATagOrEndsAnAttribute) {
  EXPECT_EQ(html_text(R"(<b title="a" id='c'> & x)"), "&lt;b title=&quot;a&quot; id=&#39;c&#39;&gt; &amp; x");
}

TEST(HtmlText, IsAlwaysUtf8) {
  EXPECT_EQ(html_text("Äpfel \xe2\x82\xac \xf0\x9f\x8d\x8f"), "Äpfel \xe2\x82\xac \xf0\x9f\x8d\x8f");
  EXPECT_EQ(html_text("a\xff z"), "a\xef\xbf\xbd z");
  EXPECT_EQ(html_text("\xc3<"), "\xef\xbf\xbd&lt;");                     // breaks off
  EXPECT_EQ(html_text("\xc0\xaf"), "\xef\xbf\xbd\xef\xbf\xbd");          // longer than needed
  EXPECT_EQ(html_text("\xed\xa0\x80").find('\xed'), std::string::npos);  // half of a pair
}

}  // namespace wheatstone::text_encoding_test
