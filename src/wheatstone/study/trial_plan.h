#pragma once

#include <string>
#include <vector>

#include "wheatstone/study/study_design.h"

namespace wheatstone {

struct PlannedTrial {
  bool practice = false;
  int condition = 0;  ///< of conditions_of_group
  int item = 0;       ///< from 0 on; those of practice lie behind all others
  int place = 0;      ///< of the condition in its round, or of its block
};

/// Practice, then all trials of a subject, counted from 0, in their order.
std::vector<PlannedTrial> plan_trials(const StudyDesign& design, int subject);

/// Which group of the factors between subjects a subject belongs to.
int group_of_subject(const StudyDesign& design, int subject);

/// What is equal over all subjects of a design, counted from their trials.
struct DesignBalance {
  bool positions = true;  ///< each condition equally often at each place
  bool follows = true;    ///< each condition equally often behind each other one
  bool items = true;      ///< each item equally often in each condition
};
DesignBalance count_balance(const StudyDesign& design);

/// Throws Error{bad_input} where the design's order asks for a balance that its numbers do not allow; says which
/// numbers of subjects, nearest below and above, or of items, do. `name` stands for the file.
void check_balance(const StudyDesign& design, std::string_view name);

/// The square that orders the conditions: "Williams squares of 10 rows", for people.
std::string order_text(const StudyDesign& design);

/// An effect's degrees of freedom, as the analysis will have them.
struct DesignEffect {
  std::string name;
  int effect = 0;          ///< numerator
  int error_subjects = 0;  ///< of F1
  int error_items = 0;     ///< of F2; 0 where items are not analysed
};
std::vector<DesignEffect> degrees_of_freedom(const StudyDesign& design);

}  // namespace wheatstone
