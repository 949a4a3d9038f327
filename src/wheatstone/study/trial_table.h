#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "wheatstone/study/study_data.h"

namespace wheatstone {

/// A subject's `_beh.tsv` as BIDS has it: tab-separated, times in s and lengths in m, n/a where there is no value.
/// The columns' names, with the end of the line.
std::string trial_table_header(const StudyDesign& design);

/// One trial as a line of the table, with its end. `simulated` marks observers that are no people.
std::string trial_table_row(const StudyDesign& design, int subject, const TrialRecord& record, bool simulated);

/// Reads a table back. Lines after the last whole one are left out: the machine died while it was written. `name`
/// stands for the file in messages. Throws Error{bad_input} where it is not of this design.
std::vector<TrialRecord> parse_trial_table(const StudyDesign& design, int subject, std::string_view text,
                                           std::string_view name);

/// The sidecar that explains every column, as JSON.
std::string trial_table_sidecar(const StudyDesign& design, bool simulated);

/// Fields of a line between tabs, and lines of a text, without their ends.
std::vector<std::string> fields_of(std::string_view line);
std::vector<std::string> lines_of(std::string_view text);

}  // namespace wheatstone
