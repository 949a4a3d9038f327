#include "wheatstone/display/multiview_exr.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "wheatstone/error.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/image/srgb.h"

namespace wheatstone {
namespace {

constexpr std::array<const char*, 3> letters{"R", "G", "B"};
constexpr std::size_t most_views = 1000;

std::string channel_name(const std::vector<std::string>& views, std::size_t view, std::size_t channel) {
  return view == 0 ? letters[channel] : fmt::format("{}.{}", views[view], letters[channel]);
}

std::vector<std::string> views_named_in(const OIIO::ImageSpec& spec) {
  const OIIO::ParamValue* const named = spec.find_attribute("multiView");
  std::vector<std::string> names;
  if (named == nullptr || named->type().basetype != OIIO::TypeDesc::STRING) return names;
  const std::size_t count = named->type().numelements();
  for (std::size_t i = 0; i < std::min(count, most_views); ++i)
    names.emplace_back(named->get_ustring_indexed(static_cast<int>(i)).string());
  return names;
}

}  // namespace

std::vector<std::string> view_names(std::size_t count) {
  if (count == 2) return {"left", "right"};
  std::vector<std::string> names;
  for (std::size_t v = 0; v < count; ++v) names.push_back(fmt::format("view{:02}", v));
  return names;
}

void write_multiview_exr(const std::filesystem::path& path, std::span<const Image<Rgb8>> views) {
  if (views.size() < 2 || views.size() > most_views)
    throw Error(ErrorKind::wrong_usage,
                fmt::format("{}: {} views, expected 2 to {}", path.string(), views.size(), most_views));
  for (const Image<Rgb8>& view : views)
    if (view.empty() || !same_size(view, views.front()))
      throw Error(ErrorKind::wrong_usage, fmt::format("{}: views of different sizes, expected one", path.string()));
  const int width = views.front().width(), height = views.front().height();
  const std::size_t channels = 3 * views.size();
  OIIO::ImageSpec spec(width, height, static_cast<int>(channels), OIIO::TypeDesc::HALF);
  const std::vector<std::string> names = view_names(views.size());
  for (std::size_t i = 0; i < channels; ++i) spec.channelnames[i] = channel_name(names, i / 3, i % 3);
  std::vector<OIIO::ustring> named(names.begin(), names.end());
  spec.attribute("multiView", OIIO::TypeDesc(OIIO::TypeDesc::STRING, static_cast<int>(named.size())), named.data());
  spec.attribute("oiio:ColorSpace", "Linear");
  spec.attribute("compression", "zip");

  // Otherwise the time of writing: the same views are to be the same bytes.
  spec.attribute("DateTime", "1970:01:01 00:00:00");

  // Encoded in memory and written by us: OpenEXR does not notice when a full disk swallows its last bytes.
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create("exr");
  const auto refuse = [&](const std::string& why) {
    throw Error(ErrorKind::cannot_read_write, fmt::format("{}: cannot write: {}", path.string(), why));
  };
  if (!output) refuse("the installed OpenImageIO cannot write OpenEXR");
  output->set_ioproxy(&memory);
  if (!output->open("views.exr", spec)) refuse(output->geterror());
  std::vector<float> line(static_cast<std::size_t>(width) * channels);
  for (int y = 0; y < height; ++y) {
    for (std::size_t v = 0; v < views.size(); ++v) {
      const auto row = views[v].row(y);
      for (std::size_t x = 0; x < row.size(); ++x) {
        float* const to = line.data() + x * channels + 3 * v;
        to[0] = linear_from_srgb(row[x].r);
        to[1] = linear_from_srgb(row[x].g);
        to[2] = linear_from_srgb(row[x].b);
      }
    }
    if (!output->write_scanline(y, 0, OIIO::TypeDesc::FLOAT, line.data())) refuse(output->geterror());
  }
  if (!output->close()) refuse(output->geterror());
  write_whole_file(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

bool is_multiview_exr(const std::filesystem::path& path) {
  if (path.extension() != ".exr") return false;
  const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(path.string());
  if (!input) {
    OIIO::geterror();
    return false;
  }
  return views_named_in(input->spec()).size() > 1;
}

std::vector<Image<Rgb8>> read_multiview_exr(const std::filesystem::path& path) {
  const auto refuse = [&](const std::string& what) {
    throw Error(ErrorKind::bad_input, fmt::format("{}: {}", path.string(), what));
  };
  const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(path.string());
  if (!input) refuse(fmt::format("cannot be read, expected an OpenEXR: {}", OIIO::geterror()));
  const OIIO::ImageSpec& spec = input->spec();
  const std::vector<std::string> names = views_named_in(spec);
  if (names.size() < 2) refuse("has no multiView attribute, expected two or more views");
  constexpr int most_pixels = 1 << 28;
  if (spec.width < 1 || spec.height < 1 || spec.width > most_pixels / spec.height || spec.nchannels < 1)
    refuse(fmt::format("has {}x{} pixels", spec.width, spec.height));
  std::vector<std::size_t> channels;
  for (std::size_t i = 0; i < 3 * names.size(); ++i) {
    const std::string wanted = channel_name(names, i / 3, i % 3);
    const auto found = std::ranges::find(spec.channelnames, wanted);
    if (found == spec.channelnames.end()) refuse(fmt::format("has no channel {}", wanted));
    channels.push_back(static_cast<std::size_t>(found - spec.channelnames.begin()));
  }
  std::vector<Image<Rgb8>> views(names.size(), Image<Rgb8>(spec.width, spec.height));
  const auto stride = static_cast<std::size_t>(spec.nchannels);
  std::vector<float> line(static_cast<std::size_t>(spec.width) * stride);
  const auto encoded = [](float light) { return srgb_from_linear(light > 0 ? std::min(light, 1.f) : 0.f); };
  for (int y = 0; y < spec.height; ++y) {
    if (!input->read_scanline(spec.y + y, 0, OIIO::TypeDesc::FLOAT, line.data()))
      refuse(fmt::format("is damaged or cut short: {}", input->geterror()));
    for (std::size_t v = 0; v < views.size(); ++v) {
      const auto to = views[v].row(y);
      for (std::size_t x = 0; x < to.size(); ++x) {
        const auto light = [&](std::size_t c) { return encoded(line[x * stride + channels[3 * v + c]]); };
        to[x] = {light(0), light(1), light(2)};
      }
    }
  }
  return views;
}

}  // namespace wheatstone
