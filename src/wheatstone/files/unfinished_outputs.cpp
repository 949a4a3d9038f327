#include "wheatstone/files/unfinished_outputs.h"

#include <fmt/format.h>

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
  bool some_finished = false;

  std::multiset<fs::path>& those(bool are_kept) { return are_kept ? kept : unfinished; }
  void leave_out(const fs::path& path, bool is_kept) { those(is_kept).extract(path); }
};

// Never destroyed: a thread that ends the program may come after the end of main.
Outputs& outputs() {
  static auto* const all = new Outputs;
  return *all;
}

/// Empty: wanted.
thread_local std::function<bool()> are_wanted;

}  // namespace

OutputsOnlyWhile::OutputsOnlyWhile(std::function<bool()> wanted) { are_wanted = std::move(wanted); }
OutputsOnlyWhile::~OutputsOnlyWhile() { are_wanted = nullptr; }

UnfinishedOutput::~UnfinishedOutput() {
  if (temporary_.empty()) return;
  // Not under the lock: a large folder takes its time, and may be removed by two threads at once.
  std::error_code ignored;
  if (!kept_) fs::remove_all(temporary_, ignored);
  const auto hold = hold_outputs();
  outputs().leave_out(temporary_, kept_);
}

void UnfinishedOutput::begin(fs::path temporary, const std::function<void()>& make) {
  const auto hold = hold_outputs();
  make();
  temporary_ = std::move(temporary);
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
}

}  // namespace wheatstone
