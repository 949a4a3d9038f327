// The table of which parameters each kind of marks reads, against paintings.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string_view>

#include "wheatstone/painting/paint.h"
#include "wheatstone/painting/style_parameters.h"
#include "wheatstone/synthetic/synthetic_still.h"

namespace wheatstone::style_reads_test {

/// A value for every parameter that no preset has.
const std::map<std::string_view, std::string_view>& other_values() {
  static const std::map<std::string_view, std::string_view> values{
      {"radii", "14,3"},
      {"absolute-radii", "true"},
      {"threshold", "20"},
      {"grid", "2"},
      {"blur", "4"},
      {"curvature", "0.2"},
      {"opacity", "0.4"},
      {"min-length", "9"},
      {"max-length", "5"},
      {"jitter-hue", "0.9"},
      {"jitter-saturation", "0.9"},
      {"jitter-value", "0.9"},
      {"jitter-red", "0.9"},
      {"jitter-green", "0.9"},
      {"jitter-blue", "0.9"},
      {"fineness", "0.9"},
      {"strokes", "60"},
      {"bristle", "40"},
      {"streaks", "60"},
      {"ridge", "60"},
      {"brush", "fan"},
      {"dry", "0"},
      {"dual", "true"},
      {"texture", "true"},
      {"colours", "4"},
      {"tile", "40"},
      {"depth-test", "false"},
      {"depth-threshold", "60"},
      {"follow-depth-edges", "false"},
      {"occlusion-dilation", "4"},
      {"propagation", "independent"},
      {"orientation", "gradient"},
      {"reference-filter", "gaussian"},
      {"background", "colour"},
      {"canvas-colour", "#ff0000"},
  };
  return values;
}

class StyleReads : public testing::TestWithParam<const char*> {};

TEST_P(StyleReads, ExactlyTheParametersThatItsTableNames) {
  const SyntheticStill still = make_synthetic_still({.width = 96, .height = 64, .samples_a_side = 1});
  Style base = style_by_name(GetParam());
  // The canvas shows, so that its colour counts.
  if (is_of_strokes(base)) base.background = Background::colour;
  // Paint is uneven, so that the width of bristles counts.
  if (is_of_strokes(base)) base.brush = style_by_name("oil").brush;
  const StereoPair as_it_is = paint(still.pictures, still.geometry, base).pictures;
  for (const StyleParameter& parameter : style_parameters()) {
    if (parameter.name == "marks") continue;
    // This one is refused where it would have no effect.
    if (parameter.name == "texture" && !is_of_strokes(base)) {
      EXPECT_FALSE(is_read_by(parameter, base.marks));
      continue;
    }
    Style changed = base;
    parameter.set(changed, other_values().at(parameter.name));
    if (parameter.name == "reference-filter" && changed == base) changed.reference_filter = ReferenceFilter::median;
    if (parameter.name == "background") changed.background = Background::photograph;
    const StereoPair pictures = paint(still.pictures, still.geometry, changed).pictures;
    const bool same = std::ranges::equal(pictures.left.pixels(), as_it_is.left.pixels()) &&
                      std::ranges::equal(pictures.right.pixels(), as_it_is.right.pixels());
    EXPECT_EQ(!same, is_read_by(parameter, base.marks)) << parameter.name << " of " << name_of(base.marks);
  }
}

INSTANTIATE_TEST_SUITE_P(EveryKind, StyleReads,
                         testing::Values("oil", "impressionist", "posterise", "mosaic", "diffusion"));

}  // namespace wheatstone::style_reads_test
