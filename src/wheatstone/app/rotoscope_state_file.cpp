#include "wheatstone/app/rotoscope_state_file.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <limits>

#include "wheatstone/error.h"
#include "wheatstone/files/field_bytes.h"
#include "wheatstone/files/whole_file.h"

namespace wheatstone {

template <>
inline constexpr bool is_number<ViewPosition> = true;
// It holds C arrays, whose members cannot be told; it has no gaps.
template <>
inline constexpr bool is_number<CarriedEdge> = true;
static_assert(sizeof(CarriedEdge) == 13 * sizeof(float));

namespace {

constexpr std::string_view magic = "WSRSTATE";
constexpr std::size_t head_bytes = magic.size() + sizeof(std::uint32_t);

std::uint32_t checksum_of(std::string_view bytes) {
  return static_cast<std::uint32_t>(
      crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));  // NOLINT: zlib's own type
}

std::string head_of(std::string_view content) {
  FieldWriter head{std::string(magic)};
  head(checksum_of(content));
  return std::move(head.bytes);
}

/// Throws where lengths, indices and sizes of pictures do not fit together: those who use the state trust them.
class Check {
 public:
  Check(const RotoscopeState& state, const FieldReader& reader)
      : reader_(reader), planned_(state.central_before.empty() ? state.left_before : state.central_before) {
    expect(state.frames >= 0 && state.frames_of_scene >= 0 && state.frames_of_scene <= state.frames);
    const Image<Rgb8>& frame = state.left_before;
    expect(same_size(planned_, frame) ||
           (planned_.width() == (frame.width() + 1) / 2 && planned_.height() == (frame.height() + 1) / 2));
    if (const auto& how = state.rectification.how) {
      const auto fits = [&frame](const auto& one) {
        return one.width == frame.width() && one.height == frame.height();
      };
      expect(fits(how->left) && fits(how->right) && fits(*how));
    }
    of_frame(state.left_disparity_before);
    of_frame(state.central_disparity_before);
    flow(state.flow_before.forward);
    flow(state.flow_before.backward);
    for (const Layer& one : state.layers_before) layer(one);
    memory(state.memory);
  }

 private:
  void expect(bool holds) const { reader_.expect(holds); }

  /// A picture of the planned frame's size, or none.
  template <class Pixel>
  void of_frame(const Image<Pixel>& image) const {
    expect(image.empty() || same_size(image, planned_));
  }
  void flow(const Flow& flow) const {
    of_frame(flow.x);
    of_frame(flow.y);
    expect(flow.x.empty() == flow.y.empty());
  }
  void steady(const SteadyPicture& picture) const {
    of_frame(picture.colours);
    of_frame(picture.frames);
    expect(picture.colours.empty() == picture.frames.empty());
  }
  void layer(const Layer& layer) const {
    for (const Stroke& stroke : layer.strokes)
      expect(stroke.point_count >= 1 && stroke.first_point <= layer.points.size() &&
             stroke.point_count <= layer.points.size() - stroke.first_point);
  }

  void memory(const PaintingMemory& memory) const {
    for (const std::vector<TrackedLayer>& view : memory.strokes.views)
      for (const TrackedLayer& one : view) {
        layer(one.layer);
        expect(one.tracks.size() == one.layer.strokes.size());
      }
    of_frame(memory.strokes.reference_disparity);
    const PosterisedMemory& posterised = memory.posterised;
    of_frame(posterised.colour_of);
    for (const std::uint8_t colour : posterised.colour_of.pixels()) expect(colour < posterised.palette.size());
    steady(posterised.picture);
    steady(memory.diffusion.picture);
    of_frame(memory.diffusion.disparity);
    of_frame(memory.diffusion.edges);
  }

  const FieldReader& reader_;
  const Image<Rgb8>& planned_;
};

}  // namespace

std::string rotoscope_state_with_checksum(std::string_view members) {
  FieldWriter content;
  content(layout_of<RotoscopeState>());
  content.bytes += members;
  return head_of(content.bytes) + content.bytes;
}

std::string encode_rotoscope_state(const RotoscopeState& state) {
  FieldWriter members;
  members(state);
  return rotoscope_state_with_checksum(members.bytes);
}

RotoscopeState decode_rotoscope_state(std::string_view bytes, std::string_view name) {
  const std::string_view content = bytes.substr(std::min(bytes.size(), head_bytes));
  FieldReader reader(content, fmt::format("{}: is damaged, delete its folder to start again", name));
  reader.expect(bytes.substr(0, head_bytes) == head_of(content));
  std::uint32_t layout = 0;
  reader(layout);
  if (layout != layout_of<RotoscopeState>())
    throw Error(
        ErrorKind::bad_input,
        fmt::format("{}: was written by another version of Wheatstone; continue with that version, or delete its "
                    "folder to start again",
                    name));
  RotoscopeState state;
  reader(state);
  reader.expect_end();
  Check(state, reader);
  return state;
}

void write_rotoscope_state(const std::filesystem::path& path, const RotoscopeState& state) {
  write_whole_file(path, encode_rotoscope_state(state));
}

RotoscopeState read_rotoscope_state(const std::filesystem::path& path) {
  return decode_rotoscope_state(read_whole_file(path, std::numeric_limits<std::size_t>::max()), path.string());
}

}  // namespace wheatstone
