#include "style_previews.h"

#include "painting.h"
#include "wheatstone/drawing/draw.h"
#include "wheatstone/error.h"
#include "wheatstone/painting/paint.h"
#include "wheatstone/stereo/picture_sizes.h"

namespace wheatstone::viewer {
namespace {

constexpr int preview_px = 192;

}  // namespace

Image<Rgb8> preview_of(const Photograph& photograph, const Style& style, int largest_px, const Progress& progress) {
  const auto detail =
      reads_detail(style) && photograph.detail ? photograph.detail->view() : ImageView<const std::uint8_t>();
  return draw(small_painting(photograph, style, largest_px, detail, progress), left_eye).picture;
}

void StylePreviews::show(const std::shared_ptr<const Photograph>& photograph) {
  begun_ = photograph;
  if (!photograph || !photograph->geometry) return painting_.stop();
  painting_.start([this, photograph](const std::stop_token& stop) {
    const Progress progress = [&stop](std::string_view, double) {
      if (stop.stop_requested()) throw Error(ErrorKind::interrupted, "stopped");
    };
    for (const std::string_view name : style_names()) {
      if (stop.stop_requested()) return;
      try {
        deliver_(photograph, std::string(name), preview_of(*photograph, style_by_name(name), preview_px, progress));
      } catch (const Error&) {  // one that cannot be painted has no preview
      }
    }
  });
}

}  // namespace wheatstone::viewer
