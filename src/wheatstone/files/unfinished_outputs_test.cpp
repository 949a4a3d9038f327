#include "wheatstone/files/unfinished_outputs.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "temporary_folder.h"
#include "wheatstone/error.h"
#include "wheatstone/files/temporary_file.h"

namespace wheatstone {
namespace {

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

}  // namespace
}  // namespace wheatstone
