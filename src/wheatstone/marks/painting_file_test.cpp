#include "wheatstone/marks/painting_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <span>
#include <utility>

#include "painting_generated.h"
#include "temporary_folder.h"
#include "wheatstone/drawing/draw.h"
#include "wheatstone/drawing/svg.h"
#include "wheatstone/error.h"
#include "wheatstone/files/deflate.h"

namespace wheatstone::painting_file_test {

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

/// What three views see of a wall with a step in it: the reference view, another eye, and a view beside them.
Surfaces small_surfaces() {
  Image<float> seen(20, 10, 3), only_here(20, 10, NAN), behind(7, 10, NAN);
  for (int y = 2; y < 9; ++y) {
    for (int x = 8; x < 14; ++x) seen(x, y) = 9.0625f;
    only_here(15, y) = -2.5f;
    behind(3, y) = -6;
  }
  return {{{left_eye, KnownRuns(seen)},
           {right_eye, KnownRuns(only_here)},
           {ViewPosition(2.5f), KnownRuns(behind), -4, true}},
          1.5f};
}

Painting small(int kind) {
  Painting any{.marks = small_painting(), .surfaces = small_surfaces()};
  if (kind == 0) {
    std::get<StrokePainting>(any.marks).layers[0].strokes[1].number = 77;
    std::get<StrokePainting>(any.marks).layers[0].strokes[1].is_part = true;
    std::get<StrokePainting>(any.marks).layers[0].strokes[0].change = {-9, 0, 255};
    std::get<StrokePainting>(any.marks).layers[0].strokes[1].fine = {{-127, 0, 127}, {1, 2, 3}};
    std::get<StrokePainting>(any.marks).brush = {1.5f, 11, 8, 0.5f, built_in_brush("knife")};
    any.relief = {1.5f, 3};
    return any;
  }
  const ViewRange right_only{right_eye, right_eye};
  if (kind == 1) {
    RegionPainting regions{
        20, 10, {{1, 1, 3}, {9, 1, 3}, {5, 8, 4}, {4, 2, 3}, {6, 2, 3}, {5, 4, 3.5f}}, {{0, 3}, {3, 3}}, {}};
    regions.marks = {{0, 2, {1, 2, 3}, 3.5f}, {1, 1, {4, 5, 6}, 3, right_eye, right_only}};
    any.marks = std::move(regions);
  } else {
    DiffusionPainting curves{20, 10, {{{1, 1, 3}, {1, 2, 3}}, {{2, 3, 3}, {4, 5, 6}}, {{7, 3, 5}, {7, 8, 9}}}, {}};
    curves.lines = {{0, 2}, {2, 1, right_eye, right_only}};
    any.marks = std::move(curves);
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

/// A painting's payload, not deflated.
std::vector<std::uint8_t> payload_of(const Painting& painting) {
  const std::string bytes = encode_painting(painting);
  const file::PaintingFile& whole = *file::GetPaintingFile(bytes.data());
  return inflated({whole.payload()->data(), whole.payload()->size()}, whole.payload_size()).value();
}

/// A file with a payload of any bytes, whose checksum fits.
std::string sealed(std::span<const std::uint8_t> payload, std::uint32_t version = 3) {
  flatbuffers::FlatBufferBuilder builder;
  const std::vector<std::uint8_t> bytes = deflated(payload);
  file::FinishPaintingFileBuffer(
      builder, file::CreatePaintingFileDirect(builder, version,
                                              static_cast<std::uint32_t>(crc32_z(0, bytes.data(), bytes.size())),
                                              &bytes, static_cast<std::uint32_t>(payload.size())));
  return {reinterpret_cast<const char*>(builder.GetBufferPointer()), builder.GetSize()};
}

/// Changes each byte of payloads in some of the ways, one after the other, or in all.
void expect_nothing_wild_of_forged_payloads(std::size_t ways_a_byte) {
  constexpr std::array flips{0x01, 0x10, 0x80, 0xFF};
  int drawn = 0, refused = 0;
  for (int kind = 0; kind < kinds; ++kind) {
    const std::vector<std::uint8_t> good = payload_of(small(kind));
    for (std::size_t i = 0; i < good.size(); ++i) {
      for (std::size_t way = 0; way < ways_a_byte; ++way) {
        const int flip = flips[(i + way) % flips.size()];
        std::vector<std::uint8_t> bad = good;
        bad[i] = static_cast<std::uint8_t>(bad[i] ^ flip);
        try {
          const Painting painting = decode_painting(sealed(bad), "some.wst");
          if (width_of(painting) > 100 || height_of(painting) > 100) continue;
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

TEST(PaintingFile, DrawsNothingWildFromAPayloadThatWasForged) { expect_nothing_wild_of_forged_payloads(1); }
TEST(PaintingFileLong, DrawsNothingWildFromAPayloadThatWasForgedInAnyWay) { expect_nothing_wild_of_forged_payloads(4); }

StrokePainting& strokes(Painting& painting) { return std::get<StrokePainting>(painting.marks); }
RegionPainting& regions(Painting& painting) { return std::get<RegionPainting>(painting.marks); }
DiffusionPainting& curves(Painting& painting) { return std::get<DiffusionPainting>(painting.marks); }

/// Each changes one thing that a reader must notice.
TEST(PaintingFile, RefusesMarksThatReferToNothing) {
  using Spoil = void (*)(Painting&);
  const std::pair<int, Spoil> spoilt[] = {
      {0, [](Painting& p) { strokes(p).layers[0].strokes[1].point_count = 2; }},
      {0, [](Painting& p) { strokes(p).layers[0].strokes[1].reference_view = ViewPosition(1e9f); }},
      {0, [](Painting& p) { strokes(p).layers[0].radius_px = NAN; }},
      {0, [](Painting& p) { p.relief.depth_px = -1; }},
      {0, [](Painting& p) { p.relief.bristle_px = 0; }},
      {1, [](Painting& p) { regions(p).rings[1].first_point = 4; }},
      {1, [](Painting& p) { regions(p).rings[1].point_count = 2; }},
      {1, [](Painting& p) { regions(p).rings[0].point_count = ~std::uint32_t{0}; }},
      {1, [](Painting& p) { regions(p).marks[0].ring_count = 3; }},
      {1, [](Painting& p) { regions(p).marks[0].ring_count = 0; }},
      {1, [](Painting& p) { regions(p).marks[1].first_ring = ~std::uint32_t{0}; }},
      {1, [](Painting& p) { regions(p).marks[1].disparity = INFINITY; }},
      {1, [](Painting& p) { regions(p).marks[1].views.last = ViewPosition(NAN); }},
      {1, [](Painting& p) { regions(p).points[2].y = NAN; }},
      {1, [](Painting& p) { regions(p).points[2].x = 1e9f; }},
      {2, [](Painting& p) { curves(p).lines[1].point_count = 2; }},
      {2, [](Painting& p) { curves(p).lines[1].point_count = 0; }},
      {2, [](Painting& p) { curves(p).lines[1].first_point = 4; }},
      {2, [](Painting& p) { curves(p).lines[0].reference_view = ViewPosition(-INFINITY); }},
      {2, [](Painting& p) { curves(p).points[0].at.disparity = NAN; }},
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
  EXPECT_EQ(read, Painting{.marks = small_painting()});
}

TEST(PaintingFile, ReadsVersion2) {
  // As version 2 wrote small(1), which has no surfaces there.
  static constexpr std::uint8_t bytes[] = {
      20,  0,   0,  0,   87, 83,  84, 80,  0,  0,  10, 0,   16,  0,  4,  0,   8,   0,  12, 0,   10, 0,   0,  0,  2,
      0,   0,   0,  159, 31, 95,  46, 4,   0,  0,  0,  0,   1,   0,  0,  24,  0,   0,  0,  0,   0,  18,  0,  24, 0,
      8,   0,   12, 0,   5,  0,   6,  0,   7,  0,  16, 0,   20,  0,  18, 0,   0,   0,  0,  7,   8,  9,   20, 0,  0,
      0,   10,  0,  0,   0,  8,   0,  0,   0,  24, 0,  0,   0,   0,  0,  0,   0,   0,  0,  14,  0,  24,  0,  4,  0,
      8,   0,   12, 0,   16, 0,   20, 0,   14, 0,  0,  0,   156, 0,  0,  0,   124, 0,  0,  0,   92, 0,   0,  0,  68,
      0,   0,   0,  4,   0,  0,   0,  2,   0,  0,  0,  0,   0,   0,  0,  2,   0,   0,  0,  0,   0,  96,  64, 0,  0,
      0,   191, 0,  0,   0,  191, 0,  0,   0,  63, 1,  2,   3,   0,  1,  0,   0,   0,  1,  0,   0,  0,   0,  0,  64,
      64,  0,   0,  0,   63, 0,   0,  0,   63, 0,  0,  0,   63,  4,  5,  6,   0,   2,  0,  0,   0,  0,   0,  0,  0,
      3,   0,   0,  0,   3,  0,   0,  0,   3,  0,  0,  0,   6,   0,  0,  0,   0,   0,  64, 64,  0,  0,   64, 64, 0,
      0,   128, 64, 0,   0,  64,  64, 0,   0,  64, 64, 0,   0,   96, 64, 6,   0,   0,  0,  0,   0,  128, 63, 0,  0,
      128, 63,  0,  0,   0,  65,  0,  0,   0,  64, 0,  0,   0,   64, 0,  0,   128, 64, 6,  0,   0,  0,   0,  0,  128,
      63,  0,   0,  16,  65, 0,   0,  160, 64, 0,  0,  128, 64,  0,  0,  192, 64,  0,  0,  160, 64};
  Painting expected = small(1);
  expected.surfaces = {};
  EXPECT_EQ(decode_painting({reinterpret_cast<const char*>(bytes), std::size(bytes)}, "old.wst"), expected);
}

TEST(PaintingFile, NamesAFutureVersion) {
  const std::vector<std::uint8_t> payload(12);
  EXPECT_THAT(message_of(sealed(payload, 5)), testing::HasSubstr("version 5, expected 1 to 4"));
}

TEST(PaintingFile, RefusesSurfacesThatCannotBe) {
  using Spoil = void (*)(Surfaces&);
  const Spoil spoilt[] = {
      [](Surfaces& s) { s.tolerance_px = -1; },
      [](Surfaces& s) { s.tolerance_px = NAN; },
      [](Surfaces& s) { s.seen[1].view = ViewPosition(1e9f); },
      [](Surfaces& s) { s.seen[1].view = ViewPosition(NAN); },
      [](Surfaces& s) { s.seen[2].left_px = 1 << 20; },
      [](Surfaces& s) { s.seen[2].left_px = std::numeric_limits<int>::min(); },
      [](Surfaces& s) { s.seen[0].disparity = {}; },
      [](Surfaces& s) { s.seen.resize(17, s.seen[0]); },
  };
  for (std::size_t i = 0; i < std::size(spoilt); ++i) {
    Painting painting = small(0);
    spoilt[i](painting.surfaces);
    EXPECT_THAT(message_of(encode_painting(painting)), testing::StartsWith("some.wst: ")) << i;
  }
}

TEST(PaintingFile, RefusesASurfaceWhoseBytesAreDamaged) {
  const std::vector<std::uint8_t> good = payload_of(small(2));
  const auto* seen = flatbuffers::GetRoot<file::Painting>(good.data())->surfaces()->seen();
  for (const file::Surface* surface : *seen) {
    const auto begin = surface->disparity()->data() - good.data();
    for (flatbuffers::uoffset_t i = 2; i < surface->disparity()->size(); ++i) {  // after zlib's two bytes of header
      std::vector<std::uint8_t> bad = good;
      bad[static_cast<std::size_t>(begin) + i] ^= 0xFF;
      EXPECT_THAT(message_of(sealed(bad)), testing::HasSubstr("a surface is damaged")) << i;
    }
  }
}

TEST(PaintingFile, DrawsWildSurfacesWithoutHarm) {
  Painting wild = small(0);
  Image<float> disparity(20, wild.surfaces.seen[0].disparity.height(), 4);
  disparity(0, 0) = 5e7f;
  disparity(1, 0) = -5e7f;
  for (int x = 0; x < 20; ++x) disparity(x, 1) = 5e7f - static_cast<float>(8 * x);
  wild.surfaces.seen[0].disparity = KnownRuns(disparity);
  wild.surfaces.seen[1].view = ViewPosition(1000.f);
  wild.surfaces.seen[2].left_px = 65535;
  const Painting read = decode_painting(encode_painting(wild), "wild.wst");
  EXPECT_EQ(read, wild);
  for (const float view : {-1000.f, -0.5f, 0.5f, 1000.f}) EXPECT_EQ(draw(read, ViewPosition(view)).picture.width(), 20);
}

TEST(PaintingFile, RefusesAPayloadThatDoesNotInflateToItsSize) {
  const std::vector<std::uint8_t> payload = payload_of(small(0));
  const std::vector<std::uint8_t> bytes = deflated(payload);
  for (const std::uint32_t size : {0u, static_cast<std::uint32_t>(payload.size()) - 1,
                                   static_cast<std::uint32_t>(payload.size()) + 1, 0x7fffffffu, 0xffffffffu}) {
    flatbuffers::FlatBufferBuilder builder;
    const auto checksum = static_cast<std::uint32_t>(crc32_z(0, bytes.data(), bytes.size()));
    file::FinishPaintingFileBuffer(builder, file::CreatePaintingFileDirect(builder, 3, checksum, &bytes, size));
    const std::string file(reinterpret_cast<const char*>(builder.GetBufferPointer()), builder.GetSize());
    EXPECT_THAT(message_of(file), testing::HasSubstr("the painting is damaged")) << size;
  }
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
  EXPECT_EQ(paths(svg_of(Painting{small_painting()}, left_eye)), 1u);
  EXPECT_EQ(paths(svg_of(Painting{small_painting()}, right_eye)), 2u);
  EXPECT_THAT(svg_of(Painting{small_painting()}, left_eye), testing::HasSubstr("M10 20"));
  EXPECT_THAT(svg_of(Painting{small_painting()}, right_eye), testing::HasSubstr("M-20 20"));
}

}  // namespace wheatstone::painting_file_test
