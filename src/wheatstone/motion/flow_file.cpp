#include "wheatstone/motion/flow_file.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "wheatstone/error.h"
#include "wheatstone/files/whole_file.h"

namespace wheatstone {
namespace {

static_assert(std::endian::native == std::endian::little, "flow files are little-endian");

constexpr std::string_view mark = "PIEH";  // 202021.25 as a float
constexpr int largest_side_px = 65535;
constexpr float largest_known = 1e9f;
constexpr float unknown_in_file = 1.666666752e9f;  // as Middlebury's own code writes it

template <class Number>
Number number_at(std::string_view bytes, std::size_t at) {
  Number number;
  std::memcpy(&number, bytes.data() + at, sizeof number);
  return number;
}

template <class Number>
void append(std::string& bytes, Number number) {
  const auto raw = std::bit_cast<std::array<char, sizeof number>>(number);
  bytes.append(raw.data(), raw.size());
}

}  // namespace

Flow decode_flow(std::string_view bytes, std::string_view name) {
  const auto refuse = [&](const std::string& what) {
    throw Error(ErrorKind::bad_input, fmt::format("{}: {}", name, what));
  };
  constexpr std::size_t header = 12;
  if (!bytes.starts_with(mark)) refuse("is not a flow, expected one that begins with PIEH");
  if (bytes.size() < header) refuse("is truncated in its header");
  const auto width = number_at<std::int32_t>(bytes, 4), height = number_at<std::int32_t>(bytes, 8);
  if (width < 1 || height < 1 || width > largest_side_px || height > largest_side_px)
    refuse(fmt::format("is {}x{} pixels, expected 1 to {} a side", width, height, largest_side_px));
  const std::size_t expected = static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 2 * sizeof(float);
  if (bytes.size() - header < expected)
    refuse(fmt::format("is truncated: {} bytes of flow, expected {}", bytes.size() - header, expected));

  Flow flow{Image<float>(width, height), Image<float>(width, height)};
  std::size_t at = header;
  const auto next = [&] {
    const auto value = number_at<float>(bytes, at);
    at += sizeof value;
    return std::abs(value) <= largest_known ? value : std::numeric_limits<float>::quiet_NaN();
  };
  const auto xs = flow.x.pixels(), ys = flow.y.pixels();
  for (std::size_t i = 0; i < xs.size(); ++i) {
    xs[i] = next();
    ys[i] = next();
  }
  return flow;
}

Flow read_flow(const std::filesystem::path& path) {
  constexpr std::size_t most_bytes = std::size_t{1} << 32;
  return decode_flow(read_whole_file(path, most_bytes), path.string());
}

void write_flow(const std::filesystem::path& path, const Flow& flow) {
  std::string bytes(mark);
  append<std::int32_t>(bytes, flow.x.width());
  append<std::int32_t>(bytes, flow.x.height());
  const auto xs = flow.x.pixels(), ys = flow.y.pixels();
  bytes.reserve(bytes.size() + 2 * sizeof(float) * xs.size());
  for (std::size_t i = 0; i < xs.size(); ++i) {
    append(bytes, std::isfinite(xs[i]) ? xs[i] : unknown_in_file);
    append(bytes, std::isfinite(ys[i]) ? ys[i] : unknown_in_file);
  }
  write_whole_file(path, bytes);
}

}  // namespace wheatstone
