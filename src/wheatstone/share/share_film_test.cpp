#include "wheatstone/share/share_pictures.h"

#include <gmock/gmock.h>

#include "temporary_folder.h"
#include "throws_error.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/video/film_writer.h"

namespace wheatstone::share_film_test {

using testing::HasSubstr;
using testing::Not;

void write_small_film(const std::filesystem::path& path, const FilmWriterOptions& options) {
  FilmWriter writer(path, options);
  writer.write({.picture = Image<Rgb8>(64, 32, {200, 100, 50}), .time_base = {1, 24}, .duration = 1});
  writer.finish();
}

TEST(ShareFilm, IsInsideThePageOrBesideItWhereItIsLarger) {
  const TemporaryFolder folder;
  const std::filesystem::path film = folder / "a film.mp4";
  write_small_film(film, {.frame_rate = {24, 1}});
  const SharedPicture inside = share_film(film, {.page = folder / "page.html", .layout = StereoLayout::right_left});
  EXPECT_EQ(inside.width, 32);
  ASSERT_EQ(inside.parts.size(), 1u);
  EXPECT_EQ(inside.parts[0].bytes.size(), std::filesystem::file_size(film));
  EXPECT_THAT(inside.facts, HasSubstr(R"("leftwards":true)"));
  EXPECT_THAT(html_page(inside, {}), Not(HasSubstr("'self'")));

  const SharedPicture beside =
      share_film(film, {.page = folder / "pages/page.html", .layout = StereoLayout::right_left, .most_bytes = 1000});
  EXPECT_TRUE(beside.parts.empty());
  EXPECT_THAT(beside.facts, HasSubstr(R"("file":"../a%20film.mp4")"));
  EXPECT_THAT(beside.note, HasSubstr("from where it is"));
  EXPECT_THAT(html_page(beside, {}), HasSubstr("media-src 'self' blob:;"));
}

TEST(ShareFilm, RefusesSubtitlesThatBrowsersDoNotRead) {
  const TemporaryFolder folder;
  write_small_film(folder / "film.mp4", {.layout = StereoLayout::left_right, .frame_rate = {24, 1}});
  write_whole_file(folder / "film.srt", "1\n00:00:00,000 --> 00:00:01,000\nFruit\n");
  expect_error(ErrorKind::bad_input, "film.srt: does not begin with WEBVTT",
               [&] { share_film(folder / "film.mp4", {.subtitles = folder / "film.srt"}); });
}

TEST(ShareFilm, RefusesWhatBrowsersDoNotPlayAndPagesDoNotShow) {
  const TemporaryFolder folder;
  write_small_film(folder / "lossless.mkv", {.codec = "ffv1", .layout = StereoLayout::left_right});
  expect_error(ErrorKind::bad_input, "ffv1 in matroska, which browsers do not play",
               [&] { share_film(folder / "lossless.mkv", {}); });
  write_small_film(folder / "mono.mp4", {.frame_rate = {24, 1}});
  expect_error(ErrorKind::bad_input, "its layout is mono, expected both eyes side by side",
               [&] { share_film(folder / "mono.mp4", {.layout = StereoLayout::mono}); });
}

}  // namespace wheatstone::share_film_test
