#include "paint_several.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <utility>

#include "wheatstone/app/contact_sheet.h"
#include "wheatstone/error.h"
#include "wheatstone/files/unfinished_outputs.h"
#include "wheatstone/pictures/write_image.h"

namespace wheatstone::cli {
namespace {

namespace fs = std::filesystem;

/// Results within the folder would be found as photographs by the next run.
void refuse_output_within(const std::string& folder, const std::string& output) {
  const fs::path way = fs::weakly_canonical(output).lexically_relative(fs::canonical(folder));
  if (!way.empty() && *way.begin() != "..")
    throw Error(
        ErrorKind::wrong_usage,
        fmt::format("{}: lies in {}, whose photographs are painted; expected an output (-o) outside", output, folder));
}

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

/// A job's progress as a part of all: the photograph and its number.
Session session_for(const Session& session, const PaintJob& job, std::size_t number, std::size_t count) {
  Session one = session;
  const std::string name = fmt::format("photograph {} of {}, {}", number, count, job.left);
  const double done = static_cast<double>(number - 1) / static_cast<double>(count);
  one.progress = [&session, name, done](std::string_view step, double /*of_step*/) {
    report(session.progress, fmt::format("{}: {}", name, step), done);
  };
  return one;
}

Json files_of(const PaintJob& job) {
  Json files{{"file", job.left}};
  if (!job.right.empty()) files["right"] = job.right;
  if (!job.depth.empty()) files["depth"] = job.depth;
  if (!job.why.empty()) files["why"] = job.why;
  return files;
}

/// The painted picture of a job, of the left eye where there are two; none where it was not painted.
std::optional<fs::path> result_of(const PaintJob& job, const std::string& format) {
  for (const char* name : {"left", "painted"}) {
    const fs::path file = fs::path(job.output) / fmt::format("{}.{}", name, format);
    if (fs::exists(file)) return file;
  }
  return {};
}

/// Of all photographs whose results are there, those that were painted before among them.
void write_contact_sheet(const PaintArguments& arguments, const PaintList& list, Report& report) {
  std::vector<SheetEntry> entries;
  for (const PaintJob& job : list.jobs)
    if (const std::optional<fs::path> result = result_of(job, arguments.results.format))
      entries.push_back({*result, fs::path(job.output).lexically_relative(arguments.folder).string()});
  if (entries.empty()) return;
  const std::string file = (fs::path(arguments.folder) / "contact_sheet.png").string();
  write_image(file, contact_sheet(entries));
  report.facts.push_back({"contact_sheet", file, fmt::format("contact sheet: {}", file)});
}

bool is_painted_already(const PaintJob& job) { return fs::exists(fs::path(job.output) / "report.json"); }

}  // namespace

PaintList photographs_in_folder(const PaintArguments& arguments, const Session& session) {
  const std::string& folder = arguments.files.front();
  refuse_output_within(folder, arguments.folder);
  FindPhotographsOptions options;
  if (!arguments.photographs.layout.empty()) options.views = options_for_layout(arguments.photographs.layout);
  options.views.swap = arguments.photographs.swap;
  if (!arguments.pairs.empty()) options.pairs = read_pair_table(arguments.pairs);
  PhotographFolder found = find_photographs(folder, options, session.progress);
  PaintList list{{}, std::move(found.left_out)};
  int number = 0;
  for (const FoundPhotograph& photograph : found.photographs) {
    if (number++ % arguments.part.of != arguments.part.number - 1) continue;
    const std::string output = (fs::path(arguments.folder) / photograph.stem).string();
    refuse_output_within(folder, output);
    list.jobs.push_back(
        {photograph.left.string(), photograph.right.string(), output, photograph.depth.string(), photograph.why});
  }
  return list;
}

Report paint_all(const PaintArguments& arguments, const PaintList& list, const PaintOne& paint,
                 const Session& session) {
  std::optional<MissingFolders> made;
  if (!arguments.dry_run) made.emplace(arguments.folder);
  if (fs::exists(arguments.folder) && !fs::is_directory(arguments.folder))
    throw Error(ErrorKind::cannot_read_write, fmt::format("{}: is a file, expected a folder", arguments.folder));
  const auto is_skipped = [&](const PaintJob& job) { return arguments.skip_existing && is_painted_already(job); };
  const auto skipped = static_cast<std::size_t>(std::ranges::count_if(list.jobs, is_skipped));
  const std::size_t wanted = list.jobs.size() - skipped;

  Report report;
  std::vector<std::pair<std::string, std::string>> table;
  Json photographs = Json::array(), left_out = Json::array();
  const auto fail = [&](Json files, const std::string& message, ErrorKind kind) {
    const int code = static_cast<int>(kind);
    const auto file = files["file"].get<std::string>();
    report.exit_code = std::max(report.exit_code, code);
    report.failures.push_back(message);
    table.emplace_back(file, "failed: " + without_name(file, message));
    files.update(Json{{"error", message}, {"exit_code", code}});
    photographs.push_back(std::move(files));
  };
  std::size_t number = 0, painted = 0;
  for (const PaintJob& job : list.jobs) {
    Json files = files_of(job);
    const std::string why = job.why.empty() ? "" : fmt::format(" ({})", job.why);
    if (is_skipped(job)) {
      table.emplace_back(job.left, fmt::format("painted before: {}", job.output));
      files.update(Json{{"output", job.output}, {"skipped", true}});
    } else if (arguments.dry_run) {
      table.emplace_back(job.left, fmt::format("would be written to {}{}", job.output, why));
      files.update(Json{{"output", job.output}});
    } else {
      try {
        const Painted result = paint(job, session_for(session, job, ++number, wanted));
        ++painted;
        table.emplace_back(job.left, fmt::format("written to {}{}", result.written, why));
        files.update(Json{{"output", result.written}, {"report", json_of(result.report)}});
      } catch (const Error& failure) {
        if (failure.kind() == ErrorKind::interrupted) throw;
        fail(std::move(files), failure.what(), failure.kind());
        continue;
      }
    }
    photographs.push_back(std::move(files));
  }
  for (const LeftOutFile& file : list.left_out) {
    const std::string name = file.file.string();
    if (file.error) {
      fail({{"file", name}}, fmt::format("{}: {}", name, file.reason), *file.error);
    } else {
      table.emplace_back(name, "left out: " + file.reason);
      left_out.push_back({{"file", name}, {"reason", file.reason}});
    }
  }
  if (list.jobs.empty() && report.failures.empty()) {
    report.exit_code = static_cast<int>(ErrorKind::bad_input);
    report.failures.push_back(fmt::format("{}: holds pictures, but no stereo photograph", arguments.files.front()));
  }
  const std::size_t unreadable = report.failures.size();
  std::string summary = arguments.dry_run ? fmt::format("{} photographs, none painted (--dry-run)", wanted)
                                          : fmt::format("{} of {} photographs painted", painted, wanted);
  if (skipped > 0) summary += fmt::format(", {} painted before", skipped);
  if (!left_out.empty()) summary += fmt::format(", {} files left out", left_out.size());
  report.facts = {{"painted", painted}, {"failed", unreadable}, {"photographs", photographs, table_text(table)}};
  if (is_photograph_folder(arguments)) {
    report.facts.push_back({"skipped", skipped});
    report.facts.push_back({"left_out", left_out});
  }
  if (arguments.contact_sheet && !arguments.dry_run) write_contact_sheet(arguments, list, report);
  report.facts.push_back(only_text(summary));
  return report;
}

}  // namespace wheatstone::cli
