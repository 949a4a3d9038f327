#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "wheatstone/photograph/find_photographs.h"

namespace wheatstone {

/// What names tell of files, before any is opened.
struct PairsByName {
  std::vector<FoundPhotograph> photographs;  ///< pairs, and pictures with their depth maps; stems may be alike
  std::vector<LeftOutFile> left_out;
  std::vector<std::filesystem::path> rest;  ///< files that stand for themselves
};

/// Groups files by the rules of find_photographs. Paths are relative to the folder.
PairsByName pairs_by_name(std::span<const std::filesystem::path> files);

/// The path of a picture's result: without ending, and without the word that names an eye.
std::string stem_without_eye(const std::filesystem::path& file);

/// Whether a file's name says that it is a depth map: "tree_depth.png".
bool is_depth_name(const std::filesystem::path& file);

}  // namespace wheatstone
