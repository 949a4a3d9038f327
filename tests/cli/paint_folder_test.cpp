// A folder of photographs: what is painted, what is told of the rest, and how a run goes on.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "cli/run_program.h"
#include "scenes/test_photographs.h"
#include "wheatstone/photograph/write_views.h"
#include "wheatstone/pictures/read_image.h"
#include "wheatstone/pictures/write_image.h"

namespace wheatstone::paint_folder_test {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// Ten files: four photographs, a damaged and an empty file, and what is left out.
void write_photographs(const fs::path& folder) {
  const StereoPair still = still_for_test(96, 72);
  fs::create_directories(folder / "trip");
  write_image(folder / "a_L.png", still.left);
  write_image(folder / "a_R.png", still.right);
  const ImageView<const Rgb8> views[] = {still.left, still.right};
  write_mpo(folder / "a.mpo", views);
  write_image(folder / "trip/b_sbs.png", joined(still.left, still.right, true));
  write_image(folder / "c.jpg", still.left);
  Image<Rgb8> depth(96, 72);
  for (int y = 0; y < 72; ++y)
    for (int x = 0; x < 96; ++x) depth(x, y) = Rgb8{std::uint8_t(3 * y), std::uint8_t(3 * y), std::uint8_t(3 * y)};
  write_image(folder / "c_depth.png", depth);
  write_image(folder / "lone_L.png", still.left);
  write_image(folder / "flat.png", still.left);
  put_bytes(folder / "empty.png", "");
  const std::string whole = bytes_of(folder / "a.mpo");
  put_bytes(folder / "cut.jpg", whole.substr(0, whole.size() / 3));
}

ProgramResult paint(const TemporaryFolder& folder, std::vector<std::string> more) {
  more.insert(more.begin(), {"paint", "photos", "-o", "out", "--range", "0:12", "--quiet"});
  return run_program(more, {.folder = folder / ""});
}

TEST(PaintFolder, PaintsAllThatIsAPhotographAndTellsOfTheRest) {
  const TemporaryFolder folder;
  write_photographs(folder / "photos");
  const ProgramResult result = paint(folder, {});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_EQ(std::ranges::count(result.errors, '\n'), 2) << result.errors;
  for (const char* part : {"written to out/a-mpo (MPO", "written to out/a-pair (pair with a_R.png, by their names)",
                           "photos/trip/b_sbs.png  written to out/trip/b_sbs",
                           "written to out/c (with the depth map c_depth.png)", "failed: ", "left out: one view",
                           "left out: named for the left eye", "4 of 4 photographs painted, 2 files left out"})
    EXPECT_THAT(result.output, HasSubstr(part));
  EXPECT_EQ(fs::exists(folder / "out/flat"), false);
  EXPECT_EQ(fs::exists(folder / "out/lone"), false);
}

TEST(PaintFolder, WritesWhatEachPhotographAloneWouldGet) {
  const TemporaryFolder folder;
  write_photographs(folder / "photos");
  paint(folder, {});
  const ProgramRun here{.folder = folder / ""};
  run_program({"paint", "photos/a_L.png", "photos/a_R.png", "--range", "0:12", "-o", "pair", "--quiet"}, here);
  run_program({"paint", "photos/c.jpg", "--depth", "photos/c_depth.png", "-o", "single", "--quiet"}, here);
  for (const char* name : {"left.png", "right.png", "painting.wst", "left_disparity.pfm"}) {
    EXPECT_EQ(bytes_of(folder / "out/a-pair" / name), bytes_of(folder / "pair" / name)) << name;
    EXPECT_EQ(bytes_of(folder / "out/c" / name), bytes_of(folder / "single" / name)) << name;
  }
}

TEST(PaintFolder, IsContinuedToTheSameResults) {
  const TemporaryFolder folder;
  write_photographs(folder / "photos");
  paint(folder, {});
  const std::string kept = bytes_of(folder / "out/c/report.json"), lost = bytes_of(folder / "out/a-mpo/left.png");
  fs::remove_all(folder / "out/a-mpo");
  const ProgramResult again = paint(folder, {"--skip-existing", "--json"});
  EXPECT_EQ(again.exit_code, 3);
  const nlohmann::json facts = nlohmann::json::parse(again.output);
  EXPECT_EQ(facts["painted"], 1);
  EXPECT_EQ(facts["skipped"], 3);
  EXPECT_EQ(facts["failed"], 2);
  EXPECT_EQ(facts["left_out"].size(), 2U);
  EXPECT_EQ(bytes_of(folder / "out/c/report.json"), kept);
  EXPECT_EQ(bytes_of(folder / "out/a-mpo/left.png"), lost);
}

TEST(PaintFolder, IsPaintedInPartsWhichTogetherAreTheWhole) {
  const TemporaryFolder folder;
  write_photographs(folder / "photos");
  std::size_t painted = 0;
  for (const char* part : {"1/3", "2/3", "3/3"}) {
    const nlohmann::json facts = nlohmann::json::parse(paint(folder, {"--part", part, "--json"}).output);
    EXPECT_LE(facts["painted"], 2) << part;
    painted += facts["painted"].get<std::size_t>();
  }
  EXPECT_EQ(painted, 4U);
  for (const char* name : {"a-mpo", "a-pair", "c", "trip/b_sbs"})
    EXPECT_TRUE(fs::exists(folder / "out" / name / "left.png")) << name;
  for (const char* wrong : {"0/3", "4/3", "3", "a/b", "1/0"})
    EXPECT_EQ(paint(folder, {"--part", wrong}).exit_code, 2) << wrong;
}

TEST(PaintFolder, HasAContactSheetOfAllResults) {
  const TemporaryFolder folder;
  write_photographs(folder / "photos");
  paint(folder, {"--part", "1/2"});
  const ProgramResult result = paint(folder, {"--contact-sheet", "--skip-existing"});
  EXPECT_THAT(result.output, HasSubstr("contact sheet: out/contact_sheet.png"));
  const Image<Rgb8> sheet = read_image(folder / "out/contact_sheet.png");
  EXPECT_EQ(sheet.width(), 2 * 332 + 12);  // four results
  EXPECT_EQ(sheet.height(), 2 * 278 + 12);
}

TEST(PaintCommand, ShowsOnePhotographInAllStyles) {
  const TemporaryFolder folder;
  write_photographs(folder / "photos");
  const ProgramResult result =
      run_program({"paint", "photos/a.mpo", "--contact-sheet", "--range", "0:12", "-o", "styles", "--quiet"},
                  {.folder = folder / ""});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  run_program({"paint", "photos/a.mpo", "--style", "mosaic", "--range", "0:12", "-o", "mosaic", "--quiet"},
              {.folder = folder / ""});
  EXPECT_EQ(bytes_of(folder / "styles/mosaic/left.png"), bytes_of(folder / "mosaic/left.png"));
  EXPECT_GT(read_image(folder / "styles/contact_sheet.png").width(), 3 * 332);
  expect_refused(folder, {"paint", "photos/a.mpo", "--contact-sheet", "--style", "mosaic", "-o", "new"}, 2,
                 "--style: has no effect with --contact-sheet of one photograph");
}

TEST(PaintFolder, IsNotPaintedInADryRun) {
  const TemporaryFolder folder;
  write_photographs(folder / "photos");
  const ProgramResult result = paint(folder, {"--dry-run"});
  EXPECT_THAT(result.output, HasSubstr("would be written to out/a-pair (pair with a_R.png, by their names)"));
  EXPECT_THAT(result.output, HasSubstr("4 photographs, none painted"));
  EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST(PaintFolder, ThatCannotBePaintedIsRefused) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "empty");
  expect_refused(folder, {"paint", "empty", "-o", "out"}, 3, "empty: holds no picture");
  fs::create_directory(folder / "flat");
  write_image(folder / "flat/one.png", still_for_test(96, 72).left);
  expect_refused(folder, {"paint", "flat", "-o", "flat/out"}, 2, "flat/out: lies in flat");
  expect_refused(folder, {"paint", "flat", "-o", "flat"}, 2, "expected an output");
  expect_refused(folder, {"paint", "flat/one.png", "--dry-run"}, 2, "it works on a folder of photographs");
  expect_refused(folder, {"paint", "flat", "--depth", "d.png", "-o", "out"}, 2, "but a folder is given");
  put_bytes(folder / "pairs.tsv", "one\n");
  expect_refused(folder, {"paint", "flat", "--pairs", "pairs.tsv", "-o", "out"}, 3, "pairs.tsv:1: expected LEFT");
  const ProgramResult none = run_program({"paint", "flat", "-o", "out"}, {.folder = folder / ""});
  EXPECT_EQ(none.exit_code, 3);
  EXPECT_THAT(none.errors, HasSubstr("flat: holds pictures, but no stereo photograph"));
  EXPECT_FALSE(fs::exists(folder / "out"));
}

}  // namespace wheatstone::paint_folder_test
