#include "wheatstone/photograph/pairs_by_name_internal.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string_view>

#include "wheatstone/files/text_encoding.h"
#include "wheatstone/photograph/find_layout.h"

namespace wheatstone {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view separators = "_-. ";

struct EyeWord {
  std::string_view word;
  bool is_left;
};
// The long words first: "left" also ends with a short one.
constexpr std::array<EyeWord, 4> eye_words{{{"left", true}, {"right", false}, {"l", true}, {"r", false}}};

/// Which eye's picture a file is, by its name or by that of a folder above it.
struct EyeName {
  bool is_left = false;
  std::string scene;  ///< the same for both eyes, and for no other scene
  std::string form;   ///< how the eye is named; the same for both
  bool sure = true;   ///< false: the name may only look like it, as "bright" does
  std::string stem;   ///< of the pair
};

std::string joined_path(const fs::path& folder, const std::string& name) {
  return name.empty() ? folder.generic_string() : (folder / name).generic_string();
}

std::optional<EyeName> eye_by_name(const fs::path& folder, const std::string& name) {
  const std::string small = lower_case(name);
  for (const auto& [word, is_left] : eye_words) {
    if (!small.ends_with(word)) continue;
    const bool is_long = word.size() > 1;
    EyeName eye{.is_left = is_left, .scene = {}, .form = is_long ? "left" : "l", .sure = true, .stem = {}};
    std::string scene = name.substr(0, name.size() - word.size());
    if (!scene.empty() && separators.find(scene.back()) != std::string_view::npos) {
      eye.form += scene.back();
      scene.pop_back();
    } else if (!scene.empty()) {
      if (!is_long) continue;
      eye.sure = false;
    }
    // "tree_left_right" names both eyes: it says how one picture holds them.
    if (const std::optional<EyeName> inner = eye_by_name(folder, scene); inner && inner->sure) return {};
    eye.scene = folder.generic_string() + "/" + scene;
    eye.stem = joined_path(folder, scene);
    return eye;
  }
  return {};
}

/// A folder that is named for an eye, and what lies above and below it on the way to a file.
struct EyeFolder {
  EyeWord eye;
  fs::path above, below;
};

/// The lowest such folder.
std::optional<EyeFolder> eye_folder(const fs::path& file) {
  fs::path below = file.stem();
  for (fs::path folder = file.parent_path(); !folder.empty(); folder = folder.parent_path()) {
    const std::string name = lower_case(folder.filename().string());
    const auto found = std::ranges::find(eye_words, name, &EyeWord::word);
    if (found != eye_words.end()) return EyeFolder{*found, folder.parent_path(), below};
    below = folder.filename() / below;
  }
  return {};
}

std::optional<EyeName> eye_by_name(const fs::path& file) {
  return eye_by_name(file.parent_path(), file.stem().string());
}

/// Whether a word of the name says that the file is a map, which belongs to a photograph: "disp_left".
bool is_map_name(const std::string& name) {
  constexpr std::array<std::string_view, 6> maps{"disp", "disparity", "depth", "mask", "occlusion", "confidence"};
  std::string word;
  for (const char letter : lower_case(name) + "_") {
    if (separators.find(letter) == std::string_view::npos) {
      word += letter;
    } else {
      if (std::ranges::find(maps, word) != maps.end()) return true;
      word.clear();
    }
  }
  return false;
}

constexpr std::array<std::string_view, 2> depth_ends{"_depth", "-depth"};

/// The pictures of one scene, by their names.
struct NamedPictures {
  struct Picture {
    fs::path file;
    EyeName eye;
  };
  std::vector<Picture> left, right;
  std::string map_name;  ///< what would tell that they are maps
  bool by_folder = false;
};

std::string names_of(const std::vector<NamedPictures::Picture>& pictures) {
  std::string names;
  for (const NamedPictures::Picture& picture : pictures)
    names += (names.empty() ? "" : ", ") + picture.file.filename().string();
  return names;
}

void settle(const NamedPictures& scene, PairsByName& found) {
  const auto leave_out = [&found](const std::vector<NamedPictures::Picture>& pictures, const std::string& reason) {
    for (const NamedPictures::Picture& picture : pictures) found.left_out.push_back({picture.file, reason, {}});
  };
  const auto& [left, right, map_name, by_folder] = scene;
  if (left.empty() || right.empty()) {
    for (const NamedPictures::Picture& picture : left.empty() ? right : left) {
      if (picture.eye.sure)
        found.left_out.push_back(
            {picture.file,
             fmt::format("named for the {} eye, but there is no picture of the {} eye",
                         picture.eye.is_left ? "left" : "right", picture.eye.is_left ? "right" : "left"),
             {}});
      else
        found.rest.push_back(picture.file);
    }
  } else if (is_map_name(map_name)) {
    leave_out(left, "named as a map, not as a photograph");
    leave_out(right, "named as a map, not as a photograph");
  } else if (left.size() > 1 || right.size() > 1) {
    leave_out(left, fmt::format("doubtful partner: {} for the left eye, {} for the right eye", names_of(left),
                                names_of(right)));
    leave_out(right, fmt::format("doubtful partner: {} for the left eye, {} for the right eye", names_of(left),
                                 names_of(right)));
  } else if (left.front().eye.form != right.front().eye.form) {
    leave_out(left, fmt::format("doubtful partner: {} names its eye in another way", names_of(right)));
    leave_out(right, fmt::format("doubtful partner: {} names its eye in another way", names_of(left)));
  } else {
    const fs::path& other = right.front().file;
    const std::string why = by_folder ? fmt::format("pair with {}, by their folders", other.generic_string())
                                      : fmt::format("pair with {}, by their names", other.filename().string());
    found.photographs.push_back({left.front().eye.stem, left.front().file, other, {}, why});
  }
}

/// A picture's name without its ending, or that which a depth map's name says.
std::string picture_of(const fs::path& file) {
  std::string name = file.stem().string();
  if (is_depth_name(file)) name.resize(name.size() - depth_ends.front().size());
  return joined_path(file.parent_path(), name);
}

/// Gives depth maps to their pictures, and leaves the other files.
std::vector<fs::path> without_depth(std::span<const fs::path> files, PairsByName& found) {
  struct Files {
    std::vector<fs::path> pictures, depths;
  };
  std::map<std::string, Files> by_name;
  for (const fs::path& file : files) {
    if (is_depth_name(file))
      by_name[picture_of(file)].depths.push_back(file);
    else if (!is_stereo_file_name(file))
      by_name[picture_of(file)].pictures.push_back(file);
  }
  std::set<fs::path> taken;
  const auto leave_out = [&](const fs::path& file, const std::string& reason) {
    found.left_out.push_back({file, reason, {}});
    taken.insert(file);
  };
  for (const auto& [name, alike] : by_name) {
    const auto& [pictures, depths] = alike;
    if (depths.empty()) continue;
    const std::optional<EyeName> eye = pictures.empty() ? std::nullopt : eye_by_name(pictures.front());
    if (pictures.empty()) {
      for (const fs::path& depth : depths) leave_out(depth, "depth map, but there is no picture for it");
    } else if (eye && eye->sure) {
      for (const fs::path& depth : depths)
        leave_out(depth, fmt::format("depth map of {}, which is named for one eye of a pair",
                                     pictures.front().filename().string()));
    } else if (pictures.size() > 1 || depths.size() > 1) {
      for (const std::vector<fs::path>* list : {&pictures, &depths})
        for (const fs::path& file : *list)
          leave_out(file, fmt::format("doubtful depth: {} pictures and {} depth maps have this name", pictures.size(),
                                      depths.size()));
    } else {
      found.photographs.push_back({name,
                                   pictures.front(),
                                   {},
                                   depths.front(),
                                   fmt::format("with the depth map {}", depths.front().filename().string())});
      taken.insert({pictures.front(), depths.front()});
    }
  }
  std::vector<fs::path> others;
  std::ranges::copy_if(files, std::back_inserter(others), [&](const fs::path& file) { return !taken.contains(file); });
  return others;
}

}  // namespace

bool is_depth_name(const fs::path& file) {
  const std::string small = lower_case(file.stem().string());
  return std::ranges::any_of(depth_ends,
                             [&](std::string_view end) { return small.size() > end.size() && small.ends_with(end); });
}

std::string stem_without_eye(const fs::path& file) {
  const std::optional<EyeName> eye = eye_by_name(file);
  return eye ? eye->stem : picture_of(file);
}

PairsByName pairs_by_name(std::span<const fs::path> files) {
  PairsByName found;
  const std::vector<fs::path> pictures = without_depth(files, found);
  // A folder "left" says something only beside a folder "right".
  std::map<std::string, std::set<bool>> eyes_in;
  for (const fs::path& file : pictures)
    if (const auto folder = eye_folder(file)) eyes_in[folder->above.generic_string()].insert(folder->eye.is_left);

  std::map<std::string, NamedPictures> scenes;
  for (const fs::path& file : pictures) {
    const auto put = [&](const EyeName& eye, const std::string& map_name, bool by_folder) {
      NamedPictures& scene = scenes[eye.scene];
      (eye.is_left ? scene.left : scene.right).push_back({file, eye});
      scene.map_name = map_name;
      scene.by_folder = by_folder;
    };
    const auto folder = eye_folder(file);
    const std::optional<EyeName> eye = is_stereo_file_name(file) ? std::nullopt : eye_by_name(file);
    const bool is_in_pair_of_folders = !is_stereo_file_name(file) && folder &&
                                       eyes_in[folder->above.generic_string()].size() == 2 && !(eye && eye->sure);
    if (is_in_pair_of_folders) {
      const std::string below = folder->below.generic_string();
      put({.is_left = folder->eye.is_left,
           .scene = folder->above.generic_string() + "//" + below,
           .form = folder->eye.word.size() > 1 ? "left/" : "l/",
           .sure = true,
           .stem = joined_path(folder->above, below)},
          folder->above.filename().string() + "_" + folder->below.filename().string(), true);
    } else if (eye) {
      put(*eye, fs::path(eye->stem).filename().string(), false);
    } else {
      found.rest.push_back(file);
    }
  }
  for (const auto& [name, scene] : scenes) settle(scene, found);
  return found;
}

}  // namespace wheatstone
