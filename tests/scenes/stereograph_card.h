#pragma once

// A stereograph card as it comes from a scanner: two faded prints with rounded tops on a grainy mount, writing below
// them, the whole a little turned.

#include <opencv2/imgproc.hpp>

#include "wheatstone/image/mat_opencv.h"
#include "wheatstone/photograph/card_windows_internal.h"

namespace wheatstone {

struct CardOptions {
  int width = 1000;
  Rgb8 mount{214, 188, 140};
  double turn_deg = 0;         ///< clockwise
  double rounding = 0.25;      ///< radius of the prints' upper corners, as a share of their width
  double gutter_share = 0.03;  ///< between the prints, of the card's width
  int seed = 1;
  int photographs = 2;
  double ground_share = 0;  ///< of the card's width: black ground of the scanner on all sides
};

/// `left` and `right` are where the prints lie before the card is turned about the picture's centre.
struct TestCard {
  Image<Rgb8> picture;
  CardWindow left, right;
};

/// A print: brown, with two thirds of its contrast gone, and bright in the sky.
inline cv::Mat faded_print(const Image<Rgb8>& photograph, const cv::Size& size) {
  cv::Mat grey, print;
  const int width = photograph.height() * size.width / size.height;
  const cv::Rect middle((photograph.width() - width) / 2, 0, width, photograph.height());
  cv::cvtColor(as_mat(photograph)(middle), grey, cv::COLOR_RGB2GRAY);
  cv::resize(grey, grey, size, 0, 0, cv::INTER_AREA);
  cv::Mat channels[3];
  const double darkest[] = {92, 76, 58}, contrast[] = {0.38, 0.36, 0.32};
  for (int c = 0; c < 3; ++c) grey.convertTo(channels[c], CV_8U, contrast[c], darkest[c]);
  cv::merge(channels, 3, print);
  return print;
}

inline void paste_rounded(const cv::Mat& print, const CardWindow& window, double rounding, cv::Mat& card) {
  cv::Mat shape(print.size(), CV_8U, cv::Scalar(0));
  const int radius = static_cast<int>(rounding * window.width);
  shape.rowRange(radius, shape.rows).setTo(255);
  shape(cv::Rect(radius, 0, window.width - 2 * radius, radius + 1)).setTo(255);
  for (const int x : {radius, window.width - 1 - radius}) cv::circle(shape, {x, radius}, radius, cv::Scalar(255), -1);
  print.copyTo(card(cv::Rect(window.left, window.top, window.width, window.height)), shape);
}

inline TestCard make_card(const StereoPair& pair, const CardOptions& options) {
  const auto share = [&](double of_width) { return static_cast<int>(of_width * options.width); };
  const int width = share(0.42), height = share(0.43), gutter = share(options.gutter_share);
  TestCard made;
  made.left = {(options.width - gutter) / 2 - width, share(0.03), width, height};
  made.right = {(options.width + gutter) / 2, share(0.03), width, height};
  made.picture = Image<Rgb8>(options.width, share(0.53), options.mount);
  cv::Mat card = as_mat(made.picture);
  if (options.photographs > 0)
    paste_rounded(faded_print(pair.left, {width, height}), made.left, options.rounding, card);
  if (options.photographs > 1)
    paste_rounded(faded_print(pair.right, {width, height}), made.right, options.rounding, card);
  const double letters = options.width / 1400.;
  cv::putText(card, "No. 1134. Still life with fruit, a vase and a copper cup.", {share(0.2), share(0.507)},
              cv::FONT_HERSHEY_SIMPLEX, letters, {60, 50, 40}, 1 + options.width / 1000, cv::LINE_AA);
  // The mount is grainy, and lighter on one side.
  cv::Mat grain(card.size(), CV_16SC3), sum;
  cv::RNG random(static_cast<std::uint64_t>(options.seed));
  random.fill(grain, cv::RNG::NORMAL, cv::Scalar::all(0), cv::Scalar::all(6));
  for (int y = 0; y < grain.rows; ++y)
    for (int x = 0; x < grain.cols; ++x)
      grain.at<cv::Vec3s>(y, x) -= cv::Vec3s::all(static_cast<short>(8 * x / grain.cols));
  cv::add(card, grain, sum, cv::noArray(), CV_8U);
  const cv::Point2f centre(static_cast<float>(card.cols - 1) / 2, static_cast<float>(card.rows - 1) / 2);
  cv::warpAffine(sum, card, cv::getRotationMatrix2D(centre, -options.turn_deg, 1), card.size(), cv::INTER_LINEAR,
                 cv::BORDER_REPLICATE);
  if (const int ground = share(options.ground_share); ground > 0) {
    Image<Rgb8> scan(card.cols + 2 * ground, card.rows + 2 * ground, {9, 9, 11});
    cv::Mat whole = as_mat(scan);
    card.copyTo(whole(cv::Rect(ground, ground, card.cols, card.rows)));
    made.picture = std::move(scan);
    for (CardWindow* window : {&made.left, &made.right}) window->left += ground, window->top += ground;
  }
  return made;
}

}  // namespace wheatstone
