#include "wheatstone/app/rotoscope_state_file.h"

#include <flatbuffers/flatbuffers.h>
#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <limits>

#include "rotoscope-state_generated.h"
#include "wheatstone/error.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/stereo/reduced_pair.h"
#include "wheatstone/struct_fields_internal.h"

namespace wheatstone {
namespace {

using flatbuffers::Offset;
using Builder = flatbuffers::FlatBufferBuilder;

// Whoever adds a member to one of these adds it to the schema, to `encode` and to `decode`.
static_assert(field_count<RotoscopeState>() == 14 && field_count<SceneDepth>() == 2 && field_count<DepthEnds>() == 2 &&
              field_count<SceneRectification>() == 3 && field_count<Rectification>() == 4 &&
              field_count<RectifyingMap>() == 5 && field_count<ColourTransfer>() == 2 &&
              field_count<RotoscopeTotals>() == 8 && field_count<PaintingMemory>() == 4 &&
              field_count<StrokeMemory>() == 3 && field_count<TrackedLayer>() == 2 && field_count<StrokeTrack>() == 5 &&
              field_count<Layer>() == 3 && field_count<Stroke>() == 10 && field_count<PosterisedMemory>() == 3 &&
              field_count<MosaicTile>() == 8 && field_count<MosaicMemory>() == 1 &&
              field_count<DiffusionMemory>() == 4 && field_count<SteadyPicture>() == 2);

constexpr std::string_view magic = "WSRSTATE";
constexpr std::size_t head_bytes = 16;
constexpr std::size_t most_bytes = std::size_t{0x7fffffff} - head_bytes;  // FlatBuffers' own limit

std::uint32_t checksum_of(std::string_view bytes) {
  return static_cast<std::uint32_t>(
      crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));  // NOLINT: zlib's own type
}

/// What stands before the content.
std::string head_of(std::string_view content) {
  const std::uint32_t checksum = checksum_of(content);
  std::string bytes(magic);
  for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(checksum >> shift & 0xff);
  bytes.resize(head_bytes);
  return bytes;
}

// Values of the program and of the file.
state::Rgb stored(const Rgb8& c) { return {c.r, c.g, c.b}; }
state::Sample stored(const SampledColour& c) { return {c.r, c.g, c.b}; }
state::Point stored(const ControlPoint& p) { return {p.x, p.y, p.disparity}; }
state::Stroke stored(const Stroke& s) {
  return {s.first_point,
          s.point_count,
          s.radius_px,
          s.opacity,
          s.disparity,
          s.reference_view.eye_separations(),
          s.views.first.eye_separations(),
          s.views.last.eye_separations(),
          s.number,
          s.is_part,
          stored(s.colour)};
}
state::Track stored(const StrokeTrack& t) {
  return {t.shown, t.ends, t.first_length_px, t.first_colour_difference, t.first_gain};
}
state::PaletteColour stored(const PaletteColour& c) { return {c.red, c.green, c.blue}; }
state::Tile stored(const MosaicTile& t) { return {t.x, t.y, t.along_x, t.along_y, t.red, t.green, t.blue, t.view}; }
state::Edge stored(const CarriedEdge& e) {
  return {e.x,
          e.y,
          e.across_x,
          e.across_y,
          stored(e.colours[0]),
          stored(e.colours[1]),
          e.disparities[0],
          e.disparities[1],
          e.view};
}

state::RectifyingMap stored(const RectifyingMap& map) {
  return {map.straightening, flatbuffers::make_span(map.homography), flatbuffers::make_span(map.row_correction)};
}
state::ColourTransfer stored(const ColourTransfer& c) {
  return {flatbuffers::make_span(c.gain), flatbuffers::make_span(c.gamma)};
}

Rgb8 taken(const state::Rgb& c) { return {c.r(), c.g(), c.b()}; }
SampledColour taken(const state::Sample& c) { return {c.r(), c.g(), c.b()}; }
ControlPoint taken(const state::Point& p) { return {p.x(), p.y(), p.disparity()}; }
Stroke taken(const state::Stroke& s) {
  return {.first_point = s.first_point(),
          .point_count = s.point_count(),
          .radius_px = s.radius_px(),
          .opacity = s.opacity(),
          .colour = taken(s.colour()),
          .disparity = s.disparity(),
          .reference_view = ViewPosition(s.reference_view()),
          .views = {ViewPosition(s.first_view()), ViewPosition(s.last_view())},
          .number = s.number(),
          .is_part = s.is_part()};
}
StrokeTrack taken(const state::Track& t) {
  return {t.shown(), t.ends(), t.first_length_px(), t.first_colour_difference(), t.first_gain()};
}
PaletteColour taken(const state::PaletteColour& c) { return {c.red(), c.green(), c.blue()}; }
MosaicTile taken(const state::Tile& t) {
  return {t.x(), t.y(), t.along_x(), t.along_y(), t.red(), t.green(), t.blue(), t.view()};
}
CarriedEdge taken(const state::Edge& e) {
  return {.x = e.x(),
          .y = e.y(),
          .across_x = e.across_x(),
          .across_y = e.across_y(),
          .colours = {taken(e.first()), taken(e.second())},
          .disparities = {e.first_disparity(), e.second_disparity()},
          .view = e.view()};
}

RectifyingMap taken(const state::RectifyingMap& from, PictureSize size) {
  RectifyingMap map{.width = size.width, .height = size.height, .straightening = from.straightening()};
  std::copy_n(from.homography()->begin(), map.homography.size(), map.homography.begin());
  std::copy_n(from.row_correction()->begin(), map.row_correction.size(), map.row_correction.begin());
  return map;
}
ColourTransfer taken(const state::ColourTransfer& from) {
  ColourTransfer transfer;
  std::copy_n(from.gain()->begin(), 3, transfer.gain.begin());
  std::copy_n(from.gamma()->begin(), 3, transfer.gamma.begin());
  return transfer;
}

template <class Value>
auto encode_all(std::span<const Value> values, Builder& builder) {
  if constexpr (std::is_arithmetic_v<Value>) {
    return builder.CreateVector(values.data(), values.size());
  } else {
    using Stored = decltype(stored(values[0]));
    return builder.CreateVectorOfStructs<Stored>(values.size(),
                                                 [&](std::size_t i, Stored* to) { *to = stored(values[i]); });
  }
}
template <class Value>
auto encode_all(const std::vector<Value>& values, Builder& builder) {
  return encode_all(std::span<const Value>(values), builder);
}

/// `create` makes the schema's table of an image of such pixels.
template <class Pixel>
auto encode_image(const Image<Pixel>& image, Builder& builder, auto create) {
  const auto values = encode_all(image.pixels(), builder);
  return create(builder, static_cast<std::uint32_t>(image.width()), static_cast<std::uint32_t>(image.height()), values);
}
auto encode(const Image<Rgb8>& image, Builder& builder) { return encode_image(image, builder, state::CreatePicture); }
auto encode(const Image<SampledColour>& image, Builder& builder) {
  return encode_image(image, builder, state::CreateSamples);
}
auto encode(const Image<float>& image, Builder& builder) { return encode_image(image, builder, state::CreateMap); }
auto encode(const Image<std::uint8_t>& image, Builder& builder) {
  return encode_image(image, builder, state::CreateMask);
}

auto encode(const Flow& flow, Builder& builder) {
  const auto x = encode(flow.x, builder), y = encode(flow.y, builder);
  return state::CreateFlow(builder, x, y);
}

auto encode(const SceneRectification& scene, Builder& builder) {
  state::RectifyingMap left, right;
  if (scene.how) left = stored(scene.how->left), right = stored(scene.how->right);
  const state::ColourTransfer colour = stored(scene.colour.value_or(ColourTransfer{}));
  return state::CreateRectification(builder, scene.measured, scene.how ? &left : nullptr, scene.how ? &right : nullptr,
                                    scene.colour ? &colour : nullptr);
}

auto encode(const Layer& layer, Builder& builder) {
  const auto points = encode_all(layer.points, builder);
  const auto strokes = encode_all(layer.strokes, builder);
  return state::CreateLayer(builder, layer.radius_px, points, strokes);
}

auto encode(const std::vector<std::vector<TrackedLayer>>& views, Builder& builder) {
  std::vector<Offset<state::View>> all;
  for (const std::vector<TrackedLayer>& layers : views) {
    std::vector<Offset<state::TrackedLayer>> tracked;
    for (const TrackedLayer& one : layers) {
      const auto layer = encode(one.layer, builder);
      tracked.push_back(state::CreateTrackedLayer(builder, layer, encode_all(one.tracks, builder)));
    }
    all.push_back(state::CreateViewDirect(builder, &tracked));
  }
  return builder.CreateVector(all);
}

/// About how many bytes the pictures are; all else is small beside them.
std::size_t picture_bytes(const RotoscopeState& state) {
  std::size_t bytes = 0;
  const auto add = [&bytes](const auto&... images) { ((bytes += images.pixels().size_bytes()), ...); };
  const PaintingMemory& memory = state.memory;
  add(state.left_before, state.central_before, state.left_disparity_before, state.central_disparity_before,
      state.flow_before.forward.x, state.flow_before.forward.y, state.flow_before.backward.x,
      state.flow_before.backward.y, memory.strokes.reference_disparity, memory.posterised.colour_of,
      memory.posterised.picture.colours, memory.posterised.picture.frames, memory.diffusion.picture.colours,
      memory.diffusion.picture.frames, memory.diffusion.disparity, memory.diffusion.edges);
  return bytes;
}

/// Reads what the schema's verifier has found whole. Throws where numbers do not fit together.
class Decoder {
 public:
  explicit Decoder(std::string_view name) : name_(name) {}

  [[noreturn]] void fail() const {
    throw Error(ErrorKind::bad_input, fmt::format("{}: is damaged, delete its folder to start again", name_));
  }
  void expect(bool holds) const {
    if (!holds) fail();
  }

  template <class Value, class From>
  std::vector<Value> all(const From& from) const {
    std::vector<Value> values;
    values.reserve(from.size());
    for (const auto* one : from) values.push_back(taken(*one));
    return values;
  }

  template <class Pixel, class From>
  Image<Pixel> image(const From& from) const {
    const auto& values = *from.values();
    constexpr auto most = static_cast<std::uint32_t>(std::numeric_limits<int>::max());
    expect(from.width() <= most && from.height() <= most &&
           std::uint64_t{from.width()} * from.height() == values.size());
    Image<Pixel> result(static_cast<int>(from.width()), static_cast<int>(from.height()));
    if constexpr (std::is_arithmetic_v<Pixel>) {
      std::copy(values.begin(), values.end(), result.pixels().begin());
    } else {
      std::transform(values.begin(), values.end(), result.pixels().begin(),
                     [](const auto* one) { return taken(*one); });
    }
    return result;
  }

  /// A picture of the frame's size, or none.
  template <class Pixel, class From>
  Image<Pixel> frame_image(const From& from, const Image<Rgb8>& frame) const {
    Image<Pixel> result = image<Pixel>(from);
    expect(result.empty() || same_size(result, frame));
    return result;
  }

  Flow flow(const state::Flow& from, const Image<Rgb8>& frame) const {
    Flow result{frame_image<float>(*from.x(), frame), frame_image<float>(*from.y(), frame)};
    expect(result.x.empty() == result.y.empty());
    return result;
  }

  Layer layer(const state::Layer& from) const {
    Layer result{from.radius_px(), all<ControlPoint>(*from.points()), all<Stroke>(*from.strokes())};
    for (const Stroke& stroke : result.strokes)
      expect(stroke.point_count >= 1 && stroke.first_point <= result.points.size() &&
             stroke.point_count <= result.points.size() - stroke.first_point);
    return result;
  }

  SteadyPicture steady(const state::Samples& mean, const state::Mask& frames, const Image<Rgb8>& frame) const {
    SteadyPicture result{frame_image<SampledColour>(mean, frame), frame_image<std::uint8_t>(frames, frame)};
    expect(result.colours.empty() == result.frames.empty());
    return result;
  }

  SceneRectification rectification(const state::Rectification& from, const Image<Rgb8>& frame) const {
    SceneRectification scene{.measured = from.measured()};
    expect((from.left() == nullptr) == (from.right() == nullptr));
    const PictureSize size{frame.width(), frame.height()};
    if (from.left() != nullptr)
      scene.how = Rectification{taken(*from.left(), size), taken(*from.right(), size), size.width, size.height};
    if (from.colour() != nullptr) scene.colour = taken(*from.colour());
    return scene;
  }

  PaintingMemory memory(const state::RotoscopeState& from, const Image<Rgb8>& frame) const;
  RotoscopeState state(const state::RotoscopeState& from) const;

 private:
  std::string_view name_;
};

PaintingMemory Decoder::memory(const state::RotoscopeState& from, const Image<Rgb8>& frame) const {
  PaintingMemory memory;
  for (const state::View* view : *from.views()) {
    std::vector<TrackedLayer>& layers = memory.strokes.views.emplace_back();
    for (const state::TrackedLayer* one : *view->layers()) {
      layers.push_back({layer(*one->layer()), all<StrokeTrack>(*one->tracks())});
      expect(layers.back().tracks.size() == layers.back().layer.strokes.size());
    }
  }
  memory.strokes.reference_disparity = frame_image<float>(*from.reference_disparity(), frame);
  memory.strokes.last_number = from.last_number();

  PosterisedMemory& posterised = memory.posterised;
  posterised.palette = all<PaletteColour>(*from.palette());
  posterised.colour_of = frame_image<std::uint8_t>(*from.colour_of(), frame);
  for (const std::uint8_t colour : posterised.colour_of.pixels()) expect(colour < posterised.palette.size());
  posterised.picture = steady(*from.posterised_mean(), *from.posterised_frames(), frame);

  memory.mosaic.tiles = all<MosaicTile>(*from.tiles());

  DiffusionMemory& diffusion = memory.diffusion;
  diffusion.picture = steady(*from.diffusion_mean(), *from.diffusion_frames(), frame);
  diffusion.disparity = frame_image<float>(*from.diffusion_disparity(), frame);
  diffusion.edges = frame_image<std::uint8_t>(*from.diffusion_edges(), frame);
  diffusion.points = all<CarriedEdge>(*from.edges());
  return memory;
}

RotoscopeState Decoder::state(const state::RotoscopeState& from) const {
  RotoscopeState state;
  state.frames = from.frames();
  state.frames_of_scene = from.frames_of_scene();
  expect(state.frames >= 0 && state.frames_of_scene >= 0 && state.frames_of_scene <= state.frames);
  const state::Totals& totals = *from.totals();
  state.totals = {totals.scenes(),  totals.whole_strokes(),    totals.survived_strokes(), totals.popped_strokes(),
                  totals.strokes(), totals.worst_bare_share(), totals.moved_frames(),     totals.least_separation()};
  if (from.range() != nullptr) state.range = DisparityRange{from.range()->least(), from.range()->largest()};
  state.left_before = image<Rgb8>(*from.left_before());
  const Image<Rgb8>& frame = state.left_before;
  const state::SceneDepth& depth = *from.depth();
  state.depth = {{depth.first_farthest_px(), depth.first_nearest_px()}, {depth.farthest_px(), depth.nearest_px()}};
  if (const state::DepthRange* range = from.depth_range())
    state.depth_range = InverseDepthRange{range->farthest(), range->nearest()};
  state.rectification = rectification(*from.rectification(), frame);
  state.central_before = image<Rgb8>(*from.central_before());
  const Image<Rgb8>& planned = state.central_before.empty() ? frame : state.central_before;
  const PictureSize half{(frame.width() + 1) / 2, (frame.height() + 1) / 2};
  expect(same_size(planned, frame) || (planned.width() == half.width && planned.height() == half.height));
  state.left_disparity_before = frame_image<float>(*from.left_disparity_before(), planned);
  state.central_disparity_before = frame_image<float>(*from.central_disparity_before(), planned);
  state.flow_before = {flow(*from.forward(), planned), flow(*from.backward(), planned)};
  for (const state::Layer* one : *from.layers_before()) state.layers_before.push_back(layer(*one));
  state.memory = memory(from, planned);
  return state;
}

}  // namespace

std::string rotoscope_state_with_checksum(std::string_view content) { return head_of(content).append(content); }

std::string encode_rotoscope_state(const RotoscopeState& state) {
  if (picture_bytes(state) > most_bytes / 10 * 9)
    throw Error(ErrorKind::cannot_read_write, "the film's frames are too large to be kept for going on later");
  Builder builder;
  const auto left = encode(state.left_before, builder), central = encode(state.central_before, builder);
  const auto left_disparity = encode(state.left_disparity_before, builder);
  const auto central_disparity = encode(state.central_disparity_before, builder);
  const auto forward = encode(state.flow_before.forward, builder);
  const auto backward = encode(state.flow_before.backward, builder);
  std::vector<Offset<state::Layer>> layers;
  for (const Layer& layer : state.layers_before) layers.push_back(encode(layer, builder));
  const auto layers_before = builder.CreateVector(layers);
  const PaintingMemory& memory = state.memory;
  const auto views = encode(memory.strokes.views, builder);
  const auto reference_disparity = encode(memory.strokes.reference_disparity, builder);
  const auto palette = encode_all(memory.posterised.palette, builder);
  const auto colour_of = encode(memory.posterised.colour_of, builder);
  const auto posterised_mean = encode(memory.posterised.picture.colours, builder);
  const auto posterised_frames = encode(memory.posterised.picture.frames, builder);
  const auto tiles = encode_all(memory.mosaic.tiles, builder);
  const auto diffusion_mean = encode(memory.diffusion.picture.colours, builder);
  const auto diffusion_frames = encode(memory.diffusion.picture.frames, builder);
  const auto diffusion_disparity = encode(memory.diffusion.disparity, builder);
  const auto diffusion_edges = encode(memory.diffusion.edges, builder);
  const auto edges = encode_all(memory.diffusion.points, builder);
  const auto rectification = encode(state.rectification, builder);
  const RotoscopeTotals& t = state.totals;
  const state::Totals totals(t.scenes, t.whole_strokes, t.survived_strokes, t.popped_strokes, t.strokes,
                             t.worst_bare_share, t.moved_frames, t.least_separation);
  const DisparityRange found = state.range.value_or(DisparityRange{});
  const state::Range range(found.least, found.largest);
  const auto [first, ends] = state.depth;
  const auto [farthest, nearest] = state.depth_range.value_or(InverseDepthRange{});
  const state::DepthRange depth_range(farthest, nearest);
  const state::SceneDepth depth(first.farthest_px, first.nearest_px, ends.farthest_px, ends.nearest_px);
  builder.Finish(state::CreateRotoscopeState(
      builder, state.frames, state.frames_of_scene, &totals, state.range ? &range : nullptr, rectification, &depth,
      state.depth_range ? &depth_range : nullptr, left, central, left_disparity, central_disparity, forward, backward,
      layers_before, views, reference_disparity, memory.strokes.last_number, palette, colour_of, posterised_mean,
      posterised_frames, tiles, diffusion_mean, diffusion_frames, diffusion_disparity, diffusion_edges, edges));
  return rotoscope_state_with_checksum(
      {reinterpret_cast<const char*>(builder.GetBufferPointer()), builder.GetSize()});  // NOLINT: bytes as text
}

RotoscopeState decode_rotoscope_state(std::string_view bytes, std::string_view name) {
  const Decoder decoder(name);
  decoder.expect(bytes.size() >= head_bytes && bytes.size() <= most_bytes);
  const std::string_view content = bytes.substr(head_bytes);
  decoder.expect(bytes.substr(0, head_bytes) == head_of(content));
  // The buffer's numbers stand at multiples of eight bytes, from its beginning.
  flatbuffers::Verifier verifier(reinterpret_cast<const std::uint8_t*>(content.data()), content.size());  // NOLINT
  decoder.expect(state::VerifyRotoscopeStateBuffer(verifier));
  return decoder.state(*state::GetRotoscopeState(content.data()));
}

void write_rotoscope_state(const std::filesystem::path& path, const RotoscopeState& state) {
  write_whole_file(path, encode_rotoscope_state(state));
}

RotoscopeState read_rotoscope_state(const std::filesystem::path& path) {
  return decode_rotoscope_state(read_whole_file(path, most_bytes), path.string());
}

}  // namespace wheatstone
