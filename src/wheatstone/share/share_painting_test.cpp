#include "wheatstone/share/share_pictures.h"

#include <gmock/gmock.h>

#include "scenes/two_surfaces.h"
#include "wheatstone/painting/paint.h"

namespace wheatstone::share_painting_test {

TEST(SharePainting, BecomesSmallerUntilThePageHasTheSizeThatIsWanted) {
  const Painting painted =
      paint(test_scene::photographs(), test_scene::geometry(), style_by_name("impressionist")).painting;
  const Painting painting = placed(painted, {.scale = 2});
  const SharedPicture whole = share_painting(painting, {});
  EXPECT_EQ(whole.width, 2 * test_scene::width);

  const std::size_t most_bytes = page_bytes(whole) * 3 / 4;
  const SharedPicture half = share_painting(painting, {.most_bytes = most_bytes});
  EXPECT_LE(html_page(half, {}).size(), most_bytes);
  EXPECT_EQ(half.width, test_scene::width);
  EXPECT_EQ(half.height, test_scene::height);
  EXPECT_THAT(half.note, testing::HasSubstr("the picture is 160x120 pixels"));
}

}  // namespace wheatstone::share_painting_test
