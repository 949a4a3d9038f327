#include "wheatstone/marks/painting_file.h"

#include <flatbuffers/flatbuffers.h>
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "painting_generated.h"
#include "wheatstone/error.h"
#include "wheatstone/files/deflate.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/marks/disparity_code.h"

namespace wheatstone {
namespace {

constexpr std::uint32_t first_version = 1, current_version = 4;
constexpr std::size_t most_bytes = 0x7fffffff;  // FlatBuffers' own limit
constexpr std::uint32_t largest_side_px = 65535;
constexpr float farthest_view = 1000;  ///< more eye separations than any display has

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
  std::vector<std::uint8_t> parts;
  std::vector<file::ColourChange> changes;
  std::vector<file::FineColour> fine;
  bool numbered = false, has_parts = false, changing = false, is_fine = false;
  for (const Stroke& s : layer.strokes) {
    strokes.emplace_back(s.first_point, s.point_count, s.radius_px, s.opacity, s.disparity,
                         s.reference_view.eye_separations(), s.views.first.eye_separations(),
                         s.views.last.eye_separations(), s.colour.r, s.colour.g, s.colour.b);
    numbers.push_back(s.number);
    numbered = numbered || s.number != 0;
    parts.push_back(s.is_part ? 1 : 0);
    has_parts = has_parts || s.is_part;
    changes.emplace_back(s.change.r, s.change.g, s.change.b);
    changing = changing || s.change != ColourChange{};
    const auto& [begin, end] = s.fine;
    fine.emplace_back(begin[0], begin[1], begin[2], end[0], end[1], end[2]);
    is_fine = is_fine || s.fine != FineColour{};
  }
  return file::CreateLayerDirect(builder, layer.radius_px, &points.x, &points.y, &points.disparity, &strokes,
                                 numbered ? &numbers : nullptr, has_parts ? &parts : nullptr,
                                 changing ? &changes : nullptr, is_fine ? &fine : nullptr);
}

flatbuffers::Offset<file::Brush> encode_brush(const Brush& brush, flatbuffers::FlatBufferBuilder& builder) {
  const auto& [bristle_px, streaks, ridge, dry, picture] = brush;
  if (picture.empty()) return file::CreateBrush(builder, bristle_px, streaks, ridge, dry);
  const std::vector<std::uint8_t> cover(picture.cover().begin(), picture.cover().end());
  return file::CreateBrushDirect(builder, bristle_px, streaks, ridge, dry, &cover, picture.name.c_str());
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

struct MarksInFile {
  Rgb8 canvas{255, 255, 255};
  bool canvas_shows = true;
  std::vector<flatbuffers::Offset<file::Layer>> layers;
  flatbuffers::Offset<file::Regions> regions;
  flatbuffers::Offset<file::Curves> curves;
  flatbuffers::Offset<file::Brush> brush;
};

flatbuffers::Offset<file::Surfaces> encode_surfaces(const Surfaces& surfaces, flatbuffers::FlatBufferBuilder& builder) {
  std::vector<std::vector<std::uint8_t>> bytes(surfaces.seen.size());
  tbb::parallel_for(std::size_t{0}, bytes.size(),
                    [&](std::size_t i) { bytes[i] = encode_disparities(surfaces.seen[i].disparity); });
  std::vector<flatbuffers::Offset<file::Surface>> seen;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const Surface& s = surfaces.seen[i];
    seen.push_back(file::CreateSurfaceDirect(builder, s.view.eye_separations(), s.left_px,
                                             static_cast<std::uint32_t>(s.disparity.width()),
                                             static_cast<std::uint32_t>(s.disparity.height()), &bytes[i], s.continued));
  }
  return file::CreateSurfacesDirect(builder, surfaces.tolerance_px, &seen);
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

ColourChange decode_change(const file::ColourChange& from, const Checker& checker) {
  for (const std::int16_t levels : {from.red(), from.green(), from.blue()})
    checker.expect(std::abs(levels) <= 255, "a change of a stroke's colour is out of range");
  return {from.red(), from.green(), from.blue()};
}

FineColour decode_fine(const file::FineColour& from) {
  return {{from.red(), from.green(), from.blue()}, {from.red_end(), from.green_end(), from.blue_end()}};
}

Brush decode_brush(const file::Brush& from, const Checker& checker) {
  Brush brush{from.bristle_px(), from.streaks(), from.ridge(), from.dry()};
  checker.expect(brush.bristle_px >= 0 && brush.bristle_px <= static_cast<float>(largest_side_px),
                 "the brush's bristles are out of range");
  checker.expect(brush.streaks >= 0 && brush.streaks <= 255 && brush.ridge >= 0 && brush.ridge <= 255 &&
                     brush.dry >= 0 && brush.dry <= 1,
                 "the brush is out of range");
  if (from.picture() == nullptr) return brush;
  checker.expect(from.picture()->size() == BrushPicture::length * BrushPicture::width,
                 fmt::format("the brush's picture has {} pixels, expected {}x{}", from.picture()->size(),
                             BrushPicture::length, BrushPicture::width));
  const auto* name = from.picture_name();
  brush.picture =
      brush_picture(name == nullptr ? "picture" : name->str(), {from.picture()->data(), from.picture()->size()});
  return brush;
}

Layer decode_layer(const file::Layer& from, const Checker& checker) {
  Layer layer{from.radius_px(), decode_points(from, checker), {}};
  checker.expect(std::isfinite(layer.radius_px), "a layer's radius is out of range");
  const auto as_many = [&](const auto* column, std::string_view what) {
    checker.expect(column == nullptr || column->size() == from.strokes()->size(),
                   fmt::format("a layer's strokes and {} differ in length", what));
    return column;
  };
  const auto* numbers = as_many(from.numbers(), "their numbers");
  const auto* parts = as_many(from.parts(), "what tells which are parts of others");
  const auto* changes = as_many(from.changes(), "the changes of their colours");
  const auto* fine = as_many(from.fine(), "their fine colours");
  layer.strokes.reserve(from.strokes()->size());
  for (flatbuffers::uoffset_t i = 0; i < from.strokes()->size(); ++i) {
    layer.strokes.push_back(decode_stroke(*from.strokes()->Get(i), layer.points.size(), checker));
    if (numbers != nullptr) layer.strokes.back().number = numbers->Get(i);
    if (parts != nullptr) layer.strokes.back().is_part = parts->Get(i) != 0;
    if (changes != nullptr) layer.strokes.back().change = decode_change(*changes->Get(i), checker);
    if (fine != nullptr) layer.strokes.back().fine = decode_fine(*fine->Get(i));
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

Surface decode_surface(const file::Surface& from, const Checker& checker) {
  checker.expect(std::abs(from.view()) <= farthest_view, "a surface's view position is out of range");
  checker.expect(from.width() >= 1 && from.height() >= 1 && from.width() <= largest_side_px &&
                     from.height() <= largest_side_px && std::abs(std::int64_t{from.left_px()}) <= largest_side_px,
                 "a surface's size or place is out of range");
  std::optional<KnownRuns> disparity =
      decode_disparities({from.disparity()->data(), from.disparity()->size()}, static_cast<int>(from.width()),
                         static_cast<int>(from.height()));
  checker.expect(disparity.has_value(), "a surface is damaged");
  return {ViewPosition(from.view()), std::move(*disparity), from.left_px(), from.continued()};
}

Surfaces decode_surfaces(const file::Surfaces& from, const Checker& checker) {
  constexpr flatbuffers::uoffset_t most = 16;
  checker.expect(from.seen()->size() <= most, fmt::format("the painting has more than {} surfaces", most));
  checker.expect(from.tolerance_px() >= 0 && from.tolerance_px() <= static_cast<float>(largest_side_px),
                 "the tolerance of the surfaces is out of range");
  Surfaces surfaces{{}, from.tolerance_px()};
  for (const file::Surface* surface : *from.seen()) surfaces.seen.push_back(decode_surface(*surface, checker));
  return surfaces;
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
  Painting painting;
  if (from.regions() != nullptr) {
    painting.marks = decode_regions(*from.regions(), width, height, checker);
  } else if (from.curves() != nullptr) {
    painting.marks = decode_curves(*from.curves(), width, height, checker);
  } else {
    StrokePainting strokes{
        width, height, {from.canvas_red(), from.canvas_green(), from.canvas_blue()}, {}, !from.canvas_hidden()};
    for (const file::Layer* layer : *from.layers()) strokes.layers.push_back(decode_layer(*layer, checker));
    if (from.brush() != nullptr) strokes.brush = decode_brush(*from.brush(), checker);
    painting.marks = std::move(strokes);
  }
  painting.relief = {from.relief_depth_px(), from.relief_bristle_px()};
  if (from.surfaces() != nullptr) painting.surfaces = decode_surfaces(*from.surfaces(), checker);
  return painting;
}

// Each kind of marks has its place in the file.

void add_marks(const StrokePainting& painting, flatbuffers::FlatBufferBuilder& payload, MarksInFile& to) {
  to.canvas = painting.canvas_colour;
  to.canvas_shows = painting.canvas_shows;
  if (painting.brush != Brush{}) to.brush = encode_brush(painting.brush, payload);
  for (const Layer& layer : painting.layers) to.layers.push_back(encode_layer(layer, payload));
}
void add_marks(const RegionPainting& painting, flatbuffers::FlatBufferBuilder& payload, MarksInFile& to) {
  to.regions = encode_regions(painting, payload);
}
void add_marks(const DiffusionPainting& painting, flatbuffers::FlatBufferBuilder& payload, MarksInFile& to) {
  to.curves = encode_curves(painting, payload);
}

/// FlatBuffers reads numbers where they lie: a copy puts them on even addresses whatever the file says.
std::vector<std::uint8_t> payload_of(const file::PaintingFile& file, const Checker& checker) {
  constexpr std::uint32_t first_deflated_version = 3;
  const std::span<const std::uint8_t> stored(file.payload()->data(), file.payload()->size());
  if (file.version() < first_deflated_version) return {stored.begin(), stored.end()};
  checker.expect(file.payload_size() <= most_bytes, "the painting is damaged");
  auto payload = inflated(stored, file.payload_size());
  checker.expect(payload.has_value(), "the painting is damaged");
  return std::move(*payload);
}

}  // namespace

std::string encode_painting(const Painting& painting) {
  flatbuffers::FlatBufferBuilder payload;
  MarksInFile marks;
  std::visit([&](const auto& of_a_kind) { add_marks(of_a_kind, payload, marks); }, painting.marks);
  flatbuffers::Offset<file::Surfaces> surfaces;
  if (!painting.surfaces.seen.empty()) surfaces = encode_surfaces(painting.surfaces, payload);
  payload.Finish(file::CreatePaintingDirect(
      payload, static_cast<std::uint32_t>(width_of(painting)), static_cast<std::uint32_t>(height_of(painting)),
      marks.canvas.r, marks.canvas.g, marks.canvas.b, &marks.layers, marks.regions, marks.curves,
      painting.relief.depth_px, painting.relief.bristle_px, surfaces, !marks.canvas_shows, marks.brush));

  flatbuffers::FlatBufferBuilder builder;
  const std::vector<std::uint8_t> bytes = deflated({payload.GetBufferPointer(), payload.GetSize()});
  file::FinishPaintingFileBuffer(
      builder, file::CreatePaintingFileDirect(builder, current_version, crc32_of(bytes), &bytes, payload.GetSize()));
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
  // What FlatBuffers writes ends on such a boundary; what is cut off may be no more than padding.
  const bool is_whole = aligned.size() % sizeof(flatbuffers::uoffset_t) == 0;
  checker.expect(is_whole && file::VerifyPaintingFileBuffer(verifier), "the painting is damaged or truncated");
  const file::PaintingFile& file = *file::GetPaintingFile(data);
  checker.expect(
      file.version() >= first_version && file.version() <= current_version,
      fmt::format("the painting has version {}, expected {} to {}", file.version(), first_version, current_version));
  checker.expect(crc32_of(std::span(file.payload()->data(), file.payload()->size())) == file.checksum(),
                 "the painting is damaged: its checksum does not match");

  const std::vector<std::uint8_t> payload = payload_of(file, checker);
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
