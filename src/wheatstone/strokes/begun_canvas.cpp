#include "wheatstone/strokes/begun_canvas_internal.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "wheatstone/image/mat_opencv.h"

namespace wheatstone {
namespace {

void enlarge_band(const BegunCanvas& begun, int first, int end, Canvas& to, int top) {
  constexpr int reach = 2;  // of what the rows are interpolated from, and one to spare
  const Canvas& smaller = begun.canvas;
  const int factor = begun.factor;
  const int rows = std::min(smaller.height * factor, begun.height);
  const int columns = std::min(smaller.width * factor, begun.width);
  const int from_row = std::max(std::min(first, rows - 1) / factor - reach, 0);
  const int from_end = std::min((end + factor - 1) / factor + reach, smaller.height);
  const auto enlarge = [&](const Image<float>& from, Image<float>& plane) {
    const cv::Mat small = as_mat(from)(cv::Rect(0, from_row, smaller.width, from_end - from_row));
    cv::Mat large;
    cv::resize(small, large, {small.cols * factor, small.rows * factor}, 0, 0, cv::INTER_LINEAR);
    const auto width = static_cast<std::size_t>(columns);
    for (int y = first; y < end; ++y) {
      const auto own = plane.row(y - top).first(static_cast<std::size_t>(to.width));
      std::copy_n(large.ptr<float>(std::min(y, rows - 1) - from_row * factor), width, own.begin());
      std::ranges::fill(own.subspan(width), own[width - 1]);
    }
  };
  enlarge(smaller.red, to.red);
  enlarge(smaller.green, to.green);
  enlarge(smaller.blue, to.blue);
  enlarge(smaller.coverage, to.coverage);
  for (int y = first; y < end; ++y) {
    const auto own = to.coverage.row(y - top).first(static_cast<std::size_t>(to.width));
    std::ranges::fill(own.subspan(y < rows ? static_cast<std::size_t>(columns) : 0), 0.f);
  }
}

}  // namespace

void enlarge_rows(const BegunCanvas& begun, int first, int end, Canvas& to, int top) {
  tbb::parallel_for(0, band_count(end - first), [&](int band) {
    enlarge_band(begun, first + band * band_rows, std::min(first + (band + 1) * band_rows, end), to, top);
  });
}

Canvas enlarged_canvas(const BegunCanvas& begun) {
  Canvas canvas(begun.width, begun.height, {});
  enlarge_rows(begun, 0, begun.height, canvas);
  return canvas;
}

Image<Rgb8> picture_of(const BegunCanvas& begun) {
  Image<Rgb8> picture(begun.width, begun.height);
  const auto level = [](float value) { return static_cast<std::uint8_t>(value + 0.5f); };
  for_each_row(begun, [&](const Canvas& canvas, int row, int y) {
    const auto red = canvas.red.row(row), green = canvas.green.row(row), blue = canvas.blue.row(row);
    const auto to = picture.row(y);
    for (std::size_t x = 0; x < to.size(); ++x) to[x] = {level(red[x]), level(green[x]), level(blue[x])};
  });
  return picture;
}

Image<std::uint8_t> bare_pixels(const BegunCanvas& begun, ImageView<const std::uint8_t> wanted) {
  Image<std::uint8_t> bare(begun.width, begun.height);
  for_each_row(begun, [&](const Canvas& canvas, int row, int y) {
    const auto coverage = canvas.coverage.row(row);
    const auto marks = bare.row(y);
    for (std::size_t x = 0; x < marks.size(); ++x) marks[x] = coverage[x] < 0.5f ? 255 : 0;
    if (wanted.empty()) return;
    const auto wanted_here = wanted.row(y);
    for (std::size_t x = 0; x < marks.size(); ++x) marks[x] = wanted_here[x] != 0 ? marks[x] : std::uint8_t{0};
  });
  return bare;
}

}  // namespace wheatstone
