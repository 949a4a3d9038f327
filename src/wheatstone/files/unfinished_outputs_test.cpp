#include "wheatstone/files/unfinished_outputs.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <future>
#include <stdexcept>
#include <thread>

#include "temporary_folder.h"
#include "throws_error.h"
#include "wheatstone/error.h"
#include "wheatstone/files/temporary_file.h"

namespace wheatstone::unfinished_outputs_test {

namespace fs = std::filesystem;

TEST(UnfinishedOutputs, AreAllRemovedAtOnce) {
  const TemporaryFolder folder;
  const TemporaryFile file(folder / "left.png");
  UnfinishedOutput output;
  output.begin(folder / "views.partial", [&] {
    fs::create_directory(folder / "views.partial");
    put_bytes(folder / "views.partial/view_000.png", "view");
  });
  EXPECT_FALSE(outputs_are_finished());
  remove_unfinished_outputs();
  EXPECT_TRUE(folder.is_empty());
}

TEST(UnfinishedOutputs, AreFinishedWhenTheLastHasItsName) {
  const TemporaryFolder folder;
  TemporaryFile first(folder / "left.png"), second(folder / "right.png");
  first.commit();
  EXPECT_FALSE(outputs_are_finished());
  second.commit();
  EXPECT_TRUE(outputs_are_finished());
  remove_unfinished_outputs();
  EXPECT_EQ(std::distance(fs::directory_iterator(folder / ""), {}), 2);
}

TEST(UnfinishedOutputs, OfWorkThatNobodyWaitsForAreNotFinished) {
  const TemporaryFolder folder;
  bool wanted = true;
  {
    const OutputsOnlyWhile only([&] { return wanted; });
    TemporaryFile first(folder / "left.png"), second(folder / "right.png");
    first.commit();
    wanted = false;
    EXPECT_THROW(second.commit(), Error);
  }
  TemporaryFile(folder / "other.png").commit();
  EXPECT_EQ(std::distance(fs::directory_iterator(folder / ""), {}), 2);
}

TEST(UnfinishedOutputs, AreNotThoseOfAForkedChild) {
  const TemporaryFolder folder;
  const TemporaryFile file(folder / "made/left.png");
  // The child cannot wait for a thread that it does not have.
  std::promise<void> held, ended;
  std::thread holder([&] {
    const auto hold = hold_outputs();
    held.set_value();
    ended.get_future().wait();
  });
  held.get_future().wait();
  const pid_t child = ::fork();
  if (child == 0) {
    ::alarm(20);
    remove_unfinished_outputs();
    TemporaryFile own(folder / "made/right.png");
    own.commit();
    ::_exit(outputs_are_finished() ? 0 : 1);
  }
  int status = -1;
  ::waitpid(child, &status, 0);
  ended.set_value();
  holder.join();
  EXPECT_EQ(status, 0);
  TemporaryFile(folder / "other.png").commit();
  EXPECT_TRUE(fs::exists(folder / "made/right.png"));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder / "made"), {}), 2) << "what the parent writes is there";
}

TEST(MissingFolders, AreRemovedWhereNothingCameToLieInThem) {
  const TemporaryFolder folder;
  {
    const MissingFolders made(folder / "a/b"), same(folder / "a/b"), other(folder / "c/d/");
    EXPECT_TRUE(fs::is_directory(folder / "a/b") && fs::is_directory(folder / "c/d"));
    put_bytes(folder / "c/e", "1");
  }
  EXPECT_FALSE(fs::exists(folder / "a"));
  EXPECT_TRUE(fs::exists(folder / "c/e") && !fs::exists(folder / "c/d"));
  {
    const MissingFolders made(folder / "a/b");
    remove_unfinished_outputs();
    EXPECT_FALSE(fs::exists(folder / "a"));
  }
  put_bytes(folder / "f", "1");
  expect_error(ErrorKind::cannot_read_write, "the folder cannot be made", [&] { MissingFolders made(folder / "f/g"); });
}

TEST(UnfinishedOutputs, ThatAreKeptStay) {
  const TemporaryFolder folder;
  {
    UnfinishedOutput kept, other;
    kept.begin(folder / "kept", [&] { put_bytes(folder / "kept", "1"); });
    other.begin(folder / "other", [&] { put_bytes(folder / "other", "1"); });
    kept.keep(true);
    other.keep(true);
    other.keep(false);
    remove_unfinished_outputs();
    EXPECT_TRUE(std::filesystem::exists(folder / "kept"));
    EXPECT_FALSE(std::filesystem::exists(folder / "other"));
    EXPECT_FALSE(outputs_are_finished());
  }
  EXPECT_TRUE(std::filesystem::exists(folder / "kept"));
}

TEST(UnfinishedOutputs, ThatSeveralGoOnWithStayWhereAllKeepThem) {
  const TemporaryFolder folder;
  {
    UnfinishedOutput first, second;
    first.begin(folder / "kept", [&] { put_bytes(folder / "kept", "1"); });
    second.begin(folder / "kept", [] {});
    first.keep(true);
    second.keep(true);
    remove_unfinished_outputs();
  }
  EXPECT_TRUE(fs::exists(folder / "kept"));
  TemporaryFile file(folder / "done");
  file.commit();
  EXPECT_TRUE(outputs_are_finished()) << "nothing of them is remembered";
}

TEST(UnfinishedOutputs, AreNotBegunWhereTheyCannotBeMade) {
  const TemporaryFolder folder;
  put_bytes(folder / "foreign", "not ours");
  {
    UnfinishedOutput output;
    EXPECT_THROW(output.begin(folder / "foreign", [] { throw std::runtime_error("is there already"); }),
                 std::runtime_error);
    remove_unfinished_outputs();
  }
  EXPECT_EQ(bytes_of(folder / "foreign"), "not ours");
}

TEST(UnfinishedOutputs, RemainSoWhereTheyCannotBeRenamed) {
  const TemporaryFolder folder;
  {
    UnfinishedOutput output;
    output.begin(folder / "half", [&] { put_bytes(folder / "half", "half"); });
    EXPECT_THROW(output.finish([] { throw std::runtime_error("is in the way"); }), std::runtime_error);
    EXPECT_FALSE(outputs_are_finished());
  }
  EXPECT_TRUE(folder.is_empty());
}

}  // namespace wheatstone::unfinished_outputs_test
