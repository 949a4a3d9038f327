#include "wheatstone/marks/style.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "wheatstone/error.h"
#include "wheatstone/painting/style_parameters.h"

namespace wheatstone::style_test {

template <class Call>
Error error_of(Call call) {
  try {
    call();
  } catch (const Error& error) {
    return error;
  }
  return {ErrorKind::interrupted, "no error"};
}

TEST(Style, PresetsHaveHertzmannsValues) {
  const Style expressionist = style_by_name("expressionist");
  EXPECT_EQ(expressionist.radii_px, (std::vector<float>{8, 4, 2}));
  EXPECT_EQ(expressionist.threshold, 50);
  EXPECT_EQ(expressionist.curvature, 0.25f);
  EXPECT_EQ(expressionist.opacity, 0.7f);
  EXPECT_EQ(expressionist.min_length, 10);
  EXPECT_EQ(expressionist.max_length, 16);
  EXPECT_EQ(expressionist.jitter.value, 0.5f);
  const Style pointillist = style_by_name("pointillist");
  EXPECT_EQ(pointillist.radii_px, (std::vector<float>{4, 2}));
  EXPECT_EQ(pointillist.grid, 0.5f);
  EXPECT_EQ(pointillist.max_length, 0);
}

TEST(Style, ComesBackFromItsFile) {
  for (const std::string_view name : style_names()) {
    Style style = style_by_name(name);
    style.canvas_colour = {1, 128, 255};
    style.orientation = Orientation::gradient;
    style.depth_threshold_px = 3.7f;
    Style read;
    apply_toml(style_to_toml(style), "style.toml", read);
    EXPECT_EQ(read, style) << name;
  }
}

TEST(Style, FileMayStartFromAPreset) {
  Style style;
  apply_toml("style = 'psychedelic'\nradii = [10, 5]\n", "mine.toml", style);
  EXPECT_EQ(style.jitter.hue, 0.5f);
  EXPECT_EQ(style.radii_px, (std::vector<float>{10, 5}));
}

TEST(Style, RefusesWhatCannotBePaintedWithByName) {
  const auto message = [](const char* toml) {
    return std::string(error_of([&] {
                         Style style;
                         apply_toml(toml, "mine.toml", style);
                       }).what());
  };
  EXPECT_THAT(message("radii = [-3]"),
              testing::AllOf(testing::HasSubstr("mine.toml"), testing::HasSubstr("radius is -3")));
  EXPECT_THAT(message("threshold = 0"), testing::HasSubstr("threshold is 0"));
  EXPECT_THAT(message("radii = [2, 8]"), testing::HasSubstr("coarse to fine"));
  EXPECT_THAT(message("colour = 3"), testing::HasSubstr("unknown key 'colour'"));
  EXPECT_THAT(message("min-length = 20"), testing::HasSubstr("at most max-length"));
  EXPECT_THAT(message("threshold = nan"), testing::HasSubstr("finite"));
  EXPECT_THAT(message("threshold = 'much'"), testing::HasSubstr("expected a number"));
  EXPECT_THAT(message("radii = ["), testing::HasSubstr("line 1"));
}

TEST(Style, RadiiScaleWithTheWidthUnlessAbsolute) {
  Style style;
  EXPECT_FLOAT_EQ(style_scale(style, 1280), 2);
  style.absolute_radii = true;
  EXPECT_FLOAT_EQ(style_scale(style, 1280), 1);
}

TEST(Style, ListsThePresetsWhereThereIsNoSuchOne) {
  const Error error = error_of([] { style_by_name("cubist"); });
  EXPECT_EQ(error.kind(), ErrorKind::wrong_usage);
  EXPECT_THAT(error.what(), testing::HasSubstr("impressionist"));
}

}  // namespace wheatstone::style_test
