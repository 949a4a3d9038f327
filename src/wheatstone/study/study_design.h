#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "wheatstone/study/path_graph.h"
#include "wheatstone/study/simulated_display.h"

namespace wheatstone {

/// What a subject answers.
enum class StudyTask {
  path,    ///< whether two highlighted nodes are joined by a path of two links: yes or no
  rating,  ///< how a picture is, on a scale
};

/// In which order a subject meets the conditions.
enum class TrialOrder {
  balanced,  ///< Williams squares where the number of subjects allows, else Latin squares
  williams,  ///< each condition equally often at each place, and equally often behind each other condition
  latin,     ///< each condition equally often at each place
  random,    ///< drawn by lot for each subject; not balanced
};

enum class TrialArrangement {
  rounds,  ///< all conditions once, then all of them again
  blocks,  ///< all repetitions of a condition, then those of the next
};

/// What is shown in a condition. In a design file lengths stand in cm, as the literature has them.
struct ShownSettings {
  int nodes = 90;
  float depth_mm = 100;
  GraphPlacement placement = GraphPlacement::planes;
  SimulatedDisplay display;
  friend bool operator==(const ShownSettings&, const ShownSettings&) = default;
};

/// A value of a factor: its name, and what it sets.
struct FactorLevel {
  std::string name;
  std::vector<std::pair<std::string, std::string>> sets;  ///< setting and value, as in the file
};

struct StudyFactor {
  std::string name;
  bool between = false;  ///< subjects meet one of its levels only
  std::vector<FactorLevel> levels;
};

/// A condition beside the factors' combinations, such as a flat picture.
using ControlCondition = FactorLevel;

/// A question at the end, answered by a number.
struct StudyQuestion {
  std::string name;  ///< of the column
  std::string text;
  int least = 1, most = 5;
  std::string least_means, most_means;
};

/// What a publication tells of a condition, over its subjects.
struct PublishedMean {
  std::string measure;  ///< "response_time", in s, "percent_correct" or "rating"
  std::string condition;
  double mean = 0, deviation = 0;
};

/// What subjects read.
struct StudyTexts {
  std::string instruction;
  std::string question;
  std::string yes = "yes", no = "no";
  std::string practice_ends = "The practice is over. Press space to begin.";
  std::string pause = "Take a short break. Press space to go on.";
  std::string thanks = "That was the last one. Thank you.";
};

/// An experiment. Read from TOML; docs/studies.md lists the keys.
struct StudyDesign {
  std::string name;
  std::string title;
  std::string task_label;  ///< letters and digits: BIDS's task-<label>
  StudyTask task = StudyTask::path;
  int subjects = 0;     ///< that the design is made for
  int repetitions = 0;  ///< trials of a subject in each condition
  int item_count = 0;   ///< different graphs or pictures; each subject meets each at most once
  TrialOrder order = TrialOrder::balanced;
  TrialArrangement arrangement = TrialArrangement::rounds;
  int practice = 4;  ///< trials that do not count
  int break_every = 20;
  std::uint64_t seed = 1;
  std::vector<StudyFactor> factors;
  std::vector<ControlCondition> controls;
  std::vector<StudyQuestion> questions;
  std::vector<PublishedMean> published;
  ShownSettings shown;
  std::vector<std::string> items;  ///< names of the pictures; empty for graphs
  std::string left, right;         ///< patterns of the pictures' files, with {item} and {FACTOR}
  int scale_least = 1, scale_most = 5;
  StudyTexts texts;
  std::string toml;  ///< the file itself
};

/// A condition as subjects of one group meet it.
struct StudyCondition {
  std::string name;                 ///< "depth_cm=2,views_per_10cm=4", or a control's
  std::vector<std::string> levels;  ///< of each factor; "n/a" in a control condition
  bool is_control = false;
  ShownSettings shown;
};

/// The combinations of the levels of the factors between subjects; one where there are none.
int group_count(const StudyDesign& design);
/// How many conditions each subject meets.
int condition_count(const StudyDesign& design);
/// Those that a subject of the group meets, the last factor's levels in turn first, then the controls.
std::vector<StudyCondition> conditions_of_group(const StudyDesign& design, int group);

/// Reads a design. `name` stands for the file in messages. Throws Error{bad_input} that names a key that is unknown,
/// missing or wrong.
StudyDesign parse_study_design(std::string_view toml, std::string_view name);

/// A built-in design by name, or a TOML file. Throws Error.
StudyDesign load_study_design(const std::string& name_or_path);

struct BuiltInDesign {
  std::string_view name, toml;
};
std::span<const BuiltInDesign> built_in_designs();

/// The design's items are half yes: whether the answer to this one is. Of the items that a subject meets in a condition
/// half are yes where their number is even.
bool is_connected(const StudyDesign& design, int item);

/// An item's graph as it is shown in a condition.
PathGraph graph_of_item(const StudyDesign& design, int item, const ShownSettings& shown, const StudyScreen& screen);

/// An item's files below the folder of stimuli: a graph's, or both eyes' pictures.
std::vector<std::string> stimulus_files(const StudyDesign& design, int item, const StudyCondition& condition);

}  // namespace wheatstone
