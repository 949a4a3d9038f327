#include "cli/progress_display.h"

#include <gtest/gtest.h>

#include <sstream>
#include <string>

namespace wheatstone::cli::progress_display_test {

using std::chrono::seconds;

constexpr ProgressDisplay::Clock::time_point start{seconds(1000)};

TEST(ProgressDisplay, ALineTellsNowAndThenHowLongItTakes) {
  std::ostringstream errors;
  ProgressDisplay display(ProgressDisplay::Style::every_step, errors);
  for (int second = 0; second <= 24; ++second) display.show("frames", second / 60.0, start + seconds(second));
  display.show("marks", 0, start + seconds(25));
  EXPECT_EQ(errors.str(), "frames\nframes: 17 %, 0:10 gone, 0:50 left\nframes: 33 %, 0:20 gone, 0:40 left\nmarks\n");
}

TEST(ProgressDisplay, LinesBeginWhereARunTakesTwoSeconds) {
  std::ostringstream errors;
  ProgressDisplay display(ProgressDisplay::Style::lines, errors);
  display.show("reading", 0, start);
  display.show("matching", 0, start + std::chrono::milliseconds(1900));
  EXPECT_EQ(errors.str(), "");
  display.show("matching", 0.2, start + seconds(3));
  display.show("matching", 0.3, start + seconds(4));
  display.show("painting", 0, start + seconds(5));
  EXPECT_EQ(errors.str(), "matching\npainting\n");
}

TEST(ProgressDisplay, TheBarTellsItAfterTwoSeconds) {
  std::ostringstream errors;
  ProgressDisplay display(ProgressDisplay::Style::bar, errors);
  display.show("frames", 0, start);
  display.show("frames", 0.01, start + seconds(1));
  EXPECT_EQ(errors.str().find("left"), std::string::npos);
  display.show("frames", 0.02, start + seconds(150));
  EXPECT_NE(errors.str().find("2 % frames, 2:30 gone, 2:02:30 left"), std::string::npos) << errors.str();
}

TEST(ProgressDisplay, WhatAnEarlierRunDidCountsForNothing) {
  std::ostringstream errors;
  ProgressDisplay display(ProgressDisplay::Style::every_step, errors);
  display.show("painting frame 50 of 100", 0.5, start);
  display.show("painting frame 60 of 100", 0.6, start + seconds(10));
  EXPECT_EQ(errors.str(), "painting frame 50 of 100\npainting frame 60 of 100: 60 %, 0:10 gone, 0:40 left\n");
}

}  // namespace wheatstone::cli::progress_display_test
