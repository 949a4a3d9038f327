#include <gtest/gtest.h>

#include "cli/run_program.h"

namespace wheatstone {
namespace {

TEST(ShareCommand, RefusesASizeThatNoPageOfThePictureHas) {
  const TemporaryFolder folder;
  put_bytes(folder / "cloud.csv", "x,y,z\n0,0,0\n1,1,1\n2,1,0\n");
  const ProgramResult sliced = run_program(
      {"render", "cloud.csv", "--size", "64x48", "--save-slices", "s.exr", "-o", "views"}, {.folder = folder / ""});
  ASSERT_EQ(sliced.exit_code, 0) << sliced.errors;
  expect_refused(folder, {"share", "s.exr", "--max-size", "2kB", "-o", "page.html"}, 2,
                 "--max-size: is '2kB', but the smallest page of s.exr has ");
  const ProgramResult fits =
      run_program({"share", "s.exr", "--max-size", "200kB", "-o", "page.html"}, {.folder = folder / ""});
  EXPECT_EQ(fits.exit_code, 0) << fits.errors;
  EXPECT_LE(bytes_of(folder / "page.html").size(), 200'000u);
  const std::string long_caption(150'000, 'a');
  expect_refused(folder, {"share", "s.exr", "--max-size", "200kB", "--caption", long_caption, "-o", "more.html"}, 2,
                 "the smallest page");
}

}  // namespace
}  // namespace wheatstone
