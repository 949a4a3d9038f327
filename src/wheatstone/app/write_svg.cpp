#include "wheatstone/app/write_svg.h"

#include "wheatstone/drawing/draw.h"
#include "wheatstone/drawing/svg.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/pictures/write_image.h"

namespace wheatstone {

void write_svg(const std::filesystem::path& path, const Painting& painting, ViewPosition view) {
  write_whole_file(path,
                   svg_of(painting, view, svg_has_ground(painting) ? encode_png(draw(painting, view).picture) : ""));
}

}  // namespace wheatstone
