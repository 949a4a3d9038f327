#include "wheatstone/calibration/checkerboard.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "wheatstone/error.h"
#include "wheatstone/image/mat_opencv.h"
#include "wheatstone/pictures/read_image.h"

namespace wheatstone {
namespace {

constexpr int least_corners = 3, most_corners = 200;

void check(const Checkerboard& board) {
  if (std::min(board.columns, board.rows) < least_corners || std::max(board.columns, board.rows) > most_corners)
    throw Error(ErrorKind::wrong_usage, fmt::format("the board has {}x{} inner corners, expected {} to {} a side",
                                                    board.columns, board.rows, least_corners, most_corners));
  if (!(board.square_mm > 0) || board.square_mm > 1e6)
    throw Error(ErrorKind::wrong_usage,
                fmt::format("the board's squares are {} mm wide, expected a length above 0", board.square_mm));
}

/// Moves corners to where the edges around them cross.
void refine(const cv::Mat& luminance, std::vector<cv::Point2f>& corners) {
  // The window must not reach the next corner.
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < corners.size(); ++i) nearest = std::min(nearest, cv::norm(corners[i] - corners[i - 1]));
  const int half = std::clamp(static_cast<int>(nearest / 2.5), 2, 11);
  cv::cornerSubPix(luminance, corners, {half, half}, {-1, -1},
                   {cv::TermCriteria::EPS | cv::TermCriteria::COUNT, 50, 1e-3});
}

/// The older way: finds what the newer one misses when the board has no white rim, but is less exact.
bool find_by_quads(const cv::Mat& luminance, cv::Size size, std::vector<cv::Point2f>& corners) {
  constexpr int flags = cv::CALIB_CB_ADAPTIVE_THRESH | cv::CALIB_CB_NORMALIZE_IMAGE | cv::CALIB_CB_FAST_CHECK;
  if (!cv::findChessboardCorners(luminance, size, corners, flags)) return false;
  refine(luminance, corners);
  return true;
}

constexpr int exactly = cv::CALIB_CB_NORMALIZE_IMAGE | cv::CALIB_CB_ACCURACY;

constexpr int search_side_px = 1024;

/// The board in a copy of the picture reduced to a side that is searched quickly, in pixels of the picture itself.
/// Searching a large picture that shows none would take minutes.
bool find_roughly(const cv::Mat& luminance, cv::Size size, std::vector<cv::Point2f>& corners) {
  const double scale = std::min(1.0, static_cast<double>(search_side_px) / std::max(luminance.cols, luminance.rows));
  const cv::Mat small = scale < 1 ? shrunk(luminance, scale) : luminance;
  if (!cv::findChessboardCornersSB(small, size, corners, exactly) && !find_by_quads(small, size, corners)) return false;
  const auto back = static_cast<float>(1 / scale);
  for (cv::Point2f& corner : corners) corner = (corner + cv::Point2f(0.5f, 0.5f)) * back - cv::Point2f(0.5f, 0.5f);
  return true;
}

/// Finds the corners again in the full picture, around where they were found in a reduced one.
void find_exactly(const cv::Mat& luminance, cv::Size size, std::vector<cv::Point2f>& corners) {
  const cv::Rect box = cv::boundingRect(corners);
  const int rim_x = 2 * box.width / size.width + 8, rim_y = 2 * box.height / size.height + 8;
  const cv::Rect around = cv::Rect(box.x - rim_x, box.y - rim_y, box.width + 2 * rim_x, box.height + 2 * rim_y) &
                          cv::Rect(0, 0, luminance.cols, luminance.rows);
  std::vector<cv::Point2f> found;
  if (!cv::findChessboardCornersSB(luminance(around).clone(), size, found, exactly)) {
    refine(luminance, corners);
    return;
  }
  for (cv::Point2f& corner : found) corner += cv::Point2f(static_cast<float>(around.x), static_cast<float>(around.y));
  corners = std::move(found);
}

/// Corner (column, row) of a board that is turned by a quarter `turns` times.
std::vector<PicturePoint> turned(const std::vector<PicturePoint>& corners, const Checkerboard& board, int turns) {
  const int columns = board.columns, rows = board.rows;
  std::vector<PicturePoint> result(corners.size());
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      int from_column = column, from_row = row;
      if (turns == 1) from_column = row, from_row = rows - 1 - column;
      if (turns == 2) from_column = columns - 1 - column, from_row = rows - 1 - row;
      if (turns == 3) from_column = columns - 1 - row, from_row = column;
      result[static_cast<std::size_t>(row) * columns + column] =
          corners[static_cast<std::size_t>(from_row) * columns + from_column];
    }
  }
  return result;
}

/// How unlike two numberings of the board point: the cameras of a rig stand upright side by side, so that the same
/// numbering runs the same way in both.
double direction_difference(const std::vector<PicturePoint>& a, const std::vector<PicturePoint>& b,
                            const Checkerboard& board) {
  const auto along = [&](const std::vector<PicturePoint>& corners, std::size_t to) {
    const cv::Point2d step(corners[to].x - corners[0].x, corners[to].y - corners[0].y);
    return step / std::max(cv::norm(step), 1e-9);
  };
  const auto row_end = static_cast<std::size_t>(board.columns) - 1;
  const auto column_end = static_cast<std::size_t>(board.columns) * (static_cast<std::size_t>(board.rows) - 1);
  return cv::norm(along(a, row_end) - along(b, row_end)) + cv::norm(along(a, column_end) - along(b, column_end));
}

std::vector<PicturePoint> numbered_like(const std::vector<PicturePoint>& model, std::vector<PicturePoint> corners,
                                        const Checkerboard& board) {
  std::vector<PicturePoint> best = corners;
  for (int turns = 1; turns < 4; ++turns) {
    if (turns != 2 && board.columns != board.rows) continue;
    std::vector<PicturePoint> other = turned(corners, board, turns);
    if (direction_difference(model, other, board) < direction_difference(model, best, board)) best = std::move(other);
  }
  return best;
}

}  // namespace

std::vector<PicturePoint> find_checkerboard(ImageView<const Rgb8> picture, const Checkerboard& board) {
  check(board);
  cv::Mat luminance;
  cv::cvtColor(as_mat(picture), luminance, cv::COLOR_RGB2GRAY);
  const cv::Size size(board.columns, board.rows);
  std::vector<cv::Point2f> corners;
  if (!find_roughly(luminance, size, corners)) return {};
  if (std::max(luminance.cols, luminance.rows) > search_side_px) find_exactly(luminance, size, corners);
  std::vector<PicturePoint> points;
  points.reserve(corners.size());
  // OpenCV counts from the centre of the first pixel.
  for (const cv::Point2f& corner : corners)
    points.push_back({static_cast<double>(corner.x) + 0.5, static_cast<double>(corner.y) + 0.5});
  return points;
}

BoardSighting find_checkerboards(ImageView<const Rgb8> left, ImageView<const Rgb8> right, const Checkerboard& board) {
  if (!same_size(left, right))
    throw Error(ErrorKind::bad_input, fmt::format("the right picture is {}x{} pixels, expected the left one's {}x{}",
                                                  right.width(), right.height(), left.width(), left.height()));
  BoardSighting sighting;
  sighting.width = left.width();
  sighting.height = left.height();
  sighting.left = find_checkerboard(left, board);
  sighting.right = find_checkerboard(right, board);
  if (!sighting.left.empty() && !sighting.right.empty())
    sighting.right = numbered_like(sighting.left, std::move(sighting.right), board);
  return sighting;
}

std::vector<BoardSighting> find_checkerboards(std::span<const PictureFiles> files, const Checkerboard& board,
                                              const Progress& progress) {
  std::vector<BoardSighting> sightings;
  for (std::size_t i = 0; i < files.size(); ++i) {
    report(progress, "finding checkerboards", static_cast<double>(i) / static_cast<double>(files.size()));
    const Image<Rgb8> left = read_image(files[i].left), right = read_image(files[i].right);
    if (!same_size(left, right))
      throw Error(ErrorKind::bad_input,
                  fmt::format("{}: is {}x{} pixels, expected {}x{} as {}", files[i].right.string(), right.width(),
                              right.height(), left.width(), left.height(), files[i].left.string()));
    sightings.push_back(find_checkerboards(left, right, board));
    sightings.back().left_name = files[i].left.string();
    sightings.back().right_name = files[i].right.string();
  }
  report(progress, "finding checkerboards", 1);
  return sightings;
}

}  // namespace wheatstone
