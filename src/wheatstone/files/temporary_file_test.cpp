#include "wheatstone/files/temporary_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "temporary_folder.h"
#include "throws_error.h"

namespace wheatstone::temporary_file_test {

namespace fs = std::filesystem;

TEST(TemporaryFile, AppearsOnlyWhenCommitted) {
  const TemporaryFolder folder;
  TemporaryFile file(folder / "left.png");
  put_bytes(file.path(), "whole");
  EXPECT_FALSE(fs::exists(folder / "left.png"));
  file.commit();
  EXPECT_EQ(bytes_of(folder / "left.png"), "whole");
  EXPECT_FALSE(fs::exists(file.path()));
}

TEST(TemporaryFile, LeavesNothingAndHarmsNothingWithoutCommit) {
  const TemporaryFolder folder;
  put_bytes(folder / "left.png", "old");
  {
    const TemporaryFile file(folder / "left.png");
    put_bytes(file.path(), "half");
  }
  EXPECT_EQ(bytes_of(folder / "left.png"), "old");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder / ""), {}), 1);
}

TEST(TemporaryFile, KeepsFolderAndEnding) {
  const TemporaryFolder folder;
  const TemporaryFile file(folder / "left.png");
  EXPECT_EQ(file.path().parent_path(), (folder / "left.png").parent_path());
  EXPECT_EQ(file.path().extension(), ".png");
}

TEST(TemporaryFile, OfOneNameTwiceAtOnceAreTwoFiles) {
  const TemporaryFolder folder;
  const TemporaryFile first(folder / "left.png");
  const TemporaryFile second(folder / "left.png");
  EXPECT_NE(first.path(), second.path());
}

TEST(TemporaryFile, CommittedIsAsReadableAsAnyNewFile) {
  const TemporaryFolder folder;
  put_bytes(folder / "plain", "");
  TemporaryFile file(folder / "left.png");
  file.commit();
  EXPECT_EQ(fs::status(folder / "left.png").permissions(), fs::status(folder / "plain").permissions());
}

TEST(TemporaryFile, ReplacesWhatALinkPointsAt) {
  const TemporaryFolder folder;
  put_bytes(folder / "real.png", "old");
  fs::create_symlink(folder / "real.png", folder / "link.png");
  TemporaryFile file(folder / "link.png");
  put_bytes(file.path(), "new");
  file.commit();
  EXPECT_TRUE(fs::is_symlink(folder / "link.png"));
  EXPECT_EQ(bytes_of(folder / "real.png"), "new");
}

TEST(TemporaryFile, OfADeviceIsTheDevice) {
  TemporaryFile file("/dev/null");
  EXPECT_EQ(file.path(), "/dev/null");
  file.commit();
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST(TemporaryFile, RefusesAFolderAndWhatCannotBeInOne) {
  const TemporaryFolder folder;
  put_bytes(folder / "file", "x");
  expect_error(ErrorKind::cannot_read_write, "file", [&] { TemporaryFile(folder / "file/left.png"); });
  expect_error(ErrorKind::cannot_read_write, "cannot write", [&] { TemporaryFile(folder / ""); });
}

TEST(TemporaryFile, MakesItsFoldersAndRemovesThemWhenItIsNotFinished) {
  const TemporaryFolder folder;
  { const TemporaryFile file(folder / "new/below/left.png"); }
  EXPECT_TRUE(folder.is_empty());
  {
    const TemporaryFile file(folder / "new/left.png");
    TemporaryFile other(folder / "new/right.png");
    other.commit();
  }
  EXPECT_FALSE(fs::exists(folder / "new/left.png"));
  EXPECT_TRUE(fs::exists(folder / "new/right.png"));
  const TemporaryFile file(folder / "at/once/left.png");
  remove_unfinished_outputs();
  EXPECT_FALSE(fs::exists(folder / "at"));
}

TEST(TemporaryFile, FollowsALinkThatLeadsNowhereYet) {
  const TemporaryFolder folder;
  fs::create_symlink("below/target.png", folder / "link.png");
  TemporaryFile file(folder / "link.png");
  put_bytes(file.path(), "x");
  file.commit();
  EXPECT_TRUE(fs::is_symlink(folder / "link.png"));
  EXPECT_EQ(bytes_of(folder / "below/target.png"), "x");
}

}  // namespace wheatstone::temporary_file_test
