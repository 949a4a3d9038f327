// One process runs many command lines: none leaves anything behind for the next.

#include "cli/run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <opencv2/core.hpp>
#include <sstream>

#include "cli/run_program.h"

namespace wheatstone::run_test {

struct Said {
  int exit_code;
  std::string output;
  std::string errors;
};

Said run(const std::vector<std::string>& arguments) {
  std::ostringstream output;
  std::ostringstream errors;
  const int exit_code = cli::run_command_line(arguments, output, errors);
  return {exit_code, output.str(), errors.str()};
}

TEST(RunCommandLine, PrintsToItsStreams) {
  const Said said = run({"depth", "--json"});
  EXPECT_EQ(said.exit_code, 0);
  EXPECT_THAT(said.output, testing::StartsWith("{"));
  EXPECT_EQ(said.errors, "");
  EXPECT_THAT(run({"--help"}).output, testing::HasSubstr("Commands:"));
  EXPECT_EQ(run({"depth", "--quix"}).output, "");
  EXPECT_EQ(run({"depth", "--quix"}).exit_code, 2);
}

TEST(RunCommandLine, OptionsOfOneRunAreGoneInTheNext) {
  ASSERT_EQ(run({"depth", "--json", "--near", "300"}).exit_code, 0);
  const Said next = run({"depth"});
  EXPECT_THAT(next.output, testing::StartsWith("screen: "));
  EXPECT_EQ(next.output, run_program({"depth"}, {.own_process = true}).output);
}

TEST(RunCommandLine, LimitOfThreadsEndsWithItsRun) {
  const auto limit = [] { return tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism); };
  const std::size_t before = limit();
  const int before_in_opencv = cv::getNumThreads();
  ASSERT_EQ(run({"depth", "--threads", "1"}).exit_code, 0);
  EXPECT_EQ(limit(), before);
  EXPECT_EQ(cv::getNumThreads(), before_in_opencv);
}

TEST(RunCommandLine, OutputThatFailsIsExitCodeFour) {
  std::ostringstream output;
  output.setstate(std::ios::badbit);
  std::ostringstream errors;
  const std::vector<std::string> arguments = {"depth"};
  EXPECT_EQ(cli::run_command_line(arguments, output, errors), 4);
  EXPECT_EQ(errors.str(), "wheatstone: standard output: cannot write\n");
}

}  // namespace wheatstone::run_test
