#pragma once

#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "wheatstone/study/study_design.h"

namespace wheatstone {

inline constexpr double not_available = std::numeric_limits<double>::quiet_NaN();

/// One answered trial. Answers of a path task are 1 for yes and 0 for no; of a rating, its number.
struct TrialRecord {
  int trial = 0;      ///< from 1 on; those of practice are not recorded
  int condition = 0;  ///< of conditions_of_group
  int item = 0;       ///< from 0 on
  int response = 0;
  double response_time_s = 0;           ///< from the frame that was shown first to the key
  double head_least_m = not_available;  ///< of the head's way to the sides, to the right of the middle
  double head_most_m = not_available;
  double log_delay_s = not_available;  ///< from the key to its record
};

struct SubjectRecords {
  int number = 0;  ///< from 0 on: its row of the design
  std::vector<TrialRecord> trials;
  std::vector<std::pair<std::string, int>> answers;  ///< to the questions, by their names
};

/// All that a study has brought so far.
struct StudyData {
  StudyDesign design;
  bool simulated = false;  ///< by observers that are no people
  std::vector<SubjectRecords> subjects;
};

/// Whether an answer is right; none for a rating.
std::optional<bool> is_correct(const StudyDesign& design, const TrialRecord& record);

/// "01": the label of a subject in names of files.
std::string subject_label(const StudyDesign& design, int subject);

/// Throws Error{bad_input} where a subject, counted from 0, has no row in the design.
void check_subject(const StudyDesign& design, int subject);

/// The name of an item: "item-012", or the picture's.
std::string item_name(const StudyDesign& design, int item);

}  // namespace wheatstone
