// What only a real film can tell, where there is one.

#include <gtest/gtest.h>

#include <filesystem>
#include <optional>

#include "shared_data.h"
#include "wheatstone/motion/flow.h"
#include "wheatstone/video/film_reader.h"

namespace wheatstone::real_film_test {

TEST(FindCutLong, AWalkThroughTheStreetsHasNone) {
  const std::filesystem::path path = shared_data() / "video/tokyo_walk_mono.mp4";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is missing";
  FilmReader film = open_film(path);
  Image<Rgb8> before;
  Frame frame;
  for (int i = 0; i < 60; ++i) {
    ASSERT_TRUE(film.read(frame));
    if (i > 0) {
      const FrameChange change = find_cut(before, frame.picture);
      EXPECT_FALSE(change.cut) << i;
      EXPECT_GT(change.confirmed_share, 0.9) << i;
    }
    before = std::move(frame.picture);
  }
  // Where a picture of the same size is spliced in, there is one.
  Image<Rgb8> other(before.width(), before.height());
  for (int y = 0; y < other.height(); ++y)
    for (int x = 0; x < other.width(); ++x)
      other(x, y) = {static_cast<std::uint8_t>(x * 7 % 256), static_cast<std::uint8_t>(y * 5 % 256), 90};
  EXPECT_TRUE(find_cut(before, other).cut);
}

}  // namespace wheatstone::real_film_test
