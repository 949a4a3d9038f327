#include "wheatstone/photograph/find_photographs.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <set>
#include <span>
#include <string_view>
#include <system_error>
#include <utility>

#include "wheatstone/photograph/carried_depth.h"
#include "wheatstone/photograph/find_layout.h"
#include "wheatstone/photograph/pairs_by_name_internal.h"
#include "wheatstone/photograph/pairs_by_time_internal.h"
#include "wheatstone/pictures/picture_file.h"
#include "wheatstone/pictures/read_image.h"
#include "wheatstone/stereo/picture_sizes.h"

namespace wheatstone {
namespace {

namespace fs = std::filesystem;

/// Whether the ending says that a file may be a picture, or depth.
bool may_be_picture(const fs::path& file) {
  constexpr std::array<std::string_view, 27> endings{".png",  ".apng", ".pns",  ".jpg",  ".jpeg", ".jpe",  ".jps",
                                                     ".mpo",  ".tif",  ".tiff", ".webp", ".heic", ".heif", ".hif",
                                                     ".avif", ".gif",  ".bmp",  ".ppm",  ".pgm",  ".pnm",  ".exr",
                                                     ".tga",  ".jp2",  ".j2k",  ".hdr",  ".psd",  ".sgi"};
  const std::string ending = ending_of(file);
  return std::ranges::find(endings, ending) != endings.end() || (ending == ".pfm" && is_depth_name(file));
}

/// Lists the pictures in folder/below, relative to the folder.
void list_pictures(const fs::path& folder, const fs::path& below, std::vector<fs::path>& files,
                   std::vector<LeftOutFile>& left_out) {
  std::error_code error;
  fs::directory_iterator entries(folder / below, error);
  for (; !error && entries != fs::directory_iterator(); entries.increment(error)) {
    const fs::path name = entries->path().filename(), file = below / name;
    std::error_code gone;
    if (name.native().starts_with('.')) continue;
    if (entries->is_directory(gone) && !entries->is_symlink(gone)) {
      if (fs::exists(entries->path() / "painting.wst", gone))
        left_out.push_back({file, "folder of a painting", {}});
      else
        list_pictures(folder, file, files, left_out);
    } else if (entries->is_regular_file(gone) && may_be_picture(name)) {
      files.push_back(file);
    }
  }
  if (!error) return;
  const std::string message = "cannot read the folder: " + error.message();
  if (below.empty()) throw Error(ErrorKind::cannot_read_write, fmt::format("{}: {}", folder.string(), message));
  left_out.push_back({below, message, ErrorKind::cannot_read_write});
}

/// An error of a file as the reason for which it is left out.
LeftOutFile left_out_for(const fs::path& file, const Error& error) {
  const std::string name = file.string() + ": ", message = error.what();
  return {file, message.starts_with(name) ? message.substr(name.size()) : message, error.kind()};
}

/// Why two pictures make no pair, as their headers tell; empty where they make one. What there is to say of their sizes
/// is added to its reason.
std::vector<LeftOutFile> wrong_with_pair(FoundPhotograph& pair) {
  std::vector<LeftOutFile> wrong;
  std::vector<std::pair<int, int>> sizes;
  for (const auto& [file, other] : {std::pair(pair.left, pair.right), std::pair(pair.right, pair.left)}) {
    try {
      const ImageDescription picture = describe_image(file);
      const bool lies = picture.orientation >= 5;  // EXIF: turned by a quarter
      sizes.emplace_back(lies ? picture.height : picture.width, lies ? picture.width : picture.height);
    } catch (const Error& error) {
      wrong.push_back(left_out_for(file, error));
    }
  }
  if (wrong.size() == 1) {
    const bool left_is_wrong = wrong.front().file == pair.left;
    wrong.push_back({left_is_wrong ? pair.right : pair.left,
                     fmt::format("its partner {} cannot be read", wrong.front().file.filename().string()),
                     {}});
  }
  if (sizes.size() < 2 || sizes[0] == sizes[1]) return wrong;
  if (differ_by_few({sizes[0].first, sizes[0].second}, {sizes[1].first, sizes[1].second})) {
    pair.why += fmt::format("; {}x{} and {}x{} pixels, framed to the common part", sizes[0].first, sizes[0].second,
                            sizes[1].first, sizes[1].second);
    return wrong;
  }
  for (const std::size_t i : {0U, 1U})
    wrong.push_back({i == 0 ? pair.left : pair.right,
                     fmt::format("doubtful partner: {} has {}x{} pixels, this picture {}x{}",
                                 (i == 0 ? pair.right : pair.left).filename().string(), sizes[1 - i].first,
                                 sizes[1 - i].second, sizes[i].first, sizes[i].second),
                     {}});
  return wrong;
}

/// How a file is a photograph by itself; empty where it is not.
std::string how_by_itself(const fs::path& file, const ReadViewsOptions& options) {
  // Whoever says where two views lie is believed.
  const bool is_told = options.layout || options.scan || options.swap;
  if (!is_told && !is_stereo_file_name(file) && carries_depth(file)) return "one picture with the depth of its file";
  const std::optional<ViewsFile> views = find_views(file, options);
  return views ? describe_views(*views) : "";
}

/// The kind of a photograph's files, which tells apart those of one name.
std::string kind_of_files(const FoundPhotograph& photograph) {
  const std::string ending = ending_of(photograph.left);
  return !photograph.right.empty() || ending.empty() ? "pair" : ending.substr(1);
}

/// Where several have one stem, they get their kind behind it, and a number where that is not enough.
void make_stems_unique(std::vector<FoundPhotograph>& photographs) {
  std::map<std::string, int> count;
  for (const FoundPhotograph& photograph : photographs) ++count[photograph.stem];
  std::set<std::string> taken;
  for (const auto& [stem, many] : count)
    if (many == 1) taken.insert(stem);
  for (FoundPhotograph& photograph : photographs) {
    if (count[photograph.stem] == 1) continue;
    const std::string stem = fmt::format("{}-{}", photograph.stem, kind_of_files(photograph));
    photograph.stem = stem;
    for (int number = 2; !taken.insert(photograph.stem).second; ++number)
      photograph.stem = fmt::format("{}-{}", stem, number);
  }
}

/// A file's path within the folder; its name where it lies elsewhere.
fs::path within(const fs::path& folder, const fs::path& file) {
  const fs::path way = fs::weakly_canonical(file).lexically_relative(fs::weakly_canonical(folder / ""));
  return way.empty() || *way.begin() == ".." ? file.filename() : way;
}

/// Takes what the names of files say: pairs, and photographs that are alone. `tell` is called before each.
void take_named(const fs::path& folder, std::vector<FoundPhotograph> named,
                const std::function<void(const fs::path&)>& tell, PhotographFolder& found) {
  for (FoundPhotograph& photograph : named) {
    photograph.left = folder / photograph.left;
    if (!photograph.right.empty()) photograph.right = folder / photograph.right;
    if (!photograph.depth.empty()) photograph.depth = folder / photograph.depth;
    if (photograph.stem.empty()) photograph.stem = fs::canonical(folder).filename().string();
    tell(photograph.left);
    std::vector<LeftOutFile> wrong;
    if (!photograph.right.empty()) wrong = wrong_with_pair(photograph);
    if (wrong.empty()) found.photographs.push_back(std::move(photograph));
    std::ranges::move(wrong, std::back_inserter(found.left_out));
  }
}

/// Takes the files that are a photograph by themselves. Returns the others.
std::vector<fs::path> take_whole(const fs::path& folder, std::span<const fs::path> names, const ReadViewsOptions& views,
                                 const std::function<void(const fs::path&)>& tell, PhotographFolder& found) {
  std::vector<fs::path> alone;
  for (const fs::path& name : names) {
    const fs::path file = folder / name;
    tell(file);
    try {
      if (std::string how = how_by_itself(file, views); !how.empty())
        found.photographs.push_back({stem_without_eye(name), file, {}, {}, std::move(how)});
      else
        alone.push_back(file);
    } catch (const Error& error) {
      if (error.kind() == ErrorKind::interrupted) throw;
      found.left_out.push_back(left_out_for(file, error));
    }
  }
  return alone;
}

}  // namespace

PhotographFolder find_photographs(const fs::path& folder, const FindPhotographsOptions& options,
                                  const Progress& progress) {
  PhotographFolder found;
  std::vector<fs::path> files;
  list_pictures(folder, {}, files, found.left_out);
  if (files.empty() && options.pairs.empty())
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: holds no picture, expected stereo photographs", folder.string()));

  std::set<fs::path> given;
  for (FoundPhotograph pair : options.pairs) {
    given.insert({fs::weakly_canonical(pair.left), fs::weakly_canonical(pair.right)});
    pair.stem = stem_without_eye(within(folder, pair.left));
    found.photographs.push_back(std::move(pair));
  }
  if (!given.empty())
    std::erase_if(files, [&](const fs::path& file) { return given.contains(fs::weakly_canonical(folder / file)); });
  std::ranges::sort(files);
  PairsByName named = pairs_by_name(files);

  const std::size_t all = named.photographs.size() + named.rest.size();
  std::size_t done = 0;
  const auto tell = [&](const fs::path& file) {
    report(progress, fmt::format("looking at {}", file.string()),
           static_cast<double>(done++) / static_cast<double>(all));
  };
  for (LeftOutFile& file : named.left_out) file.file = folder / file.file;
  for (LeftOutFile& file : found.left_out) file.file = folder / file.file;
  std::ranges::move(named.left_out, std::back_inserter(found.left_out));
  take_named(folder, std::move(named.photographs), tell, found);
  const std::vector<fs::path> alone = take_whole(folder, named.rest, options.views, tell, found);
  PairsByTime timed = pairs_by_time(alone, progress);
  std::ranges::move(timed.left_out, std::back_inserter(found.left_out));
  for (FoundPhotograph& pair : timed.photographs) {
    pair.stem = stem_without_eye(within(folder, pair.left));
    found.photographs.push_back(std::move(pair));
  }
  std::ranges::sort(found.photographs, {}, &FoundPhotograph::left);
  std::ranges::sort(found.left_out, {}, &LeftOutFile::file);
  make_stems_unique(found.photographs);
  return found;
}

bool holds_photographs(const fs::path& folder) {
  std::vector<fs::path> files;
  std::vector<LeftOutFile> left_out;
  list_pictures(folder, {}, files, left_out);
  std::ranges::sort(files);
  const auto says_so = [](const fs::path& file) {
    constexpr int any = 100;  // pixels a side: the name is asked for a layout, not whether it is squeezed
    return file.has_parent_path() || is_stereo_file_name(file) || is_depth_name(file) ||
           layout_from_name(file, any, any).has_value();
  };
  if (std::ranges::any_of(files, says_so)) return true;
  constexpr std::size_t pair = 2;
  if (files.size() > pair && !pairs_by_name(files).photographs.empty()) return true;
  if (files.empty() || files.front().filename().string().starts_with("view_")) return false;
  try {
    return !how_by_itself(folder / files.front(), {}).empty();
  } catch (const Error&) {
    return false;  // who reads the views tells it
  }
}

}  // namespace wheatstone
