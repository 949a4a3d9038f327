#include "wheatstone/pictures/describe_image.h"

#include "wheatstone/pictures/open_picture.h"

namespace wheatstone {

ImageDescription describe_image(const std::filesystem::path& path) {
  const OpenPicture open = open_picture(path);
  const StoredPicture& picture = open.reader->picture();
  ImageDescription description;
  description.format = open.reader->format();
  description.width = picture.width;
  description.height = picture.height;
  description.channels = picture.channels;
  description.has_alpha = picture.alpha_channel >= 0;
  description.bits = picture.value_of("oiio:BitsPerSample", picture.kind.bits);
  description.is_float = picture.kind.is_float;
  description.orientation = picture.value_of("Orientation", 1);
  return description;
}

}  // namespace wheatstone
