#include "wheatstone/files/unfinished_outputs.h"

#include <fmt/format.h>
#include <pthread.h>

#include <algorithm>
#include <new>
#include <set>
#include <system_error>
#include <utility>

#include "wheatstone/error.h"

namespace wheatstone {
namespace {

namespace fs = std::filesystem;

struct Outputs {
  std::recursive_mutex mutex;
  // Several may have one name: of a folder that several parts of a program go on with.
  std::multiset<fs::path> unfinished;
  std::multiset<fs::path> kept;
  std::multiset<fs::path> made_folders;  ///< above what is unfinished; those within others come later
  bool some_finished = false;

  std::multiset<fs::path>& those(bool are_kept) { return are_kept ? kept : unfinished; }
  void leave_out(const fs::path& path, bool is_kept) { those(is_kept).extract(path); }
};

// Never destroyed: a thread that ends the program may come after the end of main.
Outputs& outputs() {
  static auto* const all = [] {
    // A child that is forked has none of its parent's outputs, nor the thread that may hold the mutex.
    ::pthread_atfork(nullptr, nullptr, [] { new (&outputs()) Outputs; });
    return new Outputs;
  }();
  return *all;
}

/// Empty: wanted.
thread_local std::function<bool()> are_wanted;

/// Removes folders that hold nothing, those within others first.
template <class Folders>
void remove_empty(const Folders& folders) {
  std::error_code ignored;
  for (auto folder = folders.rbegin(); folder != folders.rend(); ++folder) fs::remove(*folder, ignored);
}

/// Makes the folders that lead to this one, and tells which they were, from the outermost on.
std::vector<fs::path> make_missing_folders(const fs::path& folder) {
  std::vector<fs::path> missing;
  std::error_code error;
  for (fs::path at = folder; !at.empty() && !fs::exists(at, error); at = at.parent_path()) missing.push_back(at);
  std::ranges::reverse(missing);
  std::vector<fs::path> made;
  for (const fs::path& path : missing) {
    if (fs::create_directory(path, error)) made.push_back(path);
    if (!error) continue;
    remove_empty(made);
    throw Error(ErrorKind::cannot_read_write,
                fmt::format("{}: the folder cannot be made: {}", path.string(), error.message()));
  }
  return made;
}

}  // namespace

MissingFolders::MissingFolders(const fs::path& folder) {
  const auto hold = hold_outputs();
  made_ = make_missing_folders(folder);
  outputs().made_folders.insert(made_.begin(), made_.end());
}

MissingFolders::~MissingFolders() {
  const auto hold = hold_outputs();
  remove_empty(made_);
  for (const fs::path& folder : made_) outputs().made_folders.extract(folder);
}

OutputsOnlyWhile::OutputsOnlyWhile(std::function<bool()> wanted) { are_wanted = std::move(wanted); }
OutputsOnlyWhile::~OutputsOnlyWhile() { are_wanted = nullptr; }

UnfinishedOutput::~UnfinishedOutput() {
  if (temporary_.empty()) return;
  // Not under the lock: a large folder takes its time, and may be removed by two threads at once.
  std::error_code ignored;
  if (!kept_) fs::remove_all(temporary_, ignored);
  const auto hold = hold_outputs();
  above_.reset();
  outputs().leave_out(temporary_, kept_);
}

void UnfinishedOutput::begin(fs::path temporary, const std::function<void()>& make) {
  const auto hold = hold_outputs();
  auto above = std::make_unique<MissingFolders>(temporary.parent_path());
  make();
  temporary_ = std::move(temporary);
  above_ = std::move(above);
  kept_ = false;
  outputs().unfinished.insert(temporary_);
}

void UnfinishedOutput::keep(bool kept) {
  if (temporary_.empty()) return;
  const auto hold = hold_outputs();
  outputs().leave_out(temporary_, kept_);
  kept_ = kept;
  outputs().those(kept_).insert(temporary_);
}

void UnfinishedOutput::finish(const std::function<void()>& rename) {
  if (temporary_.empty()) return;
  const auto hold = hold_outputs();
  if (are_wanted && !are_wanted())
    throw Error(ErrorKind::interrupted,
                fmt::format("{}: is not finished, its call was cancelled", temporary_.string()));
  rename();
  outputs().leave_out(temporary_, kept_);
  temporary_.clear();
  above_.reset();
  // What is written inside an unfinished folder is no result yet.
  if (outputs().unfinished.empty() && outputs().kept.empty()) outputs().some_finished = true;
}

std::unique_lock<std::recursive_mutex> hold_outputs() { return std::unique_lock(outputs().mutex); }

bool outputs_are_finished() {
  const auto hold = hold_outputs();
  return outputs().some_finished && outputs().unfinished.empty() && outputs().kept.empty();
}

void remove_unfinished_outputs() {
  const auto hold = hold_outputs();
  // Another thread may still be writing into a folder while it is removed.
  constexpr int most_tries = 100;
  for (const fs::path& path : outputs().unfinished) {
    std::error_code error;
    for (int tries = 0; tries < most_tries && fs::symlink_status(path, error).type() != fs::file_type::not_found;
         ++tries)
      fs::remove_all(path, error);
  }
  remove_empty(outputs().made_folders);
}

}  // namespace wheatstone
