#include "wheatstone/files/file_lock.h"

#include <gtest/gtest.h>

#include <thread>

#include "temporary_folder.h"

namespace wheatstone::file_lock_test {

TEST(FileLock, IsHeldByOneAtATime) {
  const TemporaryFolder folder;
  FileLock first, second;
  EXPECT_FALSE(first.hold(folder / "lock"));
  EXPECT_EQ(second.hold(folder / "lock"), std::errc::resource_unavailable_try_again);
  first.release();
  EXPECT_FALSE(second.hold(folder / "lock"));
  EXPECT_EQ(first.hold(folder / "nowhere/lock"), std::errc::no_such_file_or_directory);
}

TEST(FileLock, OfAFileThatWasReplacedMeanwhileHoldsTheNewOne) {
  const TemporaryFolder folder;
  put_bytes(folder / "table", "old");
  FileLock first, second;
  ASSERT_FALSE(first.hold(folder / "table"));
  std::thread waiting([&] { EXPECT_FALSE(second.hold(folder / "table", true)); });
  put_bytes(folder / "new", "new");
  std::filesystem::rename(folder / "new", folder / "table");
  first.release();
  waiting.join();
  EXPECT_EQ(first.hold(folder / "table"), std::errc::resource_unavailable_try_again);
}

}  // namespace wheatstone::file_lock_test
