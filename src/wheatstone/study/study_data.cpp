#include "wheatstone/study/study_data.h"

#include <fmt/format.h>

#include "wheatstone/error.h"

namespace wheatstone {

std::optional<bool> is_correct(const StudyDesign& design, const TrialRecord& record) {
  if (design.task != StudyTask::path) return {};
  return (record.response == 1) == is_connected(design, record.item);
}

std::string subject_label(const StudyDesign& design, int subject) {
  return fmt::format("{:0{}}", subject + 1, design.subjects < 100 ? 2 : design.subjects < 1000 ? 3 : 5);
}

void check_subject(const StudyDesign& design, int subject) {
  if (subject < 0 || subject >= design.subjects)
    throw Error(ErrorKind::bad_input,
                fmt::format("subject: is {}, expected a number from 1 to {}", subject + 1, design.subjects));
}

std::string item_name(const StudyDesign& design, int item) {
  if (design.items.empty()) return fmt::format("item-{:03}", item + 1);
  return design.items[static_cast<std::size_t>(item)];
}

}  // namespace wheatstone
