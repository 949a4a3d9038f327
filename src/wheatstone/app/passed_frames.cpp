#include <fmt/format.h>

#include <cstring>
#include <limits>
#include <span>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <utility>
#include <vector>

#include "wheatstone/app/passed_frames_internal.h"
#include "wheatstone/files/whole_file.h"

namespace wheatstone {
namespace {

namespace fs = std::filesystem;

/// What stands before the pixels and the note.
struct Head {
  int width, height;
  std::int64_t pts;
  Rational time_base;
  std::int64_t duration;
  RotoscopeTotals totals;
};
static_assert(std::is_trivially_copyable_v<Head>);

// A run that goes on with the film would remove files whose names begin with a dot.
constexpr auto frame_name = ".frame_";
constexpr auto state_name = ".state_";

}  // namespace

PassedFrames::PassedFrames(fs::path work_folder, bool held_here) : folder_(std::move(work_folder)) {
  if (held_here) return;
  of_another_.begin(folder_, [] {});
  of_another_.keep(true);
}

fs::path PassedFrames::frame_file(std::int64_t number) const {
  return folder_ / fmt::format("{}{:09}", frame_name, number);
}
fs::path PassedFrames::state_file(std::int64_t number) const {
  return folder_ / fmt::format("{}{:09}", state_name, number);
}

void PassedFrames::put(std::int64_t number, const PassedFrame& passed) const {
  const Frame& frame = passed.frame;
  const Head head{frame.picture.width(), frame.picture.height(), frame.pts,
                  frame.time_base,       frame.duration,         passed.totals};
  std::string bytes;
  const auto append = [&bytes](const void* from, std::size_t size) {
    bytes.append(static_cast<const char*>(from), size);
  };
  bytes.reserve(sizeof(head) + frame.picture.pixels().size_bytes() + passed.rows_note.size());
  append(&head, sizeof(head));
  append(frame.picture.pixels().data(), frame.picture.pixels().size_bytes());
  append(passed.rows_note.data(), passed.rows_note.size());
  write_whole_file(frame_file(number), bytes);
}

std::optional<PassedFrame> PassedFrames::take(std::int64_t number) const {
  const fs::path file = frame_file(number);
  std::error_code error;
  if (!fs::exists(file, error)) return std::nullopt;
  const std::string bytes = read_whole_file(file, std::numeric_limits<std::size_t>::max());
  std::string_view rest = bytes;
  const auto take_bytes = [&rest](void* to, std::size_t size) {
    std::memcpy(to, rest.data(), size);
    rest.remove_prefix(size);
  };
  Head head;
  take_bytes(&head, sizeof(head));
  PassedFrame passed{{{}, head.pts, head.time_base, head.duration}, head.totals, {}};
  if (head.width > 0) {
    passed.frame.picture = Image<Rgb8>(head.width, head.height);
    take_bytes(passed.frame.picture.pixels().data(), passed.frame.picture.pixels().size_bytes());
  }
  passed.rows_note = rest;
  fs::remove(file, error);
  return passed;
}

void remove_passed_frames(const fs::path& work_folder) {
  std::error_code error;
  std::vector<fs::path> passed;
  for (const fs::directory_entry& entry : fs::directory_iterator(work_folder, error)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(frame_name) || name.starts_with(state_name)) passed.push_back(entry.path());
  }
  for (const fs::path& file : passed) fs::remove(file, error);
}

}  // namespace wheatstone
