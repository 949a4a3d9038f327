// Small paintings in every style, compared with those that are kept here: the plan exactly, the picture with tolerance.
//
// A plan follows from comparing sums over pixels, so a last bit that another instruction set rounds otherwise may
// decide which stroke is laid first. It does not in these paintings: every instruction set gives the kept plan.
//
// After a wanted change: WHEATSTONE_MAKE_GOLDEN=1 build/release/bin/wheatstone_golden_test, then look at the pictures.

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <span>

#include "golden/golden_folders.h"
#include "painting_generated.h"
#include "scenes/two_surfaces.h"
#include "wheatstone/drawing/draw.h"
#include "wheatstone/files/deflate.h"
#include "wheatstone/marks/painting_file.h"
#include "wheatstone/painting/paint.h"
#include "wheatstone/pictures/read_image.h"
#include "wheatstone/pictures/write_image.h"

namespace wheatstone::golden_test {

namespace fs = std::filesystem;

bool making() { return std::getenv("WHEATSTONE_MAKE_GOLDEN") != nullptr; }

Style style_of(const std::string& name) {
  Style style = style_by_name(name);
  style.background = Background::colour;
  return style;
}

/// FNV-1a of what the painting's file holds: every number of every mark, and every disparity. How zlib packs them does
/// not count.
std::string fingerprint(Painting painting) {
  std::uint64_t sum = 0xcbf29ce484222325;
  const auto add = [&](std::span<const std::uint8_t> bytes) {
    for (const std::uint8_t byte : bytes) sum = (sum ^ byte) * 0x100000001b3;
  };
  for (const Surface& surface : painting.surfaces.seen) {
    for (int y = 0; y < surface.disparity.height(); ++y)
      for (int x = 0; x < surface.disparity.width(); ++x) {
        const float disparity = surface.disparity(x, y);
        const auto steps = std::bit_cast<std::array<std::uint8_t, 4>>(
            std::isnan(disparity) ? std::numeric_limits<std::int32_t>::min()
                                  : static_cast<std::int32_t>(disparity * disparity_steps));
        add(steps);
      }
  }
  painting.surfaces.seen.clear();
  const std::string bytes = encode_painting(painting);
  const file::PaintingFile& whole = *file::GetPaintingFile(bytes.data());
  add(inflated({whole.payload()->data(), whole.payload()->size()}, whole.payload_size()).value());
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(sum));
  return text;
}

std::map<std::string, std::string> kept_plans() {
  std::map<std::string, std::string> plans;
  std::ifstream file(golden::kept_folder() / "plans.txt");
  for (std::string style, plan; file >> style >> plan;) plans[style] = plan;
  return plans;
}

PaintedPair painted(const Style& style) { return paint(test_scene::photographs(), test_scene::geometry(), style); }

/// The plan of a style's painting.
Painting planned(std::string_view name) { return painted(style_of(std::string(name))).painting; }

TEST(Golden, PlansAreTheSameToTheBit) {
  std::map<std::string, std::string> plans;
  for (const std::string_view name : style_names()) plans[std::string(name)] = fingerprint(planned(name));
  if (making()) {
    std::ofstream file(golden::kept_folder() / "plans.txt");
    for (const auto& [style, plan] : plans) file << style << " " << plan << "\n";
  }
  EXPECT_EQ(plans, kept_plans());
}

TEST(Golden, PlansAreTheSameWithEveryInstructionSet) {
  const std::string name = "impressionist";
  for (const auto target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    EXPECT_EQ(fingerprint(planned(name)), kept_plans()[name]) << hwy::TargetName(target);
  }
  hwy::SetSupportedTargetsForTest(0);
}

/// Levels by which a pixel's worst channel is off.
int off_by(Rgb8 a, Rgb8 b) { return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)}); }

/// At most 0.02 % of the pixels are off by more than 1 level (.004), none by more than 3 (.012). Where they are, the
/// difference lies in the build folder, 64 times as strong.
void expect_same_picture(const Image<Rgb8>& picture, const std::string& name) {
  const fs::path kept = golden::kept_folder() / (name + ".png");
  if (making()) write_image(kept, picture);
  ASSERT_TRUE(fs::exists(kept)) << kept;
  const Image<Rgb8> expected = read_image(kept);
  ASSERT_TRUE(same_size(picture, expected)) << name;
  Image<Rgb8> difference(picture.width(), picture.height());
  int noticeable = 0, largest = 0;
  for (std::size_t i = 0; i < picture.pixels().size(); ++i) {
    const int off = off_by(picture.pixels()[i], expected.pixels()[i]);
    noticeable += off > 1 ? 1 : 0;
    largest = std::max(largest, off);
    const auto level = static_cast<std::uint8_t>(std::min(255, 64 * off));
    difference.pixels()[i] = {level, level, level};
  }
  const bool same = noticeable <= 2e-4 * static_cast<double>(picture.pixels().size()) && largest <= 3;
  if (same) return;
  write_image(golden::difference_folder() / (name + ".png"), picture);
  write_image(golden::difference_folder() / (name + "_difference.png"), difference);
  ADD_FAILURE() << name << ": " << noticeable << " pixels differ, by up to " << largest << " levels; see "
                << golden::difference_folder() / (name + "_difference.png");
}

TEST(Golden, PicturesLookTheSame) {
  for (const std::string_view name : style_names())
    expect_same_picture(draw(planned(name), right_eye).picture, std::string(name));
}

}  // namespace wheatstone::golden_test
