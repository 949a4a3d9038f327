#include "wheatstone/study/study_design.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <optional>
#include <ranges>

#include "wheatstone/error.h"
#include "wheatstone/random.h"
#include "wheatstone/study/settings_internal.h"

namespace wheatstone {
namespace {

std::optional<float> float_in(const std::string& text, float least, float most) {
  float value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !(value >= least && value <= most)) return {};
  return value;
}

std::optional<bool> truth_of(const std::string& text) {
  if (text == "true") return true;
  if (text == "false") return false;
  return {};
}

/// One setting: reads a value; false where it is none.
struct Setting {
  std::string_view name, expected;
  std::function<bool(const std::string&, ShownSettings&)> set;
};

/// A setting that is a number within these limits.
template <class Put>
Setting number_setting(std::string_view name, float least, float most, std::string_view expected, Put put) {
  return {name, expected, [=](const std::string& text, ShownSettings& shown) {
            const std::optional<float> value = float_in(text, least, most);
            if (value) put(shown, *value);
            return value.has_value();
          }};
}

template <class Put>
Setting truth_setting(std::string_view name, Put put) {
  return {name, "true or false", [=](const std::string& text, ShownSettings& shown) {
            const std::optional<bool> value = truth_of(text);
            if (value) put(shown, *value);
            return value.has_value();
          }};
}

template <class Value, class Put>
Setting name_setting(std::string_view name, std::string_view expected,
                     std::vector<std::pair<std::string_view, Value>> names, Put put) {
  return {name, expected, [=](const std::string& text, ShownSettings& shown) {
            const auto found = std::ranges::find(names, text, [](const auto& choice) { return choice.first; });
            if (found != names.end()) put(shown, found->second);
            return found != names.end();
          }};
}

const std::vector<Setting>& settings() {
  static const std::vector<Setting> all{
      {"nodes", "a multiple of three from 9 to 3000",
       [](const std::string& text, ShownSettings& shown) {
         const std::optional<float> value = float_in(text, 9, 3000);
         if (value) shown.nodes = static_cast<int>(*value);
         return value && std::fmod(*value, 3.0f) == 0;
       }},
      number_setting("depth_cm", 0, 100, "a number from 0 to 100",
                     [](ShownSettings& shown, float value) { shown.depth_mm = 10 * value; }),
      number_setting("views_per_10cm", 0, 1000, "a number from 0 to 1000",
                     [](ShownSettings& shown, float value) { shown.display.views_per_10cm = value; }),
      number_setting("crosstalk", 0, 0.5f, "a share from 0 to 0.5",
                     [](ShownSettings& shown, float value) { shown.display.crosstalk = value; }),
      truth_setting("monoscopic", [](ShownSettings& shown, bool value) { shown.display.monoscopic = value; }),
      truth_setting("track_distance", [](ShownSettings& shown, bool value) { shown.display.tracks_distance = value; }),
      name_setting<Quantised>("quantised", R"("head" or "eyes")",
                              {{"head", Quantised::head}, {"eyes", Quantised::eyes}},
                              [](ShownSettings& shown, Quantised value) { shown.display.quantised = value; }),
      name_setting<GraphPlacement>("placement", R"("planes" or "volume")",
                                   {{"planes", GraphPlacement::planes}, {"volume", GraphPlacement::volume}},
                                   [](ShownSettings& shown, GraphPlacement value) { shown.placement = value; }),
  };
  return all;
}

/// Replaces {key} in a pattern.
void fill_in(std::string& pattern, const std::string& key, const std::string& value) {
  const std::string mark = "{" + key + "}";
  for (std::size_t at = pattern.find(mark); at != std::string::npos; at = pattern.find(mark, at + value.size()))
    pattern.replace(at, mark.size(), value);
}

ShownSettings with_levels(ShownSettings shown, const std::vector<const FactorLevel*>& levels) {
  for (const FactorLevel* level : levels)
    for (const auto& [key, value] : level->sets) apply_setting(key, value, shown, "");
  return shown;
}

/// The levels of the factors whose subjects are `between` in combination `number`; the last factor's change fastest.
std::vector<const FactorLevel*> combination(const StudyDesign& design, bool between, int number) {
  std::vector<const FactorLevel*> levels;
  for (auto factor = design.factors.rbegin(); factor != design.factors.rend(); ++factor) {
    if (factor->between != between) continue;
    const int count = static_cast<int>(factor->levels.size());
    levels.insert(levels.begin(), &factor->levels[static_cast<std::size_t>(number % count)]);
    number /= count;
  }
  return levels;
}

int combination_count(const StudyDesign& design, bool between) {
  int count = 1;
  for (const StudyFactor& factor : design.factors)
    if (factor.between == between) count *= static_cast<int>(factor.levels.size());
  return count;
}

/// The conditions that are combinations of the factors. Where all factors are between subjects, controls may stand
/// alone.
int crossed_count(const StudyDesign& design) {
  const bool has_within =
      std::ranges::any_of(design.factors, [](const StudyFactor& factor) { return !factor.between; });
  return has_within || design.controls.empty() ? combination_count(design, false) : 0;
}

StudyCondition factor_condition(const StudyDesign& design, int group, int number) {
  const std::vector<const FactorLevel*> of_group = combination(design, true, group);
  const std::vector<const FactorLevel*> own = combination(design, false, number);
  StudyCondition condition;
  auto next_of_group = of_group.begin(), next_own = own.begin();
  for (const StudyFactor& factor : design.factors) {
    const FactorLevel& level = **(factor.between ? next_of_group++ : next_own++);
    condition.levels.push_back(level.name);
    if (!factor.between)
      condition.name += fmt::format("{}{}={}", condition.name.empty() ? "" : ",", factor.name, level.name);
  }
  condition.shown = with_levels(with_levels(design.shown, of_group), own);
  return condition;
}

}  // namespace

bool is_setting(std::string_view name) {
  return std::ranges::any_of(settings(), [name](const Setting& setting) { return setting.name == name; });
}

void apply_setting(std::string_view name, const std::string& value, ShownSettings& shown, std::string_view where) {
  const auto found = std::ranges::find(settings(), name, [](const Setting& setting) { return setting.name; });
  if (found == settings().end()) {
    std::string names;
    for (const Setting& setting : settings()) names += fmt::format("{}{}", names.empty() ? "" : ", ", setting.name);
    throw Error(ErrorKind::bad_input, fmt::format("{}: '{}' is no setting, expected one of {}", where, name, names));
  }
  if (!found->set(value, shown))
    throw Error(ErrorKind::bad_input, fmt::format("{}: {} is '{}', expected {}", where, name, value, found->expected));
}

int group_count(const StudyDesign& design) { return combination_count(design, true); }

int condition_count(const StudyDesign& design) {
  return crossed_count(design) + static_cast<int>(design.controls.size());
}

std::vector<StudyCondition> conditions_of_group(const StudyDesign& design, int group) {
  std::vector<StudyCondition> conditions;
  for (int number = 0; number < crossed_count(design); ++number)
    conditions.push_back(factor_condition(design, group, number));
  for (const ControlCondition& control : design.controls) {
    StudyCondition condition{.name = control.name, .is_control = true};
    condition.levels.assign(design.factors.size(), "n/a");
    condition.shown = with_levels(with_levels(design.shown, combination(design, true, group)), {&control});
    conditions.push_back(condition);
  }
  return conditions;
}

bool is_connected(const StudyDesign& design, int item) {
  // Conditions are dealt out to the items in turn.
  const int conditions = condition_count(design);
  return (item / conditions + item % conditions) % 2 == 0;
}

PathGraph graph_of_item(const StudyDesign& design, int item, const ShownSettings& shown, const StudyScreen& screen) {
  const PathGraphOptions options{.nodes = shown.nodes,
                                 .placement = shown.placement,
                                 .depth_mm = shown.depth_mm,
                                 .viewing_distance_mm = screen.viewing_distance_mm,
                                 .eye_separation_mm = screen.eye_separation_mm};
  return make_path_graph(options, hash_keys({design.seed, static_cast<std::uint64_t>(item)}),
                         is_connected(design, item));
}

std::vector<std::string> stimulus_files(const StudyDesign& design, int item, const StudyCondition& condition) {
  if (design.items.empty())
    return {fmt::format("graphs/item-{:03}_nodes-{}_depth-{}mm.json", item + 1, condition.shown.nodes,
                        std::lround(condition.shown.depth_mm))};
  std::vector<std::string> files{design.left, design.right};
  for (std::string& file : files) {
    fill_in(file, "item", design.items[static_cast<std::size_t>(item)]);
    for (std::size_t i = 0; i < design.factors.size(); ++i) fill_in(file, design.factors[i].name, condition.levels[i]);
  }
  if (files[1].empty() || files[1] == files[0]) files.pop_back();
  return files;
}

}  // namespace wheatstone
