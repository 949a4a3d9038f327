#include "wheatstone/app/write_svg.h"

#include <string>

#include "wheatstone/drawing/draw.h"
#include "wheatstone/drawing/svg.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/pictures/write_image.h"

namespace wheatstone {
namespace {

std::string svg_of_any(const Painting& painting, ViewPosition view) {
  if (painting.regions.width > 0) return svg_of(painting.regions, view);
  if (painting.curves.width > 0) return svg_of(painting.curves, view, encode_png(draw(painting.curves, view).picture));
  return svg_of(painting.strokes, view);
}

}  // namespace

void write_svg(const std::filesystem::path& path, const Painting& painting, ViewPosition view) {
  write_whole_file(path, svg_of_any(painting, view));
}

}  // namespace wheatstone
