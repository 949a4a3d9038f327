#include "wheatstone/share/page.h"

#include <gmock/gmock.h>

namespace wheatstone::page_test {

using testing::HasSubstr;
using testing::Not;

SharedPicture small_picture() { return {R"({"title":"a"})", {{"layer-0", {1, 2, 3}}}, "jpeg", 4, 3}; }

TEST(Page, HostileWordsStayWords) {
  const std::string hostile = R"x("><script>alert(1)</script><!--)x";
  const std::string page = html_page(small_picture(), {.title = hostile, .description = hostile, .caption = hostile});
  EXPECT_THAT(page, Not(HasSubstr("<script>alert")));
  EXPECT_THAT(page, HasSubstr("<title>&quot;&gt;&lt;script&gt;alert(1)&lt;/script&gt;&lt;!--</title>"));
}

TEST(Page, HostileFactsCannotEndTheirScript) {
  SharedPicture picture = small_picture();
  picture.facts = R"x({"title":"</script><script>alert(1)"})x";
  EXPECT_THAT(html_page(picture, {.title = "a"}), HasSubstr(R"x({"title":"\u003c/script>\u003cscript>alert(1)"})x"));
}

TEST(Page, AllowsItsOwnCodeAndNoAddress) {
  const std::string page = html_page(small_picture(), {.title = "a"});
  EXPECT_THAT(page, HasSubstr("content=\"default-src 'none'; script-src 'sha256-"));
  EXPECT_THAT(page, Not(HasSubstr("unsafe")));
  EXPECT_THAT(page, Not(HasSubstr("http://")));
  EXPECT_THAT(page, Not(HasSubstr("https://")));
}

TEST(Page, HoldsPartsWithTheirLength) {
  EXPECT_THAT(html_page(small_picture(), {.title = "a"}), HasSubstr("data-part=\"picture/layer-0\">base64:3:AQID<"));
}

TEST(Page, CodeTakesAtMost100Kilobytes) { EXPECT_LT(page_element_code().size(), 100'000u); }

}  // namespace wheatstone::page_test
