#pragma once

#include <cstdint>
#include <string>

#include "wheatstone/image/image.h"

namespace wheatstone {

/// A fraction, as films give their rates and their ticks; 0/1 where unknown.
struct Rational {
  int numerator = 0;
  int denominator = 1;

  double value() const { return static_cast<double>(numerator) / denominator; }
  friend bool operator==(const Rational&, const Rational&) = default;
};

/// One picture of a film and when it is shown. Times count ticks of `time_base` seconds, as the film itself counts
/// them.
struct Frame {
  Image<Rgb8> picture;
  std::int64_t pts = 0;  ///< presentation time
  Rational time_base{1, 1};
  std::int64_t duration = 0;  ///< 0 where unknown
  /// The same picture with 16 bits a channel, where there is one: read where FilmReaderOptions::deep asks for it, and
  /// written where writes_deep. Empty: `picture` is all that there is.
  Image<Rgb16> deep = {};

  double seconds() const { return static_cast<double>(pts) * time_base.value(); }
};

/// Two eyes' pictures of one moment, same size; `right` is empty where the film has one eye. Times as in Frame.
struct StereoFrame {
  Image<Rgb8> left;
  Image<Rgb8> right;
  std::int64_t pts = 0;
  Rational time_base{1, 1};
  std::int64_t duration = 0;
  Image<Rgb16> left_deep = {}, right_deep = {};  ///< as Frame::deep
};

/// How a film says its colours are coded, in libav's names ("bt709", "smpte170m", "bt2020nc", "gbr"; "tv", "pc");
/// empty where it does not say.
struct ColourTags {
  std::string matrix;
  std::string range;
  std::string primaries;
  std::string transfer;
  friend bool operator==(const ColourTags&, const ColourTags&) = default;
};

}  // namespace wheatstone
