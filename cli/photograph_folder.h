#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "command.h"
#include "depth_argument.h"
#include "stereo_arguments.h"
#include "views_argument.h"
#include "wheatstone/photograph/find_photographs.h"

namespace wheatstone::cli {

/// How a folder of photographs is worked on, as it is typed: the same for all commands.
struct FolderArguments {
  std::string pairs;            ///< the table of pairs; empty: there is none
  std::string name = "{stem}";  ///< of a result, with placeholders
  bool dry_run = false, skip_existing = false, contact_sheet = false;
  Part part;  ///< every `of`th photograph, from the `number`th on
};

/// --dry-run, --skip-existing, --part, --pairs and --name, which have an effect where `is_folder` holds and none of
/// `unless`. `done` says what becomes of a photograph, as "painted", `placeholders` what --name knows beside {stem} and
/// {name}, as ", {style}".
Rows folder_rows(FolderArguments& arguments, const std::function<bool()>& is_folder, std::string_view done,
                 std::string_view placeholders = {}, const Reasons& unless = {});

/// --contact-sheet, likewise; of `paint` it has an effect on one photograph, too.
Row contact_sheet_row(FolderArguments& arguments, const std::function<bool()>& is_folder, Reasons unless = {});

/// One photograph and where its result goes.
struct PhotographJob {
  std::string left, right;  ///< right is empty where left holds both views, or is one picture with its depth
  std::string output;
  std::string depth = {};  ///< depth map that was found for the one picture
  std::string why = {};    ///< how the files were found to belong together; empty: they were given
};

/// The photographs of one run, and the files that it leaves out.
struct PhotographList {
  std::vector<PhotographJob> jobs;
  std::vector<LeftOutFile> left_out = {};
};

/// Where the results of a folder go.
struct FolderOutput {
  std::string folder;  ///< in which all lie
  std::string ending;  ///< of a result that is a file, as ".mpo"; empty: it is a folder, or gets its ending later
  std::vector<std::pair<std::string, std::string>> placeholders;  ///< what --name knows beside {stem} and {name}
};

/// The photographs in a folder and below it, each with its result's name in the output. `photographs` tells the layout
/// and whether the eyes are swapped. Throws Error: bad_input; wrong_usage where results would lie in the folder itself,
/// or two would get one name.
PhotographList photographs_in_folder(const std::string& folder, const StereoArguments& photographs,
                                     const FolderArguments& arguments, const FolderOutput& output,
                                     const Session& session);

/// The same for commands that need two views: pictures with depth are left out.
PhotographList pairs_in_folder(const std::string& folder, const StereoArguments& photographs,
                               const FolderArguments& arguments, const FolderOutput& output, const Session& session);

/// What is read for one photograph of a folder.
StereoArguments photograph_of(const StereoArguments& given, const PhotographJob& job);

/// The same, for commands that read views or a picture with its depth.
void read_photograph_of(const PhotographJob& job, ViewsArguments& views, DepthArguments& depth);

/// folder_rows of a command with LEFT and RIGHT; RIGHT is refused beside a folder.
Rows pair_folder_rows(FolderArguments& arguments, const StereoArguments& photographs, std::string_view done);

}  // namespace wheatstone::cli
