#include "wheatstone/app/comfort_stimuli.h"

#include <fmt/format.h>

#include <algorithm>

#include "wheatstone/error.h"
#include "wheatstone/study/study_design.h"

namespace wheatstone {
namespace {

/// The text with what stands from `begin` to the end of its `end` replaced.
std::string with_part(std::string text, std::string_view begin, std::string_view end, const std::string& part) {
  const std::size_t from = text.find(begin);
  const std::size_t to = text.find(end, from);
  return text.replace(from, to + end.size() - from, part);
}

}  // namespace

ComfortVersions comfort_versions(const StereoPair& photographs, const PaintPhotographOptions& options,
                                 const Progress& progress) {
  ComfortVersions versions{.original = photographs};
  PaintPhotographOptions both = options;
  both.depth_budget.reset();  // all versions have one depth
  PaintedPhotograph painted = paint_photograph(photographs, both, progress);
  versions.consistent = std::move(painted.painted.pictures);
  PaintPhotographOptions each = both;
  each.style.propagation = Propagation::independent;
  each.left_disparity = std::move(painted.geometry.left_disparity);
  each.right_disparity = std::move(painted.geometry.right_disparity);
  versions.inconsistent = std::move(paint_photograph(photographs, each, progress).painted.pictures);
  return versions;
}

std::string comfort_design(const std::vector<std::string>& pictures) {
  constexpr std::size_t versions = 3, most_repetitions = 4;
  if (pictures.size() < versions)
    throw Error(ErrorKind::wrong_usage,
                fmt::format("there are {} photographs, expected at least {}: each subject sees a picture once only",
                            pictures.size(), versions));
  std::string items;
  for (const std::string& picture : pictures) items += fmt::format("{}\"{}\"", items.empty() ? "" : ", ", picture);
  const std::size_t repetitions = std::min(pictures.size() / versions, most_repetitions);
  std::string toml(std::ranges::find(built_in_designs(), "painting-comfort", &BuiltInDesign::name)->toml);
  toml = with_part(
      toml, "from\n# 1 (sick)", "version.\n",
      fmt::format("from\n# 1 (sick) to 5 (super). Each subject rates {} of {} pictures, each in one version.\n",
                  versions * repetitions, pictures.size()));
  toml = with_part(toml, "repetitions =", "\n", fmt::format("repetitions = {}\n", repetitions));
  toml = with_part(toml, "items =", "]", fmt::format("items = [{}]", items));
  // The least number of subjects from that of the paper on with which each picture is met equally often in each
  // version.
  constexpr std::size_t published_subjects = 30;
  for (std::size_t subjects = published_subjects;; subjects += versions) {
    toml = with_part(toml, "subjects =", "\n", fmt::format("subjects = {}\n", subjects));
    try {
      parse_study_design(toml, "painting-comfort");
      return toml;
    } catch (const Error&) {
      if (subjects > published_subjects + versions * pictures.size()) throw;
    }
  }
}

}  // namespace wheatstone
