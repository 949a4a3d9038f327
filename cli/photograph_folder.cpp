#include "photograph_folder.h"

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <optional>
#include <utility>

#include "placeholders.h"
#include "wheatstone/error.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/photograph/carried_depth.h"
#include "wheatstone/photograph/find_layout.h"

namespace wheatstone::cli {
namespace {

namespace fs = std::filesystem;

/// Results within the folder would be found as photographs by the next run.
void refuse_output_within(const std::string& folder, const std::string& output) {
  const fs::path way = fs::weakly_canonical(output).lexically_relative(fs::canonical(folder));
  if (!way.empty() && *way.begin() != "..")
    throw Error(ErrorKind::wrong_usage,
                fmt::format("{}: lies in {}, the folder of the photographs; expected an output (-o) outside it", output,
                            folder));
}

/// The name of a result without its ending. Throws Error{wrong_usage} where it leads out of the output.
std::string result_name(const FolderArguments& arguments, const FolderOutput& output, const std::string& stem) {
  std::vector<Placeholder> known{{"stem", stem}, {"name", fs::path(stem).filename().string()}};
  for (const auto& [name, text] : output.placeholders) known.push_back({name, text});
  std::string name = filled("--name", arguments.name, known);
  const fs::path path = name;
  bool is_below = !name.empty() && !path.is_absolute() && path.has_filename();
  for (const fs::path& part : path) is_below = is_below && part != ".." && part != ".";
  if (!is_below)
    throw Error(ErrorKind::wrong_usage,
                fmt::format("--name: makes '{}' of {}, expected a name within the output", name, stem));
  return name;
}

}  // namespace

Rows folder_rows(FolderArguments& a, const std::function<bool()>& is_folder, std::string_view done,
                 std::string_view placeholders, const Reasons& unless) {
  Reasons reasons = unless;
  reasons.push_back(when([is_folder] { return !is_folder(); }, "on files; it works on a folder of photographs"));
  return under(
      "A folder of photographs",
      {row("--dry-run", flag(a.dry_run),
           fmt::format("Show which files of a folder are photographs, and why; nothing is {}", done), reasons),
       row("--skip-existing", flag(a.skip_existing),
           "Skip photographs of a folder whose results exist already, to continue a run", reasons),
       row("--part", parsed(a.part, parse_part, "NUMBER/PARTS"),
           "Take only this part of a folder's photographs, which are dealt out by name: 3/16 on the third of 16 "
           "machines",
           reasons),
       row("--pairs", text(a.pairs),
           "File that lists pairs that cannot be told by their names: LEFT, a tab and RIGHT on each line, relative to "
           "this file",
           reasons),
       row("--name", text(a.name),
           fmt::format("Names of the results in the output: {{stem}}, the path of the photograph in the folder; "
                       "{{name}}, the same without folders{}",
                       placeholders),
           reasons)});
}

Row contact_sheet_row(FolderArguments& a, const std::function<bool()>& is_folder, Reasons unless) {
  unless.push_back(when([is_folder] { return !is_folder(); }, "on files; it works on a folder of photographs"));
  Row sheet = row("--contact-sheet", flag(a.contact_sheet),
                  "Also write contact_sheet.png, which shows all results, small, with their names", std::move(unless));
  sheet.heading = "A folder of photographs";
  return sheet;
}

PhotographList photographs_in_folder(const std::string& folder, const StereoArguments& photographs,
                                     const FolderArguments& arguments, const FolderOutput& output,
                                     const Session& session) {
  refuse_output_within(folder, output.folder);
  result_name(arguments, output, "photograph");  // refused before the folder is read
  FindPhotographsOptions options;
  if (!photographs.layout.empty()) options.views = options_for_layout(photographs.layout);
  options.views.swap = photographs.swap;
  if (!arguments.pairs.empty()) options.pairs = read_pair_table(arguments.pairs);
  PhotographFolder found = find_photographs(folder, options, session.progress);
  PhotographList list{{}, std::move(found.left_out)};
  std::map<std::string, std::string> taken;
  int number = 0;
  for (const FoundPhotograph& photograph : found.photographs) {
    const std::string name = result_name(arguments, output, photograph.stem);
    const auto [known, is_new] = taken.emplace(name, photograph.left.string());
    if (!is_new)
      throw Error(ErrorKind::wrong_usage,
                  fmt::format("--name: gives {} and {} the same name '{}'; {{stem}} tells them apart", known->second,
                              photograph.left.string(), name));
    if (number++ % arguments.part.of != arguments.part.number - 1) continue;
    const std::string result = (fs::path(output.folder) / (name + output.ending)).string();
    refuse_output_within(folder, result);
    list.jobs.push_back(
        {photograph.left.string(), photograph.right.string(), result, photograph.depth.string(), photograph.why});
  }
  return list;
}

PhotographList pairs_in_folder(const std::string& folder, const StereoArguments& photographs,
                               const FolderArguments& arguments, const FolderOutput& output, const Session& session) {
  if (!photographs.right.empty())
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: is a folder, expected no other photograph beside it, but {} is given", folder,
                            photographs.right));
  PhotographList list = photographs_in_folder(folder, photographs, arguments, output, session);
  std::erase_if(list.jobs, [&](const PhotographJob& job) {
    const bool is_single =
        !job.depth.empty() || (job.right.empty() && photographs.layout.empty() && !photographs.swap &&
                               !is_stereo_file_name(job.left) && carries_depth(job.left));
    if (is_single) list.left_out.push_back({job.left, "one picture with depth, which holds no second view", {}});
    return is_single;
  });
  return list;
}

StereoArguments photograph_of(const StereoArguments& given, const PhotographJob& job) {
  StereoArguments one = given;
  one.left = job.left;
  one.right = job.right;
  // A layout is that of files that hold both views.
  if (!job.right.empty()) one.layout.clear();
  return one;
}

void read_photograph_of(const PhotographJob& job, ViewsArguments& views, DepthArguments& depth) {
  views.files = {job.left};
  if (!job.right.empty()) views.files.push_back(job.right);
  if (!job.right.empty() || !job.depth.empty()) views.layout.clear();
  depth.file = job.depth;
}

Rows pair_folder_rows(FolderArguments& a, const StereoArguments& photographs, std::string_view done) {
  return folder_rows(
      a, [&photographs] { return is_folder(photographs.left); }, done);
}

}  // namespace wheatstone::cli
