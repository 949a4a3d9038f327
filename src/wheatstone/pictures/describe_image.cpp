#include "wheatstone/pictures/describe_image.h"

#include "wheatstone/pictures/open_picture_internal.h"

namespace wheatstone {

ImageDescription describe_image(const std::filesystem::path& path) {
  const OpenPicture open = open_picture(path);
  const OIIO::ImageSpec& spec = open.decoder->spec();
  ImageDescription description;
  description.format = open.decoder->format_name();
  description.width = spec.width;
  description.height = spec.height;
  description.channels = spec.nchannels;
  description.has_alpha = spec.alpha_channel >= 0;
  description.bits = spec.get_int_attribute("oiio:BitsPerSample", static_cast<int>(8 * spec.format.size()));
  description.is_float = spec.format.is_floating_point();
  description.orientation = spec.get_int_attribute("Orientation", 1);
  return description;
}

}  // namespace wheatstone
