#include "wheatstone/pictures/disparity_file.h"

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>

#include "temporary_folder.h"
#include "throws_error.h"
#include "wheatstone/error.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/pictures/portable_float_map_internal.h"

namespace wheatstone::disparity_file_test {

namespace fs = std::filesystem;

class DisparityFile : public testing::Test {
 protected:
  fs::path in_folder(const std::string& name) const { return folder_ / name; }

 private:
  TemporaryFolder folder_;
};

Image<float> ramp(float offset) {
  Image<float> disparity(7, 5);
  for (int y = 0; y < 5; ++y)
    for (int x = 0; x < 7; ++x) disparity(x, y) = offset + static_cast<float>(x) + 0.25f * static_cast<float>(y);
  disparity(3, 2) = std::numeric_limits<float>::quiet_NaN();
  return disparity;
}

void expect_equal(const Image<float>& a, const Image<float>& b, float tolerance) {
  ASSERT_TRUE(same_size(a, b));
  for (std::size_t i = 0; i < a.pixels().size(); ++i) {
    if (std::isnan(b.pixels()[i])) {
      EXPECT_TRUE(std::isnan(a.pixels()[i]));
    } else {
      EXPECT_NEAR(a.pixels()[i], b.pixels()[i], tolerance);
    }
  }
}

TEST_F(DisparityFile, ComesBackFromPfmAndExrAsItWas) {
  for (const char* name : {"ramp.pfm", "ramp.exr"}) {
    write_disparity(in_folder(name), ramp(-3));
    expect_equal(read_disparity(in_folder(name)), ramp(-3), 0);
  }
}

TEST_F(DisparityFile, ComesBackFromPngWithinItsStep) {
  write_disparity(in_folder("ramp.png"), ramp(1));
  expect_equal(read_disparity(in_folder("ramp.png")), ramp(1), 0.5f / 256);
}

TEST_F(DisparityFile, OfAnyRangeComesBackFromPngWithinItsStep) {
  write_disparity(in_folder("negative.png"), ramp(-3));
  expect_equal(read_disparity(in_folder("negative.png")), ramp(-3), 0.5f / 256);
  Image<float> far(3, 1);
  far(0, 0) = -2000;
  far(1, 0) = 3000;
  far(2, 0) = std::numeric_limits<float>::quiet_NaN();
  write_disparity(in_folder("far.png"), far);
  expect_equal(read_disparity(in_folder("far.png")), far, 0.05f);
  // A scale that is given counts.
  EXPECT_NEAR(read_disparity(in_folder("negative.png"), 256.f)(0, 0), 1 + ramp(-3)(0, 0) - std::floor(ramp(-3)(0, 0)),
              2);
}

TEST_F(DisparityFile, ScalesEightBitPngAndTakesZeroForUnknown) {
  const std::uint8_t values[] = {0, 4, 200, 255};
  const fs::path path = in_folder("eight.png");
  const auto output = OIIO::ImageOutput::create(path.string());
  ASSERT_TRUE(output->open(path.string(), OIIO::ImageSpec(4, 1, 1, OIIO::TypeDesc::UINT8)));
  output->write_image(OIIO::TypeDesc::UINT8, values);
  output->close();
  const Image<float> disparity = read_disparity(path, 4.f);
  EXPECT_TRUE(std::isnan(disparity(0, 0)));
  EXPECT_FLOAT_EQ(disparity(1, 0), 1);
  EXPECT_FLOAT_EQ(disparity(3, 0), 63.75f);
}

TEST_F(DisparityFile, ReadsBigEndianPfm) {
  std::string bytes = "Pf\n2 1\n1.0\n";
  bytes += std::string("\x3F\x80\x00\x00\xC0\x00\x00\x00", 8);  // 1 and −2
  const Image<float> disparity = decode_pfm(bytes, "big.pfm");
  EXPECT_FLOAT_EQ(disparity(0, 0), 1);
  EXPECT_FLOAT_EQ(disparity(1, 0), -2);
}

TEST_F(DisparityFile, TakesInfinityForUnknown) {
  Image<float> disparity(2, 1, 5);
  disparity(1, 0) = std::numeric_limits<float>::infinity();
  write_disparity(in_folder("infinite.pfm"), disparity);
  EXPECT_TRUE(std::isnan(read_disparity(in_folder("infinite.pfm"))(1, 0)));
}

TEST_F(DisparityFile, IsRefusedWhereNothingIsKnown) {
  write_disparity(in_folder("bad.pfm"), Image<float>(2, 1, std::numeric_limits<float>::infinity()));
  expect_error(ErrorKind::bad_input, in_folder("bad.pfm").string() + ": the disparity is unknown everywhere",
               [this] { read_disparity(in_folder("bad.pfm")); });
}

TEST_F(DisparityFile, NamesTheFileAndTheTroubleInOneLine) {
  const auto message_of = [this](const std::string& bytes) -> std::string {
    write_whole_file(in_folder("bad.pfm"), bytes);
    try {
      read_disparity(in_folder("bad.pfm"));
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::bad_input);
      return error.what();
    }
    return "no error";
  };
  EXPECT_THAT(message_of("Pf\n2 2\n-1\nabc"), testing::HasSubstr("bad.pfm: is truncated"));
  EXPECT_THAT(message_of("Pf\n-2 2\n-1\nabc"), testing::HasSubstr("-2x2"));
  EXPECT_THAT(message_of("Pf\n2 2\n0\nabc"), testing::HasSubstr("scale"));
  EXPECT_THAT(message_of("Pf\n99999999999 2\n-1\n"), testing::HasSubstr("not a number"));
  EXPECT_THAT(message_of("hello"), testing::HasSubstr("not a disparity map"));
}

TEST_F(DisparityFile, SurvivesEveryFlippedByteOfAPfm) {
  write_disparity(in_folder("good.pfm"), ramp(2));
  const std::string good = read_whole_file(in_folder("good.pfm"), 10'000);
  for (std::size_t i = 0; i < good.size(); ++i) {
    for (const int flip : {0x01, 0x80, 0xFF}) {
      std::string bad = good;
      bad[i] = static_cast<char>(bad[i] ^ flip);
      try {
        EXPECT_GT(decode_pfm(bad, "flipped").pixels().size(), 0u);
      } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::bad_input);
      }
    }
  }
}

}  // namespace wheatstone::disparity_file_test
