#include "wheatstone/ranks/ranks.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>

#include "thread_ranks.h"
#include "wheatstone/error.h"
#include "wheatstone/ranks/launch.h"

namespace wheatstone::ranks_test {

Ranks::Bytes text(const std::string& words) { return Ranks::bytes_of(std::span<const char>(words)); }

TEST(Ranks, OneAloneNeedsNobody) {
  const Ranks ranks;
  EXPECT_TRUE(ranks.alone());
  EXPECT_TRUE(ranks.first());
  ranks.meet();
  EXPECT_EQ(ranks.from_all(7), std::vector<int>{7});
  EXPECT_EQ(ranks.from_first(text("all")), text("all"));
  EXPECT_EQ(ranks.fail({3, "broken"}).message, "broken");
}

TEST(Ranks, GiveEachOtherWhatIsForEach) {
  as_ranks(3, [](const Ranks& ranks) {
    const char mine = static_cast<char>('a' + ranks.rank());
    std::vector<Ranks::Bytes> to;
    for (const std::string other : {"0", "1", "2"}) to.push_back(text(mine + other));
    const std::vector<Ranks::Bytes> from = ranks.exchange(to);
    const std::string me = std::to_string(ranks.rank());
    EXPECT_EQ(from, (std::vector<Ranks::Bytes>{text("a" + me), text("b" + me), text("c" + me)}));
    EXPECT_EQ(ranks.from_all(10 * ranks.rank()), (std::vector<int>{0, 10, 20}));
    EXPECT_EQ(ranks.from_first(text(std::string(1, mine))), text("a"));
    EXPECT_TRUE(anywhere(ranks.rank() == 1, ranks));
    EXPECT_FALSE(anywhere(false, ranks));
    EXPECT_EQ(ranks.to_first(text("x"))[2].size(), ranks.first() ? 1u : 0u);
  });
}

TEST(Ranks, PartsOfAListAreAllOfIt) {
  std::atomic<std::size_t> sum = 0;
  as_ranks(4, [&](const Ranks& ranks) {
    const RankPart part = part_of(ranks, 10);
    EXPECT_EQ(part.first == 0, ranks.first());
    sum += part.end - part.first;
  });
  EXPECT_EQ(sum, 10u);
}

TEST(Ranks, AllEndWithTheErrorOfTheFirstThatFails) {
  for (const int failing : {0, 1, 2}) {
    std::array<std::string, 3> said;
    EXPECT_THROW(as_ranks(3,
                          [&](const Ranks& ranks) {
                            try {
                              ranks.meet();
                              if (ranks.rank() >= failing)
                                throw Error(ErrorKind::bad_input, "part " + std::to_string(ranks.rank()));
                              ranks.from_all(1);
                              ranks.from_all(2);
                            } catch (const Error& error) {
                              said[ranks.rank()] = ranks.fail({static_cast<int>(error.kind()), error.what()}).message;
                              throw;
                            }
                          }),
                 Error);
    for (const std::string& words : said) EXPECT_EQ(words, "part " + std::to_string(failing));
  }
}

TEST(Launch, IsThatOfMpirunOrNone) {
  ::unsetenv("OMPI_COMM_WORLD_RANK");
  ::unsetenv("PMI_RANK");
  EXPECT_FALSE(mpi_launch());
  ::setenv("PMI_RANK", "2", 1);
  ::setenv("PMI_SIZE", "4", 1);
  ASSERT_TRUE(mpi_launch());
  EXPECT_EQ(mpi_launch()->rank, 2);
  EXPECT_EQ(mpi_launch()->count, 4);
  ::unsetenv("PMI_RANK");
  EXPECT_TRUE(start_ranks({0, 1}).alone());
}

}  // namespace wheatstone::ranks_test
