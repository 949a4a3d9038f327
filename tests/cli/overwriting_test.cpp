// No run writes over what it reads, under whatever name, and what an earlier run has left does not mix with a new one.

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "cli/run_program.h"
#include "wheatstone/photograph/write_views.h"
#include "wheatstone/pictures/write_image.h"

namespace wheatstone::overwriting_test {

namespace fs = std::filesystem;

Image<Rgb8> grey(std::uint8_t level) { return Image<Rgb8>(32, 24, Rgb8{level, level, level}); }

/// left.png and right.png in a folder of their own, whose bytes must be the same afterwards.
class Overwriting : public testing::Test {
 protected:
  void SetUp() override {
    write_image(folder_ / "left.png", grey(100));
    write_image(folder_ / "right.png", grey(110));
  }

  void refused(const std::vector<std::string>& arguments, const std::string& file) {
    const std::string before = bytes_of(folder_ / file);
    expect_refused(folder_, arguments, 2, file + ": is the same file as the input");
    EXPECT_EQ(bytes_of(folder_ / file), before);
  }

  const TemporaryFolder folder_;
};

TEST_F(Overwriting, OfPhotographsIsRefused) {
  for (const std::string command : {"paint", "rectify"})
    refused({command, "left.png", "right.png", "-o", "."}, "left.png");
  refused({"paint", "left.png", "right.png", "-o", "left.png"}, "left.png");
  fs::create_directory(folder_ / "out");
  fs::create_symlink("../left.png", folder_ / "out/left_disparity.png");
  refused({"match", "left.png", "right.png", "-o", "out"}, "left_disparity.png");
  fs::create_hard_link(folder_ / "right.png", folder_ / "out/right.png");
  refused({"rectify", "left.png", "right.png", "-o", "out"}, "right.png");
  refused({"paint", "left.png", "right.png", "--display", "looking-glass-portrait", "-o", "left.png"}, "left.png");
}

TEST_F(Overwriting, OfPackedViewsIsRefused) {
  const Image<Rgb8> left = grey(100), right = grey(110);
  const std::vector<ImageView<const Rgb8>> views{left, right};
  write_mpo(folder_ / "p.mpo", views);
  fs::create_symlink("p.mpo", folder_ / "link.mpo");
  refused({"pack", "p.mpo", "--to", "mpo", "-o", "p.mpo"}, "p.mpo");
  refused({"pack", "p.mpo", "--to", "mpo", "-o", "link.mpo"}, "link.mpo");
  refused({"pack", "left.png", "right.png", "--to", "anaglyph", "-o", "right.png"}, "right.png");
  fs::rename(folder_ / "left.png", folder_ / "view_003.png");
  refused({"pack", "view_003.png", "right.png", "-o", "."}, "view_003.png");
  fs::rename(folder_ / "right.png", folder_ / "quilt_qs2x1a1.3333.png");
  refused({"pack", "view_003.png", "quilt_qs2x1a1.3333.png", "--quilt", "2x1", "-o", "quilt"},
          "quilt_qs2x1a1.3333.png");
}

TEST_F(Overwriting, OfParticlesSlicesAndBoardsIsRefused) {
  put_bytes(folder_ / "c.hdf5", "stands for particles");
  put_bytes(folder_ / "s.exr", "stands for slices");
  refused({"render", "c.hdf5", "--save-slices", "c.hdf5"}, "c.hdf5");
  refused({"render", "s.exr", "--save-slices", "s.exr"}, "s.exr");
  refused({"render", "c.hdf5", "--quilt", "2x1", "-o", "c.hdf5"}, "c.hdf5");
  refused({"calibrate", "--left", "left.png", "--right", "right.png", "-o", "left.png"}, "left.png");
  refused({"calibrate", ".", "-o", "right.png"}, "right.png");
}

TEST_F(Overwriting, NeedsTheNameOfAnOutput) {
  for (const std::vector<std::string>& line :
       std::vector<std::vector<std::string>>{{"paint", "left.png", "right.png"},
                                             {"rectify", "left.png", "right.png"},
                                             {"match", "left.png", "right.png"},
                                             {"pack", "left.png", "right.png"},
                                             {"render", "left.png"},
                                             {"calibrate", "."},
                                             {"rotoscope", "left.png"},
                                             {"synth", "still"},
                                             {"synth", "film"},
                                             {"synth", "universe"}}) {
    std::vector<std::string> arguments = line;
    arguments.insert(arguments.end(), {"-o", ""});
    expect_refused(folder_, arguments, 2, "--output: is empty, expected a name");
  }
  expect_refused(folder_, {"render", "left.png", "--save-slices", ""}, 2, "--save-slices: is empty, expected a name");
}

TEST_F(Overwriting, AFolderThatHoldsInputsUnderOtherNamesIsWrittenTo) {
  write_image(folder_ / "a.png", grey(90));
  const ProgramResult result = run_program({"pack", "a.png", "right.png", "-o", "."}, {.folder = folder_ / ""});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_EQ(files_in(folder_ / ""),
            (std::set<std::string>{"a.png", "left.png", "right.png", "view_000.png", "view_001.png"}));
}

TEST_F(Overwriting, AFolderOfViewsIsReplacedAsAWholeButNothingForeign) {
  fs::create_directory(folder_ / "vv");
  for (const char* name : {"vv/view_000.png", "vv/view_002.png", "vv/view_004.png", "vv/mine.txt"})
    put_bytes(folder_ / name, "old");
  const ProgramResult result = run_program({"pack", "left.png", "right.png", "-o", "vv"}, {.folder = folder_ / ""});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_EQ(files_in(folder_ / "vv"), (std::set<std::string>{"mine.txt", "view_000.png", "view_001.png"}));
}

}  // namespace wheatstone::overwriting_test
