#include "wheatstone/app/snapshot_series.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "wheatstone/error.h"
#include "wheatstone/video/frame_sequence.h"

namespace wheatstone {

std::optional<SnapshotSeries> find_series(const std::string& pattern, const CloudChoice& choice) {
  const std::optional<FramePattern> names = frame_pattern(pattern);
  if (!names) return std::nullopt;
  SnapshotSeries series;
  for (const std::int64_t number : numbers_without_hole(*names, 2)) {
    const std::filesystem::path file = names->file(number);
    const std::optional<double> time = open_cloud(file, choice).time;
    if (!time)
      throw Error(ErrorKind::bad_input,
                  fmt::format("{}: tells no time, expected a GADGET HDF5 snapshot, as a series has", file.string()));
    if (!series.times.empty() && !(*time > series.times.back()))
      throw Error(ErrorKind::bad_input,
                  fmt::format("{}: its time is {}, expected one after {}, that of {}", file.string(), *time,
                              series.times.back(), series.files.back().filename().string()));
    series.files.push_back(file);
    series.times.push_back(*time);
  }
  return series;
}

SeriesReader::SeriesReader(SnapshotSeries series, CloudChoice choice)
    : series_(std::move(series)), choice_(std::move(choice)) {}

TimedCloud SeriesReader::read(std::size_t number, const Progress& progress) {
  TimedCloud timed = read_timed_cloud(series_.files[number], choice_, progress);
  choice_.origin = timed.cloud.origin;
  return timed;
}

/// Makes this snapshot the earlier one.
void SeriesReader::take(std::size_t number, const Progress& progress) {
  if (taken_ == number) return;
  if (taken_ && *taken_ + 1 == number) {
    earlier_ = std::exchange(later_, {});
  } else {
    earlier_ = read(number, progress);
  }
  later_ = read(number + 1, progress);
  if (earlier_.cloud.box_size != later_.cloud.box_size)
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: its box has a side of {}, expected {}, that of {}", series_.files[number + 1].string(),
                            later_.cloud.box_size, earlier_.cloud.box_size, series_.files[number].filename().string()));
  matched_ = match_particles(earlier_.cloud, later_.cloud);
  taken_ = number;
}

Cloud SeriesReader::at(double time, const Progress& progress) {
  const auto after = std::ranges::upper_bound(series_.times, time);
  const auto number = static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - series_.times.begin() - 1, 0));
  take(std::min(number, series_.files.size() - 2), progress);
  return cloud_between(earlier_, later_, matched_, time);
}

}  // namespace wheatstone
