#include "cli/window_program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>
#include <vector>

namespace wheatstone::cli::view_words_test {

using testing::ElementsAre;

std::vector<std::string> passed_on(std::vector<std::string> words) {
  CLI::App command;
  ViewArguments arguments;
  const Rows rows = view_rows(arguments);
  add_rows(command, rows);
  std::ranges::reverse(words);  // CLI11 takes the last word first
  command.parse(words);
  return words_of(given_on(command, rows));
}

TEST(ViewWords, AreThoseThatWereGiven) {
  EXPECT_THAT(passed_on({}), ElementsAre());
  EXPECT_THAT(passed_on({"--focus", ".5,.4", "--focus-gain", "0.30000001", "a.npy"}),
              ElementsAre("--focus", ".5,.4", "--focus-gain", "0.30000001", "--", "a.npy"));
  EXPECT_THAT(passed_on({"left.png", "--mode", "left", "--full-screen", "--", "-right.png"}),
              ElementsAre("--mode", "left", "--full-screen", "--", "left.png", "-right.png"));
  // As a file of options has it.
  EXPECT_THAT(passed_on({"--full-screen=false", "a.wst"}), ElementsAre("--", "a.wst"));
}

}  // namespace wheatstone::cli::view_words_test
