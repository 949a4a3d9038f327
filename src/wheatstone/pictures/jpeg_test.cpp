#include "wheatstone/pictures/jpeg_internal.h"

#include <gtest/gtest.h>

#include <string>

namespace wheatstone::jpeg_test {

// A thumbnail's end marker inside a segment, then a scan, then the real end marker.
const std::string whole(
    "\xFF\xD8"
    "\xFF\xE1\x00\x06\x01\xFF\xD9\x02"
    "\xFF\xDA\x00\x03\x00"
    "data\xFF\x00more"
    "\xFF\xD9",
    27);

TEST(JpegEnd, IsFoundInAWholeFile) { EXPECT_TRUE(jpeg_is_whole(whole)); }

TEST(JpegEnd, IsFoundBeforeTrailingBytes) { EXPECT_TRUE(jpeg_is_whole(whole + "camera's own bytes")); }

TEST(JpegEnd, IsMissingFromEveryPartOfAFile) {
  for (std::size_t length = 4; length < whole.size(); ++length) {
    EXPECT_FALSE(jpeg_is_whole(whole.substr(0, length))) << length << " bytes";
  }
}

TEST(JpegEnd, IsNotAskedOfOtherFiles) { EXPECT_TRUE(jpeg_is_whole("\x89PNG\r\n")); }

}  // namespace wheatstone::jpeg_test
