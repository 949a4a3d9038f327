#include "wheatstone/app/rotoscope_state_file_internal.h"

#include <limits>

#include "wheatstone/app/field_file_internal.h"
#include "wheatstone/files/whole_file.h"

namespace wheatstone {

// It holds C arrays, whose members cannot be told; it has no gaps.
template <>
inline constexpr bool is_number<CarriedEdge> = true;
static_assert(sizeof(CarriedEdge) == 13 * sizeof(float));

namespace {

constexpr FieldFile state_format{"WSRSTATE", "delete its folder to start again"};

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
    of_frame(state.corrected_disparity);
    of_frame(state.central_disparity_before);
    flow(state.flow_before.forward);
    flow(state.flow_before.backward);
    of_frame(state.detail);
    for (const Layer& one : state.layers_before) layer(one);
    memory(state.memory);
    memory(state.outside_memory);
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

std::filesystem::path outgoing_file(const std::filesystem::path& state) { return state.string() + "_outgoing"; }

}  // namespace

std::string rotoscope_state_with_checksum(std::string_view members) {
  return field_file_of_members<RotoscopeState>(state_format, members);
}

std::string encode_rotoscope_state(const RotoscopeState& state) { return encode_field_file(state_format, state); }

RotoscopeState decode_rotoscope_state(std::string_view bytes, std::string_view name) {
  return decode_field_file<RotoscopeState>(
      state_format, bytes, name, [](const RotoscopeState& state, const FieldReader& reader) { Check(state, reader); });
}

void write_rotoscope_state(const std::filesystem::path& path, const RotoscopeState& state) {
  write_whole_file(path, encode_rotoscope_state(state));
}

RotoscopeState read_rotoscope_state(const std::filesystem::path& path) {
  return decode_rotoscope_state(read_whole_file(path, std::numeric_limits<std::size_t>::max()), path.string());
}

void write_film_state(const std::filesystem::path& path, const FilmState& state) {
  if (state.outgoing) write_rotoscope_state(outgoing_file(path), *state.outgoing);
  write_rotoscope_state(path, state.shot);
}

FilmState read_film_state(const std::filesystem::path& path) {
  FilmState state{read_rotoscope_state(path), std::nullopt};
  std::error_code ignored;
  if (std::filesystem::exists(outgoing_file(path), ignored)) state.outgoing = read_rotoscope_state(outgoing_file(path));
  return state;
}

void remove_film_state(const std::filesystem::path& path) {
  std::error_code ignored;
  std::filesystem::remove(path, ignored);
  std::filesystem::remove(outgoing_file(path), ignored);
}

}  // namespace wheatstone
