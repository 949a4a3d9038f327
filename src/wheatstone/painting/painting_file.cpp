#include "wheatstone/painting/painting_file.h"

#include <flatbuffers/flatbuffers.h>
#include <fmt/format.h>
#include <zlib.h>

#include <cmath>
#include <vector>

#include "painting_generated.h"
#include "wheatstone/error.h"
#include "wheatstone/image/whole_file.h"

namespace wheatstone {
namespace {

constexpr std::uint32_t current_version = 1;
constexpr std::size_t most_bytes = 0x7fffffff;  // FlatBuffers' own limit
constexpr std::uint32_t largest_side_px = 65535;

std::uint32_t checksum(const std::uint8_t* bytes, std::size_t size) {
  return static_cast<std::uint32_t>(crc32_z(0, bytes, size));
}

flatbuffers::Offset<file::Layer> encode_layer(const Layer& layer, flatbuffers::FlatBufferBuilder& builder) {
  std::vector<float> x, y, disparity;
  for (const ControlPoint& point : layer.points) {
    x.push_back(point.x);
    y.push_back(point.y);
    disparity.push_back(point.disparity);
  }
  std::vector<file::Stroke> strokes;
  strokes.reserve(layer.strokes.size());
  for (const Stroke& s : layer.strokes)
    strokes.emplace_back(s.first_point, s.point_count, s.radius_px, s.opacity, s.disparity, s.reference_view,
                         s.views.first, s.views.last, s.colour.r, s.colour.g, s.colour.b);
  return file::CreateLayerDirect(builder, layer.radius_px, &x, &y, &disparity, &strokes);
}

/// Throws, with the file's name in front, where a thing that must hold does not.
class Checker {
 public:
  explicit Checker(std::string_view name) : name_(name) {}
  void expect(bool holds, std::string_view complaint) const {
    if (!holds) throw Error(ErrorKind::bad_input, fmt::format("{}: {}", name_, complaint));
  }

 private:
  std::string_view name_;
};

bool all_finite(std::initializer_list<float> values) {
  for (const float value : values)
    if (!std::isfinite(value)) return false;
  return true;
}

Stroke decode_stroke(const file::Stroke& from, std::size_t point_count, const Checker& checker) {
  checker.expect(from.point_count() >= 1 && from.first_point() <= point_count &&
                     from.point_count() <= point_count - from.first_point(),
                 "a stroke's control points lie outside its layer");
  checker.expect(all_finite({from.radius_px(), from.opacity(), from.disparity(), from.reference_view(),
                             from.first_view(), from.last_view()}),
                 "a stroke holds a number that is not finite");
  checker.expect(from.radius_px() > 0 && from.radius_px() <= static_cast<float>(largest_side_px),
                 "a stroke's radius is out of range");
  checker.expect(from.opacity() >= 0 && from.opacity() <= 1, "a stroke's opacity is out of range, expected 0 to 1");
  return {from.first_point(),
          from.point_count(),
          from.radius_px(),
          from.opacity(),
          {from.red(), from.green(), from.blue()},
          from.disparity(),
          from.reference_view(),
          {from.first_view(), from.last_view()}};
}

Layer decode_layer(const file::Layer& from, const Checker& checker) {
  const std::size_t point_count = from.x()->size();
  checker.expect(from.y()->size() == point_count && from.disparity()->size() == point_count,
                 "a layer's point arrays differ in length");
  Layer layer;
  layer.radius_px = from.radius_px();
  layer.points.reserve(point_count);
  for (flatbuffers::uoffset_t i = 0; i < point_count; ++i) {
    const ControlPoint point{from.x()->Get(i), from.y()->Get(i), from.disparity()->Get(i)};
    // Points may leave the picture a little; far outside they would only overflow the rasteriser's columns.
    constexpr float far_px = 4 * static_cast<float>(largest_side_px);
    for (const float value : {point.x, point.y, point.disparity})
      checker.expect(std::abs(value) <= far_px, "a control point is out of range");
    layer.points.push_back(point);
  }
  layer.strokes.reserve(from.strokes()->size());
  for (const file::Stroke* stroke : *from.strokes())
    layer.strokes.push_back(decode_stroke(*stroke, point_count, checker));
  return layer;
}

}  // namespace

std::string encode_painting(const Painting& painting) {
  flatbuffers::FlatBufferBuilder payload;
  std::vector<flatbuffers::Offset<file::Layer>> layers;
  for (const Layer& layer : painting.layers) layers.push_back(encode_layer(layer, payload));
  payload.Finish(file::CreatePaintingDirect(payload, static_cast<std::uint32_t>(painting.width),
                                            static_cast<std::uint32_t>(painting.height), painting.canvas_colour.r,
                                            painting.canvas_colour.g, painting.canvas_colour.b, &layers));

  flatbuffers::FlatBufferBuilder builder;
  const auto bytes = builder.CreateVector(payload.GetBufferPointer(), payload.GetSize());
  file::FinishPaintingFileBuffer(
      builder, file::CreatePaintingFile(builder, current_version,
                                        checksum(payload.GetBufferPointer(), payload.GetSize()), bytes));
  return {reinterpret_cast<const char*>(builder.GetBufferPointer()), builder.GetSize()};
}

Painting decode_painting(std::string_view bytes, std::string_view name) {
  const Checker checker(name);
  constexpr std::size_t smallest = 2 * sizeof(flatbuffers::uoffset_t);
  checker.expect(
      bytes.size() >= smallest && bytes.size() <= most_bytes && file::PaintingFileBufferHasIdentifier(bytes.data()),
      "is not a painting, expected a .wst file");
  const std::vector<std::uint8_t> aligned(bytes.begin(), bytes.end());
  const std::uint8_t* data = aligned.data();
  flatbuffers::Verifier verifier(data, aligned.size());
  checker.expect(file::VerifyPaintingFileBuffer(verifier), "the painting is damaged or truncated");
  const file::PaintingFile& file = *file::GetPaintingFile(data);
  checker.expect(file.version() == current_version,
                 fmt::format("the painting has version {}, expected {}", file.version(), current_version));
  checker.expect(checksum(file.payload()->data(), file.payload()->size()) == file.checksum(),
                 "the painting is damaged: its checksum does not fit");

  // FlatBuffers reads numbers where they lie; a copy puts them on even addresses whatever the file says.
  const std::vector<std::uint8_t> payload(file.payload()->begin(), file.payload()->end());
  flatbuffers::Verifier payload_verifier(payload.data(), payload.size());
  checker.expect(payload.size() >= smallest && payload_verifier.VerifyBuffer<file::Painting>(nullptr),
                 "the painting is damaged");
  const file::Painting& from = *flatbuffers::GetRoot<file::Painting>(payload.data());
  checker.expect(
      from.width() >= 1 && from.height() >= 1 && from.width() <= largest_side_px && from.height() <= largest_side_px,
      fmt::format("the painting is {}x{} pixels, expected 1 to {} a side", from.width(), from.height(),
                  largest_side_px));
  Painting painting{static_cast<int>(from.width()),
                    static_cast<int>(from.height()),
                    {from.canvas_red(), from.canvas_green(), from.canvas_blue()},
                    {}};
  for (const file::Layer* layer : *from.layers()) painting.layers.push_back(decode_layer(*layer, checker));
  return painting;
}

void write_painting(const std::filesystem::path& path, const Painting& painting) {
  write_whole_file(path, encode_painting(painting));
}

Painting read_painting(const std::filesystem::path& path) {
  return decode_painting(read_whole_file(path, most_bytes), path.string());
}

}  // namespace wheatstone
