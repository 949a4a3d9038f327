#include <fmt/format.h>

#include <limits>
#include <system_error>
#include <utility>
#include <vector>

#include "wheatstone/app/passed_frames_internal.h"
#include "wheatstone/files/field_bytes.h"
#include "wheatstone/files/whole_file.h"

namespace wheatstone {
namespace {

namespace fs = std::filesystem;

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
  FieldWriter writer;
  writer(passed);
  write_whole_file(frame_file(number), writer.bytes);
}

std::optional<PassedFrame> PassedFrames::take(std::int64_t number) const {
  const fs::path file = frame_file(number);
  std::error_code error;
  if (!fs::exists(file, error)) return std::nullopt;
  const std::string bytes = read_whole_file(file, std::numeric_limits<std::size_t>::max());
  FieldReader reader(bytes, fmt::format("{}: is damaged", file.string()));
  PassedFrame passed;
  reader(passed);
  reader.expect_end();
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
