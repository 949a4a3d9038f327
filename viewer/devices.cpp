#include "devices.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <vector>

#include "wheatstone/error.h"

namespace wheatstone::viewer {

std::span<const LookingWith> devices() {
  static constexpr std::array known{LookingWith{"no-glasses", "No glasses", "left", ""},
                                    LookingWith{"red-cyan", "Red-cyan glasses", "red-cyan", ""},
                                    LookingWith{"3d-screen", "3D screen or projector", "left-right-half", ""},
                                    LookingWith{"looking-glass", "Looking Glass", "quilt", "looking-glass-portrait"},
                                    LookingWith{"headset", "Headset", "left-right", ""}};
  return known;
}

const LookingWith& find_device(std::string_view name) {
  const auto found = std::ranges::find(devices(), name, &LookingWith::name);
  if (found != devices().end()) return *found;
  std::vector<std::string_view> names;
  for (const LookingWith& device : devices()) names.push_back(device.name);
  throw Error(ErrorKind::wrong_usage,
              fmt::format("'{}' is no viewing device, expected one of: {}", name, fmt::join(names, ", ")));
}

}  // namespace wheatstone::viewer
