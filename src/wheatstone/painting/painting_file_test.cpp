#include "wheatstone/painting/painting_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "painting_generated.h"
#include "wheatstone/error.h"
#include "wheatstone/painting/svg.h"

namespace wheatstone {
namespace {

Painting small_painting() {
  Layer layer;
  layer.radius_px = 3;
  layer.points = {{1, 2, 3}, {4, 5.5f, -6}, {7, 8, 9}};
  layer.strokes.push_back(
      {.first_point = 0, .point_count = 2, .radius_px = 3, .opacity = 0.5f, .colour = {1, 2, 3}, .disparity = 3});
  layer.strokes.push_back({.first_point = 2,
                           .point_count = 1,
                           .radius_px = 2,
                           .colour = {4, 5, 6},
                           .disparity = 9,
                           .reference_view = right_eye,
                           .views = {right_eye, right_eye}});
  return {20, 10, {7, 8, 9}, {layer, {.radius_px = 1, .points = {}, .strokes = {}}}};
}

std::string message_of(const std::string& bytes) {
  try {
    decode_painting(bytes, "some.wst");
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::bad_input);
    return error.what();
  }
  return "no error";
}

TEST(PaintingFile, ComesBackEqual) {
  const auto path = std::filesystem::path(testing::TempDir()) / "comes_back.wst";
  write_painting(path, small_painting());
  EXPECT_EQ(read_painting(path), small_painting());
}

TEST(PaintingFile, RefusesEveryTruncation) {
  const std::string good = encode_painting(small_painting());
  for (std::size_t size = 0; size < good.size(); ++size)
    EXPECT_THAT(message_of(good.substr(0, size)), testing::StartsWith("some.wst: ")) << size;
}

TEST(PaintingFile, NeverBelievesAFlippedByteOfItsPayload) {
  const std::string good = encode_painting(small_painting());
  int unnoticed = 0;
  for (std::size_t i = 0; i < good.size(); ++i) {
    for (const int flip : {0x01, 0x10, 0x80, 0xFF}) {
      std::string bad = good;
      bad[i] = static_cast<char>(bad[i] ^ flip);
      try {
        // Bytes of padding may change without changing the painting.
        EXPECT_EQ(decode_painting(bad, "some.wst"), small_painting()) << "byte " << i;
        ++unnoticed;
      } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::bad_input);
      }
    }
  }
  EXPECT_LT(unnoticed, 200) << "of " << 4 * good.size();
}

TEST(PaintingFile, NamesAFutureVersion) {
  flatbuffers::FlatBufferBuilder builder;
  const std::vector<std::uint8_t> payload{0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
  file::FinishPaintingFileBuffer(builder, file::CreatePaintingFileDirect(builder, 2, 0, &payload));
  const std::string bytes(reinterpret_cast<const char*>(builder.GetBufferPointer()), builder.GetSize());
  EXPECT_THAT(message_of(bytes), testing::HasSubstr("version 2, expected 1"));
}

TEST(PaintingFile, TellsWhenAFileIsSomethingElse) {
  EXPECT_THAT(message_of("a text that is no painting at all"), testing::HasSubstr("is not a painting"));
}

TEST(Svg, HasOnePathForEveryStrokeOfTheView) {
  const auto paths = [](const std::string& svg) {
    std::size_t count = 0;
    for (std::size_t at = svg.find("<path"); at != std::string::npos; at = svg.find("<path", at + 1)) ++count;
    return count;
  };
  EXPECT_EQ(paths(svg_of(small_painting(), left_eye)), 1u);
  EXPECT_EQ(paths(svg_of(small_painting(), right_eye)), 2u);
  EXPECT_THAT(svg_of(small_painting(), left_eye), testing::HasSubstr("M1.00 2.00C"));
  EXPECT_THAT(svg_of(small_painting(), right_eye), testing::HasSubstr("M-2.00 2.00C"));
}

}  // namespace
}  // namespace wheatstone
