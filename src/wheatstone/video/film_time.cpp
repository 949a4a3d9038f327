#include "wheatstone/video/film_time.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdint>

namespace wheatstone {

std::optional<double> film_time_from(std::string_view text) {
  double seconds = 0;
  for (int parts = 1;; ++parts) {
    const std::size_t colon = text.find(':');
    const std::string_view part = text.substr(0, colon);
    const bool last = colon == std::string_view::npos;
    double value = 0;
    const auto read = std::from_chars(part.data(), part.data() + part.size(), value);
    if (read.ec != std::errc() || read.ptr != part.data() + part.size() || parts > 3) return std::nullopt;
    // Below the first, minutes and seconds end at 60; only the last has a fraction.
    if (!(value >= 0) || value > 1e9 || (parts > 1 && value >= 60)) return std::nullopt;
    if (!last && value != std::floor(value)) return std::nullopt;
    seconds = 60 * seconds + value;
    if (last) return seconds;
    text.remove_prefix(colon + 1);
  }
}

std::string film_time_text(double seconds) {
  const auto ms = static_cast<std::int64_t>(std::llround(seconds * 1000));
  const std::int64_t s = ms / 1000, minutes = s / 60, hours = minutes / 60;
  if (hours > 0) return fmt::format("{}:{:02}:{:02}.{:03}", hours, minutes % 60, s % 60, ms % 1000);
  return fmt::format("{}:{:02}.{:03}", minutes, s % 60, ms % 1000);
}

}  // namespace wheatstone
