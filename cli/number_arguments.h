#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "wheatstone/image/image.h"
#include "wheatstone/number_range.h"
#include "wheatstone/particles/condition.h"
#include "wheatstone/video/frame.h"

namespace wheatstone::cli {

// The one place where numbers are read from the command line. Nothing but decimal numbers is taken: NaN, infinity and
// trailing text are refused everywhere. Each function throws Error{wrong_usage} that names the option, what was typed
// and what was expected.

double parse_number(const std::string& option, std::string_view text, NumberRange range);
long long parse_integer(const std::string& option, std::string_view text, NumberRange range);

/// "640x360" as two numbers, "1,2,3" as three: exactly `count`, with `between` between them. `expected` is how the
/// option is written, as "WIDTHxHEIGHT"; messages have it.
struct NumberList {
  char between;
  std::size_t count;
  NumberRange range;
  std::string_view expected;
};
std::vector<double> parse_numbers(const std::string& option, std::string_view text, const NumberList& list);
/// The same for whole numbers.
std::vector<int> parse_integers(const std::string& option, std::string_view text, const NumberList& list);

/// A length in millimetres: "30", "30mm", "3cm", "0.03m", "1.2in". The range is in millimetres.
double parse_length_mm(const std::string& option, std::string_view text, NumberRange range_mm);

/// A share of something: "3%" or "0.03". The range is in percent.
float parse_share(const std::string& option, std::string_view text, NumberRange percent);

/// The size of a file: "8MB", "500kB" or a number of bytes, of at least one kilobyte.
std::size_t parse_bytes(const std::string& option, std::string_view text);

/// COLUMNSxROWS or WIDTHxHEIGHT: two whole numbers.
PictureSize parse_size(const std::string& option, std::string_view text, NumberRange side,
                       std::string_view expected = "WIDTHxHEIGHT");

/// One of several parts of some work, which machines share.
struct Part {
  int number = 1, of = 1;
};

/// "3/16": the third of 16 parts.
Part parse_part(const std::string& option, const std::string& words);

/// A moment of a film in seconds, as ffmpeg takes it: "12.5", "1:02", "1:02:03.5"; nothing where the text is empty.
std::optional<double> parse_time_s(const std::string& option, std::string_view text);

/// Frames per second: "24", "23.976" or "24000/1001".
Rational parse_frame_rate(const std::string& option, std::string_view text);

/// A condition that particles are chosen by: "Temperature > 1e6 and Density < 1e-3".
Condition parse_where(const std::string& option, const std::string& words);

/// "3366FF", or with a '#' before it.
Rgb8 parse_colour(const std::string& option, std::string_view text);

}  // namespace wheatstone::cli
