#include "time_argument.h"

#include <fmt/format.h>

#include <charconv>
#include <string_view>

#include "wheatstone/error.h"

namespace wheatstone::cli {

std::optional<double> time_option(const std::string& option, const std::string& text) {
  if (text.empty()) return {};
  const auto fail = [&] {
    return Error(ErrorKind::wrong_usage,
                 fmt::format("{}: is '{}', expected seconds or [HH:]MM:SS, as 12.5 or 1:02:03", option, text));
  };
  double seconds = 0;
  int parts = 0;
  for (std::string_view rest = text;; ++parts) {
    const std::size_t colon = rest.find(':');
    const std::string_view part = rest.substr(0, colon);
    double value = 0;
    const auto [stop, error] = std::from_chars(part.data(), part.data() + part.size(), value);
    const bool last = colon == std::string_view::npos;
    // Below the first, minutes and seconds end at 60.
    if (error != std::errc{} || stop != part.data() + part.size() || !(value >= 0 && value < 1e9) ||
        (parts > 0 && value >= 60) || (!last && value != static_cast<double>(static_cast<long long>(value))) ||
        parts > 2)
      throw fail();
    seconds = 60 * seconds + value;
    if (last) return seconds;
    rest.remove_prefix(colon + 1);
  }
}

}  // namespace wheatstone::cli
