#include "wheatstone/app/output_folder.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cctype>
#include <optional>
#include <set>
#include <string>
#include <system_error>
#include <utility>

#include "wheatstone/error.h"
#include "wheatstone/files/output_paths.h"

namespace wheatstone {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse_folder(const fs::path& folder, std::string_view reason) {
  throw Error(ErrorKind::cannot_read_write, fmt::format("{}: cannot be written: {}", folder.string(), reason));
}

/// The temporary folder of results. It lies in a folder that exists, so that its files need only be renamed: the folder
/// above may be on another file system, or not writable.
fs::path growing_folder(const fs::path& final_folder) {
  static std::atomic<unsigned> count = 0;
  std::error_code error;
  const fs::path place = fs::is_directory(final_folder, error) ? final_folder : final_folder.parent_path();
  return place / fmt::format(".{}.{}-{}.partial", final_folder.filename().string(), ::getpid(), count++);
}

/// A name such as view_007.png, taken apart at the first number of three digits or more.
struct NumberedName {
  std::string before, number, behind;
};

std::optional<NumberedName> numbered(const std::string& name) {
  constexpr std::ptrdiff_t least_digits = 3;
  const auto is_digit = [](unsigned char c) { return std::isdigit(c) != 0; };
  auto first = std::find_if(name.begin(), name.end(), is_digit);
  while (first != name.end()) {
    const auto last = std::find_if_not(first, name.end(), is_digit);
    if (last - first >= least_digits) return NumberedName{{name.begin(), first}, {first, last}, {last, name.end()}};
    first = std::find_if(last, name.end(), is_digit);
  }
  return std::nullopt;
}

/// True if both names belong to one numbered series. 1000 may follow 999; 20261122 does not continue a series from 000.
bool same_series(const NumberedName& one, const NumberedName& other) {
  const auto follows = [](const std::string& number, const std::string& longer) {
    return longer.size() == number.size() + 1 && longer.front() == '1';
  };
  return one.before == other.before && one.behind == other.behind &&
         (one.number.size() == other.number.size() || follows(one.number, other.number) ||
          follows(other.number, one.number));
}

std::set<std::string> files_in(const fs::path& folder) {
  std::set<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    std::error_code ignored;
    if (!entry.is_directory(ignored)) names.insert(entry.path().filename().string());
  }
  return names;
}

/// The files in a folder and below it, by their places in it.
std::set<std::string> files_below(const fs::path& folder) {
  std::set<std::string> names;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
    if (!entry.is_directory()) names.insert(entry.path().lexically_relative(folder).string());
  return names;
}

/// The files that an earlier run has left of the series that are written now.
std::vector<std::string> left_of_series(const std::set<std::string>& present, const std::set<std::string>& written) {
  std::vector<NumberedName> series;
  for (const std::string& name : written) {
    const std::optional<NumberedName> parts = numbered(name);
    if (parts && std::ranges::none_of(series, [&](const NumberedName& known) { return same_series(known, *parts); }))
      series.push_back(*parts);
  }
  std::vector<std::string> left;
  for (const std::string& name : present) {
    const std::optional<NumberedName> parts = numbered(name);
    if (parts && !written.contains(name) &&
        std::ranges::any_of(series, [&](const NumberedName& known) { return same_series(known, *parts); }))
      left.push_back(name);
  }
  return left;
}

}  // namespace

OutputFolder::OutputFolder(const fs::path& folder, std::vector<fs::path> inputs) : inputs_(std::move(inputs)) {
  if (folder.empty()) throw Error(ErrorKind::wrong_usage, "the name of the output folder is empty");
  std::error_code error;
  final_ = fs::absolute(folder).lexically_normal();
  if (!final_.has_filename()) final_ = final_.parent_path();
  if (fs::is_symlink(fs::symlink_status(final_, error)) || fs::exists(final_, error)) final_ = followed(final_);
  if (fs::exists(final_, error) && !fs::is_directory(final_, error)) {
    check_not_an_input(folder, inputs_);
    refuse_folder(folder, "is a file, expected a folder");
  }
  temporary_ = growing_folder(final_);
  unfinished_.begin(temporary_, [&] {
    const bool made = fs::create_directory(temporary_, error);
    if (error) refuse_folder(folder, error.message());
    if (!made) refuse_folder(folder, fmt::format("{} is in the way", temporary_.string()));
  });
}

fs::path OutputFolder::file(std::string_view name) const {
  check_not_an_input(final_ / name, inputs_);
  return temporary_ / name;
}

void OutputFolder::commit() {
  unfinished_.finish([this] {
    std::error_code error;
    if (fs::exists(final_, error)) return move_into_existing();
    fs::rename(temporary_, final_, error);
    if (error) refuse_folder(final_, error.message());
  });
}

void OutputFolder::move_into_existing() const {
  std::error_code error;
  const std::set<std::string> written = files_below(temporary_);
  const std::vector<std::string> old = left_of_series(files_in(final_), written);
  for (const std::string& name : old) check_not_an_input(final_ / name, inputs_);
  for (const std::string& name : written)
    if (fs::is_directory(final_ / name, error)) refuse_folder(final_ / name, "is a folder, expected a file");
  for (const std::string& name : written) {
    fs::create_directories((final_ / name).parent_path(), error);
    fs::rename(temporary_ / name, final_ / name, error);
    if (error) refuse_folder(final_ / name, error.message());
  }
  for (const std::string& name : old) {
    fs::remove(final_ / name, error);
    if (error) refuse_folder(final_ / name, error.message());
  }
  fs::remove_all(temporary_, error);
}

}  // namespace wheatstone
