#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "wheatstone/study/study_folder.h"

namespace wheatstone {

/// A subject's answers to the questions, by their names, in the order of the design.
using Answers = std::vector<std::pair<std::string, int>>;

/// The subjects of participants.tsv, by their numbers. Throws Error{bad_input} that names the line of one that cannot
/// be, or a subject whose folder is there and that is not listed.
std::vector<int> read_participants(const StudyFolder& folder);

/// The answers of phenotype/questionnaire.tsv, of the subjects that gave any. Throws Error{bad_input} that names the
/// line of an answer that cannot be, and that of a subject that is not among `listed`.
std::map<int, Answers> read_answers(const StudyFolder& folder, const std::vector<int>& listed);

/// Adds a subject to participants.tsv where it is missing.
void list_participant(const StudyFolder& folder, int subject);

/// Writes a subject's row of the questionnaire.
void list_answers(const StudyFolder& folder, const SubjectRecords& subject);

/// The sidecar of participants.tsv.
std::string participants_sidecar(const StudyDesign& design, bool simulated);

/// Whether anything has this name, be it a link that leads nowhere: reading it then says what is wrong.
bool is_there(const std::filesystem::path& file);

/// Makes a folder of a study with those above it. Throws Error{cannot_read_write}.
void make_study_folders(const std::filesystem::path& folder);

}  // namespace wheatstone
