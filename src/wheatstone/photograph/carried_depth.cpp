#include "wheatstone/photograph/carried_depth.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "wheatstone/error.h"
#include "wheatstone/files/text_encoding.h"
#include "wheatstone/photograph/xmp_internal.h"
#include "wheatstone/pictures/disparity_file.h"
#include "wheatstone/pictures/heif_pictures.h"
#include "wheatstone/pictures/jpeg.h"
#include "wheatstone/pictures/open_picture.h"
#include "wheatstone/pictures/read_image.h"
#include "wheatstone/pictures/upright.h"

namespace wheatstone {

namespace {

namespace fs = std::filesystem;

constexpr int grey_tolerance = 8;  // of JPEGs

int colourfulness(Rgb8 colour) {
  const auto [least, most] = std::minmax({colour.r, colour.g, colour.b});
  return most - least;
}

/// Share of the pixels of a half, of every step-th of every step-th row, of more colour than this.
double coloured_share(const Image<Rgb8>& both, int first_column, int tolerance, int step = 4) {
  int all = 0, coloured = 0;
  for (int y = 0; y < both.height(); y += step)
    for (int x = first_column; x < first_column + both.width() / 2; x += step) {
      ++all;
      coloured += colourfulness(both(x, y)) > tolerance ? 1 : 0;
    }
  return static_cast<double>(coloured) / std::max(all, 1);
}

/// How much a pixel of the green channel differs from its neighbours.
int steepness(const Image<Rgb8>& both, int x, int y) {
  return std::max(std::abs(both(x + 1, y).g - both(x - 1, y).g), std::abs(both(x, y + 1).g - both(x, y - 1).g));
}

/// Whether the right half has sharp edges where the left one has edges, too, and is smoother elsewhere: a grey copy of
/// the photograph has the same edges, but is as rough.
bool is_depth_of_left_half(const Image<Rgb8>& both) {
  const int width = both.width() / 2;
  constexpr int edge = 12;  // levels
  std::vector<int> photograph, depth;
  std::array<std::vector<int>, 2> near_edge;  // the photograph around edges of the depth, and elsewhere
  for (int y = 2; y + 2 < both.height(); y += 2)
    for (int x = 2; x + 2 < width; x += 2) {
      photograph.push_back(steepness(both, x, y));
      depth.push_back(steepness(both, x + width, y));
      int around = 0;
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) around = std::max(around, steepness(both, x + dx, y + dy));
      near_edge[depth.back() >= edge ? 0 : 1].push_back(around);
    }
  if (photograph.empty() || near_edge[0].empty() || near_edge[1].empty()) return false;
  const auto median = [](std::vector<int> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
  };
  const double rough_share = static_cast<double>(near_edge[0].size()) / static_cast<double>(depth.size());
  // Around edges of true depth a photograph is 1.3 (leaves before woven cloth) to 4 times as steep as elsewhere.
  constexpr double most_edges = 0.2, least_agreement = 1.25;
  return rough_share < most_edges && 2 * median(depth) <= median(photograph) &&
         median(near_edge[0]) >= least_agreement * median(near_edge[1]);
}

bool is_named_so(const fs::path& path) {
  const std::string stem = lower_case(path.stem().string());
  return stem == "rgbd" ||
         (stem.ends_with("rgbd") && std::isalnum(static_cast<unsigned char>(stem[stem.size() - 5])) == 0);
}

CarriedDepth cut(const Image<Rgb8>& both) {
  const int width = both.width() / 2;
  CarriedDepth read{Image<Rgb8>(width, both.height()), Image<float>(width, both.height()), DepthKind::inverse,
                    "its right half"};
  for (int y = 0; y < both.height(); ++y)
    for (int x = 0; x < width; ++x) {
      read.picture(x, y) = both(x, y);
      read.depth(x, y) = both(x + width, y).g;
    }
  return read;
}

/// Whether a first look at a JPEG shows a right half in colour, as most photographs have. A mean of 64 pixels has at
/// most the mean of their colourfulness: where this is so, many of these pixels are far from grey.
bool right_half_is_coloured(std::string_view bytes, const fs::path& path) {
  constexpr double some = 0.25;
  const Image<Rgb8> small = decode_small_jpeg(bytes, path);
  return coloured_share(small, small.width() / 2, 3 * grey_tolerance, 1) > some;
}

/// The picture and the depth of a file whose halves, next to each other, look like these; none where they do not.
/// A name that ends in the word "rgbd" is believed where the right half is grey. Throws as read_image.
std::optional<CarriedDepth> find_depth_beside(std::string_view bytes, const fs::path& path) {
  if (is_jpeg(bytes) && right_half_is_coloured(bytes, path)) return {};
  const Image<Rgb8> both = read_image(path);
  if (both.width() < 2 || both.width() % 2 != 0) return {};
  constexpr double few = 0.002, some = 0.02;
  const bool is_grey = coloured_share(both, both.width() / 2, grey_tolerance) <= few;
  if (!is_grey) return {};
  if (is_named_so(path)) return cut(both);
  if (coloured_share(both, 0, 3 * grey_tolerance) < some || !is_depth_of_left_half(both)) return {};
  return cut(both);
}

}  // namespace

CarriedDepth read_depth_beside(const fs::path& path) {
  const Image<Rgb8> both = read_image(path);
  const int width = both.width() / 2;
  if (width < 1 || both.width() % 2 != 0)
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: is {} pixels wide, expected a picture and its depth of one width beside each other",
                            path.string(), both.width()));
  for (int y = 0; y < both.height(); ++y)
    for (const Rgb8 level : both.row(y).subspan(static_cast<std::size_t>(width)))
      if (colourfulness(level) > grey_tolerance)
        throw Error(
            ErrorKind::bad_input,
            fmt::format("{}: its right half is in colour, expected the grey levels of a depth map", path.string()));
  return cut(both);
}

namespace {

[[noreturn]] void refuse_depth(const fs::path& path, std::string_view what) {
  throw Error(ErrorKind::bad_input, fmt::format("{}: its depth map {}", path.string(), what));
}

double number_of(const fs::path& path, std::string_view name, std::optional<std::string_view> text) {
  double number = 0;
  if (text) {
    const auto [end, error] = std::from_chars(text->data(), text->data() + text->size(), number);
    if (error == std::errc() && std::isfinite(number)) return number;
  }
  refuse_depth(path, fmt::format("has no number for {}", name));
}

/// Brings levels of 0..1 to what they stand for. https://developers.google.com/depthmap-metadata/encoding: level 0 is
/// the nearest point in both formats.
DepthKind interpret(const fs::path& path, const Xmp& xmp, std::string_view prefix, Image<float>& levels) {
  const auto property = [&](std::string_view name) { return xmp_property(xmp, fmt::format("{}:{}", prefix, name)); };
  const std::string_view format = property("Format").value_or("");
  if (format == "RangeInverse") {
    for (float& level : levels.pixels()) level = 1 - level;
    return DepthKind::inverse;
  }
  if (format != "RangeLinear")
    refuse_depth(path, fmt::format("has the format '{}', expected RangeInverse or RangeLinear", format.substr(0, 40)));
  const double near = number_of(path, "Near", property("Near")), far = number_of(path, "Far", property("Far"));
  if (!(near > 0 && far > near))
    refuse_depth(path, fmt::format("lies between {} and {}, expected two distances above 0", near, far));
  for (float& level : levels.pixels()) level = static_cast<float>(near + level * (far - near));
  return DepthKind::metric;
}

/// An entry of the list of what stands behind a picture, in the order of the file.
struct ContainerItem {
  std::string_view semantic;
  std::size_t length = 0;
};

/// Dynamic Depth 1.0, sec. 3: Container:Directory lists the picture itself first, without a length.
std::vector<ContainerItem> container_items(const fs::path& path, const Xmp& xmp) {
  std::vector<ContainerItem> items;
  const std::string_view text = xmp.packet;
  constexpr std::string_view tag = "<Container:Item";
  for (std::size_t at = text.find(tag); at != text.npos; at = text.find(tag, at + 1)) {
    const std::string_view item = text.substr(at, text.find('>', at) - at);
    const auto semantic = xmp_property(item, "Item:Semantic");
    if (!semantic) continue;
    const auto length = xmp_property(item, "Item:Length");
    const double bytes = length ? number_of(path, "Item:Length", length) : 0;
    if (bytes < 0 || bytes > static_cast<double>(most_picture_bytes)) refuse_depth(path, "has an impossible length");
    items.push_back({*semantic, static_cast<std::size_t>(bytes)});
  }
  return items;
}

bool lists_depth(const std::vector<ContainerItem>& items) {
  return std::ranges::any_of(items, [](const ContainerItem& item) { return item.semantic == "Depth"; });
}

/// The bytes of the depth map, which stands with the other items at the end of the file.
std::string_view depth_behind_picture(const fs::path& path, std::string_view bytes,
                                      const std::vector<ContainerItem>& items) {
  std::size_t at = bytes.size();
  for (std::size_t i = items.size(); i-- > 1;) {
    if (items[i].length > at) refuse_depth(path, "is listed with more bytes than the file has");
    at -= items[i].length;
    if (items[i].semantic == "Depth") return bytes.substr(at, items[i].length);
  }
  refuse_depth(path, "is not listed behind the picture");
}

/// The levels and what they stand for, as the JPEG stores them; none where it has none.
std::optional<std::pair<Image<float>, DepthKind>> jpeg_depth(const fs::path& path, std::string_view bytes) {
  const Xmp xmp = read_xmp(bytes, path);
  if (const auto data = xmp_property(xmp, "GDepth:Data")) {
    const std::optional<std::string> map = decode_base64(*data);
    if (!map) refuse_depth(path, "is not base64");
    Image<float> levels = decode_depth(*map, path);
    const DepthKind kind = interpret(path, xmp, "GDepth", levels);
    return {{std::move(levels), kind}};
  }
  const std::vector<ContainerItem> items = container_items(path, xmp);
  if (!lists_depth(items)) return {};
  Image<float> levels = decode_depth(depth_behind_picture(path, bytes, items), path);
  const DepthKind kind = interpret(path, xmp, "DepthMap", levels);
  return {{std::move(levels), kind}};
}

}  // namespace

std::optional<CarriedDepth> find_carried_depth(const fs::path& path) {
  const std::string bytes = read_picture_bytes(path);
  if (is_heif(bytes)) {
    std::optional<HeifDepth> found = read_heif_depth(path);
    if (!found) return {};
    const bool is_inverse = found->kind == HeifDepthKind::inverse;
    return CarriedDepth{read_image(path), std::move(found->depth), is_inverse ? DepthKind::inverse : DepthKind::metric,
                        "the depth image of its HEIC file"};
  }
  auto found = is_jpeg(bytes) ? jpeg_depth(path, bytes) : std::nullopt;
  if (!found && may_be_animated(bytes)) return {};
  if (!found) return find_depth_beside(bytes, path);
  // The map lies as the picture is stored.
  const int orientation = open_picture(path).reader->picture().value_of("Orientation", 1);
  return CarriedDepth{read_image(path), upright(std::move(found->first), orientation), found->second,
                      "the depth map of its XMP"};
}

bool carries_depth(const fs::path& path) {
  try {
    const std::string bytes = read_picture_bytes(path);
    if (is_heif(bytes)) return read_heif_depth(path).has_value();
    if (is_jpeg(bytes)) {
      const Xmp xmp = read_xmp(bytes, path);
      if (xmp_property(xmp, "GDepth:Data") || lists_depth(container_items(path, xmp))) return true;
    }
    return !may_be_animated(bytes) && find_depth_beside(bytes, path).has_value();
  } catch (const Error&) {
    return false;
  }
}

}  // namespace wheatstone
