#pragma once

// OpenEXR with the passes of a renderer, as Blender writes it: "ViewLayer.Depth.left.Z" and so on.

#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "temporary_folder.h"
#include "wheatstone/image/colour.h"
#include "wheatstone/pictures/picture_file.h"

namespace wheatstone {

/// A view as it is written. Vectors are Blender's: y up, X and Y to the frame before, Z and W from the frame after.
struct RenderedView {
  Image<Rgb8> picture;
  Image<float> depth;
  std::array<Image<float>, 4> vectors = {};  ///< empty: none
};

/// `depth_channel`: "Z", or "V" as later versions of Blender call it.
inline void write_rendered_frame(const std::filesystem::path& path, const std::vector<RenderedView>& views,
                                 const std::string& depth_channel = "Z") {
  const std::array<std::string, 2> names{"left", "right"};
  const int width = views.front().picture.width(), height = views.front().picture.height();
  StoredPicture stored{width, height};
  std::vector<std::vector<float>> channels;
  const auto add = [&](const std::string& name, auto value_at) {
    stored.channel_names.push_back("ViewLayer." + name);
    std::vector<float>& values = channels.emplace_back();
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) values.push_back(value_at(x, y));
  };
  for (std::size_t v = 0; v < views.size(); ++v) {
    const RenderedView& view = views[v];
    add("Combined." + names[v] + ".R", [&](int x, int y) { return linear_from_srgb(view.picture(x, y).r); });
    add("Combined." + names[v] + ".G", [&](int x, int y) { return linear_from_srgb(view.picture(x, y).g); });
    add("Combined." + names[v] + ".B", [&](int x, int y) { return linear_from_srgb(view.picture(x, y).b); });
    if (!view.depth.empty())
      add("Depth." + names[v] + "." + depth_channel, [&](int x, int y) { return view.depth(x, y); });
    constexpr std::array<const char*, 4> axes{"X", "Y", "Z", "W"};
    for (std::size_t axis = 0; axis < 4 && !view.vectors[axis].empty(); ++axis)
      add("Vector." + names[v] + "." + axes[axis], [&](int x, int y) { return view.vectors[axis](x, y); });
  }
  stored.channels = static_cast<int>(channels.size());
  stored.kind = floats_kind;
  stored.put("multiView", std::vector<std::string>(names.begin(), names.end()));
  stored.put("oiio:ColorSpace", "Linear");
  std::vector<float> pixels;
  for (std::size_t i = 0; i < channels.front().size(); ++i)
    for (const std::vector<float>& channel : channels) pixels.push_back(channel[i]);
  const std::string bytes =
      encode_picture(path, stored,
                     {pixels.data(), floats_kind, 0, height,
                      static_cast<std::ptrdiff_t>(channels.size() * static_cast<std::size_t>(width) * sizeof(float))});
  put_bytes(path, bytes);
}

}  // namespace wheatstone
