#include "wheatstone/display/view_framing.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "wheatstone/error.h"
#include "wheatstone/image/mat_opencv.h"

namespace wheatstone {

ViewFraming parse_view_framing(std::string_view words, std::string_view option) {
  if (words == "fit") return {.whole = true};
  if (words == "fill") return {};
  ViewFraming framing;
  const char* at = words.data();
  const char* const end = at + words.size();
  bool is_right = true;
  for (double* const number : {&framing.x, &framing.y, &framing.zoom}) {
    const auto [behind, error] = std::from_chars(at, end, *number);
    is_right =
        is_right && error == std::errc() && (number == &framing.zoom ? behind == end : behind != end && *behind == ',');
    at = is_right && behind != end ? behind + 1 : behind;
    if (!is_right) break;
  }
  constexpr double least_zoom = 0.1, most_zoom = 20;
  const auto is_share = [](double number) { return number >= 0 && number <= 1; };
  if (!is_right || !is_share(framing.x) || !is_share(framing.y) ||
      !(framing.zoom >= least_zoom && framing.zoom <= most_zoom))
    throw Error(ErrorKind::wrong_usage,
                fmt::format("{}: is '{}', expected fit, fill or X,Y,ZOOM, as 0.5,0.3,1.5: the place that comes to the "
                            "middle, 0 to 1 from the upper left corner, and how much larger than with fill, {} to {}",
                            option, words, least_zoom, most_zoom));
  return framing;
}

ShownPart shown_part(double picture_width, double picture_height, double frame_width, double frame_height,
                     const ViewFraming& framing, double stretch) {
  frame_width /= stretch;  // in the screen's square pixels
  const double across = frame_width / picture_width, down = frame_height / picture_height;
  ShownPart part{.stretch = stretch};
  part.scale = framing.whole ? std::min(across, down) : std::max(across, down) * framing.zoom;
  const auto begin = [&](double place, double picture, double frame) {
    const double shown = frame / part.scale;
    if (framing.whole || shown >= picture) return (picture - shown) / 2;
    return std::clamp(place * picture - shown / 2, 0., picture - shown);
  };
  part.left = begin(framing.x, picture_width, frame_width);
  part.top = begin(framing.y, picture_height, frame_height);
  return part;
}

CoveredPart covered_part(double picture_width, double picture_height, int frame_width, int frame_height,
                         const ShownPart& part) {
  const auto column = [&](double x) {
    return std::clamp(static_cast<int>(std::lround((x - part.left) * part.scale * part.stretch)), 0, frame_width);
  };
  const auto row = [&](double y) {
    return std::clamp(static_cast<int>(std::lround((y - part.top) * part.scale)), 0, frame_height);
  };
  return {column(0), row(0), column(picture_width), row(picture_height)};
}

void put_bars(const CoveredPart& covered, ImageView<Rgb8> frame) {
  for (int y = 0; y < frame.height(); ++y) {
    const auto row = frame.row(y);
    if (y < covered.top || y >= covered.bottom) {
      std::ranges::fill(row, Rgb8{});
    } else {
      std::fill(row.begin(), row.begin() + covered.left, Rgb8{});
      std::fill(row.begin() + covered.right, row.end(), Rgb8{});
    }
  }
}

Image<Rgb8> framed_view(ImageView<const Rgb8> picture, int frame_width, int frame_height, const ShownPart& part) {
  Image<Rgb8> frame(frame_width, frame_height);
  // Smaller pictures are made in two steps: by areas to about the size, then in parts of a pixel.
  const double across = part.scale * part.stretch;
  const int width = std::max(static_cast<int>(std::lround(picture.width() * std::min(across, 1.))), 1);
  const int height = std::max(static_cast<int>(std::lround(picture.height() * std::min(part.scale, 1.))), 1);
  cv::Mat smaller = as_mat(picture);
  if (width < picture.width() || height < picture.height())
    cv::resize(as_mat(picture), smaller, cv::Size(width, height), 0, 0, cv::INTER_AREA);
  // Pixel centres lie half a pixel within.
  const double step_x = static_cast<double>(width) / picture.width() / across;
  const double step_y = static_cast<double>(height) / picture.height() / part.scale;
  const double left = part.left * static_cast<double>(width) / picture.width();
  const double top = part.top * static_cast<double>(height) / picture.height();
  const cv::Matx23d to_picture(step_x, 0, left + 0.5 * step_x - 0.5, 0, step_y, top + 0.5 * step_y - 0.5);
  cv::warpAffine(smaller, as_mat(frame), to_picture, cv::Size(frame_width, frame_height),
                 cv::INTER_CUBIC | cv::WARP_INVERSE_MAP, cv::BORDER_REPLICATE);
  put_bars(covered_part(picture.width(), picture.height(), frame_width, frame_height, part), frame);
  return frame;
}

Image<Rgb8> framed_view(ImageView<const Rgb8> picture, int frame_width, int frame_height, const ViewFraming& framing) {
  return framed_view(picture, frame_width, frame_height,
                     shown_part(picture.width(), picture.height(), frame_width, frame_height, framing));
}

}  // namespace wheatstone
