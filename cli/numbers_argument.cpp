#include "numbers_argument.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "wheatstone/error.h"

namespace wheatstone::cli {

std::vector<float> parse_numbers(const std::string& option, const std::string& text, char between, std::size_t count) {
  std::vector<float> numbers;
  const char* at = text.data();
  const char* const end = text.data() + text.size();
  while (numbers.size() < count) {
    float number = 0;
    const auto [stop, error] = std::from_chars(at, end, number);
    const bool last = numbers.size() + 1 == count;
    if (error != std::errc{} || !std::isfinite(number) || (last ? stop != end : stop == end || *stop != between))
      throw Error(ErrorKind::wrong_usage,
                  fmt::format("{}: is '{}', expected {} numbers with '{}' between them", option, text, count, between));
    numbers.push_back(number);
    at = stop + 1;
  }
  return numbers;
}

}  // namespace wheatstone::cli
