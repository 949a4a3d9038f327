#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "wheatstone/error.h"
#include "wheatstone/photograph/read_views.h"
#include "wheatstone/progress.h"

namespace wheatstone {

/// A photograph that can be painted in stereo, and its files.
struct FoundPhotograph {
  std::string stem;             ///< "trip/tree": its path without what names an eye and without ending; unique
  std::filesystem::path left;   ///< the left view, a file with both views, or one picture that has depth
  std::filesystem::path right;  ///< empty: `left` is the only picture
  std::filesystem::path depth;  ///< depth map of the one picture; empty: there is none, or its own file has it
  std::string why;              ///< in words: "pair with tree_R.jpg, by their names"
};

/// A file that is no photograph, or not surely one.
struct LeftOutFile {
  std::filesystem::path file;
  std::string reason;
  std::optional<ErrorKind> error;  ///< of a file that cannot be read; none: the file is sound
};

struct PhotographFolder {
  std::vector<FoundPhotograph> photographs;  ///< in the order of their files' names
  std::vector<LeftOutFile> left_out;         ///< likewise
};

struct FindPhotographsOptions {
  ReadViewsOptions views;              ///< of files that hold both views
  std::vector<FoundPhotograph> pairs;  ///< known before, as read_pair_table gives them; no rule takes their files
};

/// Finds the stereo photographs in a folder and below it:
/// - two pictures whose names differ in what names the eye: tree_L and tree_R (or -, space, dot), tree_left and
///   tree_right, treeleft and treeright, left and right, L and R, in capitals or not;
/// - two pictures of the same name in the folders left/ and right/, or L/ and R/;
/// - a picture and its depth map, which has its name and "_depth" or "-depth";
/// - a file that holds both views, as find_views sees it, or its own depth, as find_carried_depth.
/// - two pictures of one view that were taken at the same time, where they show themselves that they are a pair, and
/// whose eye's each is (pairs_by_time).
/// A pair has pictures of one size, but for a few rows or columns (differ_by_few). What is not surely a photograph is
/// left out with its reason: a picture whose partner is missing, several candidates for one partner, pictures that
/// differ in size, names of maps ("disp_left"), one view. Files are pictures by their endings. Hidden files and
/// folders, links to folders, and folders that hold a painting of Wheatstone are not looked into. Throws Error:
/// bad_input where there is no picture, cannot_read_write where the folder cannot be read.
PhotographFolder find_photographs(const std::filesystem::path& folder, const FindPhotographsOptions& options = {},
                                  const Progress& progress = {});

/// Whether a folder holds photographs, rather than the views of one: a file name says that it holds two views or depth,
/// or there are pictures in folders below it, or a pair among more than two pictures, or the first picture holds two
/// views or its own depth. Names that begin with "view_" are of views.
bool holds_photographs(const std::filesystem::path& folder);

/// Reads a table of pairs: LEFT, a tab and RIGHT a line, relative to the table's folder. Empty lines have no meaning.
/// The stems are empty. Throws Error{bad_input} that names the table and the line.
std::vector<FoundPhotograph> read_pair_table(const std::filesystem::path& table);

}  // namespace wheatstone
