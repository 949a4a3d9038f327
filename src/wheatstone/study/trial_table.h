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

/// Reads a table back. `name` stands for the file in messages. Throws Error{bad_input} that names the line where it is
/// not of this design, of this subject or of these observers, or where a value cannot be.
std::vector<TrialRecord> parse_trial_table(const StudyDesign& design, int subject, std::string_view text,
                                           std::string_view name, bool simulated);

/// The sidecar that explains every column, as JSON.
std::string trial_table_sidecar(const StudyDesign& design, bool simulated);

}  // namespace wheatstone
