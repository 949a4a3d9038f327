// Views in frames of another shape, and stereograph cards.

#include "wheatstone/display/stereo_card.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <regex>
#include <sstream>
#include <vector>

#include "throws_error.h"
#include "wheatstone/synthetic/synthetic_still.h"

namespace wheatstone::stereo_card_test {

constexpr double inch_mm = 25.4, point_mm = inch_mm / 72;

const StereoPair& pair() {
  static const StereoPair still = make_synthetic_still({.width = 240, .height = 180, .samples_a_side = 1}).pictures;
  return still;
}

/// The numbers before each of this operator in a PDF whose pages are not compressed.
std::vector<std::vector<double>> operands(const std::string& pdf, const std::string& name, int count) {
  std::string number = R"((-?[0-9.]+)[ \n])", pattern;
  for (int i = 0; i < count; ++i) pattern += number;
  const std::regex wanted(pattern + name + R"([ \n])");
  std::vector<std::vector<double>> found;
  for (std::sregex_iterator at(pdf.begin(), pdf.end(), wanted); at != std::sregex_iterator(); ++at) {
    found.emplace_back();
    for (int i = 1; i <= count; ++i) found.back().push_back(std::stod((*at)[i]));
  }
  return found;
}

TEST(StereoCard, OfAPdfHasItsSizeInMillimetresWhenItIsReadBack) {
  const std::string pdf = stereo_card_pdf(pair(), {.caption = "Äpfel – Pommes"});
  std::smatch box;
  ASSERT_TRUE(std::regex_search(pdf, box, std::regex(R"(/MediaBox \[ 0 0 ([0-9.]+) ([0-9.]+) \])")));
  EXPECT_NEAR(std::stod(box[1]) * point_mm, 178, 0.01);
  EXPECT_NEAR(std::stod(box[2]) * point_mm, 89, 0.01);
  // Two pictures, each as large as its window and 83 mm from the other, clipped to round corners.
  const auto placed = operands(pdf, "cm", 6);
  ASSERT_EQ(placed.size(), 2u);
  const StereoCardLayout layout = stereo_card_layout(240, 180, {});
  for (const std::size_t eye : {0u, 1u}) {
    EXPECT_NEAR(placed[eye][0] * point_mm, layout.windows[eye].width_mm, 0.01);
    EXPECT_NEAR(placed[eye][3] * point_mm, layout.windows[eye].height_mm, 0.01);
    EXPECT_NEAR(placed[eye][4] * point_mm, layout.windows[eye].left_mm, 0.01);
    EXPECT_NEAR(89 - placed[eye][5] * point_mm, layout.windows[eye].top_mm + layout.windows[eye].height_mm, 0.01);
  }
  EXPECT_NEAR((placed[1][4] - placed[0][4]) * point_mm, 83, 0.01);
  EXPECT_EQ(operands(pdf, "c", 6).size(), 8u);
  EXPECT_EQ(pdf, stereo_card_pdf(pair(), {.caption = "Äpfel – Pommes"}));
  EXPECT_NE(pdf, stereo_card_pdf(pair(), {.caption = "Birnen"}));
}

TEST(StereoCard, HasItsPartsWithinItAndApart) {
  for (const ViewFraming framing : {ViewFraming{}, ViewFraming{.whole = true}})
    for (const int height : {60, 240, 900}) {
      const StereoCardLayout card = stereo_card_layout(240, height, framing);
      const auto& [left, right] = card.windows;
      EXPECT_GE(left.left_mm, 5);
      EXPECT_LT(left.left_mm + left.width_mm, right.left_mm);
      EXPECT_LE(right.left_mm + right.width_mm, card.width_mm - 5);
      EXPECT_GE(left.top_mm, 4);
      EXPECT_LE(left.top_mm + left.height_mm, card.caption.top_mm);
      EXPECT_LT(card.caption.top_mm + card.caption.height_mm, card.height_mm);
      if (framing.whole) {
        EXPECT_NEAR(left.width_mm / left.height_mm, 240. / height, 1e-6);
      }
    }
}

TEST(StereoCard, OfAPictureHasTheViewsInRoundWindowsAndTheCaptionBelow) {
  const StereoCardOptions options{.caption = "Apples", .dpi = 100};
  const Image<Rgb8> card = stereo_card_picture(pair(), options);
  EXPECT_EQ(card.width(), 701);
  EXPECT_EQ(card.height(), 350);
  const StereoCardLayout layout = stereo_card_layout(240, 180, {});
  const auto at = [&](double x_mm, double y_mm) {
    return card(static_cast<int>(x_mm * 100 / inch_mm), static_cast<int>(y_mm * 100 / inch_mm));
  };
  for (const PaperArea& window : layout.windows) {
    EXPECT_EQ(at(window.left_mm + 0.4, window.top_mm + 0.4), options.mount);
    EXPECT_EQ(at(window.left_mm + window.width_mm - 0.6, window.top_mm + window.height_mm - 0.6), options.mount);
    EXPECT_NE(at(window.left_mm + 0.6, window.top_mm + window.height_mm / 2), options.mount);
    EXPECT_NE(at(window.left_mm + window.width_mm / 2, window.top_mm + 0.6), options.mount);
  }
  const auto dark_below = [&](const Image<Rgb8>& of) {
    int dark = 0;
    for (int y = static_cast<int>(layout.caption.top_mm * 100 / inch_mm); y < of.height(); ++y)
      dark += static_cast<int>(std::ranges::count_if(of.row(y), [](Rgb8 pixel) { return pixel.r < 120; }));
    return dark;
  };
  EXPECT_GT(dark_below(card), 30);
  EXPECT_EQ(dark_below(stereo_card_picture(pair(), {.dpi = 100})), 0);
}

TEST(StereoCard, RefusesACaptionForWhichThereIsNoRoom) {
  std::string words;
  for (int i = 0; i < 400; ++i) words += "word ";
  expect_error(ErrorKind::wrong_usage, "--caption: is too long", [&] { stereo_card_pdf(pair(), {.caption = words}); });
  expect_error(ErrorKind::wrong_usage, "--caption: is too long",
               [&] { stereo_card_picture(pair(), {.caption = words}); });
  words.resize(250);
  EXPECT_FALSE(stereo_card_pdf(pair(), {.caption = words}).empty());
  EXPECT_FALSE(stereo_card_picture(pair(), {.caption = words}).empty());
}

TEST(ViewFraming, ShowsThePartThatIsWanted) {
  // Columns of the picture are 0 to 199, rows 0 to 99; the frame is upright.
  const auto shown = [](const char* words) { return shown_part(200, 100, 60, 120, parse_view_framing(words, "")); };
  const ShownPart fill = shown("fill"), fit = shown("fit"), right = shown("1,0.5,1"), close = shown("0.25,0.5,2");
  EXPECT_DOUBLE_EQ(fill.scale, 1.2);
  EXPECT_DOUBLE_EQ(fill.left, 75);
  EXPECT_DOUBLE_EQ(fit.scale, 0.3);
  EXPECT_DOUBLE_EQ(fit.left, 0);
  EXPECT_DOUBLE_EQ(fit.top, -150);
  EXPECT_DOUBLE_EQ(right.left, 150);  // no further than the edge
  EXPECT_DOUBLE_EQ(close.scale, 2.4);
  EXPECT_DOUBLE_EQ(close.left, 37.5);
  for (const char* words : {"", "fits", "1,2", "1,2,3", "0.5,0.5,0", "0.5,0.5,21", "-0.1,0,1", "0.5,0.5,1x", "nan,0,1"})
    expect_error(ErrorKind::wrong_usage, "--framing: is '", [&] { parse_view_framing(words, "--framing"); });
}

TEST(ViewFraming, KeepsPlacesWhereTheyBelong) {
  Image<Rgb8> ramp(200, 100);
  for (int y = 0; y < 100; ++y)
    for (int x = 0; x < 200; ++x) ramp(x, y) = {std::uint8_t(x), std::uint8_t(2 * y), 0};
  const Image<Rgb8> fit = framed_view(ramp, 100, 100, ViewFraming{.whole = true});
  EXPECT_EQ(fit(50, 20), Rgb8{});
  EXPECT_EQ(fit(50, 80), Rgb8{});
  EXPECT_NEAR(fit(50, 50).r, 101, 1);
  EXPECT_NEAR(fit(50, 50).g, 101, 2);
  const Image<Rgb8> fill = framed_view(ramp, 300, 300, ViewFraming{});
  EXPECT_NEAR(fill(150, 150).r, 100, 1);
  EXPECT_NEAR(fill(3, 150).r, 51, 1);
}

}  // namespace wheatstone::stereo_card_test
