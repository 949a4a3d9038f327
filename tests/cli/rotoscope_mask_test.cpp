// Films that are painted within masks on the command line: what is made, and what is refused in one line.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "cli/run_program.h"
#include "scenes/film_of_scenes.h"
#include "wheatstone/pictures/read_image.h"
#include "wheatstone/pictures/write_image.h"

namespace wheatstone::rotoscope_mask_test {

namespace fs = std::filesystem;
using testing::HasSubstr;
using Words = std::vector<std::string>;

/// Five frames for two eyes, and masks of the left half of an eye.
class MaskedLine : public testing::Test {
 protected:
  MaskedLine() {
    make_film_of_scenes(folder_ / "film.mp4", 5, {});
    Image<Rgb8> mask(96, 64);
    for (int y = 0; y < 64; ++y)
      for (int x = 0; x < 48; ++x) mask(x, y) = {255, 255, 255};
    write_image(folder_ / "half.png", mask);
    for (const char* name : {"few_1.png", "few_2.png", "few_3.png", "few_4.png"}) write_image(folder_ / name, mask);
    write_image(folder_ / "small.png", Image<Rgb8>(40, 40));
  }
  ProgramResult rotoscope(const Words& words) const {
    Words line{"rotoscope", "film.mp4", "--quiet"};
    line.insert(line.end(), words.begin(), words.end());
    return run_program(line, {.folder = folder_ / ""});
  }
  TemporaryFolder folder_;
};

TEST_F(MaskedLine, LeavesTheFilmAsItIsOrPaintsItOtherwise) {
  for (const Words& words : {Words{"--mask", "half.png", "-o", "own_%d.png"},
                             {"--mask", "half.png", "--outside", "posterise", "-o", "other_%d.png"},
                             {"--style", "posterise", "--depth-budget", "full", "-o", "all_%d.png"}}) {
    const ProgramResult result = rotoscope(words);
    ASSERT_EQ(result.exit_code, 0) << result.errors;
  }
  const Image<Rgb8> film = frames_of(folder_ / "film.mp4").front().picture, own = read_image(folder_ / "own_1.png"),
                    other = read_image(folder_ / "other_1.png"), all = read_image(folder_ / "all_1.png");
  for (int y = 0; y < film.height(); ++y)
    for (int x = 48; x < 96; ++x) {
      ASSERT_EQ(own(x, y), film(x, y)) << x << ", " << y;
      ASSERT_EQ(other(x, y), all(x, y)) << x << ", " << y;
    }
  EXPECT_FALSE(own == film);
}

TEST_F(MaskedLine, RefusesWhatDoesNotFitInOneLine) {
  const auto expect = [&](const Words& words, int exit_code, const std::string& message) {
    const ProgramResult result = rotoscope(words);
    EXPECT_EQ(result.exit_code, exit_code) << message;
    EXPECT_THAT(result.errors, HasSubstr(message));
    EXPECT_EQ(std::ranges::count(result.errors, '\n'), 1) << result.errors;
    EXPECT_FALSE(fs::exists(folder_ / "painted.mp4")) << message;
  };
  expect({"--mask", "few_%d.png"}, 3, "few_%d.png: has 4 frames, expected 5 as film.mp4");
  expect({"--mask", "small.png"}, 3,
         "small.png: is 40x40 pixels, expected 96x64 as an eye of film.mp4, or 192x64 for both eyes as its frames");
  expect({"--mask", "none.png"}, 3, "none.png: no such file");
  expect({"--outside", "oil"}, 2, "--outside requires --mask");
  expect({"--mask", "half.png", "--outside", "oils"}, 2, "style: there is no 'oils'");
  expect({"--mask", "half.png", "--depth-budget", "5%"}, 2, "--depth-budget: has no effect with --mask");
  expect({"--mask", "half.png", "--zero-parallax", "5"}, 2, "--zero-parallax: has no effect with --mask");
  expect({"--mask", "half.png", "--display", "looking-glass-portrait"}, 2, "--mask: has no effect with --display");
  expect({"--mask", "half.png", "-o", "m_%d.wst"}, 2, "--mask: has no effect on marks (.wst)");
  expect({"--mask", "half.png", "-o", "half.png"}, 2, "half.png");
  put_bytes(folder_ / "s.toml", "[[shot]]\nbegin = 1\nzero-parallax = 3\n");
  expect({"--mask", "half.png", "--shots", "s.toml"}, 3, "'zero-parallax' has no effect with --mask");
}

}  // namespace wheatstone::rotoscope_mask_test
