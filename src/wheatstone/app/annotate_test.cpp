// What is written into pictures of particles: numbers that can be read, in every stretch.

#include "wheatstone/app/annotate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "throws_error.h"
#include "wheatstone/app/colour_bar_ticks_internal.h"
#include "wheatstone/display/typeset.h"
#include "wheatstone/multiview/colour_bar.h"

namespace wheatstone::annotate_test {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr int letter_px = 10;

/// Letters of one width: those of UTF-8 count once.
std::vector<int> widths_of(const std::vector<std::string>& labels) {
  std::vector<int> widths;
  for (const std::string& label : labels)
    widths.push_back(letter_px * static_cast<int>(std::ranges::count_if(label, [](char byte) {
                       return (static_cast<unsigned char>(byte) & 0xc0) != 0x80;
                     })));
  return widths;
}

ToneSettings tone(Stretch stretch, float least, float most) {
  return {.look = Look::mass, .shown = Shown::column, .stretch = stretch, .least = least, .most = most};
}

std::vector<std::string> labels_of(const ToneSettings& settings, int length_px = 400) {
  std::vector<std::string> labels;
  for (const Tick& tick : colour_bar_ticks(settings, length_px, letter_px, widths_of).ticks)
    labels.push_back(tick.label);
  return labels;
}

TEST(ColourBarTicks, AreEvenStepsOfALinearScale) {
  EXPECT_THAT(labels_of(tone(Stretch::linear, 0, 1)), ElementsAre("0", "0.2", "0.4", "0.6", "0.8", "1"));
  EXPECT_THAT(labels_of(tone(Stretch::linear, -310, 290), 200), ElementsAre("-200", "0", "200"));
  EXPECT_EQ(colour_bar_ticks(tone(Stretch::linear, 0, 3.2e9f), 400, letter_px, widths_of).exponent, 9);
}

TEST(ColourBarTicks, ArePowersOfTenOfALogarithm) {
  EXPECT_THAT(labels_of(tone(Stretch::log, 3e5f, 4e9f)), ElementsAre("10⁶", "10⁷", "10⁸", "10⁹"));
  EXPECT_THAT(labels_of(tone(Stretch::log, 1, 100)), ElementsAre("1", "2", "5", "10", "20", "50", "100"));
  EXPECT_THAT(labels_of(tone(Stretch::log, 9000, 12000)),
              ElementsAre("0.9", "0.95", "1", "1.05", "1.1", "1.15", "1.2"));
}

TEST(ColourBarTicks, ThinOutWhereAsinhIsLinear) {
  EXPECT_THAT(labels_of(tone(Stretch::asinh, 0, 100)), ElementsAre("0", "1", "2", "5", "10", "20", "50", "100"));
}

TEST(ColourBarTicks, StandWhereTheBarHasTheirColourAndApart) {
  for (const Stretch stretch : {Stretch::asinh, Stretch::log, Stretch::linear})
    for (const float least : {1e-12f, 0.02f, 3.f, 900.f})
      for (const float range : {1.001f, 1.3f, 7.f, 100.f, 1e5f, 1e11f})
        for (const int length_px : {60, 150, 400, 1500}) {
          const ToneSettings settings = tone(stretch, least, least * range);
          const ColourBarTicks bar = colour_bar_ticks(settings, length_px, letter_px, widths_of);
          ASSERT_GE(bar.ticks.size(), length_px > 100 ? 2u : 1u) << least << " " << range;
          std::vector<std::string> labels;
          for (const Tick& tick : bar.ticks) {
            labels.push_back(tick.label);
            ASSERT_GE(tick.place, 0);
            ASSERT_LE(tick.place, 1);
            const bool in_powers = tick.label.find_first_not_of("-.0123456789") != std::string::npos;
            if (in_powers) continue;
            const double number = std::stod(tick.label) * std::pow(10, bar.exponent);
            EXPECT_NEAR(value_at(settings, tick.place), number, 2e-2 * (std::abs(number) + least * (range - 1)));
          }
          const std::vector<int> widths = widths_of(labels);
          for (std::size_t i = 1; i < labels.size(); ++i) {
            const int least_px = (widths[i] + widths[i - 1]) / 2 + letter_px;
            EXPECT_GE((bar.ticks[i].place - bar.ticks[i - 1].place) * static_cast<float>(length_px) + 0.01f,
                      static_cast<float>(least_px));
          }
        }
}

TEST(Typeset, UnitsHavePowersAndSigns) {
  EXPECT_EQ(typeset_unit("1e+10*Msun/kpc**2"), "10¹⁰ M☉ kpc⁻²");
  EXPECT_EQ(typeset_unit("1e10 Msun / kpc^2", 3), "10¹³ M☉ kpc⁻²");
  EXPECT_EQ(typeset_unit("code_mass/code_length**2", -4), "10⁻⁴ code mass (code length)⁻²");
  EXPECT_EQ(typeset_unit("6.8e-31*g*cm**-3"), "6.8×10⁻³¹ g cm⁻³");
  EXPECT_EQ(typeset_unit("Msun/(kpc)**2"), "M☉ kpc⁻²");
  EXPECT_EQ(typeset_unit("km s-1"), "km s⁻¹");
  EXPECT_EQ(typeset_unit("1/kpc**2"), "kpc⁻²");
  EXPECT_EQ(typeset_unit("K"), "K");
  EXPECT_EQ(typeset_unit("what, of 10?"), "what, of 10?");
}

/// Of a view of noise in no colour, between the limits.
RenderedParticles rendered(Stretch stretch, bool orthographic) {
  RenderedParticles result;
  result.rendered.tone = tone(stretch, 2e-6f, 3e-3f);
  result.least = 2e6f;
  result.most = 3e9f;
  result.units = {.length = "kpc", .value = "1e+10*Msun/kpc**2", .name = "column density"};
  result.scene.camera.focal_px = 800;
  result.scene.splat_style.size_depth = 100;
  if (orthographic) result.scene.camera.orthographic_depth = 100;
  return result;
}

TEST(Annotate, DrawsTheColoursOfEveryStretchAndProjection) {
  for (const Stretch stretch : {Stretch::asinh, Stretch::log, Stretch::linear})
    for (const bool orthographic : {false, true})
      for (const auto& [width, height] : {std::pair{640, 360}, {320, 240}, {1920, 1080}}) {
        std::vector<Image<Rgb8>> views{Image<Rgb8>(width, height)};
        const RenderedParticles result = rendered(stretch, orthographic);
        EXPECT_THAT(annotate(result, views), IsEmpty());
        const Image<Rgb8> bar = colour_bar(result.rendered.tone, width * 2 / 5, 1);
        int longest = 0;
        for (int y = height / 2; y < height; ++y)
          for (int left = width / 2; left + bar.width() <= width; ++left)
            longest += std::ranges::equal(bar.row(0), views[0].row(y).subspan(left, bar.width()));
        EXPECT_GT(longest, 2) << width;
      }
}

/// Rows of the lower half that are not dark.
int rows_of(const Image<Rgb8>& view) {
  int rows = 0;
  for (int y = view.height() / 2; y < view.height(); ++y)
    rows += std::ranges::any_of(view.row(y), [](Rgb8 pixel) { return pixel != Rgb8{}; });
  return rows;
}

TEST(Annotate, IsLargerInFilms) {
  std::vector<Image<Rgb8>> still{Image<Rgb8>(1280, 720)}, film = still;
  annotate(rendered(Stretch::log, false), still);
  annotate(rendered(Stretch::log, false), film, {.shown_as = ShownAs::film});
  EXPECT_GT(rows_of(film[0]), 1.3 * rows_of(still[0]));
}

TEST(Annotate, IsReadOnLightPlaces) {
  std::vector<Image<Rgb8>> dark{Image<Rgb8>(640, 360)}, light = dark;
  std::ranges::fill(light[0].pixels(), Rgb8{255, 255, 255});
  annotate(rendered(Stretch::log, false), dark);
  annotate(rendered(Stretch::log, false), light);
  EXPECT_GT(std::ranges::count(light[0].pixels(), Rgb8{0, 0, 0}), 500);
}

TEST(Annotate, NamesTypesBesideTheirColours) {
  RenderedParticles types = rendered(Stretch::asinh, false);
  types.types = {{"gas", {200, 100, 0}}, {"halo", {0, 100, 200}}};
  std::vector<Image<Rgb8>> views{Image<Rgb8>(640, 360)};
  EXPECT_THAT(annotate(types, views), IsEmpty());
  for (const TypeColour& type : types.types) EXPECT_GE(std::ranges::count(views[0].pixels(), type.colour), 100);
  views = {Image<Rgb8>(640, 30)};
  EXPECT_THAT(annotate(types, views), testing::Contains(testing::HasSubstr("no list of types")));
}

TEST(Annotate, SaysWhatItLeavesOut) {
  std::vector<Image<Rgb8>> views{Image<Rgb8>(64, 48)};
  EXPECT_THAT(annotate(rendered(Stretch::log, false), views),
              ElementsAre(testing::HasSubstr("no scale bar: views of 64x48"), testing::HasSubstr("no colour bar")));
  RenderedParticles thesis = rendered(Stretch::asinh, false);
  thesis.rendered.tone.look = Look::thesis;
  views = {Image<Rgb8>(640, 360)};
  EXPECT_THAT(annotate(thesis, views), ElementsAre(testing::HasSubstr("no colour bar: colours do not stand")));
}

/// Columns of the upper or lower part of a view in which something was drawn: the first and the last.
std::pair<int, int> drawn_columns(const Image<Rgb8>& view, int top, int bottom, int left, int right) {
  int first = right, last = left;
  for (int x = left; x < right; ++x)
    for (int y = top; y < bottom; ++y)
      if (view(x, y) == Rgb8{230, 230, 230}) {
        first = std::min(first, x);
        last = std::max(last, x);
      }
  return {first, last};
}

TEST(Annotate, StandsAtTheDepthThatIsAskedForWithItsTitle) {
  constexpr int width = 640, height = 360;
  RenderedParticles result = rendered(Stretch::log, false);
  result.rig = evenly_spaced(width, height, 2, 1);
  for (const float behind_mm : {-80.f, 0.f, 60.f}) {
    std::vector<Image<Rgb8>> views(2, Image<Rgb8>(width, height));
    EXPECT_THAT(annotate(result, views, {.title = "Gas & <dust>", .behind_mm = behind_mm}), IsEmpty());
    const double parallax = screen_parallax_mm(result.viewing, behind_mm) / result.viewing.screen_width_mm * width;
    EXPECT_EQ(std::abs(parallax) > 5, behind_mm != 0);
    for (const auto& [top, bottom, left, right] :
         {std::array{0, 60, 200, 440}, {height - 60, height, 0, 200}, {height - 60, height, 240, width}}) {
      const auto in_left = drawn_columns(views[0], top, bottom, left, right);
      const auto in_right = drawn_columns(views[1], top, bottom, left, right);
      ASSERT_LT(in_left.first, in_left.second);
      EXPECT_NEAR(in_right.first - in_left.first, parallax, 1);
      EXPECT_NEAR(in_right.second - in_left.second, parallax, 1);
    }
    const auto title = drawn_columns(views[0], 0, 60, 200, 440);
    EXPECT_NEAR(title.first + title.second + parallax, width, 6) << "in the middle";
  }
  std::vector<Image<Rgb8>> views(2, Image<Rgb8>(width, height));
  expect_error(ErrorKind::wrong_usage, "annotation depth: is -2000 mm",
               [&] { annotate(result, views, {.behind_mm = -2000}); });
  EXPECT_THAT(annotate(result, views, {.title = std::string(200, 'm')}),
              ElementsAre(testing::HasSubstr("no title: views of 640x360 pixels are too small")));
}

}  // namespace wheatstone::annotate_test
