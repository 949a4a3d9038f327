#include "wheatstone/app/output_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "temporary_folder.h"
#include "throws_error.h"
#include "wheatstone/files/whole_file.h"

namespace wheatstone::output_folder_test {

namespace fs = std::filesystem;
using testing::UnorderedElementsAre;

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    names.push_back(entry.path().filename().string());
  return names;
}

void write_into(OutputFolder& output, const std::vector<std::string>& names) {
  for (const std::string& name : names) write_whole_file(output.file(name), "new");
}

TEST(OutputFolder, AppearsOnlyWhenItIsWhole) {
  const TemporaryFolder folder;
  {
    OutputFolder output(folder / "results");
    write_into(output, {"a.txt"});
    EXPECT_FALSE(fs::exists(folder / "results"));
  }
  EXPECT_TRUE(folder.is_empty()) << "nothing is left without a commit";
  {
    OutputFolder output(folder / "results");
    write_into(output, {"a.txt"});
    output.commit();
  }
  EXPECT_EQ(bytes_of(folder / "results/a.txt"), "new");
  EXPECT_THAT(names_in(folder / ""), UnorderedElementsAre("results"));
}

TEST(OutputFolder, ReplacesOnlyFilesOfTheSameNames) {
  const TemporaryFolder folder;
  put_bytes(folder / "mine.txt", "mine");
  put_bytes(folder / "a.txt", "old");
  {
    OutputFolder output(folder / "");
    write_into(output, {"a.txt"});
    output.commit();
  }
  EXPECT_EQ(bytes_of(folder / "a.txt"), "new");
  EXPECT_EQ(bytes_of(folder / "mine.txt"), "mine");
  EXPECT_THAT(names_in(folder / ""), UnorderedElementsAre("a.txt", "mine.txt"));
}

TEST(OutputFolder, ReplacesANumberedSeriesAsAWholeAndNothingForeign) {
  const TemporaryFolder folder;
  for (const char* name : {"view_000.png", "view_002.png", "view_004.png", "view_002_disparity.pfm", "view_007.jpg",
                           "view_02.png", "view_20261122.png", "myview_002.png", "notes.txt"})
    put_bytes(folder / name, "old");
  fs::create_directory(folder / "view_003.png");
  OutputFolder output(folder / "");
  write_into(output, {"view_000.png", "view_001.png"});
  output.commit();
  EXPECT_THAT(names_in(folder / ""),
              UnorderedElementsAre("view_000.png", "view_001.png", "view_003.png", "view_002_disparity.pfm",
                                   "view_007.jpg", "view_02.png", "view_20261122.png", "myview_002.png", "notes.txt"));
}

TEST(OutputFolder, ReplacesASeriesThatCountsBeyondItsDigits) {
  const TemporaryFolder folder;
  for (const char* name : {"view_999.png", "view_1000.png", "view_2000.png"}) put_bytes(folder / name, "old");
  OutputFolder output(folder / "");
  write_into(output, {"view_000.png"});
  output.commit();
  EXPECT_THAT(names_in(folder / ""), UnorderedElementsAre("view_000.png", "view_2000.png"));
}

TEST(OutputFolder, RefusesToReplaceAnInput) {
  const TemporaryFolder folder;
  put_bytes(folder / "left.png", "photograph");
  put_bytes(folder / "right.png", "photograph");
  fs::create_directory(folder / "out");
  fs::create_symlink("../left.png", folder / "out/left.png");
  fs::create_hard_link(folder / "right.png", folder / "out/right.png");
  const std::vector<fs::path> inputs{folder / "left.png", folder / "right.png"};
  for (const char* place : {"", "out"}) {
    const OutputFolder output(folder / place, inputs);
    for (const char* name : {"left.png", "right.png"})
      expect_error(ErrorKind::wrong_usage, std::string(name) + ": is the same file as the input",
                   [&] { output.file(name); });
    EXPECT_NO_THROW(output.file("anaglyph.png"));
  }
  expect_error(ErrorKind::wrong_usage, "left.png", [&] { OutputFolder(folder / "left.png", inputs); });
}

TEST(OutputFolder, RefusesToRemoveAnInputOfTheSameSeries) {
  const TemporaryFolder folder;
  put_bytes(folder / "view_003.png", "photograph");
  {
    OutputFolder output(folder / "", {folder / "view_003.png"});
    write_into(output, {"view_000.png", "view_001.png"});
    expect_error(ErrorKind::wrong_usage, "view_003.png: is the same file as the input", [&] { output.commit(); });
  }
  EXPECT_THAT(names_in(folder / ""), UnorderedElementsAre("view_003.png"));
}

TEST(OutputFolder, MovesNothingWhereAFolderIsInTheWay) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "b.txt");
  put_bytes(folder / "a.txt", "old");
  {
    OutputFolder output(folder / "");
    write_into(output, {"a.txt", "b.txt"});
    expect_error(ErrorKind::cannot_read_write, "b.txt: cannot be written", [&] { output.commit(); });
  }
  EXPECT_EQ(bytes_of(folder / "a.txt"), "old");
  EXPECT_THAT(names_in(folder / ""), UnorderedElementsAre("a.txt", "b.txt"));
}

TEST(OutputFolder, IsReachedThroughALink) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "real");
  fs::create_directory_symlink("real", folder / "link");
  OutputFolder output(folder / "link");
  write_into(output, {"a.txt"});
  output.commit();
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
  EXPECT_THAT(names_in(folder / "real"), UnorderedElementsAre("a.txt"));
}

TEST(OutputFolder, NeedsNothingFromTheFolderAbove) {
  const TemporaryFolder folder;
  fs::create_directories(folder / "above/mine");
  fs::permissions(folder / "above", fs::perms::owner_read | fs::perms::owner_exec);
  {
    OutputFolder output(folder / "above/mine");
    write_into(output, {"a.txt"});
    EXPECT_THAT(names_in(folder / "above"), UnorderedElementsAre("mine"));
    output.commit();
  }
  fs::permissions(folder / "above", fs::perms::owner_all);
  EXPECT_THAT(names_in(folder / "above/mine"), UnorderedElementsAre("a.txt"));
}

TEST(OutputFolder, MakesTheFoldersAboveAndRemovesThemWhenItIsNotFinished) {
  const TemporaryFolder folder;
  {
    const OutputFolder output(folder / "new/below/views");
    put_bytes(output.file("a.txt"), "a");
  }
  EXPECT_TRUE(folder.is_empty());
  OutputFolder output(folder / "new/below/views");
  put_bytes(output.file("a.txt"), "a");
  output.commit();
  EXPECT_THAT(names_in(folder / "new/below/views"), UnorderedElementsAre("a.txt"));
}

TEST(OutputFolder, FollowsALinkThatLeadsNowhereYet) {
  const TemporaryFolder folder;
  fs::create_symlink("target", folder / "link");
  OutputFolder output(folder / "link");
  put_bytes(output.file("a.txt"), "a");
  output.commit();
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
  EXPECT_THAT(names_in(folder / "target"), UnorderedElementsAre("a.txt"));
}

TEST(OutputFolder, RefusesWhatCannotBeAFolder) {
  const TemporaryFolder folder;
  put_bytes(folder / "file", "x");
  expect_error(ErrorKind::cannot_read_write, "is a file", [&] { OutputFolder(folder / "file"); });
  expect_error(ErrorKind::cannot_read_write, "file/such", [&] { OutputFolder(folder / "file/such"); });
  expect_error(ErrorKind::wrong_usage, "empty", [] { OutputFolder(""); });
}

}  // namespace wheatstone::output_folder_test
