#include "wheatstone/multiview/slice_file.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <memory>

#include "wheatstone/error.h"
#include "wheatstone/image/temporary_file.h"

namespace wheatstone {
namespace {

constexpr int version = 1;
constexpr int most_slices = 4096;
constexpr double most_bytes = 16e9;
constexpr float largest_half = 65504;

[[noreturn]] void refuse_to_write(const std::filesystem::path& path, const std::string& why) {
  throw Error(ErrorKind::cannot_read_write, fmt::format("{}: cannot write, {}", path.string(), why));
}

OIIO::ImageSpec spec_of(const Slice& slice, std::size_t index, const SliceStack& stack) {
  OIIO::ImageSpec spec(slice.pixels.width(), slice.pixels.height(), 4, OIIO::TypeDesc::HALF);
  spec.channelnames = {"R", "G", "B", "A"};
  spec.alpha_channel = 3;
  spec.x = slice.left;
  spec.y = slice.top;
  spec.full_x = 0;
  spec.full_y = 0;
  spec.full_width = stack.width;
  spec.full_height = stack.height;
  spec.attribute("compression", "zip");
  spec.attribute("oiio:subimagename", fmt::format("slice_{:03}", index));
  spec.attribute("wheatstone:version", version);
  spec.attribute("wheatstone:parallax_px", slice.parallax_px);
  spec.attribute("wheatstone:span", stack.span);
  spec.attribute("wheatstone:exposure", stack.exposure);
  spec.attribute("wheatstone:eye_separation_mm", stack.viewing.eye_separation_mm);
  spec.attribute("wheatstone:viewing_distance_mm", stack.viewing.viewing_distance_mm);
  spec.attribute("wheatstone:screen_width_mm", stack.viewing.screen_width_mm);
  return spec;
}

/// A stack without light is one empty pixel, since a file must have a part.
std::vector<Slice> parts_of(const SliceStack& stack) {
  if (!stack.slices.empty()) return stack.slices;
  return {Slice{.parallax_px = 0, .left = 0, .top = 0, .pixels = Image<LinearRgba>(1, 1)}};
}

void limit_light(Image<LinearRgba>& pixels) {
  for (LinearRgba& pixel : pixels.pixels())
    pixel = {std::min(pixel.r, largest_half), std::min(pixel.g, largest_half), std::min(pixel.b, largest_half),
             pixel.a};
}

void write_parts(const std::filesystem::path& path, const std::string& file, const SliceStack& stack) {
  std::vector<Slice> slices = parts_of(stack);
  std::vector<OIIO::ImageSpec> specs;
  for (const Slice& slice : slices) specs.push_back(spec_of(slice, specs.size(), stack));
  const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create("exr");
  if (!output || !output->open(file, static_cast<int>(specs.size()), specs.data()))
    refuse_to_write(path, output ? output->geterror() : OIIO::geterror());
  for (std::size_t i = 0; i < slices.size(); ++i) {
    if (i > 0 && !output->open(file, specs[i], OIIO::ImageOutput::AppendSubimage))
      refuse_to_write(path, output->geterror());
    limit_light(slices[i].pixels);
    if (!output->write_image(OIIO::TypeDesc::FLOAT, slices[i].pixels.pixels().data()))
      refuse_to_write(path, output->geterror());
  }
  if (!output->close()) refuse_to_write(path, output->geterror());
}

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& what) {
  std::string line = what;
  std::replace(line.begin(), line.end(), '\n', ' ');
  throw Error(ErrorKind::bad_input, fmt::format("{}: {}", path.string(), line));
}

float number_in(const std::filesystem::path& path, const OIIO::ImageSpec& spec, const char* name) {
  const OIIO::ParamValue* found = spec.find_attribute(name, OIIO::TypeDesc::FLOAT);
  if (found == nullptr)
    refuse(path, fmt::format("is an OpenEXR picture without Wheatstone's slices: a part has no {}", name));
  const float number = spec.get_float_attribute(name);
  if (!std::isfinite(number)) refuse(path, fmt::format("its {} is no number", name));
  return number;
}

/// Checks a part before anything is allocated for it.
void check_part(const std::filesystem::path& path, const OIIO::ImageSpec& spec, const SliceStack& stack) {
  if (spec.nchannels != 4 || spec.channelnames != std::vector<std::string>{"R", "G", "B", "A"})
    refuse(path, "a slice has other channels than R, G, B and A");
  constexpr int farthest = 1 << 20;
  if (spec.width < 1 || spec.height < 1 || spec.width > farthest || spec.height > farthest ||
      std::abs(spec.x) > farthest || std::abs(spec.y) > farthest)
    refuse(path, fmt::format("a slice is {}x{} pixels at {}, {}", spec.width, spec.height, spec.x, spec.y));
  if (spec.full_width != stack.width || spec.full_height != stack.height)
    refuse(path, "its slices belong to views of different sizes");
}

SliceStack read_parts(const std::filesystem::path& path, OIIO::ImageInput& input) {
  SliceStack stack;
  double bytes = 0;
  for (int part = 0; part < most_slices && input.seek_subimage(part, 0); ++part) {
    const OIIO::ImageSpec spec = input.spec(part, 0);
    if (part == 0) {
      number_in(path, spec, "wheatstone:parallax_px");
      stack.width = spec.full_width;
      stack.height = spec.full_height;
      stack.span = number_in(path, spec, "wheatstone:span");
      stack.exposure = number_in(path, spec, "wheatstone:exposure");
      stack.viewing.eye_separation_mm = number_in(path, spec, "wheatstone:eye_separation_mm");
      stack.viewing.viewing_distance_mm = number_in(path, spec, "wheatstone:viewing_distance_mm");
      stack.viewing.screen_width_mm = number_in(path, spec, "wheatstone:screen_width_mm");
      stack.viewing.width_px = stack.width;
      constexpr int widest = 1 << 16;
      if (stack.width < 1 || stack.height < 1 || stack.width > widest || stack.height > widest || !(stack.exposure > 0))
        refuse(path,
               fmt::format("its views are {}x{} pixels of exposure {}", stack.width, stack.height, stack.exposure));
    }
    check_part(path, spec, stack);
    bytes += static_cast<double>(spec.width) * spec.height * sizeof(LinearRgba);
    if (bytes > most_bytes)
      refuse(path, fmt::format("its slices need more than {:.0f} GB of memory", most_bytes / 1e9));
    Slice slice{
        .parallax_px = number_in(path, spec, "wheatstone:parallax_px"), .left = spec.x, .top = spec.y, .pixels = {}};
    slice.pixels = Image<LinearRgba>(spec.width, spec.height);
    if (!input.read_image(part, 0, 0, 4, OIIO::TypeDesc::FLOAT, slice.pixels.pixels().data()))
      refuse(path, fmt::format("slice {} is damaged or cut short", part));
    for (const LinearRgba& pixel : slice.pixels.pixels())
      if (!std::isfinite(pixel.r + pixel.g + pixel.b + pixel.a))
        refuse(path, fmt::format("slice {} has light that is no number", part));
    stack.slices.push_back(std::move(slice));
  }
  std::ranges::stable_sort(stack.slices, {}, &Slice::parallax_px);
  std::erase_if(stack.slices, [](const Slice& slice) {
    return std::ranges::all_of(slice.pixels.pixels(), [](const LinearRgba& pixel) { return pixel == LinearRgba{}; });
  });
  return stack;
}

}  // namespace

void write_slices(const std::filesystem::path& path, const SliceStack& stack) {
  TemporaryFile temporary(path);
  write_parts(path, temporary.path().string(), stack);
  temporary.commit();
}

SliceStack read_slices(const std::filesystem::path& path) {
  if (!std::filesystem::is_regular_file(path)) refuse(path, "cannot be opened, expected slices (.exr)");
  try {
    const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::create("exr");
    OIIO::ImageSpec first;
    if (!input || !input->open(path.string(), first)) {
      if (input) input->geterror();
      refuse(path, "is no whole OpenEXR file, expected slices");
    }
    SliceStack stack = read_parts(path, *input);
    input->close();
    return stack;
  } catch (const Error&) {
    throw;
  } catch (const std::exception&) {
    refuse(path, "is damaged or cut short, expected slices");
  }
}

}  // namespace wheatstone
