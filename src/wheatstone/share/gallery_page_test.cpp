// The page that leads to many.

#include "wheatstone/share/gallery_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "temporary_folder.h"

namespace wheatstone::gallery_page_test {

using testing::HasSubstr;
using testing::Not;

TEST(GalleryPage, LeadsToThePagesThatHaveAPicture) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "trip");
  put_bytes(folder / "trip/a b#1.html", html_page({}, {.title = "Tea & <cake>", .description = {}, .caption = {}}));
  put_bytes(folder / "trip/a b#1.jpg", "a picture");
  put_bytes(folder / "plain.html", "no page of ours");
  put_bytes(folder / "plain.jpg", "a picture");
  put_bytes(folder / "index.html", "the gallery of an earlier run");
  const std::vector<GalleryEntry> entries = gallery_entries(folder / "");
  ASSERT_EQ(entries.size(), 2U);
  EXPECT_EQ(entries[0].title, "plain");
  EXPECT_EQ(entries[1].title, "Tea & <cake>");
  const std::string page = gallery_page(entries, {.title = "A \"trip\"", .description = {}, .caption = "In <May>"});
  EXPECT_THAT(page, HasSubstr("href=\"trip/a%20b%231.html\""));
  EXPECT_THAT(page, HasSubstr("src=\"trip/a%20b%231.jpg\" alt=\"Tea &amp; &lt;cake&gt;\""));
  EXPECT_THAT(page, HasSubstr("<h1>A &quot;trip&quot;</h1>"));
  EXPECT_THAT(page, HasSubstr("<p>In &lt;May&gt;</p>"));
  EXPECT_THAT(page, Not(HasSubstr("<script")));
}

}  // namespace wheatstone::gallery_page_test
