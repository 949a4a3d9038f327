#include "wheatstone/marks/painting_file.h"

#include <flatbuffers/flatbuffers.h>
#include <fmt/format.h>
#include <zlib.h>

#include <cmath>
#include <vector>

#include "painting_generated.h"
#include "wheatstone/error.h"
#include "wheatstone/files/whole_file.h"

namespace wheatstone {
namespace {

constexpr std::uint32_t first_version = 1, current_version = 2;
constexpr std::size_t most_bytes = 0x7fffffff;  // FlatBuffers' own limit
constexpr std::uint32_t largest_side_px = 65535;
constexpr float farthest_view = 1000;  ///< more eye separations than any display has

std::uint32_t checksum(const std::uint8_t* bytes, std::size_t size) {
  return static_cast<std::uint32_t>(crc32_z(0, bytes, size));
}

/// Points as the file holds them.
struct PointColumns {
  std::vector<float> x, y, disparity;
  void add(const ControlPoint& point) {
    x.push_back(point.x);
    y.push_back(point.y);
    disparity.push_back(point.disparity);
  }
};

flatbuffers::Offset<file::Layer> encode_layer(const Layer& layer, flatbuffers::FlatBufferBuilder& builder) {
  PointColumns points;
  for (const ControlPoint& point : layer.points) points.add(point);
  std::vector<file::Stroke> strokes;
  std::vector<std::uint32_t> numbers;
  bool numbered = false;
  for (const Stroke& s : layer.strokes) {
    strokes.emplace_back(s.first_point, s.point_count, s.radius_px, s.opacity, s.disparity,
                         s.reference_view.eye_separations(), s.views.first.eye_separations(),
                         s.views.last.eye_separations(), s.colour.r, s.colour.g, s.colour.b);
    numbers.push_back(s.number);
    numbered = numbered || s.number != 0;
  }
  return file::CreateLayerDirect(builder, layer.radius_px, &points.x, &points.y, &points.disparity, &strokes,
                                 numbered ? &numbers : nullptr);
}

flatbuffers::Offset<file::Regions> encode_regions(const RegionPainting& regions,
                                                  flatbuffers::FlatBufferBuilder& builder) {
  PointColumns points;
  for (const ControlPoint& point : regions.points) points.add(point);
  std::vector<file::Ring> rings;
  for (const Ring& ring : regions.rings) rings.emplace_back(ring.first_point, ring.point_count);
  std::vector<file::Region> marks;
  for (const RegionMark& m : regions.marks)
    marks.emplace_back(m.first_ring, m.ring_count, m.disparity, m.reference_view.eye_separations(),
                       m.views.first.eye_separations(), m.views.last.eye_separations(), m.colour.r, m.colour.g,
                       m.colour.b);
  return file::CreateRegionsDirect(builder, &points.x, &points.y, &points.disparity, &rings, &marks);
}

flatbuffers::Offset<file::Curves> encode_curves(const DiffusionPainting& curves,
                                                flatbuffers::FlatBufferBuilder& builder) {
  PointColumns points;
  std::vector<file::Colour> colours;
  for (const ColourPoint& point : curves.points) {
    points.add(point.at);
    colours.emplace_back(point.colour.r, point.colour.g, point.colour.b);
  }
  std::vector<file::Line> lines;
  for (const ColourLine& l : curves.lines)
    lines.emplace_back(l.first_point, l.point_count, l.reference_view.eye_separations(),
                       l.views.first.eye_separations(), l.views.last.eye_separations());
  return file::CreateCurvesDirect(builder, &points.x, &points.y, &points.disparity, &colours, &lines);
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

/// Whether `count` things from `first` on, at least `least`, are among `all`.
bool lie_within(std::uint32_t first, std::uint32_t count, std::size_t all, std::uint32_t least) {
  return count >= least && first <= all && count <= all - first;
}

/// The views of anything that has them.
ViewRange decode_views(const auto& from, const Checker& checker) {
  checker.expect(all_finite({from.first_view(), from.last_view()}) && std::abs(from.reference_view()) <= farthest_view,
                 "a mark's view positions are out of range");
  return {ViewPosition(from.first_view()), ViewPosition(from.last_view())};
}

/// The points of a table that has the three arrays.
std::vector<ControlPoint> decode_points(const auto& from, const Checker& checker) {
  const std::size_t count = from.x()->size();
  checker.expect(from.y()->size() == count && from.disparity()->size() == count, "point arrays differ in length");
  std::vector<ControlPoint> points;
  points.reserve(count);
  for (flatbuffers::uoffset_t i = 0; i < count; ++i) {
    const ControlPoint point{from.x()->Get(i), from.y()->Get(i), from.disparity()->Get(i)};
    // Points may leave the picture a little; far outside they would only overflow the rasteriser's columns.
    constexpr float far_px = 4 * static_cast<float>(largest_side_px);
    for (const float value : {point.x, point.y, point.disparity})
      checker.expect(std::abs(value) <= far_px, "a point is out of range");
    points.push_back(point);
  }
  return points;
}

Stroke decode_stroke(const file::Stroke& from, std::size_t point_count, const Checker& checker) {
  checker.expect(lie_within(from.first_point(), from.point_count(), point_count, 1),
                 "a stroke's control points lie outside its layer");
  checker.expect(all_finite({from.radius_px(), from.opacity(), from.disparity()}),
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
          ViewPosition(from.reference_view()),
          decode_views(from, checker)};
}

Layer decode_layer(const file::Layer& from, const Checker& checker) {
  Layer layer{from.radius_px(), decode_points(from, checker), {}};
  checker.expect(std::isfinite(layer.radius_px), "a layer's radius is out of range");
  const auto* numbers = from.numbers();
  checker.expect(numbers == nullptr || numbers->size() == from.strokes()->size(),
                 "a layer's strokes and their numbers differ in length");
  layer.strokes.reserve(from.strokes()->size());
  for (flatbuffers::uoffset_t i = 0; i < from.strokes()->size(); ++i) {
    layer.strokes.push_back(decode_stroke(*from.strokes()->Get(i), layer.points.size(), checker));
    if (numbers != nullptr) layer.strokes.back().number = numbers->Get(i);
  }
  return layer;
}

RegionPainting decode_regions(const file::Regions& from, int width, int height, const Checker& checker) {
  RegionPainting regions{width, height, decode_points(from, checker), {}, {}};
  for (const file::Ring* ring : *from.rings()) {
    checker.expect(lie_within(ring->first_point(), ring->point_count(), regions.points.size(), 3),
                   "a ring's points lie outside the painting, or are fewer than 3");
    regions.rings.push_back({ring->first_point(), ring->point_count()});
  }
  for (const file::Region* mark : *from.marks()) {
    checker.expect(lie_within(mark->first_ring(), mark->ring_count(), regions.rings.size(), 1),
                   "a region's rings lie outside the painting");
    checker.expect(std::isfinite(mark->disparity()), "a region's disparity is not finite");
    regions.marks.push_back({mark->first_ring(),
                             mark->ring_count(),
                             {mark->red(), mark->green(), mark->blue()},
                             mark->disparity(),
                             ViewPosition(mark->reference_view()),
                             decode_views(*mark, checker)});
  }
  return regions;
}

DiffusionPainting decode_curves(const file::Curves& from, int width, int height, const Checker& checker) {
  DiffusionPainting curves{width, height, {}, {}};
  const std::vector<ControlPoint> points = decode_points(from, checker);
  checker.expect(from.colours()->size() == points.size(), "a painting's points and their colours differ in length");
  for (flatbuffers::uoffset_t i = 0; i < points.size(); ++i) {
    const file::Colour& colour = *from.colours()->Get(i);
    curves.points.push_back({points[i], {colour.red(), colour.green(), colour.blue()}});
  }
  for (const file::Line* line : *from.lines()) {
    checker.expect(lie_within(line->first_point(), line->point_count(), points.size(), 1),
                   "a line's points lie outside the painting");
    curves.lines.push_back(
        {line->first_point(), line->point_count(), ViewPosition(line->reference_view()), decode_views(*line, checker)});
  }
  return curves;
}

Painting decode_payload(const file::Painting& from, const Checker& checker) {
  checker.expect(
      from.width() >= 1 && from.height() >= 1 && from.width() <= largest_side_px && from.height() <= largest_side_px,
      fmt::format("the painting is {}x{} pixels, expected 1 to {} a side", from.width(), from.height(),
                  largest_side_px));
  const int width = static_cast<int>(from.width()), height = static_cast<int>(from.height());
  const int kinds = (from.layers()->size() > 0) + (from.regions() != nullptr) + (from.curves() != nullptr);
  checker.expect(kinds <= 1, "the painting holds more than one kind of marks");
  checker.expect(from.relief_depth_px() >= 0 && from.relief_depth_px() <= static_cast<float>(largest_side_px),
                 "the relief's depth is out of range");
  constexpr float narrowest_bristle_px = 1e-3f;
  checker.expect(from.relief_bristle_px() >= narrowest_bristle_px &&
                     from.relief_bristle_px() <= static_cast<float>(largest_side_px),
                 "the relief's bristles are out of range");
  Painting any{{width, height, {from.canvas_red(), from.canvas_green(), from.canvas_blue()}, {}}, {}, {}};
  for (const file::Layer* layer : *from.layers()) any.strokes.layers.push_back(decode_layer(*layer, checker));
  if (from.regions() != nullptr) any.regions = decode_regions(*from.regions(), width, height, checker);
  if (from.curves() != nullptr) any.curves = decode_curves(*from.curves(), width, height, checker);
  any.relief = {from.relief_depth_px(), from.relief_bristle_px()};
  return any;
}

}  // namespace

std::string encode_painting(const Painting& any) {
  flatbuffers::FlatBufferBuilder payload;
  const StrokePainting& painting = any.strokes;
  std::vector<flatbuffers::Offset<file::Layer>> layers;
  for (const Layer& layer : painting.layers) layers.push_back(encode_layer(layer, payload));
  flatbuffers::Offset<file::Regions> regions;
  flatbuffers::Offset<file::Curves> curves;
  if (any.regions.width > 0) regions = encode_regions(any.regions, payload);
  if (any.curves.width > 0) curves = encode_curves(any.curves, payload);
  payload.Finish(file::CreatePaintingDirect(payload, static_cast<std::uint32_t>(painting.width),
                                            static_cast<std::uint32_t>(painting.height), painting.canvas_colour.r,
                                            painting.canvas_colour.g, painting.canvas_colour.b, &layers, regions,
                                            curves, any.relief.depth_px, any.relief.bristle_px));

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
  checker.expect(
      file.version() >= first_version && file.version() <= current_version,
      fmt::format("the painting has version {}, expected {} to {}", file.version(), first_version, current_version));
  checker.expect(checksum(file.payload()->data(), file.payload()->size()) == file.checksum(),
                 "the painting is damaged: its checksum does not match");

  // FlatBuffers reads numbers where they lie; a copy puts them on even addresses whatever the file says.
  const std::vector<std::uint8_t> payload(file.payload()->begin(), file.payload()->end());
  flatbuffers::Verifier payload_verifier(payload.data(), payload.size());
  checker.expect(payload.size() >= smallest && payload_verifier.VerifyBuffer<file::Painting>(nullptr),
                 "the painting is damaged");
  return decode_payload(*flatbuffers::GetRoot<file::Painting>(payload.data()), checker);
}

void write_painting(const std::filesystem::path& path, const Painting& painting) {
  write_whole_file(path, encode_painting(painting));
}

Painting read_painting(const std::filesystem::path& path) {
  return decode_painting(read_whole_file(path, most_bytes), path.string());
}

}  // namespace wheatstone
