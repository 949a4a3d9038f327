#include "photograph_run.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <fstream>
#include <mutex>
#include <sstream>
#include <thread>
#include <utility>
#include <vector>

#include "failure.h"
#include "wheatstone/app/contact_sheet.h"
#include "wheatstone/error.h"
#include "wheatstone/files/unfinished_outputs.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/pictures/read_image.h"
#include "wheatstone/pictures/write_image.h"
#include "wheatstone/stereo/picture_sizes.h"

namespace wheatstone::cli {
namespace {

namespace fs = std::filesystem;

/// A file and what became of it, one a line.
std::string table_text(const std::vector<std::pair<std::string, std::string>>& rows) {
  std::size_t width = 0;
  for (const auto& [file, result] : rows) width = std::max(width, file.size());
  std::vector<std::string> texts;
  for (const auto& [file, result] : rows) texts.push_back(one_line(fmt::format("{:<{}}  {}", file, width, result)));
  return lines({}, texts);
}

/// A message without the name of the file, which stands before it already.
std::string without_name(const std::string& file, const std::string& message) {
  return message.starts_with(file + ": ") ? message.substr(file.size() + 2) : message;
}

Json files_of(const PhotographJob& job) {
  Json files{{"file", job.left}};
  if (!job.right.empty()) files["right"] = job.right;
  if (!job.depth.empty()) files["depth"] = job.depth;
  if (!job.why.empty()) files["why"] = job.why;
  return files;
}

/// Of all photographs whose results are there, those of earlier runs among them.
void write_contact_sheet(const PhotographWork& work, const PhotographList& list, Report& report) {
  std::vector<SheetEntry> entries;
  for (const PhotographJob& job : list.jobs)
    if (const std::optional<fs::path> result = work.shown(job))
      entries.push_back({*result, fs::path(job.output).lexically_relative(work.output).string()});
  if (entries.empty()) return;
  const std::string file = (fs::path(work.output) / "contact_sheet.png").string();
  write_image(file, contact_sheet(entries));
  report.facts.push_back({"contact_sheet", file, fmt::format("contact sheet: {}", file)});
}

/// Bytes that may be used, and that the machine has.
struct Memory {
  double free = 0, all = 0;
};

Memory memory_of_machine() {
  const auto page = static_cast<double>(::sysconf(_SC_PAGE_SIZE));
  Memory memory{static_cast<double>(::sysconf(_SC_AVPHYS_PAGES)) * page,
                static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * page};
  // What the system keeps of files counts as free.
  std::ifstream told("/proc/meminfo");
  for (std::string line; std::getline(told, line);) {
    constexpr std::string_view key = "MemAvailable:";
    if (line.starts_with(key)) memory.free = 1024 * std::strtod(line.c_str() + key.size(), nullptr);
  }
  return memory;
}

/// What working on a photograph takes, by its files' headers; none where these cannot be read, which the work tells.
double bytes_for(const PhotographJob& job, int max_size) {
  constexpr double bytes_a_pixel = 100;
  double pixels = 0;
  for (const std::string& file : {job.left, job.right}) {
    if (file.empty()) continue;
    try {
      const ImageDescription picture = describe_image(file);
      PictureSize size{picture.width, picture.height};
      if (max_size > 0) size = reduced_size(size, max_size);
      // A file that is alone makes two views, whether it holds them or not.
      pixels += (job.right.empty() ? 2. : 1.) * size.width * size.height;
    } catch (const Error&) {
      return 0;
    }
  }
  return bytes_a_pixel * pixels;
}

/// What became of a job.
struct Outcome {
  std::optional<PhotographResult> result;
  std::optional<Ranks::Failure> failure;
  std::string remarks;  ///< on standard error
  bool is_over = false;
};

/// Does the jobs of a list, several at a time.
class Workers {
 public:
  Workers(const PhotographWork& work, const std::vector<const PhotographJob*>& jobs, const Session& session)
      : work_(work), jobs_(jobs), session_(session), outcomes_(jobs.size()), memory_(memory_of_machine()) {
    const int processors = std::max(static_cast<int>(std::thread::hardware_concurrency()), 1);
    const int threads = session.threads > 0 ? session.threads : processors;
    constexpr int most_at_once = 16;
    at_once_ = std::clamp(std::min(threads, static_cast<int>(jobs.size())), 1, most_at_once);
  }

  std::vector<Outcome> run() {
    std::vector<std::thread> others;
    for (int i = 1; i < at_once_; ++i) others.emplace_back([this] { work_on(); });
    work_on();
    for (std::thread& other : others) other.join();
    if (interrupted_) std::rethrow_exception(interrupted_);
    return std::move(outcomes_);
  }

 private:
  void work_on() {
    while (!stopped_) {
      const std::size_t number = next_++;
      if (number >= jobs_.size()) return;
      const double bytes = bytes_for(*jobs_[number], work_.max_size);
      take(bytes);
      Outcome outcome = outcome_of(number, bytes);
      give_back(bytes);
      finish(number, std::move(outcome));
    }
  }

  Outcome outcome_of(std::size_t number, double bytes) {
    std::ostringstream output, errors;
    Session one{output, errors};
    one.json = session_.json;
    one.verbose = session_.verbose;
    one.quiet = session_.quiet;
    one.threads = session_.threads;
    one.seed = session_.seed;
    const std::string& name = jobs_[number]->left;
    one.progress = [this, number, &name](std::string_view step, double) {
      if (stopped_) throw Error(ErrorKind::interrupted, "interrupted");
      const std::lock_guard hold(mutex_);
      report(session_.progress,
             at_once_ == 1
                 ? fmt::format("photograph {} of {}, {}: {}", number + 1, jobs_.size(), name, step)
                 : fmt::format("photographs up to {} of {}, {} at a time", next_number(), jobs_.size(), at_once_),
             static_cast<double>(over_) / static_cast<double>(jobs_.size()));
    };
    one.clear_progress = [] {};
    Outcome outcome;
    try {
      if (bytes > memory_.all)
        throw Error(ErrorKind::bad_input,
                    fmt::format("{}: would take about {:.0f} GB of memory, but this machine has {:.0f} GB; --max-size "
                                "works on a reduced copy",
                                name, bytes / 1e9, memory_.all / 1e9));
      one.progress("reading", 0);
      outcome.result = work_.work(*jobs_[number], one);
    } catch (const Error& error) {
      if (error.kind() == ErrorKind::interrupted) stop(std::current_exception());
      outcome.failure = failure_of(std::current_exception());
    } catch (...) {
      outcome.failure = failure_of(std::current_exception());
    }
    outcome.remarks = errors.str();
    return outcome;
  }

  std::size_t next_number() const { return std::min(next_.load(), jobs_.size()); }

  void stop(const std::exception_ptr& why) {
    const std::lock_guard hold(mutex_);
    if (!stopped_.exchange(true)) interrupted_ = why;
    freed_.notify_all();
  }

  /// Waits until there is room, or nothing else is worked on.
  void take(double bytes) {
    std::unique_lock hold(mutex_);
    freed_.wait(hold, [&] { return stopped_ || working_ == 0 || taken_ + bytes <= memory_.free / 2; });
    ++working_;
    taken_ += bytes;
  }

  void give_back(double bytes) {
    const std::lock_guard hold(mutex_);
    --working_;
    taken_ -= bytes;
    freed_.notify_all();
  }

  /// Remarks are said in the order of the jobs.
  void finish(std::size_t number, Outcome outcome) {
    const std::lock_guard hold(mutex_);
    outcomes_[number] = std::move(outcome);
    outcomes_[number].is_over = true;
    ++over_;
    for (; told_ < outcomes_.size() && outcomes_[told_].is_over; ++told_) {
      if (outcomes_[told_].remarks.empty()) continue;
      if (session_.clear_progress) session_.clear_progress();
      session_.errors << outcomes_[told_].remarks << std::flush;
    }
  }

  const PhotographWork& work_;
  const std::vector<const PhotographJob*>& jobs_;
  const Session& session_;
  std::vector<Outcome> outcomes_;
  const Memory memory_;
  int at_once_ = 1;
  std::atomic<std::size_t> next_ = 0;
  std::atomic<bool> stopped_ = false;
  std::exception_ptr interrupted_;
  std::mutex mutex_;
  std::condition_variable freed_;
  int working_ = 0;
  double taken_ = 0;  ///< bytes
  std::size_t over_ = 0, told_ = 0;
};

/// What is said of all photographs: a row a file for people, and the same as JSON.
struct Told {
  Report report;
  std::vector<std::pair<std::string, std::string>> table;
  Json photographs = Json::array(), left_out = Json::array();

  void add(const PhotographJob& job, std::string row, Json facts) {
    table.emplace_back(job.left, std::move(row));
    Json files = files_of(job);
    files.update(facts);
    photographs.push_back(std::move(files));
  }

  void fail(Json files, const std::string& message, int code) {
    const auto file = files["file"].get<std::string>();
    report.exit_code = std::max(report.exit_code, code);
    report.failures.push_back(message);
    table.emplace_back(file, "failed: " + without_name(file, message));
    files.update(Json{{"error", message}, {"exit_code", code}});
    photographs.push_back(std::move(files));
  }

  void leave_out(const LeftOutFile& file) {
    const std::string name = file.file.string();
    if (file.error)
      return fail({{"file", name}}, fmt::format("{}: {}", name, file.reason), static_cast<int>(*file.error));
    table.emplace_back(name, "left out: " + file.reason);
    left_out.push_back({{"file", name}, {"reason", file.reason}});
  }
};

}  // namespace

Report work_on_all(const PhotographWork& work, const PhotographList& list, const Session& session) {
  const bool is_dry = work.folder.dry_run;
  std::optional<MissingFolders> made;
  if (!is_dry) made.emplace(work.output);
  if (fs::exists(work.output) && !fs::is_directory(work.output))
    throw Error(ErrorKind::cannot_read_write, fmt::format("{}: is a file, expected a folder", work.output));
  std::vector<bool> skipped;
  std::vector<const PhotographJob*> wanted;
  for (const PhotographJob& job : list.jobs) {
    skipped.push_back(work.folder.skip_existing && work.is_done(job));
    if (!skipped.back()) wanted.push_back(&job);
  }
  std::vector<Outcome> outcomes;
  if (!is_dry && !wanted.empty()) outcomes = Workers(work, wanted, session).run();

  Told told;
  std::size_t number = 0, done = 0;
  for (std::size_t i = 0; i < list.jobs.size(); ++i) {
    const PhotographJob& job = list.jobs[i];
    const std::string why = job.why.empty() ? "" : fmt::format(" ({})", job.why);
    if (skipped[i]) {
      told.add(job, fmt::format("{} before: {}", work.done, job.output), {{"output", job.output}, {"skipped", true}});
    } else if (is_dry) {
      told.add(job, fmt::format("would be written to {}{}", job.output, why), {{"output", job.output}});
    } else if (const Outcome& outcome = outcomes[number++]; outcome.failure) {
      told.fail(files_of(job), outcome.failure->message, outcome.failure->exit_code);
    } else {
      ++done;
      told.add(job, fmt::format("written to {}{}", outcome.result->written, why),
               {{"output", outcome.result->written}, {"report", json_of(outcome.result->report)}});
    }
  }
  for (const LeftOutFile& file : list.left_out) told.leave_out(file);
  Report& report = told.report;
  if (list.jobs.empty() && report.failures.empty() && work.folder.part.of == 1) {
    report.exit_code = static_cast<int>(ErrorKind::bad_input);
    report.failures.push_back(fmt::format("{}: holds pictures, but no stereo photograph", work.input));
  }
  std::string summary = is_dry ? fmt::format("{} photographs, none {} (--dry-run)", wanted.size(), work.done)
                               : fmt::format("{} of {} photographs {}", done, wanted.size(), work.done);
  const std::size_t left = list.jobs.size() - wanted.size();
  if (left > 0) summary += fmt::format(", {} {} before", left, work.done);
  if (!told.left_out.empty()) summary += fmt::format(", {} files left out", told.left_out.size());
  report.facts = {{std::string(work.done), done},
                  {"failed", report.failures.size()},
                  {"photographs", told.photographs, table_text(told.table)}};
  if (!work.input.empty()) {
    report.facts.push_back({"skipped", left});
    report.facts.push_back({"left_out", told.left_out});
  }
  if (work.folder.contact_sheet && !is_dry) write_contact_sheet(work, list, report);
  report.facts.push_back(only_text(summary));
  return report;
}

Report work_on_pairs(const StereoArguments& photographs, const FolderArguments& folder, const std::string& output,
                     std::string_view done, const PairWork& work, const Session& session) {
  const PhotographWork all{
      .input = photographs.left,
      .output = output,
      .folder = folder,
      .done = done,
      .max_size = photographs.max_size,
      .work = [&](const PhotographJob& job,
                  const Session& of_one) { return work(photograph_of(photographs, job), job.output, of_one); },
      .is_done = [](const PhotographJob& job) { return is_folder(job.output); }};
  const FolderOutput results{.folder = output, .ending = {}, .placeholders = {}};
  return work_on_all(all, pairs_in_folder(photographs.left, photographs, folder, results, session), session);
}

}  // namespace wheatstone::cli
