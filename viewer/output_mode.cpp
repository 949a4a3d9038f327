#include "output_mode.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "wheatstone/error.h"

namespace wheatstone::viewer {
namespace {

std::vector<OutputMode> all_modes() {
  std::vector<OutputMode> modes{{"left", "Left eye", SingleEye::left}, {"right", "Right eye", SingleEye::right}};
  for (const LayoutTraits& traits : stereo_layouts())
    if (is_packed(traits.layout)) modes.push_back({traits.name, std::string(traits.words), traits.layout});
  for (const AnaglyphKind& kind : anaglyph_kinds())
    modes.push_back({kind.name, fmt::format("Anaglyph {} for {} glasses", kind.name, kind.glasses), &kind});
  modes.push_back({"wiggle", "Views one after the other", Wiggle{}});
  modes.push_back({"page-flip", "Shutter glasses, by the graphics card", PageFlip{}});
  modes.push_back({"quilt", "All views of the display", Quilt{}});
  modes.push_back({"lenticular", "The display's lenses", Lenticular{}});
  return modes;
}

}  // namespace

std::span<const OutputMode> output_modes() {
  static const std::vector<OutputMode> modes = all_modes();
  return modes;
}

const OutputMode& find_output_mode(std::string_view name) {
  const auto found = std::ranges::find(output_modes(), name, &OutputMode::name);
  if (found != output_modes().end()) return *found;
  std::vector<std::string_view> names;
  for (const OutputMode& mode : output_modes()) names.push_back(mode.name);
  throw Error(ErrorKind::wrong_usage,
              fmt::format("'{}' is no output mode, expected one of: {}", name, fmt::join(names, ", ")));
}

bool shows_display_views(const OutputMode& mode) {
  return std::holds_alternative<Quilt>(mode.kind) || std::holds_alternative<Lenticular>(mode.kind);
}

std::optional<StereoLayout> interlaced_layout(const OutputMode& mode) {
  const auto* const layout = std::get_if<StereoLayout>(&mode.kind);
  if (layout == nullptr) return {};
  switch (traits_of(*layout).arrangement) {
    case Arrangement::rows:
    case Arrangement::columns:
    case Arrangement::checkerboard:
      return *layout;
    default:
      return {};
  }
}

StereoLayout layout_from(StereoLayout layout, int x, int y) {
  const auto odd = [](int value) { return (static_cast<unsigned>(value) & 1U) != 0; };
  bool changed = false;
  switch (traits_of(layout).arrangement) {
    case Arrangement::rows:
      changed = odd(y);
      break;
    case Arrangement::columns:
      changed = odd(x);
      break;
    case Arrangement::checkerboard:
      changed = odd(x) != odd(y);
      break;
    default:
      break;
  }
  return changed ? with_eyes_swapped(layout) : layout;
}

}  // namespace wheatstone::viewer
