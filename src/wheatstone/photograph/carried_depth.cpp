#include "wheatstone/photograph/carried_depth.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>
#include <vector>

#include "wheatstone/error.h"
#include "wheatstone/photograph/depth_beside_internal.h"
#include "wheatstone/photograph/xmp_internal.h"
#include "wheatstone/pictures/depth_file.h"
#include "wheatstone/pictures/heif_pictures.h"
#include "wheatstone/pictures/jpeg.h"
#include "wheatstone/pictures/open_picture.h"
#include "wheatstone/pictures/read_image.h"
#include "wheatstone/pictures/upright.h"

namespace wheatstone {
namespace {

namespace fs = std::filesystem;

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
  if (!found) return find_depth_beside(path);
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
    return !may_be_animated(bytes) && find_depth_beside(path).has_value();
  } catch (const Error&) {
    return false;
  }
}

}  // namespace wheatstone
