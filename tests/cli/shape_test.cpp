// Pictures of extreme shapes: each command does its work, or says in one line what it cannot use.

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "cli/run_program.h"
#include "wheatstone/pictures/write_image.h"

namespace wheatstone::shape_test {

/// Two views of a wall of noise, which lies at a disparity of three pixels.
void write_wall(const TemporaryFolder& folder, int width, int height) {
  constexpr int disparity_px = 3, cell_px = 4;
  const auto cells = [](int pixels) { return pixels / cell_px + 2; };
  std::mt19937 random(1);
  Image<Rgb8> wall(cells(width), cells(height)), left(width, height), right(width, height);
  for (Rgb8& cell : wall.pixels())
    cell = {static_cast<std::uint8_t>(random()), static_cast<std::uint8_t>(random()), 60};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      left(x, y) = wall(x / cell_px, y / cell_px);
      right(x, y) = wall((x + disparity_px) / cell_px, y / cell_px);
    }
  }
  write_image(folder / "left.ppm", left);
  write_image(folder / "right.ppm", right);
}

class Shape : public testing::TestWithParam<std::pair<int, int>> {
 protected:
  void SetUp() override { write_wall(folder_, GetParam().first, GetParam().second); }
  const TemporaryFolder folder_;
};

TEST_P(Shape, IsMatchedAndPainted) {
  const std::string left = "left.ppm", right = "right.ppm";
  for (const std::vector<std::string>& line :
       std::vector<std::vector<std::string>>{{"match", left, right, "--quality", "best", "-o", "matched"},
                                             {"paint", left, right, "-o", "painted"},
                                             {"measure", "stereo", left, right, "--photographs", left, right}}) {
    const ProgramResult result = run_program(line, {.folder = folder_ / ""});
    EXPECT_EQ(result.exit_code, 0) << line[0] << " " << line[1] << " " << result.errors;
  }
}

TEST_P(Shape, IsRectifiedOrRefused) {
  const ProgramResult result =
      run_program({"rectify", "left.ppm", "right.ppm", "-o", "rectified"}, {.folder = folder_ / ""});
  EXPECT_TRUE(result.exit_code == 0 || result.exit_code == 3) << result.errors;
}

INSTANTIATE_TEST_SUITE_P(Extreme, Shape,
                         testing::Values(std::pair(16, 16), std::pair(4000, 16), std::pair(33000, 16),
                                         std::pair(16, 4000), std::pair(16, 33000)));

}  // namespace wheatstone::shape_test
