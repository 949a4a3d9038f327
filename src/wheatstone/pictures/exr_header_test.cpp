#include "wheatstone/pictures/exr_header_internal.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>

#include "temporary_folder.h"
#include "throws_error.h"
#include "wheatstone/pictures/picture_file.h"
#include "wheatstone/pictures/read_image.h"

namespace wheatstone::exr_header_test {

using namespace std::string_literals;

const std::string one_part = "\x76\x2f\x31\x01\x02\0\0\0"s;
const std::string several_parts = "\x76\x2f\x31\x01\x02\x10\0\0"s;
const std::string attribute = "owner\0string\0\x04\0\0\0name"s;
const std::string endless = "owner\0string\0\xff\xff\xff\x7fname"s;

std::string complaint(const std::string& bytes) {
  std::istringstream file(bytes);
  return exr_header_complaint(file);
}
bool fits(const std::string& bytes) { return complaint(bytes).empty(); }

TEST(ExrHeader, FitsWhereAllAttributesAreThere) {
  EXPECT_TRUE(fits(one_part + attribute + attribute + "\0"s + "pixels"));
  EXPECT_TRUE(fits(several_parts + attribute + "\0"s + attribute + "\0\0"s + "pixels"));
}

TEST(ExrHeader, DoesNotFitWhereAnAttributeIsLongerThanTheFile) {
  EXPECT_FALSE(fits(one_part + endless + "\0pixels"s));
  EXPECT_FALSE(fits(one_part + attribute + endless));
  EXPECT_FALSE(fits(several_parts + attribute + "\0"s + endless + "\0\0"s));
  EXPECT_FALSE(fits(one_part + "owner\0string\0\xff\xff\xff\xffname\0"s));
}

TEST(ExrHeader, DoesNotFitAFileThatIsCutShortWithinIt) {
  const std::string whole = several_parts + attribute + "\0"s + attribute + "\0\0"s;
  for (std::size_t bytes = 8; bytes < whole.size(); ++bytes) EXPECT_FALSE(fits(whole.substr(0, bytes))) << bytes;
}

TEST(ExrHeader, HasNoChannelOfAnUnknownKindOfNumbers) {
  const std::string before = one_part + "channels\0chlist\0\x13\0\0\0R\0"s;
  const std::string after = "\0\0\0\0\0\0\0\x01\0\0\0\x01\0\0\0\0"s + "\0pixels"s;
  EXPECT_EQ(complaint(before + "\x02" + after), "");
  EXPECT_EQ(complaint(before + "\x03" + after), "a channel's numbers are of an unknown kind");
  EXPECT_EQ(complaint(before + "\xff" + after), "a channel's numbers are of an unknown kind");
}

TEST(ExrHeader, IsNotAskedOfOtherFiles) {
  EXPECT_TRUE(fits(""));
  EXPECT_TRUE(fits("\x76\x2f"));
  EXPECT_TRUE(fits("P6 1 1 255 abc"));
}

TEST(ExrHeader, IsCheckedBeforeAFileIsOpened) {
  const TemporaryFolder folder;
  std::ofstream(folder / "a.exr", std::ios::binary) << one_part << endless;
  EXPECT_EQ(open_picture_file(folder / "a.exr").complaint, "its header is longer than the file");
  expect_error(ErrorKind::bad_input, "not a picture, or a damaged one", [&] { read_image(folder / "a.exr"); });
}

}  // namespace wheatstone::exr_header_test
