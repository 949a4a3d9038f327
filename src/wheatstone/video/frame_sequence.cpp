#include "wheatstone/video/frame_sequence.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string_view>
#include <system_error>

#include "wheatstone/error.h"

namespace wheatstone {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse_pattern(const fs::path& path, std::string_view why) {
  throw Error(ErrorKind::wrong_usage,
              fmt::format("{}: {}, expected one number in the file's name, like frame_%04d.png", path.string(), why));
}

/// Reads "%d", "%4d" or "%04d" from the beginning of `text`; returns its length, 0 where it is none.
std::size_t read_number_place(std::string_view text, int& digits) {
  std::size_t at = 1;
  digits = 0;
  while (at < text.size() && text[at] >= '0' && text[at] <= '9' && digits < 100)
    digits = digits * 10 + (text[at++] - '0');
  digits = std::max(1, digits);
  return at < text.size() && text[at] == 'd' && digits <= 18 ? at + 1 : 0;
}

}  // namespace

fs::path FramePattern::file(std::int64_t number) const {
  return folder / fmt::format("{}{:0{}}{}", before, number, least_digits, after);
}

std::optional<std::int64_t> FramePattern::number_of(const std::string& file_name) const {
  if (file_name.size() < before.size() + after.size() || !file_name.starts_with(before) ||
      !file_name.ends_with(after)) {
    return {};
  }
  const char* begin = file_name.data() + before.size();
  const char* end = file_name.data() + file_name.size() - after.size();
  std::int64_t number = 0;
  const auto [stop, error] = std::from_chars(begin, end, number);
  if (begin == end || *begin == '-' || stop != end || error != std::errc()) return {};
  // Only the name that the pattern itself would give: 7 is not 0007.
  if (fmt::format("{:0{}}", number, least_digits) != std::string(begin, end)) return {};
  return number;
}

std::optional<FramePattern> frame_pattern(const fs::path& path) {
  const std::string name = path.filename().string();
  std::error_code ignored;
  if (name.find('%') == std::string::npos || fs::exists(path, ignored)) return {};
  FramePattern pattern{.folder = path.parent_path()};
  bool found = false;
  for (std::size_t at = 0; at < name.size();) {
    std::string& part = found ? pattern.after : pattern.before;
    if (name[at] != '%') {
      part += name[at++];
    } else if (name.compare(at, 2, "%%") == 0) {
      part += '%';
      at += 2;
    } else {
      if (found) refuse_pattern(path, "contains a second number pattern");
      const std::size_t length = read_number_place(std::string_view(name).substr(at), pattern.least_digits);
      if (length == 0) refuse_pattern(path, "contains a percent sign without a number pattern");
      found = true;
      at += length;
    }
  }
  if (!found) return {};
  return pattern;
}

std::vector<std::int64_t> numbers_of(const FramePattern& pattern) {
  std::vector<std::int64_t> numbers;
  std::error_code error;
  const fs::path folder = pattern.folder.empty() ? fs::path(".") : pattern.folder;
  for (auto entry = fs::directory_iterator(folder, error); !error && entry != fs::directory_iterator();
       entry.increment(error)) {
    if (const auto number = pattern.number_of(entry->path().filename().string())) numbers.push_back(*number);
  }
  std::ranges::sort(numbers);
  return numbers;
}

std::vector<std::int64_t> numbers_without_hole(const FramePattern& pattern, std::size_t least) {
  std::vector<std::int64_t> numbers = numbers_of(pattern);
  const auto refuse = [&](const std::string& what) {
    const std::string name =
        fmt::format("{}%{}d{}", pattern.before,
                    pattern.least_digits > 1 ? fmt::format("0{}", pattern.least_digits) : "", pattern.after);
    throw Error(ErrorKind::bad_input, fmt::format("{}: {}", (pattern.folder / name).string(), what));
  };
  if (numbers.size() < least)
    refuse(fmt::format("{} files have such names, expected at least {}", numbers.size(), least));
  const auto hole = std::ranges::adjacent_find(numbers, [](std::int64_t a, std::int64_t b) { return b != a + 1; });
  if (hole != numbers.end())
    refuse(fmt::format("{} is missing, the next there is {}", pattern.file(*hole + 1).filename().string(),
                       pattern.file(*(hole + 1)).filename().string()));
  return numbers;
}

}  // namespace wheatstone
