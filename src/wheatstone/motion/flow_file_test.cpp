#include "wheatstone/motion/flow_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/video/tracking.hpp>

#include "temporary_folder.h"
#include "throws_error.h"

namespace wheatstone::flow_file_test {

Flow some_flow() {
  Flow flow{Image<float>(5, 3), Image<float>(5, 3)};
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 5; ++x) flow.x(x, y) = 0.5f * static_cast<float>(x), flow.y(x, y) = -static_cast<float>(y);
  return flow;
}

TEST(FlowFile, OpenCvReadsWhatIsWritten) {
  const TemporaryFolder folder;
  const Flow flow = some_flow();
  write_flow(folder / "a.flo", flow);
  const cv::Mat read = cv::readOpticalFlow(folder / "a.flo");
  ASSERT_EQ(read.size(), cv::Size(5, 3));
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 5; ++x) EXPECT_EQ(read.at<cv::Vec2f>(y, x), cv::Vec2f(flow.x(x, y), flow.y(x, y)));
}

TEST(FlowFile, ComesBackWithItsUnknownPixels) {
  const TemporaryFolder folder;
  Flow flow = some_flow();
  flow.x(2, 1) = NAN;
  flow.y(2, 1) = NAN;
  write_flow(folder / "a.flo", flow);
  const Flow read = read_flow(folder / "a.flo");
  EXPECT_TRUE(std::isnan(read.x(2, 1)) && std::isnan(read.y(2, 1)));
  EXPECT_EQ(read.x(4, 2), flow.x(4, 2));
  EXPECT_EQ(read.y(4, 2), flow.y(4, 2));
}

TEST(FlowFile, RefusesWhatIsNoFlow) {
  const TemporaryFolder folder;
  write_flow(folder / "a.flo", some_flow());
  const std::string bytes = bytes_of(folder / "a.flo");
  for (std::size_t length = 0; length < bytes.size(); ++length)
    expect_error(ErrorKind::bad_input, "a.flo: ", [&] { decode_flow(bytes.substr(0, length), "a.flo"); });
  std::string huge = bytes;
  huge.replace(4, 4, "\x7f\x7f\x7f\x7f");
  expect_error(ErrorKind::bad_input, "pixels, expected 1 to", [&] { decode_flow(huge, "a.flo"); });
  std::string negative = bytes;
  negative.replace(8, 4, "\xff\xff\xff\xff");
  expect_error(ErrorKind::bad_input, "5x-1 pixels", [&] { decode_flow(negative, "a.flo"); });
  expect_error(ErrorKind::bad_input, "PIEH", [&] { decode_flow("P6 3 3 255 and so on", "a.flo"); });
  expect_error(ErrorKind::bad_input, "nowhere.flo", [&] { read_flow(folder / "nowhere.flo"); });
}

}  // namespace wheatstone::flow_file_test
