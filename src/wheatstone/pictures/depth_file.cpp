#include "wheatstone/pictures/depth_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "wheatstone/error.h"
#include "wheatstone/pictures/open_picture_internal.h"
#include "wheatstone/pictures/portable_float_map.h"
#include "wheatstone/pictures/stored_channel_internal.h"

namespace wheatstone {

Image<float> read_depth(const std::filesystem::path& path) {
  const std::string bytes = read_picture_bytes(path);
  const bool is_pfm = bytes.starts_with("Pf") || bytes.starts_with("PF");
  Image<float> depth = is_pfm ? decode_pfm(bytes, path.string())
                              : read_stored_channel(path, "a depth map", GreyInColours::accepted).values;
  bool some_known = false;
  for (float& value : depth.pixels()) {
    if (std::isfinite(value))
      some_known = true;
    else
      value = std::numeric_limits<float>::quiet_NaN();
  }
  if (!some_known)
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: the depth is unknown everywhere, expected at least one finite value", path.string()));
  return depth;
}

}  // namespace wheatstone
