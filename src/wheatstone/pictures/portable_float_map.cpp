#include "wheatstone/pictures/portable_float_map_internal.h"

#include <fmt/format.h>

#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "wheatstone/error.h"
#include "wheatstone/files/whole_file.h"

namespace wheatstone {
namespace {

constexpr int largest_side_px = 65535;

[[noreturn]] void refuse(std::string_view name, std::string_view complaint) {
  throw Error(ErrorKind::bad_input, fmt::format("{}: {}", name, complaint));
}

/// The header's words: they end at white space, and one white space ends the header.
class Words {
 public:
  Words(std::string_view bytes, std::string_view name) : bytes_(bytes), name_(name) {}

  std::string_view next() {
    while (at_ < bytes_.size() && is_space(bytes_[at_])) ++at_;
    const std::size_t begin = at_;
    while (at_ < bytes_.size() && !is_space(bytes_[at_])) ++at_;
    if (at_ == bytes_.size() || at_ == begin) refuse(name_, "is truncated in its PFM header");
    return bytes_.substr(begin, at_ - begin);
  }

  template <class Number>
  Number next_number() {
    const std::string_view word = next();
    Number number{};
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (error != std::errc{} || end != word.data() + word.size())
      refuse(name_, "has a PFM header with something that is not a number");
    return number;
  }

  std::string_view rest() const { return bytes_.substr(at_ + 1); }

 private:
  static bool is_space(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }

  std::string_view bytes_, name_;
  std::size_t at_ = 0;
};

float swapped(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  return std::bit_cast<float>(bits >> 24 | (bits >> 8 & 0xFF00u) | (bits << 8 & 0xFF0000u) | bits << 24);
}

}  // namespace

Image<float> decode_pfm(std::string_view bytes, std::string_view name) {
  Words words(bytes, name);
  const std::string_view kind = words.next();
  if (kind == "PF") refuse(name, "is a PFM with three channels, expected one");
  if (kind != "Pf") refuse(name, "is not a PFM, expected one that begins with Pf");
  const int width = words.next_number<int>(), height = words.next_number<int>();
  if (width < 1 || height < 1 || width > largest_side_px || height > largest_side_px)
    refuse(name, fmt::format("is {}x{} pixels, expected 1 to {} a side", width, height, largest_side_px));
  const float scale = words.next_number<float>();
  if (!std::isfinite(scale) || scale == 0) refuse(name, "has a PFM scale of 0 or infinity, expected -1 or 1");

  const std::string_view data = words.rest();
  const std::size_t expected = static_cast<std::size_t>(width) * height * sizeof(float);
  if (data.size() < expected)
    refuse(name, fmt::format("is truncated: {} bytes of pixels, expected {}", data.size(), expected));
  const bool little_endian = scale < 0;
  const bool must_swap = little_endian != (std::endian::native == std::endian::little);
  Image<float> image(width, height);
  for (int y = 0; y < height; ++y) {
    const auto row = image.row(height - 1 - y);
    std::memcpy(row.data(), data.data() + static_cast<std::size_t>(y) * row.size_bytes(), row.size_bytes());
    if (must_swap)
      for (float& value : row) value = swapped(value);
  }
  return image;
}

void write_pfm(const std::filesystem::path& path, ImageView<const float> image) {
  const float scale = std::endian::native == std::endian::little ? -1.f : 1.f;
  const std::string header = fmt::format("Pf\n{} {}\n{:.1f}\n", image.width(), image.height(), scale);
  std::vector<std::string_view> parts{header};
  for (int y = image.height() - 1; y >= 0; --y) {
    const auto row = image.row(y);
    parts.emplace_back(reinterpret_cast<const char*>(row.data()), row.size_bytes());
  }
  write_whole_file(path, parts);
}

}  // namespace wheatstone
