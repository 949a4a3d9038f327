#include "wheatstone/app/output_folder.h"

#include <fmt/format.h>
#include <unistd.h>

#include <system_error>

#include "wheatstone/error.h"

namespace wheatstone {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& folder, std::string_view reason) {
  throw Error(ErrorKind::cannot_read_write, fmt::format("{}: cannot be written: {}", folder.string(), reason));
}

}  // namespace

OutputFolder::OutputFolder(fs::path folder) : final_(fs::absolute(folder).lexically_normal()) {
  if (!final_.has_filename()) final_ = final_.parent_path();
  std::error_code error;
  if (fs::exists(final_, error) && !fs::is_directory(final_, error)) refuse(folder, "is a file, expected a folder");
  if (!fs::is_directory(final_.parent_path(), error))
    refuse(folder, fmt::format("there is no folder {}", final_.parent_path().string()));
  temporary_ = final_.parent_path() / fmt::format(".{}.partial-{}", final_.filename().string(), getpid());
  fs::create_directory(temporary_, error);
  if (error) refuse(folder, error.message());
}

OutputFolder::~OutputFolder() {
  std::error_code ignored;
  if (!temporary_.empty()) fs::remove_all(temporary_, ignored);
}

void OutputFolder::commit() {
  std::error_code error;
  if (!fs::exists(final_, error)) {
    fs::rename(temporary_, final_, error);
    if (error) refuse(final_, error.message());
    temporary_.clear();
    return;
  }
  for (const fs::directory_entry& entry : fs::directory_iterator(temporary_)) {
    fs::rename(entry.path(), final_ / entry.path().filename(), error);
    if (error) refuse(final_ / entry.path().filename(), error.message());
  }
}

}  // namespace wheatstone
