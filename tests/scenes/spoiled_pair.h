#pragma once

// For tests only: pairs spoiled in one way each, on which every measure must come out badly.

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "scenes/still_life.h"
#include "wheatstone/image/mat_opencv.h"

namespace wheatstone::spoiled {

inline const SyntheticStill& small_still(bool converged = false) { return still_life(400, 300, 1, converged); }

/// The right eye moved to the right as a whole.
inline StereoPair shifted(StereoPair pair, int columns) {
  for (int y = 0; y < pair.right.height(); ++y) {
    const auto row = pair.right.row(y);
    std::shift_right(row.begin(), row.end(), columns);
  }
  return pair;
}

/// The right eye cut into squares that are moved to and fro by up to 4 pixels.
inline StereoPair torn(StereoPair pair) {
  constexpr int square = 12;
  const Image<Rgb8> whole = pair.right;
  for (int y = 0; y < whole.height(); ++y)
    for (int x = 0; x < whole.width(); ++x) {
      const int move = (x / square * 7 + y / square * 5) % 9 - 4;
      pair.right(x, y) = whole(std::clamp(x + move, 0, whole.width() - 1), y);
    }
  return pair;
}

/// Gaussian noise of its own in each eye.
inline StereoPair noised(StereoPair pair, double deviation) {
  cv::RNG random(7);
  for (Image<Rgb8>* picture : {&pair.left, &pair.right}) {
    cv::Mat noise(picture->height(), picture->width(), CV_16SC3), sum;
    random.fill(noise, cv::RNG::NORMAL, 0, deviation);
    as_mat(*picture).convertTo(sum, CV_16SC3);
    sum += noise;
    sum.convertTo(as_mat(*picture), CV_8UC3);
  }
  return pair;
}

inline StereoPair blurred(StereoPair pair, double sigma) {
  for (Image<Rgb8>* picture : {&pair.left, &pair.right})
    cv::GaussianBlur(as_mat(*picture), as_mat(*picture), {}, sigma);
  return pair;
}

}  // namespace wheatstone::spoiled
