#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "wheatstone/study/study_data.h"
#include "wheatstone/study/trial_log.h"

namespace wheatstone {

/// Whether this folder holds a study already; false where it is missing, empty, or has only stimuli in it, for a study
/// that is to begin. Throws Error{bad_input} where it holds anything else.
bool holds_study(const std::filesystem::path& folder);

/// Throws Error{bad_input} where the folder can hold no data of this design and these observers: where it has those of
/// others, or anything but a study. Writes nothing. See StudyFolder.
void check_study_folder(const std::filesystem::path& path, const StudyDesign& design, bool simulated,
                        std::string_view simulation = {});

/// Throws Error{bad_input} that names a picture of the design that is missing below the study's folder.
void check_stimuli(const std::filesystem::path& path, const StudyDesign& design);

/// A study's folder, laid out as BIDS 1.9 has behavioural data: dataset_description.json, participants.tsv,
/// task-LABEL_beh.json, sub-01/beh/sub-01_task-LABEL_beh.tsv, phenotype/questionnaire.tsv, stimuli/; the design lies in
/// code/design.toml, heads' paths in sourcedata/.
class StudyFolder {
 public:
  /// Makes the folder, or goes on with one of the same design. Data of people and of simulated observers are never
  /// mixed, nor are those of two simulations: `simulation` says how observers answer. Throws Error: bad_input as
  /// check_study_folder, cannot_read_write.
  StudyFolder(std::filesystem::path path, const StudyDesign& design, bool simulated, std::string_view simulation = {});

  const std::filesystem::path& path() const { return path_; }
  const StudyDesign& design() const { return design_; }
  bool simulated() const { return simulated_; }
  std::filesystem::path design_file() const;

  /// Where stimuli lie, with graphs of the design's items for this screen made where they are missing. Throws
  /// Error{bad_input} that names a picture that is missing.
  std::filesystem::path stimuli() const { return path_ / "stimuli"; }
  void make_stimuli(const StudyScreen& screen) const;

  /// A subject's row in participants.tsv, which is added where it is missing.
  void add_participant(int subject) const;
  /// A subject's table of trials.
  std::filesystem::path trial_table(int subject) const;
  /// A subject's path of the head: trial, time in s and place in m.
  std::filesystem::path head_path(int subject) const;
  /// Writes a subject's answers to the questions.
  void write_answers(const SubjectRecords& subject) const;

 private:
  void begin(std::string_view simulation) const;

  std::filesystem::path path_;
  StudyDesign design_;
  bool simulated_;
};

/// The answers that the subject has given so far.
SubjectRecords read_subject(const StudyFolder& folder, int subject);

/// Writes a whole subject, as a simulation makes it.
void write_subject(const StudyFolder& folder, const SubjectRecords& subject);

/// Reads a study's folder. Throws Error{bad_input} that names the file, and the line, of what is missing, broken or
/// contradicts the design.
StudyData read_study(const std::filesystem::path& path);

}  // namespace wheatstone
