#include "wheatstone/app/rotoscope_state_file.h"

#include <fmt/format.h>
#include <zlib.h>

#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "wheatstone/error.h"
#include "wheatstone/files/whole_file.h"

namespace wheatstone {
namespace {

constexpr std::string_view magic = "WSSTATE2";
constexpr std::size_t most_bytes = std::size_t{4} << 30;

class Writer {
 public:
  template <class Value>
  requires std::is_trivially_copyable_v<Value>
  void operator()(const Value& value) { append(&value, sizeof(Value)); }
  template <class Value>
  requires std::is_trivially_copyable_v<Value>
  void operator()(const std::vector<Value>& values) {
    (*this)(std::uint64_t{values.size()});
    append(values.data(), values.size() * sizeof(Value));
  }
  template <class Pixel>
  void operator()(const Image<Pixel>& image) {
    (*this)(image.width());
    (*this)(image.height());
    append(image.pixels().data(), image.pixels().size_bytes());
  }
  template <class Value>
  void sequence(const std::vector<Value>& values, auto visit_one) {
    (*this)(std::uint64_t{values.size()});
    for (const Value& value : values) visit_one(value);
  }

  std::string bytes{};

 private:
  void append(const void* data, std::size_t size) {
    if (size > 0) bytes.append(static_cast<const char*>(data), size);
  }
};

/// Takes from the bytes what the writer put there; never more than there is.
class Reader {
 public:
  Reader(std::string_view bytes, std::string name) : bytes_(bytes), name_(std::move(name)) {}

  template <class Value>
  requires std::is_trivially_copyable_v<Value>
  void operator()(Value& value) { take(&value, sizeof(Value)); }
  template <class Value>
  requires std::is_trivially_copyable_v<Value>
  void operator()(std::vector<Value>& values) {
    values.resize(count_of(sizeof(Value)));
    take(values.data(), values.size() * sizeof(Value));
  }
  template <class Pixel>
  void operator()(Image<Pixel>& image) {
    int width = 0, height = 0;
    (*this)(width);
    (*this)(height);
    if (width < 0 || height < 0 ||
        static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height) > bytes_.size() / sizeof(Pixel))
      fail();
    image = Image<Pixel>(width, height);
    take(image.pixels().data(), image.pixels().size_bytes());
  }
  template <class Value>
  void sequence(std::vector<Value>& values, auto visit_one) {
    values.resize(count_of(1));
    for (Value& value : values) visit_one(value);
  }

  [[noreturn]] void fail() const {
    throw Error(ErrorKind::bad_input, fmt::format("{}: damaged, remove its folder to begin anew", name_));
  }
  bool at_end() const { return bytes_.empty(); }

 private:
  void take(void* to, std::size_t size) {
    if (size > bytes_.size()) fail();
    if (size > 0) std::memcpy(to, bytes_.data(), size);
    bytes_.remove_prefix(size);
  }
  std::size_t count_of(std::size_t least_size) {
    std::uint64_t count = 0;
    (*this)(count);
    if (count > bytes_.size() / least_size) fail();
    return count;
  }

  std::string_view bytes_;
  std::string name_;
};

template <class Archive, class Flow>
void visit_flow(Archive& archive, Flow& flow) {
  archive(flow.x);
  archive(flow.y);
}

template <class Archive, class Picture>
void visit_steady(Archive& archive, Picture& picture) {
  archive(picture.colours);
  archive(picture.frames);
}

template <class Archive, class Layer>
void visit_layer(Archive& archive, Layer& layer) {
  archive(layer.radius_px);
  archive(layer.points);
  archive(layer.strokes);
}

template <class Archive, class Memory>
void visit_strokes(Archive& archive, Memory& memory) {
  archive.sequence(memory.views, [&](auto& layers) {
    archive.sequence(layers, [&](auto& tracked) {
      visit_layer(archive, tracked.layer);
      archive(tracked.tracks);
    });
  });
  archive(memory.reference_disparity);
  archive(memory.last_number);
}

/// Everything, in one order for writing and reading.
template <class Archive, class State>
void visit(Archive& archive, State& state) {
  archive(state.frames);
  archive(state.frames_of_scene);
  archive(state.left_before);
  archive(state.central_before);
  archive(state.left_disparity_before);
  archive(state.central_disparity_before);
  visit_flow(archive, state.flow_before.forward);
  visit_flow(archive, state.flow_before.backward);
  archive(state.range);
  archive(state.totals);
  archive.sequence(state.layers_before, [&](auto& layer) { visit_layer(archive, layer); });
  visit_strokes(archive, state.memory.strokes);
  archive(state.memory.posterised.palette);
  archive(state.memory.posterised.colour_of);
  visit_steady(archive, state.memory.posterised.picture);
  archive(state.memory.mosaic.tiles);
  visit_steady(archive, state.memory.diffusion.picture);
  archive(state.memory.diffusion.disparity);
  archive(state.memory.diffusion.edges);
  archive(state.memory.diffusion.points);
}

std::uint32_t checksum_of(std::string_view bytes) {
  return static_cast<std::uint32_t>(
      crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));  // NOLINT: zlib's own type
}

}  // namespace

void write_rotoscope_state(const std::filesystem::path& path, const RotoscopeState& state) {
  Writer content;
  visit(content, state);
  Writer file;
  file.bytes.reserve(content.bytes.size() + magic.size() + sizeof(std::uint32_t));
  file.bytes.append(magic);
  file(checksum_of(content.bytes));
  file.bytes.append(content.bytes);
  write_whole_file(path, file.bytes);
}

RotoscopeState read_rotoscope_state(const std::filesystem::path& path) {
  const std::string bytes = read_whole_file(path, most_bytes);
  std::string_view rest = bytes;
  Reader head(rest.substr(std::min(magic.size(), rest.size())), path.string());
  std::uint32_t checksum = 0;
  head(checksum);
  if (!rest.starts_with(magic)) head.fail();
  rest.remove_prefix(magic.size() + sizeof(checksum));
  if (checksum_of(rest) != checksum) head.fail();
  Reader content(rest, path.string());
  RotoscopeState state;
  visit(content, state);
  if (!content.at_end()) content.fail();
  return state;
}

}  // namespace wheatstone
