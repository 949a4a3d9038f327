#include "wheatstone/marks/painting_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <filesystem>
#include <utility>

#include "painting_generated.h"
#include "temporary_folder.h"
#include "wheatstone/drawing/draw.h"
#include "wheatstone/drawing/svg.h"
#include "wheatstone/error.h"

namespace wheatstone {
namespace {

/// What a test must hold for each kind of painting.
constexpr int kinds = 3;
Painting small(int kind);

StrokePainting small_painting() {
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

Painting small(int kind) {
  Painting any{.strokes = small_painting()};
  if (kind == 0) {
    any.strokes.layers[0].strokes[1].number = 77;
    any.relief = {1.5f, 3};
    return any;
  }
  any.strokes.layers.clear();
  const ViewRange right_only{right_eye, right_eye};
  if (kind == 1) {
    any.regions = {20, 10, {{1, 1, 3}, {9, 1, 3}, {5, 8, 4}, {4, 2, 3}, {6, 2, 3}, {5, 4, 3.5f}}, {{0, 3}, {3, 3}}, {}};
    any.regions.marks = {{0, 2, {1, 2, 3}, 3.5f}, {1, 1, {4, 5, 6}, 3, right_eye, right_only}};
  } else {
    any.curves = {20, 10, {{{1, 1, 3}, {1, 2, 3}}, {{2, 3, 3}, {4, 5, 6}}, {{7, 3, 5}, {7, 8, 9}}}, {}};
    any.curves.lines = {{0, 2}, {2, 1, right_eye, right_only}};
  }
  return any;
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
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "comes_back.wst";
  for (int kind = 0; kind < kinds; ++kind) {
    write_painting(path, small(kind));
    EXPECT_EQ(read_painting(path), small(kind)) << kind;
  }
}

TEST(PaintingFile, RefusesEveryTruncation) {
  for (int kind = 0; kind < kinds; ++kind) {
    const std::string good = encode_painting(small(kind));
    for (std::size_t size = 0; size < good.size(); ++size)
      EXPECT_THAT(message_of(good.substr(0, size)), testing::StartsWith("some.wst: ")) << size;
  }
}

TEST(PaintingFile, NeverBelievesAFlippedByteOfItsPayload) {
  for (int kind = 0; kind < kinds; ++kind) {
    const std::string good = encode_painting(small(kind));
    int unnoticed = 0;
    for (std::size_t i = 0; i < good.size(); ++i) {
      for (const int flip : {0x01, 0x10, 0x80, 0xFF}) {
        std::string bad = good;
        bad[i] = static_cast<char>(bad[i] ^ flip);
        try {
          // Bytes of padding may change without changing the painting.
          EXPECT_EQ(decode_painting(bad, "some.wst"), small(kind)) << "byte " << i;
          ++unnoticed;
        } catch (const Error& error) {
          EXPECT_EQ(error.kind(), ErrorKind::bad_input);
        }
      }
    }
    EXPECT_LT(unnoticed, 200) << "of " << 4 * good.size();
  }
}

/// A file with a payload of any bytes, whose checksum fits.
std::string sealed(const std::uint8_t* payload, std::size_t size, std::uint32_t version) {
  flatbuffers::FlatBufferBuilder builder;
  const auto bytes = builder.CreateVector(payload, size);
  file::FinishPaintingFileBuffer(
      builder,
      file::CreatePaintingFile(builder, version, static_cast<std::uint32_t>(crc32_z(0, payload, size)), bytes));
  return {reinterpret_cast<const char*>(builder.GetBufferPointer()), builder.GetSize()};
}

TEST(PaintingFile, DrawsNothingWildFromAPayloadThatWasForged) {
  int drawn = 0, refused = 0;
  for (int kind = 0; kind < kinds; ++kind) {
    const std::string good = encode_painting(small(kind));
    const auto* payload = file::GetPaintingFile(good.data())->payload();
    for (flatbuffers::uoffset_t i = 0; i < payload->size(); ++i) {
      for (const int flip : {0x01, 0x10, 0x80, 0xFF}) {
        std::vector<std::uint8_t> bad(payload->begin(), payload->end());
        bad[i] = static_cast<std::uint8_t>(bad[i] ^ flip);
        try {
          const Painting painting = decode_painting(sealed(bad.data(), bad.size(), 2), "some.wst");
          if (painting.strokes.width > 100 || painting.strokes.height > 100) continue;
          for (const ViewPosition view : {left_eye, right_eye}) draw(painting, view);
          ++drawn;
        } catch (const Error& error) {
          EXPECT_EQ(error.kind(), ErrorKind::bad_input);
          ++refused;
        }
      }
    }
  }
  EXPECT_GT(drawn, 100);
  EXPECT_GT(refused, 100);
}

/// Each changes one thing that a reader must notice.
TEST(PaintingFile, RefusesMarksThatReferToNothing) {
  using Spoil = void (*)(Painting&);
  const std::pair<int, Spoil> spoilt[] = {
      {0, [](Painting& p) { p.strokes.layers[0].strokes[1].point_count = 2; }},
      {0, [](Painting& p) { p.strokes.layers[0].strokes[1].reference_view = ViewPosition(1e9f); }},
      {0, [](Painting& p) { p.strokes.layers[0].radius_px = NAN; }},
      {0, [](Painting& p) { p.relief.depth_px = -1; }},
      {0, [](Painting& p) { p.relief.bristle_px = 0; }},
      {0, [](Painting& p) { p.regions = small(1).regions; }},
      {1, [](Painting& p) { p.regions.rings[1].first_point = 4; }},
      {1, [](Painting& p) { p.regions.rings[1].point_count = 2; }},
      {1, [](Painting& p) { p.regions.rings[0].point_count = ~std::uint32_t{0}; }},
      {1, [](Painting& p) { p.regions.marks[0].ring_count = 3; }},
      {1, [](Painting& p) { p.regions.marks[0].ring_count = 0; }},
      {1, [](Painting& p) { p.regions.marks[1].first_ring = ~std::uint32_t{0}; }},
      {1, [](Painting& p) { p.regions.marks[1].disparity = INFINITY; }},
      {1, [](Painting& p) { p.regions.marks[1].views.last = ViewPosition(NAN); }},
      {1, [](Painting& p) { p.regions.points[2].y = NAN; }},
      {1, [](Painting& p) { p.regions.points[2].x = 1e9f; }},
      {2, [](Painting& p) { p.curves.lines[1].point_count = 2; }},
      {2, [](Painting& p) { p.curves.lines[1].point_count = 0; }},
      {2, [](Painting& p) { p.curves.lines[1].first_point = 4; }},
      {2, [](Painting& p) { p.curves.lines[0].reference_view = ViewPosition(-INFINITY); }},
      {2, [](Painting& p) { p.curves.points[0].at.disparity = NAN; }},
  };
  for (std::size_t i = 0; i < std::size(spoilt); ++i) {
    Painting painting = small(spoilt[i].first);
    spoilt[i].second(painting);
    EXPECT_THAT(message_of(encode_painting(painting)), testing::StartsWith("some.wst: ")) << i;
  }
}

TEST(PaintingFile, ReadsVersion1) {
  // As version 1 wrote small_painting().
  static constexpr std::uint8_t bytes[] = {
      20,  0,   0,   0,   87, 83,  84,  80,  0,   0,  10,  0,  16, 0,  4,   0,   8,  0,  12,  0,   10, 0,   0,
      0,   1,   0,   0,   0,  23,  147, 205, 121, 4,  0,   0,  0,  0,  1,   0,   0,  20, 0,   0,   0,  16,  0,
      20,  0,   8,   0,   12, 0,   5,   0,   6,   0,  7,   0,  16, 0,  16,  0,   0,  0,  0,   7,   8,  9,   20,
      0,   0,   0,   10,  0,  0,   0,   4,   0,   0,  0,   2,  0,  0,  0,   64,  0,  0,  0,   4,   0,  0,   0,
      214, 255, 255, 255, 0,  0,   128, 63,  28,  0,  0,   0,  20, 0,  0,   0,   12, 0,  0,   0,   4,  0,   0,
      0,   0,   0,   0,   0,  0,   0,   0,   0,   0,  0,   0,  0,  0,  0,   0,   0,  0,  0,   14,  0,  24,  0,
      4,   0,   8,   0,   12, 0,   16,  0,   20,  0,  14,  0,  0,  0,  0,   0,   64, 64, 124, 0,   0,  0,   104,
      0,   0,   0,   84,  0,  0,   0,   4,   0,   0,  0,   2,  0,  0,  0,   0,   0,  0,  0,   2,   0,  0,   0,
      0,   0,   64,  64,  0,  0,   0,   63,  0,   0,  64,  64, 0,  0,  0,   191, 0,  0,  0,   191, 0,  0,   0,
      63,  1,   2,   3,   0,  2,   0,   0,   0,   1,  0,   0,  0,  0,  0,   0,   64, 0,  0,   128, 63, 0,   0,
      16,  65,  0,   0,   0,  63,  0,   0,   0,   63, 0,   0,  0,  63, 4,   5,   6,  0,  3,   0,   0,  0,   0,
      0,   64,  64,  0,   0,  192, 192, 0,   0,   16, 65,  3,  0,  0,  0,   0,   0,  0,  64,  0,   0,  176, 64,
      0,   0,   0,   65,  3,  0,   0,   0,   0,   0,  128, 63, 0,  0,  128, 64,  0,  0,  224, 64};
  const Painting read = decode_painting({reinterpret_cast<const char*>(bytes), std::size(bytes)}, "old.wst");
  EXPECT_EQ(read, Painting{.strokes = small_painting()});
}

TEST(PaintingFile, NamesAFutureVersion) {
  const std::vector<std::uint8_t> payload(12);
  EXPECT_THAT(message_of(sealed(payload.data(), payload.size(), 3)), testing::HasSubstr("version 3, expected 1 to 2"));
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
  EXPECT_THAT(svg_of(small_painting(), left_eye), testing::HasSubstr("M10 20"));
  EXPECT_THAT(svg_of(small_painting(), right_eye), testing::HasSubstr("M-20 20"));
}

}  // namespace
}  // namespace wheatstone
