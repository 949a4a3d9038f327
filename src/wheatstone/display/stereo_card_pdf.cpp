#include <fmt/format.h>
#include <hpdf.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "wheatstone/display/lettering.h"
#include "wheatstone/display/stereo_card.h"
#include "wheatstone/display/stereo_card_internal.h"
#include "wheatstone/error.h"
#include "wheatstone/pictures/write_image.h"

namespace wheatstone {
namespace {

constexpr double point_mm = inch_mm / 72;

float points(double mm) { return static_cast<float>(mm / point_mm); }

struct FreePdf {
  void operator()(HPDF_Doc pdf) const { HPDF_Free(pdf); }
};
using Pdf = std::unique_ptr<std::remove_pointer_t<HPDF_Doc>, FreePdf>;

/// libHaru tells of an error and goes on; what failed is asked at the end.
void check(const Pdf& pdf) {
  if (const HPDF_STATUS status = HPDF_GetError(pdf.get()); status != HPDF_OK)
    throw Error(ErrorKind::cannot_read_write, fmt::format("cannot make the PDF: libHaru's error {:#x}", status));
}

/// A rectangle with round corners as a path; PDF counts upwards from the lower edge.
void put_round_path(HPDF_Page page, const PaperArea& area, double corner_mm, double page_height_mm) {
  constexpr double round = 0.5523;  // of a corner's radius: Bézier curves nearest to quarters of a circle
  const double left = area.left_mm, right = left + area.width_mm, top = page_height_mm - area.top_mm;
  const double bottom = top - area.height_mm, c = corner_mm, k = c * (1 - round);
  const auto line = [&](double x, double y) { HPDF_Page_LineTo(page, points(x), points(y)); };
  const auto curve = [&](double x1, double y1, double x2, double y2, double x, double y) {
    HPDF_Page_CurveTo(page, points(x1), points(y1), points(x2), points(y2), points(x), points(y));
  };
  HPDF_Page_MoveTo(page, points(left + c), points(bottom));
  line(right - c, bottom);
  curve(right - k, bottom, right, bottom + k, right, bottom + c);
  line(right, top - c);
  curve(right, top - k, right - k, top, right - c, top);
  line(left + c, top);
  curve(left + k, top, left, top - k, left, top - c);
  line(left, bottom + c);
  curve(left, bottom + k, left + k, bottom, left + c, bottom);
  HPDF_Page_ClosePath(page);
}

void put_window(const Pdf& pdf, HPDF_Page page, ImageView<const Rgb8> view, const PaperArea& window,
                const StereoCardLayout& layout, const StereoCardOptions& options) {
  // Not more pixels than the view has.
  const double scale =
      shown_part(view.width(), view.height(), window.width_mm, window.height_mm, options.framing).scale;
  const double px_a_mm = std::min(options.dpi / inch_mm, 1 / scale);
  const auto pixels = [&](double mm) { return std::max(static_cast<int>(std::lround(mm * px_a_mm)), 1); };
  constexpr int quality = 95;
  const std::string jpeg =
      encode_jpeg(framed_view(view, pixels(window.width_mm), pixels(window.height_mm), options.framing), quality);
  HPDF_Image image = HPDF_LoadJpegImageFromMem(pdf.get(), reinterpret_cast<const HPDF_BYTE*>(jpeg.data()),
                                               static_cast<HPDF_UINT>(jpeg.size()));
  check(pdf);
  HPDF_Page_GSave(page);
  put_round_path(page, window, layout.corner_mm, layout.height_mm);
  HPDF_Page_Clip(page);
  HPDF_Page_EndPath(page);
  HPDF_Page_DrawImage(page, image, points(window.left_mm), points(layout.height_mm - window.top_mm - window.height_mm),
                      points(window.width_mm), points(window.height_mm));
  HPDF_Page_GRestore(page);
}

void put_caption(const Pdf& pdf, HPDF_Page page, const StereoCardLayout& layout, const StereoCardOptions& options) {
  HPDF_UseUTFEncodings(pdf.get());
  const char* const name = HPDF_LoadTTFontFromFile(pdf.get(), font_for(options.caption).c_str(), HPDF_TRUE);
  check(pdf);
  HPDF_Font font = HPDF_GetFont(pdf.get(), name, "UTF-8");
  check(pdf);
  const PaperArea& place = layout.caption;
  const auto width_of = [&](const std::string& line, double letter_mm) {
    HPDF_Page_SetFontAndSize(page, font, points(letter_mm));
    return static_cast<double>(HPDF_Page_TextWidth(page, line.c_str())) * point_mm;
  };
  const CardCaption caption = fitted_caption(place, [&](double letter_mm) {
    return broken_lines(options.caption,
                        [&](const std::string& line) { return width_of(line, letter_mm) <= place.width_mm; });
  });
  const double step_mm = caption.letter_mm * card_line_step;
  double top_mm = place.top_mm + (place.height_mm - step_mm * static_cast<double>(caption.lines.size())) / 2;
  HPDF_Page_SetRGBFill(page, static_cast<float>(options.ink.r) / 255, static_cast<float>(options.ink.g) / 255,
                       static_cast<float>(options.ink.b) / 255);
  HPDF_Page_BeginText(page);
  for (const std::string& line : caption.lines) {
    const double left_mm = place.left_mm + (place.width_mm - width_of(line, caption.letter_mm)) / 2;
    HPDF_Page_TextOut(page, points(left_mm), points(layout.height_mm - top_mm - caption.letter_mm), line.c_str());
    top_mm += step_mm;
  }
  HPDF_Page_EndText(page);
}

}  // namespace

std::string stereo_card_pdf(const StereoPairView& pair, const StereoCardOptions& options) {
  const StereoCardLayout layout = stereo_card_layout(pair.left.width(), pair.left.height(), options.framing);
  const Pdf pdf(HPDF_New(nullptr, nullptr));
  if (!pdf) throw Error(ErrorKind::cannot_read_write, "cannot make the PDF: too little memory");
  HPDF_Page page = HPDF_AddPage(pdf.get());
  HPDF_Page_SetWidth(page, points(layout.width_mm));
  HPDF_Page_SetHeight(page, points(layout.height_mm));
  HPDF_Page_SetRGBFill(page, static_cast<float>(options.mount.r) / 255, static_cast<float>(options.mount.g) / 255,
                       static_cast<float>(options.mount.b) / 255);
  HPDF_Page_Rectangle(page, 0, 0, points(layout.width_mm), points(layout.height_mm));
  HPDF_Page_Fill(page);
  put_window(pdf, page, pair.left, layout.windows[0], layout, options);
  put_window(pdf, page, pair.right, layout.windows[1], layout, options);
  if (!options.caption.empty()) put_caption(pdf, page, layout, options);
  check(pdf);
  HPDF_SaveToStream(pdf.get());
  std::string bytes(HPDF_GetStreamSize(pdf.get()), '\0');
  auto size = static_cast<HPDF_UINT32>(bytes.size());
  HPDF_ReadFromStream(pdf.get(), reinterpret_cast<HPDF_BYTE*>(bytes.data()), &size);
  check(pdf);
  bytes.resize(size);
  return bytes;
}

}  // namespace wheatstone
